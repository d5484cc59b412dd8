// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "peer_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "quantiles.hpp"

namespace pose_wall::bench {
namespace {

constexpr double kDegPerRad = 57.29577951308232;

// The first of the times is pose_wall's.
void print_row(const std::string& name, const std::vector<double>& times_ms) {
  fmt::print("{:14}", name);
  for (std::size_t i = 0; i < times_ms.size(); ++i) {
    fmt::print(" {:12.3f}", times_ms[i]);
    if (i > 0) fmt::print(" {:7.2f}", times_ms[i] / times_ms[0]);
  }
  fmt::print("\n");
}

}  // namespace

void print_stages(const Contest& contest) {
  fmt::print(
      "{}: {} frames of each of {} roads, about {:.0f} points, {:.0f} voxels; ms of processor time, medians over the\n"
      "frames; ",
      contest.sensor, contest.plan.frames, contest.plan.roads, median(contest.points), median(contest.voxels));
  fmt::print("ratio: over pose_wall's\n\n{:14}", "");
  for (const Contestant& one : contest.contestants) {
    fmt::print(" {:>12}{}", one.name, &one != &contest.contestants.front() ? "   ratio" : "");
  }
  fmt::print("\n");
  for (std::uint32_t stage = 0; stage < POSE_WALL_STAGES; ++stage) {
    std::vector<double> times_ms;
    for (const Contestant& one : contest.contestants) times_ms.push_back(one.median_stage_ms(stage));
    print_row(pose_wall_stage_name(stage), times_ms);
  }
  std::vector<double> totals_ms;
  for (const Contestant& one : contest.contestants) totals_ms.push_back(one.median_total_ms());
  print_row("total", totals_ms);
  const double least_ms = median(contest.least_ms);
  fmt::print("{:14}", "x least pass");
  for (std::size_t i = 0; i < totals_ms.size(); ++i) {
    fmt::print(" {:12.1f}{}", totals_ms[i] / least_ms, i > 0 ? "        " : "");
  }
  fmt::print("\n{:14} {:12.3f}\n\n", "least pass", least_ms);
}

void print_accuracy(const Contest& contest) {
  fmt::print("{:14} {:>12} {:>22} {:>20} {:>18}\n{:14} {:>12} {:>22} {:>20} {:>18}\n", "errors", "values of 7",
             "roll, pitch, deg", "yaw, deg", "distances, mm", "", "", "RMS   median", "RMS   median", "RMS   median");
  for (const Contestant& one : contest.contestants) {
    const auto both = [&](std::size_t first, std::size_t last, double unit, int digits) {
      return fmt::format("{:.{}f} {:8.{}f}", one.rmse(first, last) * unit, digits, one.median_error(first, last) * unit,
                         digits);
    };
    fmt::print("{:14} {:12.2f} {:>22} {:>20} {:>18}\n", one.name, one.values_per_frame(),
               both(POSE_WALL_ROLL, POSE_WALL_PITCH, kDegPerRad, 3), both(POSE_WALL_YAW, POSE_WALL_YAW, kDegPerRad, 3),
               both(POSE_WALL_D_LF, POSE_WALL_D_RB, 1e3, 1));
  }
  fmt::print("\n");
}

}  // namespace pose_wall::bench
