// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros_messages/ros_publisher.hpp"
#include "apps/live/clocks.hpp"
#include "apps/live/ros_messages/planar_messages.hpp"
#include "io/config_file/key_table.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kDiagnosticsEvery = std::chrono::seconds(1);

class RosPublisher final : public Sink {
 public:
  RosPublisher(std::string part, const LoadedConfig& loaded, const HealthBoard& board, MessageEncoding encoding,
               std::unique_ptr<RosOut> out)
      : part_(std::move(part)),
        board_(board),
        out_(std::move(out)),
        messages_(encoding, config_text(*loaded.config.get(), "base_frame")),
        attitude_(out_->advertise("/pose_wall/attitude", kVector3StampedType, false)),
        distances_(out_->advertise("/pose_wall/distances", kFloat32MultiArrayType, false)),
        state_(out_->advertise("/pose_wall/state", kStateType, false)),
        points_(out_->advertise("/pose_wall/points", kPointCloud2Type, false)),
        diagnostics_(out_->advertise("/diagnostics", kDiagnosticArrayType, false)),
        transforms_(out_->advertise("/tf", kTfMessageType, false)) {
    if (loaded.planar.is_on()) planar_.emplace(*out_, encoding, loaded);
  }
  ~RosPublisher() override { out_->stop(); }

  void start() override { out_->start(); }
  void stop() override { out_->stop(); }

  void take(const LiveResult& result) override {
    out_->publish(attitude_, messages_.attitude(result));
    out_->publish(distances_, messages_.distances(result));
    out_->publish(state_, messages_.state(result));
    if (RosMessages::has_level(result)) out_->publish(transforms_, messages_.level_transform(result));
    wants_points_ = out_->subscribers(points_) > 0;
    if (result.points && wants_points_) out_->publish(points_, messages_.points(result));
    ++published_;
    tell_health();
  }

  PartHealth health() const override {
    PartHealth health;
    health.part = part_;
    const std::string trouble = out_->trouble();
    health.grade = trouble.empty() ? Grade::kGood : Grade::kWarning;
    health.summary = trouble.empty() ? "publishes" : trouble;
    health.add("results published", published_.load());
    std::uint64_t subscribers = 0;
    for (const std::size_t topic : {attitude_, distances_, state_}) subscribers += out_->subscribers(topic);
    health.add("subscribers", subscribers);
    out_->add_facts(&health);
    return health;
  }

  bool wants_points() const override { return wants_points_; }
  bool wants_planar() const override { return planar_.has_value(); }

  void take_stop(const StopNews& news) override {
    out_->publish(planar_->stop, planar_->messages.stop(news));
    out_->publish(planar_->stop_state, planar_->messages.stop_state(news));
  }
  void take_roadway(const RoadwayNews& news) override {
    const std::string transforms = planar_->messages.transforms(news);
    if (!transforms.empty()) out_->publish(transforms_, transforms);
    if (news.has_scan) out_->publish(planar_->scan, planar_->messages.scan(news));
    if (news.pose) out_->publish(planar_->pose, planar_->messages.pose(news));
    if (!news.map || news.map->version == planar_->map_version) return;
    planar_->map_version = news.map->version;
    out_->publish(planar_->map, planar_->messages.map(*news.map));
  }

 private:
  // Once a second, and at once where a part fares otherwise than it did.
  void tell_health() {
    std::vector<PartHealth> parts = board_.all();
    const bool is_news = !std::equal(parts.begin(), parts.end(), told_.begin(), told_.end(),
                                     [](const PartHealth& now, const PartHealth& told) { return now.fares_as(told); });
    if (!is_news && Clock::now() - diagnostics_last_ < kDiagnosticsEvery) return;
    diagnostics_last_ = Clock::now();
    out_->publish(diagnostics_, messages_.diagnostics(parts, wall_ns()));
    told_ = std::move(parts);
  }

  // Where the key `planar` is on.
  struct Planar {
    Planar(RosOut& out, MessageEncoding encoding, const LoadedConfig& loaded)
        : messages(encoding, loaded.planar, config_text(*loaded.config.get(), "base_frame")),
          scan(out.advertise("/scan", kLaserScanType, false)),
          map(out.advertise("/map", kOccupancyGridType, true)),
          pose(out.advertise(loaded.planar.maps() ? "/pose" : "/amcl_pose", kCovariantPoseType, false)),
          stop(out.advertise("/pose_wall/stop", kBoolType, false)),
          stop_state(out.advertise("/pose_wall/stop_state", kStopType, false)) {}

    PlanarMessages messages;
    std::size_t scan, map, pose, stop, stop_state;
    std::uint64_t map_version = 0;  // the last one that was published
  };

  std::string part_;
  const HealthBoard& board_;
  std::unique_ptr<RosOut> out_;
  RosMessages messages_;
  std::size_t attitude_, distances_, state_, points_, diagnostics_, transforms_;
  Clock::time_point diagnostics_last_{};
  std::optional<Planar> planar_;
  std::vector<PartHealth> told_;
  std::atomic<bool> wants_points_{false};
  std::atomic<std::uint64_t> published_{0};
};

}  // namespace

std::unique_ptr<Sink> make_ros_publisher(const std::string& part, const LoadedConfig& loaded, const HealthBoard& health,
                                         MessageEncoding encoding, std::unique_ptr<RosOut> out) {
  return std::make_unique<RosPublisher>(part, loaded, health, encoding, std::move(out));
}

}  // namespace pose_wall::tools::live
