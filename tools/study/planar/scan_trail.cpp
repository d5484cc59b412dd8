// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/scan_trail.hpp"

#include <algorithm>
#include <utility>

#include "io/language/language.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/thread_clock.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kKeptBeamsMost = 50'000'000;  // 0.2 GB

std::uint64_t bytes_for(const pose_wall_planar_slam_settings& settings) {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_slam_memory_needed(&settings, &bytes), translatable("the settings of the map"));
  return bytes;
}

}  // namespace

pose_wall_planar_keyframe keyframe_of(const pose_wall_planar_slam* slam, std::uint32_t number) {
  pose_wall_planar_keyframe keyframe{};
  keyframe.struct_size = sizeof keyframe;
  require_ok(pose_wall_planar_slam_keyframe(slam, number, &keyframe), translatable("a keyframe"));
  return keyframe;
}

std::vector<Closure> closures_of(const pose_wall_planar_slam* slam) {
  std::vector<Closure> closures;
  pose_wall_planar_edge edge{};
  edge.struct_size = sizeof edge;
  for (std::uint32_t k = 0; pose_wall_planar_slam_edge(slam, k, &edge) == POSE_WALL_OK; ++k) {
    if (edge.is_closure != 0 && edge.information[0] > 0.0) closures.push_back({edge.from, edge.to});
  }
  return closures;
}

ScanTrail::ScanTrail(const pose_wall_planar_slam_settings& settings) : block_(bytes_for(settings)) {
  require_ok(pose_wall_planar_slam_open(&settings, block_.data(), block_.bytes(), &slam_),
             translatable("the settings of the map"));
  last_.struct_size = sizeof last_;
}

const pose_wall_planar_slam_result& ScanTrail::add(const pose_wall_planar_scan& scan,
                                                   const pose_wall_planar_pose* odometry,
                                                   const pose_wall_planar_pose& place, std::string time) {
  const double started_ms = thread_ms();
  const std::int32_t status = pose_wall_planar_slam_process(slam_, &scan, odometry, &last_);
  const double ms = thread_ms() - started_ms;
  require_ok(status, translatable("the scan"));
  ms_sum_ += ms;
  worst_ms_ = std::max(worst_ms_, ms);
  explained_sum_ += last_.explained;
  scans_.push_back({std::move(time), last_.state, last_.keyframe, combined(last_.in_keyframe, place)});
  // A full trail matches scans and keeps none of them; they have no place in the map for sure.
  if (last_.is_keyframe != 0 || (kept_beams_ < kKeptBeamsMost && last_.is_full == 0)) {
    kept_scans_.emplace_back(scan, last_);
    kept_beams_ += scan.beams;
  }
  return last_;
}

void ScanTrail::settle() {
  require_ok(pose_wall_planar_slam_settle(slam_), translatable("the graph"));
}

std::vector<pose_wall_planar_pose> ScanTrail::keyframe_poses() const {
  std::vector<pose_wall_planar_pose> poses;
  for (std::uint32_t k = 0; k < last_.keyframes; ++k) poses.push_back(keyframe_of(slam_, k).pose);
  return poses;
}

std::vector<pose_wall_planar_pose> ScanTrail::scan_poses() const {
  const std::vector<pose_wall_planar_pose> keyframes = keyframe_poses();
  std::vector<pose_wall_planar_pose> poses;
  for (const TrailScan& scan : scans_) poses.push_back(combined(keyframes.at(scan.keyframe), scan.in_keyframe));
  return poses;
}

std::vector<pose_wall_planar_pose> ScanTrail::kept_poses() const {
  const std::vector<pose_wall_planar_pose> keyframes = keyframe_poses();
  std::vector<pose_wall_planar_pose> poses;
  for (const KeptScan& kept : kept_scans_) poses.push_back(combined(keyframes.at(kept.keyframe), kept.in_keyframe));
  return poses;
}

double ScanTrail::travel_m() const {
  return last_.keyframes == 0 ? 0.0 : keyframe_of(slam_, last_.keyframes - 1).travel_m;
}

std::size_t ScanTrail::count(std::uint32_t state) const {
  return static_cast<std::size_t>(
      std::count_if(scans_.begin(), scans_.end(), [state](const TrailScan& scan) { return scan.state == state; }));
}

double ScanTrail::explained_mean() const {
  const std::size_t scans = scans_.size() - count(POSE_WALL_PLANAR_SLAM_FIRST);
  return scans == 0 ? 0.0 : explained_sum_ / static_cast<double>(scans);
}

double ScanTrail::mean_ms() const {
  return scans_.empty() ? 0.0 : ms_sum_ / static_cast<double>(scans_.size());
}

std::string ScanTrail::saved() const {
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_slam_save_bytes(slam_, &bytes), translatable("the trail"));
  std::string saved(static_cast<std::size_t>(bytes), '\0');
  require_ok(pose_wall_planar_slam_save(slam_, saved.data(), saved.size(), &bytes), translatable("the trail"));
  saved.resize(static_cast<std::size_t>(bytes));
  return saved;
}

}  // namespace pose_wall::tools
