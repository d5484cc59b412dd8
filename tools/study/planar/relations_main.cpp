// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_relations TRAJECTORY RELATIONS: the errors of a trajectory (TUM rows, or a CARMEN log for its odometry).

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "io/numbers/angles.hpp"
#include "io/planar_files/carmen_log.hpp"
#include "io/planar_files/relations.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kSPerNs = 1e-9;

std::vector<TimedPose> odometry_of(const CarmenLog& log) {
  std::vector<TimedPose> poses;
  for (const CarmenScan& scan : log.scans) {
    const pose_wall_planar_pose& at = scan.odometry;
    poses.push_back(
        {static_cast<double>(scan.stamp_ns) * kSPerNs,
         Eigen::Translation3d(at.x_m, at.y_m, 0.0) * Eigen::AngleAxisd(at.yaw_rad, Eigen::Vector3d::UnitZ())});
  }
  return poses;
}

void print_log(const CarmenLog& log) {
  fmt::print("lines {}, scans {}, stamps not later than the one before {}", log.lines, log.scans.size(),
             log.stamps_back);
  for (std::size_t i = 0; i < static_cast<std::size_t>(CarmenSkip::kCount); ++i) {
    const auto reason = static_cast<CarmenSkip>(i);
    const CarmenSkipped& skipped = log.skip(reason);
    if (skipped.lines == 0) continue;
    fmt::print(", {} {} (first in line {}{}{})", carmen_skip_name(reason), skipped.lines, skipped.first_line,
               skipped.first_fault.empty() ? "" : ": ", skipped.first_fault);
  }
  const CarmenScan& first = log.scans.front();
  fmt::print("\nbeams {}, from {:.2f} deg by {:.2f} deg, nothing came back at {:.2f} m\n", first.range_m.size(),
             first.angle_min_rad * kDegPerRad, first.angle_step_rad * kDegPerRad, first.range_max_m);
}

void print_errors(const char* name, const RelationErrors& errors) {
  const ErrorSpread& move = errors.translation_m;
  const ErrorSpread& turn = errors.rotation_rad;
  fmt::print("{:<5} {:>6}  {:8.4f} {:8.4f} {:8.4f} (line {:>5})  {:8.3f} {:8.3f} {:8.3f} (line {:>5})\n", name,
             errors.relations, move.mean, move.sigma, move.max, move.max_line, turn.mean * kDegPerRad,
             turn.sigma * kDegPerRad, turn.max * kDegPerRad, turn.max_line);
}

bool is_carmen(const std::string& file) {
  return file.find(".clf") != std::string::npos || file.find(".log") != std::string::npos;
}

int run(const std::string& trajectory, const std::string& relations) {
  std::vector<TimedPose> poses;
  if (is_carmen(trajectory)) {
    const CarmenLog log = read_carmen_log(trajectory);
    print_log(log);
    poses = odometry_of(log);
  } else {
    poses = read_tum(trajectory);
  }
  const RelationReport report = judge_relations(poses, read_relations(relations));
  fmt::print("poses {}, relations without a pose {}\n", poses.size(), report.unmatched);
  fmt::print("      number  mean m   sigma m  max m                  mean deg sigma    max\n");
  print_errors("near", report.near);
  print_errors("all", report.all);
  return 0;
}

}  // namespace
}  // namespace pose_wall::tools

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: pose_wall_relations TRAJECTORY.tum|LOG.clf[.gz] RELATIONS\n", stderr);
    return 2;
  }
  try {
    return pose_wall::tools::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pose_wall_relations: {}\n", error.what());
    return 1;
  }
}
