// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/taught_roads.hpp"

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "lab/drive/drive_scanner.hpp"
#include "study/planar/built_map.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/scan_trail.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kTeachStep_s = 0.05;
constexpr double kTeachSpeed_m_s = 0.5;
constexpr double kFrame_m = 0.3, kFrame_rad = 0.15;  // between two frames
constexpr double kPatience = 5.0;                    // times as long as at full speed
constexpr double kTaughtCell_m = 0.05;

// Three roads meet there.
std::uint32_t first_junction(const sim::NetworkGraph& graph) {
  for (std::uint32_t k = 0; k < graph.nodes.size(); ++k) {
    if (graph.nodes[k].edges.size() >= 3) return k;
  }
  return 0;
}

ScanTrail new_trail() {
  constexpr std::uint32_t kKeyframesMost = 16384;
  pose_wall_planar_slam_settings settings{};
  require_ok(pose_wall_planar_slam_settings_init(&settings), translatable("the settings of the map"));
  settings.keyframes_most = kKeyframesMost;
  return ScanTrail(settings);
}

// The machine with its driver, and what its SLAM has so far.
class TeachingDrive {
 public:
  TeachingDrive(const sim::Network& network, const sim::SensorModel& model, std::uint64_t seed, double share)
      : network_(network),
        model_(model),
        seed_(seed),
        route_(network.graph().tour(first_junction(network.graph()), share * network.graph().length_m, seed)),
        machine_(drive_tracks(), &network, sim::start_of(route_), seed),
        driver_(route_, drive_tracks(), kTeachSpeed_m_s),
        scanner_(model),
        trail_(new_trail()) {}

  void run(const std::function<bool(double)>& notice) {
    double frame_at_m = 0.0, frame_at_rad = 0.0;
    while (!driver_.has_arrived() && machine_.time_s() < kPatience * route_.length_m / kTeachSpeed_m_s) {
      if (machine_.driven_m() >= frame_at_m || machine_.turned_rad() >= frame_at_rad) {
        frame_at_m = machine_.driven_m() + kFrame_m;
        frame_at_rad = machine_.turned_rad() + kFrame_rad;
        take_frame();
        if (!notice(machine_.driven_m() / route_.length_m)) return;
      }
      machine_.step(driver_.command(machine_.truth()), kTeachStep_s);
    }
  }

  TaughtRoads roads() {
    trail_.settle();
    TaughtRoads out;
    out.map = build_map(trail_.kept_scans(), trail_.kept_poses(), kTaughtCell_m).map;
    free_specks(&out.map);
    out.trail = trail_.saved();
    out.driven_m = machine_.driven_m();
    out.scans = static_cast<std::uint32_t>(trail_.scans().size());
    out.closures = trail_.last().closures;
    const std::vector<pose_wall_planar_pose> poses = trail_.keyframe_poses();
    for (std::size_t k = 0; k < poses.size() && k < truths_.size(); ++k) {
      out.marks.push_back({truths_[k], poses[k]});
      out.worst_m = std::max(out.worst_m, distance_m(seen_from(truths_.front(), truths_[k]), poses[k]));
    }
    return out;
  }

 private:
  void take_frame() {
    const auto stamp_ns = static_cast<std::int64_t>(machine_.time_s() * 1e9);
    const sim::Frame frame = sim::network_cloud(network_, model_.sensor, true_sensor(machine_, model_), frames_++,
                                                sim::mix(seed_ ^ 0x7eacu));
    const pose_wall_planar_scan& scan = scanner_.scan(cloud_of(frame, stamp_ns));
    const sim::PlanePose& odometry = machine_.odometry();
    const pose_wall_planar_pose given{odometry.x_m, odometry.y_m, odometry.yaw_rad};
    if (trail_.add(scan, &given, {}, "").is_keyframe != 0) truths_.push_back(true_base(machine_));
  }

  const sim::Network& network_;
  const sim::SensorModel& model_;
  std::uint64_t seed_;
  sim::Route route_;
  sim::TrackDrive machine_;
  sim::RouteDriver driver_;
  DriveScanner scanner_;
  ScanTrail trail_;
  std::vector<pose_wall_planar_pose> truths_;
  std::uint32_t frames_ = 0;
};

using Pose = pose_wall_planar_pose;
using Mark = TaughtRoads::Mark;

// `pose` of the frame `from`, as the frame `to` has it, by the nearest mark that looks the same way.
Pose carried(const std::vector<Mark>& marks, const Pose& pose, Pose Mark::*from, Pose Mark::*to) {
  constexpr double kTurned_m = 2.0;  // who looked the other way counts as so far off
  const auto apart = [&](const Mark& mark) {
    return distance_m(mark.*from, pose) + kTurned_m * (1.0 - std::cos((mark.*from).yaw_rad - pose.yaw_rad));
  };
  const auto nearest =
      std::min_element(marks.begin(), marks.end(), [&](const Mark& a, const Mark& b) { return apart(a) < apart(b); });
  return nearest == marks.end() ? pose : combined((*nearest).*to, seen_from((*nearest).*from, pose));
}

}  // namespace

pose_wall_planar_pose TaughtRoads::in_map(const pose_wall_planar_pose& truth) const {
  return carried(marks, truth, &Mark::truth, &Mark::map);
}

pose_wall_planar_pose TaughtRoads::in_truth(const pose_wall_planar_pose& pose) const {
  return carried(marks, pose, &Mark::map, &Mark::truth);
}

TaughtRoads teach_roads(const sim::Network& network, const sim::SensorModel& model, std::uint64_t seed,
                        const std::function<bool(double)>& notice, double share) {
  TeachingDrive drive(network, model, seed, share);
  drive.run(notice);
  return drive.roads();
}

}  // namespace pose_wall::tools
