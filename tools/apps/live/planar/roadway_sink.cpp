// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/planar/roadway_sink.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>
#include <utility>

#include "apps/live/clocks.hpp"
#include "apps/live/log.hpp"
#include "apps/live/planar/place_finder.hpp"
#include "io/language/language.hpp"
#include "study/planar/cloud_scans.hpp"
#include "study/planar/part_block.hpp"

namespace pose_wall::tools::live {
namespace {

std::uint64_t bytes_for(const pose_wall_planar_scanner_settings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_scanner_memory_needed(&settings, &bytes), translatable("the settings of the scan"));
  return bytes;
}

// A loss of power loses so much of a map. Each save writes all of it, 15 MB for a kilometre.
constexpr std::int64_t kSaveEvery_ns = 300'000'000'000;

class RoadwaySink final : public Sink {
 public:
  RoadwaySink(const LoadedConfig& loaded, TellRoadway tell)
      : planar_(loaded.planar),
        config_(*loaded.config.get()),
        settings_(scanner_settings_of(loaded.planar)),
        block_(bytes_for(settings_)),
        tell_(std::move(tell)) {}

  void start() override {
    open_scanner(config_);
    finder_ = planar_.maps() ? make_mapping(planar_) : make_localisation(planar_);
    log_line(Grade::kGood, part(), planar_.maps() ? "begins a new map" : "looks for the machine in " + planar_.map);
  }
  void stop() override { save(); }

  std::size_t backlog() const override { return 4; }
  bool wants_clouds() const override { return true; }

  void take(const LiveResult& result) override {
    yield_to_others();
    if (result.publication.cause != POSE_WALL_RUNTIME_FRAME || !result.frame) return;
    const std::int64_t began_ns = monotonic_ns();
    auto news = std::make_shared<RoadwayNews>();
    news->header_stamp_ns = result.header_stamp_ns;
    std::string fault;
    try {
      look(result, news.get());
    } catch (const std::exception& error) {
      fault = error.what();
      news->pose.reset();
      news->state = "refused";
    }
    tell_(news);
    if (began_ns - saved_ns_ >= kSaveEvery_ns) save();
    note(*news, fault, monotonic_ns() - began_ns);
  }

  PartHealth health() const override {
    const std::lock_guard<std::mutex> locked(lock_);
    PartHealth health = told_;
    health.part = part();
    return health;
  }

 private:
  static std::string part() { return "planar roadway"; }

  // Once, in the sink's thread: engine and stop come first where there are too few cores. By Linux 0 is this thread.
  void yield_to_others() {
    constexpr int kNice = 5;
    if (!yields_) setpriority(PRIO_PROCESS, 0, kNice);
    yields_ = true;
  }

  void open_scanner(const pose_wall_config& config) {
    scanner_ = nullptr;
    config_ = config;
    require_ok(pose_wall_planar_scanner_open(&config_, &settings_, block_.data(), block_.bytes(), &scanner_),
               translatable("the settings of the scan"));
  }

  void look(const LiveResult& result, RoadwayNews* news) {
    if (scanner_ == nullptr || std::memcmp(&result.config, &config_, sizeof config_) != 0) open_scanner(result.config);
    pose_wall_planar_floor floor{};
    floor.struct_size = sizeof floor;
    require_ok(pose_wall_planar_floor_of(&result.publication.result, &floor), translatable("the floor"));
    pose_wall_planar_scan_view view{};
    view.struct_size = sizeof view;
    news->scan.struct_size = sizeof news->scan;
    require_ok(pose_wall_planar_scanner_process(scanner_, &result.frame->frame.cloud, &floor, &news->scan, &view),
               translatable("the scan"));
    if (floor.measured != 0) floor_z_m_ = -floor.height_m;
    news->state = "no floor";
    if (view.floor_state == POSE_WALL_PLANAR_FLOOR_NONE) return;
    const pose_wall_planar_scan scan = news->scan;
    news->range_m.assign(scan.range_m, scan.range_m + scan.beams);
    news->scan.range_m = news->scan.free_m = nullptr;
    news->has_scan = true;
    take_odometry(result, news);
    const bool goes_on = news->odometry && run_ == result.publication.motion.run;
    run_ = news->odometry ? result.publication.motion.run : 0;
    // Poses of another run do not compare: the first one of a run tells no way.
    finder_->find(scan, goes_on ? &*news->odometry : nullptr, news);
    renew_map(result.header_stamp_ns);
    news->map = map_;
    news->track = track_;
  }

