// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "io/planar_files/relations.hpp"
#include "lab/sim/survey_line.hpp"
#include "lab/survey/survey_file.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kProposedStep_m = 1.0, kProposedHeight_m = 1.3;

}  // namespace

std::vector<sim::Placement> propose_survey_path(const SurveyRock& rock, const std::filesystem::path& file) {
  const std::vector<sim::Placement> path =
      sim::propose_path(*rock.rock, rock.low, rock.high, kProposedStep_m, kProposedHeight_m);
  if (!path.empty()) return path;
  throw SurveyError(
      fmt::format("{}: no place in it is like a road, with a floor and walls around; is z up, in metres? Poses of your "
                  "own go by --path",
                  file.string()));
}

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

std::string survey_path_text(const std::vector<sim::Placement>& path) {
  std::string text = "# t x y z qx qy qz qw\n";
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Quaterniond q(path[i].R_road_base);
    const sim::Vector& p = path[i].origin_road;
    text += fmt::format("{} {:.4f} {:.4f} {:.4f} {:.8f} {:.8f} {:.8f} {:.8f}\n", i, p.x(), p.y(), p.z(), q.x(), q.y(),
                        q.z(), q.w());
  }
  return text;
}

}  // namespace pose_wall::tools
