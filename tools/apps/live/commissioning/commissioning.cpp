// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Commissioning from the page. As a sink it records the clouds of a standing machine; on the page's server it takes the
// steps that a person asks for. A thread of its own works them out, one at a time.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "apps/live/clocks.hpp"
#include "apps/live/commissioning/door.hpp"
#include "apps/live/commissioning/steps.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/thread_name.hpp"
#include "apps/live/web/web_server.hpp"
#include "io/config_file/key_table.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr const char* kPart = "commissioning";
constexpr const char* kCookie = "pose_wall_commissioning=";
// What doctor asks for; a cloud every hundred years is no recording.
constexpr double kRecordedLeast_s = 2.0, kRecordedMost_s = 120.0, kRecordedUsually_s = 30.0;
// Two minutes of an OS0-128 with 2048 columns at 10 Hz, 24 bytes a point; so nothing of a recording is deleted.
constexpr double kRoom_mb = 8000.0;
constexpr std::int64_t kLook_ns = 100'000'000;  // a cloud of the usual sensors
// As of a source (udp_source.cpp): a sensor that was unplugged meanwhile, and no late cloud.
constexpr std::int64_t kSilent_ns = 1'000'000'000;

// The report is a page of its own, with its scripts in it: it may show, and reach nothing.
constexpr const char* kReportPolicy =
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:";

