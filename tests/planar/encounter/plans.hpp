// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Draws encounters.

#pragma once

#include "planar/encounter/encounter.hpp"

namespace pose_wall::test {

inline pose_wall_planar_stop_settings encounter_settings() {
  pose_wall_planar_stop_settings settings;
  (void)pose_wall_planar_stop_settings_init(&settings);
  return settings;
}

inline void draw_sensor(Plan* plan, Draw* draw) {
  const double which = draw->share();
  Sensor& s = plan->sensor;
  if (which < 0.85) {
    s = Sensor(Pattern::vlp16, 2.0, draw->within(1.4, 1.5), 0.0, draw->within(0.16, 0.2), 1.25, 600);
  } else if (which < 0.9) {
    s = Sensor(Pattern::os1_64, 2.0, draw->within(1.4, 1.6), 0.0, draw->within(0.26, 0.3), 1.0, 0);
  } else {
    s = Sensor(Pattern::mid360, 2.0, draw->within(1.4, 1.6), 3.14159265, draw->within(0.0, 0.05), 1.25, 0);
  }
  // The tail swings: it has to be seen.
  if (plan->drive == Drive::spot || plan->drive == Drive::curve) {
    s = Sensor(Pattern::mid360, 0.0, 2.2, 3.14159265, 0.0, 3.14159265, 0);
  }
  s.noise_m = draw->within(0.005, 0.02);
  s.dropout = draw->within(0.0, 0.05);
}

inline void draw_drive(Plan* plan, Draw* draw) {
  const double which = draw->share();
  Machine& m = plan->machine;
  plan->drive = which < 0.85   ? Drive::straight
                : which < 0.93 ? Drive::curve
                : which < 0.97 ? Drive::spot
                               : Drive::reverse;
  const double sign = draw->happens(0.5) ? 1.0 : -1.0;
  if (plan->drive == Drive::straight) m.set_arc(1.0, draw->within(-0.01, 0.01));
  if (plan->drive == Drive::curve) m.set_arc(1.0, sign * draw->within(0.02, 0.25));
  if (plan->drive == Drive::spot) m.set_arc(draw->within(-0.1, 0.1), sign);
  if (plan->drive == Drive::reverse) m.set_arc(-1.0, sign * draw->within(0.0, 0.1));
  plan->wish_m_s = draw->happens(0.3) ? 1.0 : draw->within(0.1, 1.0);
  plan->odometry = draw->within(0.98, 1.02);
  m.yaw_rad = draw->within(-0.05, 0.05);
}

inline Thing round_thing(double x, double y, double radius, double bottom, double top) {
  Thing t{};
  t.x_m = x, t.y_m = y, t.half_x_m = radius, t.half_y_m = -1.0, t.bottom_m = bottom, t.top_m = top;
  return t;
}

// A person who walks so that they come near a point of the machine's way at some time.
inline Thing walker(Plan* plan, Kind kind, Draw* draw) {
  const double way_m = draw->within(0.5, 6.0);
  Thing t = round_thing(0.0, 0.0, draw->within(0.17, 0.25), -0.05, draw->within(1.5, 1.95));
  t.is_person = true;
  const double speed = draw->within(0.2, 1.5), y_end = draw->within(-0.6, 0.6), x_end = 2.25 + way_m;
  const double side = draw->happens(0.5) ? 1.0 : -1.0, edge = plan->world.half_width_m - 0.4;
  if (kind == Kind::person_comes) {
    t.x_m = x_end + draw->within(2.0, 8.0), t.y_m = draw->within(-edge, edge);
  } else {
    t.x_m = x_end + draw->within(-0.5, 3.0), t.y_m = side * edge * draw->within(0.7, 1.0);
  }
  // In the sensor's sight from the first moment: nobody steps out from behind the machine.
  if (t.x_m < 2.6 + 0.5 * std::fabs(t.y_m)) t.x_m = 2.6 + 0.5 * std::fabs(t.y_m);
  const double dx = x_end - t.x_m, dy = y_end - t.y_m, far = std::hypot(dx, dy) + 1e-6;
  t.velocity_x_m_s = speed * dx / far, t.velocity_y_m_s = speed * dy / far;
  t.walks_from_s = draw->within(0.0, 4.0);
  const double reach = kind == Kind::person_crosses ? far * draw->within(0.6, 2.5) : far * draw->within(0.5, 1.3);
  t.walks_until_s = t.walks_from_s + reach / speed;
  if (kind == Kind::person_starts) t.walks_from_s = draw->within(0.0, 1.5), t.walks_until_s += 1.5;
  return t;
}

inline void furnish(Plan* plan, Draw* draw) {
  World& w = plan->world;
  const double ahead = 2.25 + draw->within(1.0, 6.0), edge = w.half_width_m - 0.3;
  const double y = draw->happens(0.6) ? draw->within(-0.9, 0.9) : draw->within(-edge, edge);
  switch (plan->kind) {
    case Kind::person_crosses:
    case Kind::person_comes:
    case Kind::person_starts:
      w.things.push_back(walker(plan, plan->kind, draw));
      if (draw->happens(0.2)) w.things.push_back(walker(plan, Kind::person_crosses, draw));
      break;
    case Kind::prop:
      w.things.push_back(round_thing(ahead, y, draw->within(0.075, 0.15), -0.1, 3.3));
      break;
    case Kind::box: {
      Thing t{ahead,
              y,
              draw->within(0.0, 3.0),
              draw->within(0.15, 0.5),
              draw->within(0.15, 0.5),
              -0.1,
              draw->within(0.3, 1.2)};
      w.things.push_back(t);
      break;
    }
    case Kind::muck:
      for (int k = 0; k < 6; ++k) {  // a heap of rounds, lower outwards
        const double r = 0.2 + 0.15 * k;
        w.things.push_back(round_thing(ahead, y, r, -0.1, draw->within(0.3, 0.36) * (6 - k) / 6.0 + 0.02));
      }
      break;
    case Kind::boom: {
      const double low = draw->within(0.4, 1.5);
      Thing t{ahead,
              y,
              draw->within(-0.5, 0.5) + 1.57,
              draw->within(0.5, 1.5),
              draw->within(0.1, 0.25),
              low,
              low + draw->within(0.2, 0.5)};
      w.things.push_back(t);
      break;
    }
    default:
      break;
  }
  if (plan->kind == Kind::dust || draw->happens(0.15)) {
    w.dust.push_back(
        {ahead, draw->within(-1.5, 1.5), draw->within(0.3, 1.5), draw->within(0.5, 2.0), draw->within(0.002, 0.3)});
    if (plan->kind == Kind::dust) {
      w.things.push_back(round_thing(ahead + draw->within(-1.0, 1.0), y, 0.2, -0.1, 1.7));
    }
  }
  if (plan->kind == Kind::puddle || draw->happens(0.1)) {
    const double long_m = draw->within(0.3, 4.0), px = 2.25 + draw->within(0.0, 5.0), py = draw->within(-1.5, 1.5);
    w.puddles.push_back({px, px + long_m, py - 1.0, py + 1.0, draw->happens(0.5)});
    if (plan->kind == Kind::puddle) {
      const double at = px + draw->within(0.0, long_m);
      w.things.push_back(draw->happens(0.5) ? round_thing(at, y, 0.2, -0.1, 1.7)
                                            : round_thing(at, y, draw->within(0.15, 0.3), -0.1, 0.35));
    }
  }
}

// Nothing stands nearer than what _confirm vouches for, and nothing on the machine's own ground when it turns.
inline void clear_start(Plan* plan, const pose_wall_planar_stop_settings& settings) {
  auto& things = plan->world.things;
  for (auto& t : things) {
    const double half = t.reach_m();
    const double dx = std::fmax(std::fabs(t.x_m) - 2.25, 0.0), dy = std::fmax(std::fabs(t.y_m) - 0.6, 0.0);
    const double far = std::hypot(dx, dy) - half;
    const bool is_low = t.top_m < settings.tall_m || t.bottom_m > 0.0;
    if (is_low && far < settings.confirm_m) t.x_m = 2.25 + settings.confirm_m + half + 0.05;
  }
}

inline void draw_loss(Plan* plan, double until_s, Draw* draw) {
  plan->loss = static_cast<Loss>(1 + draw->below(static_cast<std::uint32_t>(Loss::losses) - 1));
  plan->loss_from_s = draw->within(0.5, until_s);
  plan->dirt_to_rad = draw->within(-0.4, 0.7);
  plan->frozen_rad = draw->within(0.2, 1.5);  // the stop promises to see 10 degrees of it
}

inline Plan draw_plan(Draw* draw, const pose_wall_planar_stop_settings& settings) {
  Plan plan;
  World& w = plan.world;
  w.half_width_m = draw->within(2.0, 3.0), w.roof_m = draw->within(2.6, 3.6);
  w.floor_wave_m = draw->within(0.0, 0.03), w.floor_length_m = draw->within(5.0, 12.0);
  w.floor_phase = draw->within(0.0, 6.28), w.floor_rough_m = draw->within(0.0, 0.015);
  w.wall_wave_m = draw->within(0.0, 0.12), w.wall_length_m = draw->within(0.8, 4.0);
  w.wall_phase = draw->within(0.0, 6.28);
  if (draw->happens(0.1)) w.face_m = draw->within(5.0, 10.0);
  draw_drive(&plan, draw);
  draw_sensor(&plan, draw);
  plan.kind = static_cast<Kind>(1 + draw->below(static_cast<std::uint32_t>(Kind::kinds) - 1));
  furnish(&plan, draw);
  if (plan.drive == Drive::spot || plan.drive == Drive::reverse) {
    for (Thing& t : w.things) {
      if (t.walks_until_s > 0.0) continue;
      if (plan.drive == Drive::reverse) t.x_m = -t.x_m;
      if (plan.drive == Drive::spot && draw->happens(0.6)) {
        const double a = draw->within(0.0, 6.28);
        t.x_m = 3.2 * std::cos(a), t.y_m = std::fmin(std::fmax(2.6 * std::sin(a), -1.9), 1.9);
      }
    }
  }
  if (draw->happens(0.2)) draw_loss(&plan, 6.0, draw);
  clear_start(&plan, settings);
  return plan;
}

}  // namespace pose_wall::test
