// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/relations.hpp"
#include "survey/survey_file.hpp"

namespace pose_wall::tools {

std::vector<sim::Placement> read_survey_path(const std::filesystem::path& file) {
  std::vector<sim::Placement> path;
  try {
    for (const TimedPose& pose : read_tum(file)) {
      path.push_back({pose.T_world_base.rotation(), pose.T_world_base.translation()});
    }
  } catch (const RelationsError& error) {
    throw SurveyError(error.what());
  }
  if (path.empty()) {
    throw SurveyError(file.string() + ": it holds no pose; a line a frame is needed: t x y z qx qy qz qw");
  }
  return path;
}

}  // namespace pose_wall::tools