WebAnswer json_answer(int status, const Json& content) {
  // What a command or a path has that is no UTF-8 is replaced, not thrown.
  return web_answer(status, "application/json", content.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

WebAnswer refusal(int status, const std::string& why) {
  return json_answer(status, {{"error", why}});
}

std::string token_of(const std::string& cookies) {
  std::size_t at = cookies.find(kCookie);
  while (at != std::string::npos && at != 0 && cookies[at - 1] != ' ') at = cookies.find(kCookie, at + 1);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + std::string_view(kCookie).size();
  return cookies.substr(begin, cookies.find(';', begin) - begin);
}

std::string language_of(const Json& asked) {
  return asked.value("language", "en") == "zh" ? "zh" : "en";
}

// The recorder into the folder of the recording, whatever the settings record elsewhere.
LoadedConfig settings_of_recorder(LoadedConfig loaded, const std::string& folder) {
  loaded.live.recording = folder;
  loaded.live.recording_mb = kRoom_mb;
  loaded.live.recording_clouds = true;
  return loaded;
}

class CommissioningDesk final : public Commissioning {
 public:
  CommissioningDesk(const LoadedConfig& loaded, const HealthBoard& board, std::function<void()> restart)
      : is_secure_(!loaded.live.http_certificate.empty()),
        steps_(loaded),
        loaded_(settings_of_recorder(loaded, steps_.recording_folder())),
        board_(board),
        restart_(std::move(restart)) {}
  ~CommissioningDesk() override { stop(); }

  // ------------------------------------------------ as a sink

  void start() override {
    tell_code();
    thread_ = std::thread([this] { work(); });
  }

  void take(const LiveResult& result) override {
    if (!result.frame) return;
    const std::lock_guard<std::mutex> locked(recorder_lock_);
    if (!recorder_) return;
    recorder_->take(result);
    note_cloud();
  }

  void stop() override {
    {
      const std::lock_guard<std::mutex> locked(lock_);
      ending_ = true;
    }
    wakes_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  PartHealth health() const override {
    const std::lock_guard<std::mutex> locked(lock_);
    PartHealth health;
    health.part = kPart;
    health.grade = Grade::kWarning;  // it is no state to leave a machine in
    health.summary = door_.token().empty() ? "waits for the code" : "a page is open";
    health.add("works at", busy_.empty() ? "-" : busy_);
    health.add("codes that were wrong", wrong_codes_);
    return health;
  }

  std::size_t backlog() const override { return 20; }  // as the recorder's
  bool wants_clouds() const override { return records_; }

  // ------------------------------------------------ on the page's server

  void serve(WebServer& server) override {
    server.post("/commissioning/open", [this](const WebRequest& request) { return open(request); });
    server.get("/commissioning.json", [this](const WebRequest& request) { return state(request); });
    const auto step = [this, &server](const std::string& name, Job (CommissioningDesk::*job)(const Json&)) {
      server.post("/commissioning/" + name,
                  [this, name, job](const WebRequest& request) { return begin(request, name, job); });
    };
    step("record", &CommissioningDesk::to_record);
    step("examine", &CommissioningDesk::to_examine);
    step("check", &CommissioningDesk::to_check);
    step("save", &CommissioningDesk::to_save);
    step("restart", &CommissioningDesk::to_restart);
    server.get("/commissioning/report.html", [this](const WebRequest& request) {
      return file(request, steps_.report_file(), "text/html; charset=utf-8",
                  {"content-security-policy", kReportPolicy});
    });
    server.get("/commissioning/evidence.zip", [this](const WebRequest& request) {
      return file(request, steps_.evidence_file(), "application/zip",
                  {"content-disposition", "attachment; filename=evidence.zip"});
    });
  }

 private:
  using Job = std::function<void()>;

  // By the server's thread, or before it starts.
  void tell_code() const {
    log_anyway(Grade::kWarning, kPart, fmt::format("the code that opens the page once is {}", door_.code()));
  }

  bool admits(const WebRequest& request, bool is_at_work = true) {
    const std::lock_guard<std::mutex> locked(lock_);
    return door_.admits(token_of(request.cookies), is_at_work);
  }

  WebAnswer open(const WebRequest& request) {
    const Json asked = Json::parse(request.body, nullptr, false);
    if (!asked.is_object() || !asked.contains("code") || !asked["code"].is_string()) {
      return refusal(400, R"({"code": "..."} is expected)");
    }
    const std::lock_guard<std::mutex> locked(lock_);
    switch (door_.open(asked["code"].get<std::string>())) {
      case Door::Try::kTooOften:
        return refusal(429, "too many tries at once");
      case Door::Try::kWrong:
        ++wrong_codes_;
        log_anyway(Grade::kWarning, kPart, "somebody tried a wrong code");
        return refusal(403, "this is not the code that the log shows last");
      case Door::Try::kOpened:
        break;
    }
    log_anyway(Grade::kWarning, kPart, "a page is open, and any other one is shut");
    tell_code();
    WebAnswer answer = json_answer(200, {{"open", true}});
    answer.headers.emplace_back("set-cookie", fmt::format("{}{}; Path=/; HttpOnly; SameSite=Strict{}", kCookie,
                                                          door_.token(), is_secure_ ? "; Secure" : ""));
    return answer;
  }

  // A page that only looks holds nobody else's place.
  WebAnswer state(const WebRequest& request) {
    if (!admits(request, false)) return json_answer(200, {{"schema", 1}, {"open", false}});
    Json told = {{"schema", 1}, {"open", true}, {"mounting", steps_.mounting()}};
    const std::lock_guard<std::mutex> locked(lock_);
    told["to_confirm"] = to_confirm();
    told["busy"] = busy_;
    told["busy_s"] = busy_.empty() ? 0.0 : static_cast<double>(monotonic_ns() - busy_since_ns_) * 1e-9;
    told["error"] = error_;
    told["clouds"] = clouds_.load();
    told["recorded"] = recorded_;
    told["examined"] = examined_;
    told["checked"] = checked_;
    told["saved"] = saved_;
    return json_answer(200, told);
  }

  // What is asked is looked at now, and done by the thread.
  WebAnswer begin(const WebRequest& request, const std::string& name, Job (CommissioningDesk::*job)(const Json&)) {
    if (!admits(request))
      return refusal(403, "this page is not open for commissioning: give the code that the log shows");
    const Json asked = Json::parse(request.body, nullptr, false);
    if (!asked.is_object()) return refusal(400, "a JSON object is expected");
    const std::lock_guard<std::mutex> locked(lock_);
    if (!busy_.empty()) return refusal(409, "it is still at work");
    try {
      job_ = (this->*job)(asked);
    } catch (const Json::exception&) {
      return refusal(400, "a member is missing, or is of another kind");
    } catch (const std::exception& fault) {
      return refusal(409, fault.what());
    }
    busy_ = name;
    busy_since_ns_ = monotonic_ns();
    error_.clear();
    wakes_.notify_all();
    return json_answer(202, {{"busy", name}});
  }

  WebAnswer file(const WebRequest& request, const std::filesystem::path& path, const char* type,
                 std::pair<std::string, std::string> header) {
    if (!admits(request)) return web_answer(403, "text/plain", "this page is not open for commissioning\n");
    if (!std::filesystem::exists(path)) return web_answer(404, "text/plain", "this was not made yet\n");
    WebAnswer answer;
    answer.type = type;
    answer.file = path;
    answer.headers.push_back(std::move(header));
    return answer;
  }

  // ------------------------------------------------ the steps; with lock_ held

  // What a person must have looked at before anything is saved: what frames cannot show, and what they contradict.
  std::vector<std::string> to_confirm() const {
    std::vector<std::string> all = {"ahead", "mounting", "boxes"};
    if (examined_.is_null()) return all;
    if (examined_.value("grade", "") == "not") all.emplace_back("not_usable");
    const Json road = examined_.value("road", Json::object());
    const bool is_otherwise = road.value("ahead_known", false) && !checked_.is_null() &&
                              checked_.at("forward_axis") != road.at("forward_axis");
    if (is_otherwise) all.emplace_back("ahead_otherwise");
    return all;
  }

  Job to_record(const Json& asked) {
    const double seconds = asked.value("seconds", kRecordedUsually_s);
    if (!(seconds >= kRecordedLeast_s && seconds <= kRecordedMost_s)) {
      throw std::runtime_error(fmt::format("seconds: {} to {} are allowed", kRecordedLeast_s, kRecordedMost_s));
    }
    recorded_ = examined_ = checked_ = saved_ = nullptr;
    return [this, seconds] { record(seconds); };
  }

  Job to_examine(const Json& asked) {
    if (recorded_.is_null()) throw std::runtime_error("nothing was recorded yet");
    examined_ = checked_ = saved_ = nullptr;
    return [this, language = language_of(asked)] { keep(&examined_, steps_.examine(language, ending_)); };
  }

  Job to_check(const Json& asked) {
    if (examined_.is_null()) throw std::runtime_error("the recording was not examined yet");
    const Changes changes = asked.at("changes").get<Changes>();
    checked_ = saved_ = nullptr;
    return
        [this, changes, language = language_of(asked)] { keep(&checked_, steps_.check(changes, language, ending_)); };
  }

  Job to_save(const Json& asked) {
    if (checked_.is_null()) throw std::runtime_error("nothing was checked yet");
    const auto by = asked.at("by").get<std::string>();
    if (by.empty()) throw std::runtime_error("by: the name of who commissions is missing");
    for (const std::string& one : to_confirm()) {
      if (!asked.at("confirmed").value(one, false)) throw std::runtime_error("not all is confirmed: tick every box");
    }
    if (asked.at("config_crc32") != checked_.at("config_crc32")) {
      throw std::runtime_error("the page shows other settings than those that were checked");
    }
    const Json who = {{"by", by}, {"confirmed", asked.at("confirmed")}};
    return [this, who, language = language_of(asked), examined = examined_, checked = checked_] {
      const Json evidence = steps_.save(who, examined, checked, language, ending_);
      log_anyway(Grade::kWarning, kPart, "settings were saved; they count from the next start on");
      keep(&saved_, {{"config_crc32", checked.at("config_crc32")}, {"evidence", evidence}});
    };
  }

  // Settings that cannot be read would end it for good.
  Job to_restart(const Json& /*asked*/) {
    load_config(loaded_.asked_files, loaded_.asked_settings);
    return [this] {
      log_anyway(Grade::kWarning, kPart, "the page asks for a start with the settings that are saved");
      restart_();
    };
  }

  // ------------------------------------------------ the thread

  void work() {
    name_this_thread("commissioning");
    std::unique_lock<std::mutex> locked(lock_);
    while (true) {
      wakes_.wait(locked, [this] { return ending_ || job_; });
      if (ending_) return;
      const Job job = std::exchange(job_, nullptr);
      locked.unlock();
      std::string error;
      try {
        job();
      } catch (const std::exception& fault) {
        error = fault.what();
      }
      locked.lock();
      if (!error.empty()) log_line(Grade::kWarning, kPart, fmt::format("{}: {}", busy_, error));
      error_ = error;
      busy_.clear();
    }
  }

  void keep(Json* where, Json what) {
    const std::lock_guard<std::mutex> locked(lock_);
    *where = std::move(what);
  }

  // With recorder_lock_ held.
  void note_cloud() {
    const std::int64_t now_ns = monotonic_ns();
    longest_silence_ns_ = std::max(longest_silence_ns_, now_ns - last_cloud_ns_);
    last_cloud_ns_ = now_ns;
    ++clouds_;
  }

  void record(double seconds) {
    steps_.forget_recording();
    std::unique_ptr<Sink> recorder = make_recorder(loaded_, board_);
    recorder->start();
    {
      const std::lock_guard<std::mutex> locked(recorder_lock_);
      recorder_ = recorder.get();
      clouds_ = 0;
      longest_silence_ns_ = 0;
      last_cloud_ns_ = monotonic_ns();
    }
    records_ = true;
    const std::int64_t until_ns = monotonic_ns() + static_cast<std::int64_t>(seconds * 1e9);
    while (!ending_ && monotonic_ns() < until_ns) std::this_thread::sleep_for(std::chrono::nanoseconds(kLook_ns));
    records_ = false;
    {
      const std::lock_guard<std::mutex> locked(recorder_lock_);
      recorder_ = nullptr;
      longest_silence_ns_ = std::max(longest_silence_ns_, monotonic_ns() - last_cloud_ns_);
    }
    recorder->stop();
    const PartHealth health = recorder->health();
    const bool is_whole = std::count(health.facts.begin(), health.facts.end(),
                                     std::make_pair(std::string("results not recorded"), std::string("0"))) == 1;
    if (health.grade != Grade::kGood || !is_whole) {
      steps_.forget_recording();
      throw std::runtime_error(is_whole ? health.summary : "the disk did not keep up: record again");
    }
    if (clouds_ == 0) throw std::runtime_error("no cloud came while it was recorded: look at the source");
    if (longest_silence_ns_ > kSilent_ns && !ending_) {
      steps_.forget_recording();
      throw std::runtime_error("the sensor was silent while it was recorded: look at its cable, and record again");
    }
    keep(&recorded_, {{"seconds", seconds}, {"clouds", clouds_.load()}});
  }

  const bool is_secure_;
  CommissioningSteps steps_;
  LoadedConfig loaded_;
  const HealthBoard& board_;
  std::function<void()> restart_;

  mutable std::mutex lock_;  // of all down to the thread
  std::condition_variable wakes_;
  Door door_;
  std::uint64_t wrong_codes_ = 0;
  Job job_;
  std::string busy_, error_;
  std::int64_t busy_since_ns_ = 0;
  Json recorded_, examined_, checked_, saved_;

  std::mutex recorder_lock_;
  Sink* recorder_ = nullptr;  // while it records
  std::int64_t last_cloud_ns_ = 0, longest_silence_ns_ = 0;
  std::atomic<std::uint64_t> clouds_{0};
  std::atomic<bool> records_{false}, ending_{false};
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Commissioning> make_commissioning(const LoadedConfig& loaded, const HealthBoard& health,
                                                  std::function<void()> restart) {
  return std::make_unique<CommissioningDesk>(loaded, health, std::move(restart));
}

}  // namespace pose_wall::tools::live
