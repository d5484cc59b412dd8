// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Times the planner on drawn grids of 100 x 100 m at 5 cm. Usage: plan_trial [first seed] [seeds]

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "../drawn_roads.hpp"
#include "pose_wall_planar_plan.h"
#include "trial_task.hpp"

namespace {

// Of this thread alone: others may use the cores too.
double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint32_t first = argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 0;
  const std::uint32_t seeds = argc > 2 ? static_cast<std::uint32_t>(std::atoi(argv[2])) : 30;
  pose_wall_planar_plan_settings settings;
  (void)pose_wall_planar_plan_settings_init(&settings);
  if (argc > 3) settings.weight = std::atof(argv[3]);
  if (argc > 4) settings.cusp_cost_m = std::atof(argv[4]);
  pose_wall::test::TrialPlanner planner(settings);
  std::printf("memory %.1f MB\n", static_cast<double>(planner.block.size()) * 1e-6);
  std::printf("seed,outcome,ms,expansions,places,searches,search_cost,cost,length,bound,spot,cusps\n");
  double worst = 0.0, sum = 0.0;
  for (std::uint32_t seed = first; seed < first + seeds; ++seed) {
    const pose_wall::test::DrawnGrid grid = pose_wall::test::drawn_grid(seed);
    pose_wall_planar_pose start, goal;
    if (!pose_wall::test::draw_ends(grid, settings, seed, &start, &goal)) {
      std::printf("%u,no ends\n", seed);
      continue;
    }
    double least = 1e9;
    pose_wall_planar_plan_result r{};
    for (int k = 0; k < 3; ++k) {
      const double begin_ms = cpu_ms();
      r = planner.plan(grid, start, goal);
      least = std::min(least, cpu_ms() - begin_ms);
    }
    std::printf("%u,%s,%.1f,%u,%u,%u,%.2f,%.2f,%.2f,%.3f,%u,%u\n", seed, pose_wall_planar_plan_outcome_name(r.outcome),
                least, r.expansions, r.places, r.searches, r.search_cost_m, r.cost_m, r.length_m, r.bound, r.spot_turns,
                r.cusps);
    worst = std::max(worst, least);
    sum += least;
  }
  std::printf("mean %.1f ms, worst %.1f ms\n", sum / seeds, worst);
  return 0;
}
