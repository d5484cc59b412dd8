// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The tracker in a closed loop over drawn routes. Usage: track_trial [routes] [delay_s]

#include <cstdio>
#include <cstdlib>

#include "../track_loop.hpp"

int main(int argc, char** argv) {
  const std::uint32_t routes = argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 40;
  pose_wall_planar_track_settings settings;
  (void)pose_wall_planar_track_settings_init(&settings);
  if (argc > 2) settings.delay_s = std::atof(argv[2]);
  if (argc > 3) settings.settle_m = std::atof(argv[3]);
  std::printf("seed,state,seconds,worst_m,worst_curve_m,rms_m,swings,end_m,end_rad,slip,drift\n");
  double worst_curve = 0.0, sum = 0.0;
  int over = 0;
  for (std::uint32_t seed = 1; seed <= routes; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> slip(0.05, 0.20);
    pose_wall::test::Ground ground;
    ground.slip_left = slip(random);
    ground.slip_right = slip(random);
    ground.slip_wave = 0.02;
    const auto route = pose_wall::test::drawn_route(seed);
    pose_wall::test::LoopTracker tracker(settings);
    const auto run = pose_wall::test::run_loop(tracker, route, route[0].pose, ground, seed);
    double squares = 0.0;
    for (const auto& m : run.moments) squares += m.cross_m * m.cross_m;
    const auto& goal = route.back().pose;
    const double curve = run.worst_cross(0.0, true);
    std::printf("%u,%s,%.0f,%.3f,%.3f,%.3f,%d,%.3f,%.4f,%.2f,%.3f\n", seed,
                pose_wall_planar_track_state_name(run.last_state), run.seconds, run.worst_cross(0.0, false), curve,
                std::sqrt(squares / static_cast<double>(run.moments.size())), run.swings(0.0, 0.015),
                std::hypot(run.end.x_m - goal.x_m, run.end.y_m - goal.y_m),
                std::remainder(run.end.yaw_rad - goal.yaw_rad, 6.283185307), run.slip, run.drift_1_m);
    worst_curve = std::max(worst_curve, curve);
    sum += curve;
    over += curve > 0.05 ? 1 : 0;
  }
  std::printf("curves: mean of worst %.3f, worst %.3f, over 5 cm %d of %u\n", sum / routes, worst_curve, over, routes);
  return 0;
}
