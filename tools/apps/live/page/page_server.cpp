// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The page as a sink: a small web server, read-only, for a few viewers at once.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "apps/live/page/api/openapi.hpp"
#include "apps/live/page/broadcast.hpp"
#include "apps/live/page/events.hpp"
#include "apps/live/page/open_metrics.hpp"
#include "apps/live/page/probes.hpp"
#include "apps/live/page/roadway_events.hpp"
#include "apps/live/result_json.hpp"
#include "apps/live/web/web_server.hpp"
#include "io/config_file/key_table.hpp"
#include "study/report/assets.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::size_t kViewersMost = 16;  // each takes a frame's events ten times a second
// A viewer hears something at least so often, so that one that is gone is noticed: at each turn of the server's timer.
constexpr std::int64_t kSilentMost_ns = 500'000'000;
// As /diagnostics of ROS.
constexpr std::int64_t kHealthEvery_ns = 1'000'000'000;

// Everything comes from this server, nothing is framed, nothing else is asked.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

WebAnswer json(int status, const std::string& content) {
  return web_answer(status, "application/json", content + "\n");
}

class PageServer final : public Sink {
 public:
  PageServer(const LoadedConfig& loaded, const HealthBoard& board, const StopBoard* stop, WebPart* more)
      : loaded_(loaded),
        board_(board),
        stop_(stop),
        more_(more),
        config_crc32_(config_crc(*loaded.config.get())),
        line_(stop_settings_of(loaded.planar), config_text(*loaded.config.get(), "forward_axis")),
        place_(*parse_host_port(loaded.live.http)),
        server_(place_, WebAccess(loaded.live, place_),
                {{"content-security-policy", kPolicy},
                 {"x-content-type-options", "nosniff"},
                 {"referrer-policy", "no-referrer"},
                 {"cache-control", "no-store"}}) {}
  ~PageServer() override { stop(); }

  void start() override {
    prepare();
    broadcast_.post(Broadcast::kHello, hello_event(loaded_));  // a viewer gets it first
    try {
      server_.start();
    } catch (const std::exception& fault) {
      throw std::runtime_error(fmt::format("http: {}", fault.what()));
    }
    const std::string address = fmt::format("{}://{}", server_.access().scheme(), loaded_.live.http);
    log_line(Grade::kGood, part(),
             fmt::format("{} shows the page; {}", address,
                         is_loopback(place_.host)            ? "only this machine reaches it"
                         : server_.access().asks_for_login() ? "who has a login may look"
                                                             : "everybody who reaches this address may look"));
  }

  void take(const LiveResult& result) override {
    tell_new_config(result.config);
    if (viewers_ == 0) return;
    tell(Broadcast::kFrame, frame_event(result));
  }

  bool wants_planar() const override { return stop_ != nullptr; }
  void take_stop(const StopNews& news) override {
    if (viewers_ > 0) tell(Broadcast::kStop, stop_event(news, line_));
  }
  void take_roadway(const RoadwayNews& news) override {
    {
      const std::lock_guard<std::mutex> locked(roadway_lock_);
      newest_roadway_ = std::make_shared<const RoadwayNews>(news);
    }
    if (viewers_ == 0) return;
    if (news.map && map_told_.exchange(news.map->version) != news.map->version) {
      tell(Broadcast::kMap, map_event(*news.map));
    }
    tell(Broadcast::kRoadway, roadway_event(news));
  }

  void stop() override { server_.stop(); }

  PartHealth health() const override {
    PartHealth health;
    health.part = part();
    health.grade = server_.serves() ? Grade::kGood : Grade::kBad;
    health.summary = server_.serves() ? "serves" : "serves no more: its loop failed";
    health.add("viewers", static_cast<std::uint64_t>(viewers_.load()));
    health.add("viewers turned away", turned_away_.load());
    health.add("events sent", sent_.load());
    health.add("viewers cut off", server_.cut_off());
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
    config_crc32_ = config_crc(config);
    tell(Broadcast::kHello, hello_event(loaded_));
  }

  void tell(Broadcast::Kind kind, std::string event) {
    broadcast_.post(kind, std::move(event));
    server_.wake();
  }

  void prepare() {
    const report::Assets assets = report::live_assets();
    const auto give = [this](const char* path, std::string_view content, const char* type) {
      const auto shared = std::make_shared<const std::string>(content);
      server_.get(path, [shared, type] { return web_answer(200, type, shared); });
    };
    give("/", assets.html, "text/html; charset=utf-8");
    give("/page.css", assets.style, "text/css; charset=utf-8");
    give("/page.js", assets.script, "text/javascript; charset=utf-8");
    give("/three.js", report::three_library(), "text/javascript; charset=utf-8");
    give("/openapi.json", openapi(), "application/json");
    server_.get("/events", [this] { return view(); });
    server_.get("/state.json", [this] { return state(); });
    server_.get("/planar.json", [this] { return planar(); });
    server_.get("/map.png", [this] { return map(); });
    server_.get("/health", [this] { return health_of_all(); });
    if (more_ != nullptr) more_->serve(server_);
    server_.get("/live", [this] { return probe("live", live_probe(moment())); });
    server_.get("/ready", [this] { return probe("ready", ready_probe(moment())); });
    server_.get("/metrics", [this](const WebRequest& request) {
      const MetricsFormat format = metrics_format(request.accept);
      return web_answer(200, metrics_type(format), metrics_text(moment(), format));
    });
  }