  static void take_odometry(const LiveResult& result, RoadwayNews* news) {
    if (result.publication.has_motion != 0) news->odometry = plane_odometry(result.publication.motion);
  }

  void renew_map(std::int64_t header_stamp_ns) {
    const std::int64_t now_ns = monotonic_ns();
    if (renewed_ns_ != 0 && static_cast<double>(now_ns - renewed_ns_) < planar_.map_every_s * 1e9) return;
    renewed_ns_ = now_ns;
    if (std::shared_ptr<const RoadwayMap> changed = finder_->changed_map(header_stamp_ns)) map_ = std::move(changed);
    track_ = std::make_shared<const std::vector<pose_wall_planar_pose>>(finder_->track());
  }

  void save() {
    saved_ns_ = monotonic_ns();
    try {
      if (finder_) finder_->save(map_.get());
    } catch (const std::exception& fault) {
      log_line(Grade::kBad, part(), fmt::format("the map is not saved: {}", fault.what()));
    }
  }

  // The stop goes by the key, and the engine measures: who has set it wrong shall read it.
  bool is_floor_elsewhere() const {
    constexpr double kFloorError_m = 0.3;
    return std::abs(floor_z_m_ - planar_.stop.floor_z_m) > kFloorError_m;
  }

  void note(const RoadwayNews& news, const std::string& fault, std::int64_t took_ns) {
    const bool is_placed = news.pose.has_value();
    PartHealth health;
    health.grade = fault.empty() && is_placed && !is_floor_elsewhere() ? Grade::kGood : Grade::kWarning;
    health.summary = !fault.empty()   ? "refused: " + fault
                     : !news.has_scan ? "no floor is measured: there is no scan"
                     : planar_.maps() ? (is_placed ? "maps" : "the scan fits the map badly")
                                      : "place: " + news.state;
    if (is_floor_elsewhere()) health.summary += "; the floor is not at planar_floor_z";
    frames_ += 1;
    placed_ += is_placed ? 1 : 0;
    took_worst_ns_ = std::max(took_worst_ns_, took_ns);
    health.add("state", news.state);
    health.add("scans", frames_);
    health.add("scans with a place", placed_);
    health.add("floor z m", fmt::format("{:.2f}", floor_z_m_));
    health.add("scan worst ms", fmt::format("{:.1f}", static_cast<double>(took_worst_ns_) * 1e-6));
    for (const auto& [name, value] : finder_->facts()) health.add(name, value);
    if (map_) health.add("map", fmt::format("{} x {} cells of {:g} m", map_->width, map_->height, map_->resolution_m));
    const std::lock_guard<std::mutex> locked(lock_);
    told_ = std::move(health);
  }

  PlanarSettings planar_;
  pose_wall_config config_;
  pose_wall_planar_scanner_settings settings_;
  PartBlock block_;
  TellRoadway tell_;
  pose_wall_planar_scanner* scanner_ = nullptr;
  std::unique_ptr<PlaceFinder> finder_;
  std::uint64_t run_ = 0;  // of motion, at the last scan with odometry; 0: there was none
  std::int64_t renewed_ns_ = 0, saved_ns_ = monotonic_ns();
  bool yields_ = false;
  std::shared_ptr<const RoadwayMap> map_;
  std::shared_ptr<const std::vector<pose_wall_planar_pose>> track_;
  std::uint64_t frames_ = 0, placed_ = 0;
  double floor_z_m_ = NAN;  // as last measured; before that it is nowhere else
  std::int64_t took_worst_ns_ = 0;

  mutable std::mutex lock_;
  PartHealth told_{"", Grade::kWarning, "no frame yet", {}};
};

}  // namespace

std::unique_ptr<Sink> make_roadway_sink(const LoadedConfig& loaded, TellRoadway tell) {
  return std::make_unique<RoadwaySink>(loaded, std::move(tell));
}

}  // namespace pose_wall::tools::live
