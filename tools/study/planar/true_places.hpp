// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Poses that scans are compared with, by their time.

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

class TruePlaces {
 public:
  // TUM rows, as `pose_wall map --poses` writes them. Throws RelationsError.
  explicit TruePlaces(const std::filesystem::path& file);

  // Of exactly this time, "976052857.436207". Several scans of one time get their rows in the order of the file.
  std::optional<pose_wall_planar_pose> at(const std::string& time);

 private:
  std::multimap<double, pose_wall_planar_pose> places_;
};

}  // namespace pose_wall::tools
