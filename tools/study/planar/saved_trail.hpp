// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The trail that `pose_wall map -o` saves (trail.pwt): keyframes with what was seen from them, and their graph.

#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "pose_wall_planar_slam.h"
#include "study/planar/part_block.hpp"
#include "study/planar/scan_trail.hpp"

namespace pose_wall::tools {

// Names the file, what is wrong with it, and how to get a good one.
class TrailFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class SavedTrail {
 public:
  // Throws TrailFileError: not a trail, of another version, cut off or damaged, or it cannot be read.
  explicit SavedTrail(const std::filesystem::path& file);
  // Bytes as pose_wall_planar_slam_save wrote them; faults call them `file`.
  SavedTrail(const std::filesystem::path& file, const std::string& bytes);

  std::uint32_t keyframes() const { return keyframes_; }
  pose_wall_planar_keyframe keyframe(std::uint32_t number) const;
  // x, y, x, y ... in the keyframe's base.
  std::vector<float> points(std::uint32_t number) const;
  double travel_m() const { return keyframes_ == 0 ? 0.0 : keyframe(keyframes_ - 1).travel_m; }
  std::vector<Closure> closures() const { return closures_of(slam_); }

 private:
  PartBlock block_;
  pose_wall_planar_slam* slam_ = nullptr;
  std::uint32_t keyframes_ = 0;
};

}  // namespace pose_wall::tools
