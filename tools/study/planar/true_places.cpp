// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/true_places.hpp"

#include <cmath>

#include "io/frames/text_cursor.hpp"
#include "io/planar_files/relations.hpp"

namespace pose_wall::tools {

TruePlaces::TruePlaces(const std::filesystem::path& file) {
  for (const TimedPose& row : read_tum(file)) {
    const Eigen::Vector3d place = row.T_world_base.translation();
    const Eigen::Matrix3d turn = row.T_world_base.linear();
    places_.emplace(row.t_s, pose_wall_planar_pose{place.x(), place.y(), std::atan2(turn(1, 0), turn(0, 0))});
  }
}

std::optional<pose_wall_planar_pose> TruePlaces::at(const std::string& time) {
  const std::optional<double> t_s = parse_number<double>(time);
  const auto found = t_s ? places_.lower_bound(*t_s) : places_.end();
  if (found == places_.end() || found->first != *t_s) return std::nullopt;
  const pose_wall_planar_pose place = found->second;
  places_.erase(found);
  return place;
}

}  // namespace pose_wall::tools
