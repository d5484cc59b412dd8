// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The page as a sink: a small web server, read-only, for a few viewers at once.

#include <Eigen/Core>  // before httplib.h, which brings macros of the resolver that Eigen's names collide with

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/page/broadcast.hpp"
#include "apps/live/page/events.hpp"
#include "apps/live/page/roadway_events.hpp"
#include "apps/live/result_json.hpp"
#include "io/config_file/key_table.hpp"
#include "study/report/assets.hpp"

namespace pose_wall::tools::live {
namespace {

// Each viewer takes a thread; some are left for those who only ask once.
constexpr std::size_t kViewersMost = 16, kThreads = kViewersMost + 4;
// A viewer that takes nothing for so long is cut off; its browser comes back by itself.
constexpr int kWriteTimeout_us = 400'000;
// Of a request: whoever is slower holds a thread for nothing.
constexpr int kReadTimeout_s = 5;
constexpr std::size_t kRequestMost = 4096;  // a body is never wanted
// A viewer hears something at least so often, so that one that is gone is noticed.
constexpr int kWait_ms = 500;
// Ten publications of silence.
constexpr std::int64_t kOld_ns = 1'000'000'000;
// As /diagnostics of ROS.
constexpr std::int64_t kHealthEvery_ns = 1'000'000'000;

// Everything comes from this server, nothing is framed, nothing else is asked.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

// "localhost:8080", "[::1]:8080".
std::string host_of(const std::string& header) {
  if (!header.empty() && header.front() == '[') return header.substr(1, header.find(']') - 1);
  return header.substr(0, header.rfind(':'));
}

std::string text(std::string_view view) {
  return std::string(view);
}

class PageServer final : public Sink {
 public:
  PageServer(const LoadedConfig& loaded, const HealthBoard& board, const StopBoard* stop)
      : loaded_(loaded),
        board_(board),
        stop_(stop),
        line_(stop_settings_of(loaded.planar), config_text(*loaded.config.get(), "forward_axis")),
        place_(*parse_host_port(loaded.live.http)),
        assets_(report::live_assets()) {}
  ~PageServer() override { stop(); }

  void start() override {
    prepare();
    if (!server_.bind_to_port(place_.host, place_.port)) {
      throw std::runtime_error(
          fmt::format("http: cannot listen at {}: the port is taken, not allowed, or the address is not this machine's",
                      loaded_.live.http));
    }
    log_line(Grade::kGood, part(),
             fmt::format("http://{} shows the page; {}", loaded_.live.http,
                         is_loopback(place_.host) ? "only this machine reaches it"
                                                  : "everybody who reaches this address may look, nobody can change"));
    broadcast_.post(Broadcast::kHello, hello_event(loaded_));
    thread_ = std::thread([this] { server_.listen_after_bind(); });
  }

  void take(const LiveResult& result) override {
    {
      const std::lock_guard<std::mutex> locked(newest_lock_);
      newest_ = result;
      newest_.frame.reset();
      newest_.points.reset();
      has_newest_ = true;
    }
    tell_new_config(result.config);
    if (viewers_ == 0) return;
    broadcast_.post(Broadcast::kFrame, frame_event(result));
  }

  bool wants_planar() const override { return stop_ != nullptr; }
  void take_stop(const StopNews& news) override {
    if (viewers_ > 0) broadcast_.post(Broadcast::kStop, stop_event(news, line_));
  }
  void take_roadway(const RoadwayNews& news) override {
    {
      const std::lock_guard<std::mutex> locked(newest_lock_);
      newest_roadway_ = std::make_shared<const RoadwayNews>(news);
    }
    if (viewers_ == 0) return;
    if (news.map && map_told_.exchange(news.map->version) != news.map->version) {
      broadcast_.post(Broadcast::kMap, map_event(*news.map));
    }
    broadcast_.post(Broadcast::kRoadway, roadway_event(news));
  }

  void stop() override {
    broadcast_.end();
    server_.stop();
    if (thread_.joinable()) thread_.join();
  }

