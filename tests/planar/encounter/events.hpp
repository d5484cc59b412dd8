// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Draws of what comes into the way of a machine that drives already. One run-up on a clear road serves several events:
// each begins from what machine and stop were at its end. Things come into sight at 5.8 to 8.5 m from the sensor, as
// if they had been hidden until then.

#pragma once

#include "planar/encounter/plans.hpp"

namespace pose_wall::test {

// A clear road and a machine that will drive straight along it.
inline Plan draw_run_up(Draw* draw, const pose_wall_planar_stop_settings& settings) {
  Plan plan = draw_plan(draw, settings);
  plan.world.things.clear(), plan.world.dust.clear(), plan.world.puddles.clear();
  plan.world.face_m = 1000.0;
  plan.loss = Loss::none;
  if (plan.drive != Drive::straight) {
    plan.drive = Drive::straight;
    draw_sensor(&plan, draw);
  }
  plan.machine.set_arc(1.0, draw->within(-0.004, 0.004));
  plan.machine.yaw_rad = draw->within(-0.02, 0.02);
  plan.wish_m_s = draw->happens(0.7) ? 1.0 : draw->within(0.3, 1.0);
  plan.lasts_s = 1e9;
  return plan;
}

// The least x of what a scene has.
inline double begin_of(const World& world) {
  double least = 1e9;
  for (const Thing& t : world.things) least = std::fmin(least, t.x_m - t.reach_m());
  for (const Dust& d : world.dust) least = std::fmin(least, d.x_m - d.radius_m);
  for (const Puddle& p : world.puddles) least = std::fmin(least, p.x_min);
  return least;
}

inline void move_along(World* world, double by_m) {
  for (Thing& t : world->things) t.x_m += by_m;
  for (Dust& d : world->dust) d.x_m += by_m;
  for (Puddle& p : world->puddles) p.x_min += by_m, p.x_max += by_m;
}

// People walk so that they are in the way when the machine comes, more or less.
inline void time_walks(World* world, const Machine& machine, double wish_m_s, Draw* draw) {
  for (Thing& t : world->things) {
    if (!t.is_person) continue;
    const double lasts_s = t.walks_until_s - t.walks_from_s;
    const double end_x_m = t.x_m + lasts_s * t.velocity_x_m_s, way_m = end_x_m - machine.x_m - machine.front_m;
    const double comes_s = way_m / wish_m_s;
    t.walks_from_s = std::fmax(0.0, comes_s - lasts_s * draw->within(0.3, 1.2) + draw->within(-1.5, 1.0));
    t.walks_until_s = t.walks_from_s + lasts_s;
  }
}

inline Plan draw_event(const Plan& road, const Machine& machine, const pose_wall_planar_stop_settings& settings,
                       Draw* draw) {
  Plan event = road;
  event.kind = static_cast<Kind>(1 + draw->below(static_cast<std::uint32_t>(Kind::kinds) - 1));
  furnish(&event, draw);
  clear_start(&event, settings);
  const double sensor_x_m = machine.x_m + road.sensor.x_m, from_m = draw->within(5.8, 8.5);
  move_along(&event.world, sensor_x_m + from_m - begin_of(event.world));
  time_walks(&event.world, machine, road.wish_m_s, draw);
  if (draw->happens(0.2)) draw_loss(&event, 7.0, draw);
  event.lasts_s = 8.0;
  return event;
}

}  // namespace pose_wall::test