  // What one viewer is sent.
  class View final : public WebStream {
   public:
    explicit View(PageServer& page) : page_(page) {}
    ~View() override { page_.forget_viewer(); }

    std::shared_ptr<const std::string> next() override {
      static const auto kAlive = std::make_shared<const std::string>(": here\n\n");
      page_.tell_health_now_and_then();
      std::shared_ptr<const std::string> news = page_.broadcast_.next(&seen_);
      if (news) ++page_.sent_;
      const std::int64_t now_ns = monotonic_ns();
      if (!news && now_ns - said_ns_ >= kSilentMost_ns) news = kAlive;
      if (news) said_ns_ = now_ns;
      return news;
    }

   private:
    PageServer& page_;
    Broadcast::Seen seen_{};
    std::int64_t said_ns_ = 0;
  };

  WebAnswer view() {
    if (viewers_ >= kViewersMost) {
      ++turned_away_;
      WebAnswer answer = web_answer(503, "text/plain", fmt::format("{} viewers look already\n", kViewersMost));
      answer.headers.emplace_back("retry-after", "5");
      return answer;
    }
    ++viewers_;
    WebAnswer answer;
    answer.type = "text/event-stream";
    answer.stream = std::make_unique<View>(*this);
    return answer;
  }

  // Who comes later must not see what was live when the last one left.
  void forget_viewer() {
    if (--viewers_ > 0) return;
    broadcast_.forget_frames();
    map_told_ = 0;
  }

  // By the server's thread, for a worker that hangs publishes nothing.
  void tell_health_now_and_then() {
    const std::int64_t now_ns = monotonic_ns();
    if (now_ns - health_last_ns_ < kHealthEvery_ns) return;
    health_last_ns_ = now_ns;
    tell(Broadcast::kHealth, health_event(board_.all()));
  }

  // Silence is published, too: what is stale was left by a worker that is late or hangs.
  WebAnswer state() const {
    const Newest newest = board_.newest();
    if (!newest.is_there()) return json(503, R"({"error": "nothing was published yet"})");
    if (!newest.is_fresh()) return json(503, R"({"error": "the newest result is stale: nothing may steer"})");
    return json(200, result_json(newest.result));
  }

  std::shared_ptr<const RoadwayNews> newest_roadway() {
    const std::lock_guard<std::mutex> locked(roadway_lock_);
    return newest_roadway_;
  }

  WebAnswer planar() {
    if (stop_ == nullptr) return json(404, R"({"error": "the key planar is off"})");
    const std::shared_ptr<const RoadwayNews> roadway = newest_roadway();
    return json(200, fmt::format(R"({{"schema": 1, "stop": {}, "roadway": {}}})", stop_json(stop_->stop_now(), line_),
                                 roadway ? roadway_json(*roadway) : "null"));
  }

  // A picture takes long beside the other answers, so one serves until the map changes.
  WebAnswer map() {
    const std::shared_ptr<const RoadwayNews> roadway = newest_roadway();
    if (!roadway || !roadway->map) return web_answer(404, "text/plain", "there is no map\n");
    if (!picture_ || picture_version_ != roadway->map->version) {
      picture_ = std::make_shared<const std::string>(map_png(*roadway->map));
      picture_version_ = roadway->map->version;
    }
    return web_answer(200, "image/png", picture_);
  }

  // For monitors: the runtime comes first.
  WebAnswer health_of_all() const {
    const std::vector<PartHealth> parts = board_.all();
    const bool is_bad =
        std::any_of(parts.begin(), parts.end(), [](const PartHealth& part) { return part.grade >= Grade::kBad; });
    return json(is_bad ? 503 : 200, health_json(parts));
  }

  static WebAnswer probe(const char* name, const Probe& probe) {
    return json(probe.is_well ? 200 : 503, probe_json(name, probe));
  }

  Moment moment() const {
    Moment moment;
    moment.parts = board_.all();
    moment.hung = board_.hung();
    moment.statistics = board_.statistics();
    moment.config_crc32 = config_crc32_;
    moment.sums = board_.sums();
    if (stop_ != nullptr) {
      moment.stop = stop_->stop_now();
      moment.stop_ns = stop_->state_ns();
    }
    moment.newest = board_.newest();
    moment.now_ns = monotonic_ns();
    return moment;
  }

  LoadedConfig loaded_;
  const HealthBoard& board_;
  const StopBoard* stop_;
  WebPart* more_;
  std::atomic<std::uint32_t> config_crc32_;
  const StopLine line_;
  HostPort place_;
  Broadcast broadcast_;
  std::atomic<std::size_t> viewers_{0};
  std::atomic<std::uint64_t> turned_away_{0}, sent_{0};
  std::int64_t health_last_ns_ = -kHealthEvery_ns;  // of the server's thread, as the picture
  std::shared_ptr<const std::string> picture_;
  std::uint64_t picture_version_ = 0;
  std::mutex roadway_lock_;
  std::shared_ptr<const RoadwayNews> newest_roadway_;
  std::atomic<std::uint64_t> map_told_{0};  // version that the viewers have
  WebServer server_;                        // last: its streams know the others
};

}  // namespace

std::unique_ptr<Sink> make_page_sink(const LoadedConfig& loaded, const HealthBoard& health, const StopBoard* stop,
                                     WebPart* more) {
  return std::make_unique<PageServer>(loaded, health, stop, more);
}

}  // namespace pose_wall::tools::live