  PartHealth health() const override {
    PartHealth health;
    health.part = part();
    health.summary = "serves";
    health.add("viewers", static_cast<std::uint64_t>(viewers_.load()));
    health.add("viewers turned away", turned_away_.load());
    health.add("events sent", sent_.load());
    health.add("viewers cut off", cut_off_.load());
    return health;
  }

  bool wants_points() const override { return viewers_ > 0; }
  bool wants_clouds() const override { return viewers_ > 0; }

 private:
  std::string part() const { return "sink page " + loaded_.live.http; }

  // The extrinsic may come from tf.
  void tell_new_config(const pose_wall_config& config) {
    if (std::memcmp(&config, loaded_.config.get(), sizeof config) == 0) return;
    *loaded_.config.get() = config;
    broadcast_.post(Broadcast::kHello, hello_event(loaded_));
  }

  void prepare() {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // The library's own options let a second server take the same port, and neither would know.
    server_.set_socket_options([](int file) {
      const int on = 1;
      setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    server_.set_read_timeout(kReadTimeout_s, 0);
    server_.set_write_timeout(0, kWriteTimeout_us);
    server_.set_payload_max_length(kRequestMost);
    server_.set_keep_alive_max_count(20);
    server_.set_default_headers({{"Content-Security-Policy", kPolicy},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cache-Control", "no-store"}});
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& answer) {
      return is_allowed(request, &answer) ? httplib::Server::HandlerResponse::Unhandled
                                          : httplib::Server::HandlerResponse::Handled;
    });
    const auto give = [this](const char* path, std::string content, const char* type) {
      server_.Get(path, [content = std::move(content), type](const httplib::Request&, httplib::Response& answer) {
        answer.set_content(content, type);
      });
    };
    give("/", text(assets_.html), "text/html; charset=utf-8");
    give("/page.css", text(assets_.style), "text/css; charset=utf-8");
    give("/page.js", text(assets_.script), "text/javascript; charset=utf-8");
    server_.Get("/events", [this](const httplib::Request&, httplib::Response& answer) { view(&answer); });
    server_.Get("/state.json", [this](const httplib::Request&, httplib::Response& answer) { tell_state(&answer); });
    server_.Get("/planar.json", [this](const httplib::Request&, httplib::Response& answer) { tell_planar(&answer); });
    server_.Get("/map.png", [this](const httplib::Request&, httplib::Response& answer) { give_map(&answer); });
    server_.Get("/health", [this](const httplib::Request&, httplib::Response& answer) { tell_health(&answer); });
  }

  // Nothing but reading; and on loopback only under this machine's own names, or a page of somebody else's whose name
  // is pointed here could read it (DNS rebinding).
  bool is_allowed(const httplib::Request& request, httplib::Response* answer) const {
    if (request.method != "GET" && request.method != "HEAD") {
      answer->status = 405;
      answer->set_header("Allow", "GET, HEAD");
      answer->set_content("only GET and HEAD: nothing can be changed here\n", "text/plain");
      return false;
    }
    // One small request could ask for the page a thousand times.
    if (request.has_header("Range")) {
      answer->status = 416;
      answer->set_content("parts are not given\n", "text/plain");
      return false;
    }
    if (is_loopback(place_.host) && !is_loopback(host_of(request.get_header_value("Host")))) {
      answer->status = 421;
      answer->set_content("ask for localhost or 127.0.0.1\n", "text/plain");
      return false;
    }
    return true;
  }

  void view(httplib::Response* answer) {
    if (viewers_.fetch_add(1) >= kViewersMost) {
      --viewers_;
      ++turned_away_;
      answer->status = 503;
      answer->set_header("Retry-After", "5");
      answer->set_content(fmt::format("{} viewers look already\n", kViewersMost), "text/plain");
      return;
    }
    const auto seen = std::make_shared<Broadcast::Seen>();
    answer->set_chunked_content_provider(
        "text/event-stream",
        [this, seen](std::size_t, httplib::DataSink& sink) { return send_news(seen.get(), &sink); },
        [this](bool) {
          // Who comes later must not see what was live when the last one left.
          if (--viewers_ > 0) return;
          broadcast_.forget_frames();
          map_told_ = 0;
        });
  }

  // By the threads of the viewers, for a worker that hangs publishes nothing; one of those that come at once tells it.
  void tell_health_now_and_then() {
    std::int64_t last_ns = health_last_ns_;
    const std::int64_t now_ns = monotonic_ns();
    if (now_ns - last_ns < kHealthEvery_ns || !health_last_ns_.compare_exchange_strong(last_ns, now_ns)) return;
    broadcast_.post(Broadcast::kHealth, health_event(board_.all()));
  }

  // One round for one viewer; false at its end.
  bool send_news(Broadcast::Seen* seen, httplib::DataSink* sink) {
    const auto news = broadcast_.next(seen, kWait_ms);
    if (broadcast_.is_ending()) return false;
    static const std::string kAlive = ": here\n\n";
    tell_health_now_and_then();
    if (news.empty()) return sink->write(kAlive.data(), kAlive.size());
    for (const auto& event : news) {
      if (!sink->write(event->data(), event->size())) {
        ++cut_off_;
        return false;
      }
      ++sent_;
    }
    return true;
  }

  void tell_state(httplib::Response* answer) {
    const std::lock_guard<std::mutex> locked(newest_lock_);
    if (!has_newest_) {
      answer->status = 503;
      answer->set_content("{\"error\": \"nothing was published yet\"}\n", "application/json");
      return;
    }
    // Silence is published, too: what is older was left by a worker that hangs.
    if (monotonic_ns() - newest_.publication.published_ns > kOld_ns) answer->status = 503;
    answer->set_content(result_json(newest_) + "\n", "application/json");
  }

  std::shared_ptr<const RoadwayNews> newest_roadway() {
    const std::lock_guard<std::mutex> locked(newest_lock_);
    return newest_roadway_;
  }

  void tell_planar(httplib::Response* answer) {
    if (stop_ == nullptr) {
      answer->status = 404;
      answer->set_content("{\"error\": \"the key planar is off\"}\n", "application/json");
      return;
    }
    const std::shared_ptr<const RoadwayNews> roadway = newest_roadway();
    answer->set_content(fmt::format("{{\"stop\": {}, \"roadway\": {}}}\n", stop_json(stop_->stop_now(), line_),
                                    roadway ? roadway_json(*roadway) : "null"),
                        "application/json");
  }

  void give_map(httplib::Response* answer) {
    const std::shared_ptr<const RoadwayNews> roadway = newest_roadway();
    if (roadway && roadway->map) return answer->set_content(map_png(*roadway->map), "image/png");
    answer->status = 404;
    answer->set_content("there is no map\n", "text/plain");
  }

  // For monitors: the runtime comes first.
  void tell_health(httplib::Response* answer) {
    const std::vector<PartHealth> parts = board_.all();
    const bool is_bad =
        std::any_of(parts.begin(), parts.end(), [](const PartHealth& part) { return part.grade >= Grade::kBad; });
    answer->status = is_bad ? 503 : 200;
    answer->set_content(health_json(parts) + "\n", "application/json");
  }

  LoadedConfig loaded_;
  const HealthBoard& board_;
  const StopBoard* stop_;
  const StopLine line_;
  HostPort place_;
  report::Assets assets_;
  httplib::Server server_;
  Broadcast broadcast_;
  std::thread thread_;
  std::atomic<std::size_t> viewers_{0};
  std::atomic<std::uint64_t> turned_away_{0}, sent_{0}, cut_off_{0};
  std::atomic<std::int64_t> health_last_ns_{-kHealthEvery_ns};
  std::mutex newest_lock_;
  LiveResult newest_;
  bool has_newest_ = false;
  std::shared_ptr<const RoadwayNews> newest_roadway_;
  std::atomic<std::uint64_t> map_told_{0};  // version that the viewers have
};

}  // namespace

std::unique_ptr<Sink> make_page_sink(const LoadedConfig& loaded, const HealthBoard& health, const StopBoard* stop) {
  return std::make_unique<PageServer>(loaded, health, stop);
}

}  // namespace pose_wall::tools::live
