// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A tracked machine that drives along an arc, obeys the stop late, and brakes as weakly as the settings allow.

#pragma once

#include <cmath>
#include <deque>

#include "planar/encounter/world.hpp"

namespace pose_wall::test {

struct Machine {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  double front_m = 2.25, back_m = -2.25, half_m = 0.6;  // footprint
  double top_m = 1.7;
  double velocity = 1.0, turn_rad_m = 0.0;  // of base and of the turn, for a rim speed of 1 m/s
  double rim_m_s = 0.0;
  double acceleration = 1.0, deceleration = 1.0, latency_s = 0.2;

  double speed_m_s() const { return rim_m_s * velocity; }
  double turn_rad_s() const { return rim_m_s * turn_rad_m; }

  // The arc with speed v and turn w, as its fastest corner moves at 1 m/s.
  void set_arc(double v, double w) {
    double most = 0.0;
    for (const double cx : {front_m, back_m}) {
      for (const double cy : {-half_m, half_m}) most = std::fmax(most, std::hypot(v - w * cy, w * cx));
    }
    velocity = v / most, turn_rad_m = w / most;
  }

  // What the controller wants from now on; it acts after the latency.
  void command(double now_s, double rim, bool brakes) { queue_.push_back({now_s + latency_s, rim, brakes}); }

  void step(double now_s, double seconds) {
    while (!queue_.empty() && queue_.front().from_s <= now_s + 1e-9) {
      wanted_ = queue_.front().rim;
      queue_.pop_front();
    }
    if (rim_m_s > wanted_)
      rim_m_s = std::fmax(wanted_, rim_m_s - deceleration * seconds);
    else
      rim_m_s = std::fmin(wanted_, rim_m_s + acceleration * seconds);
    const double middle = yaw_rad + 0.5 * turn_rad_s() * seconds;
    x_m += std::cos(middle) * speed_m_s() * seconds;
    y_m += std::sin(middle) * speed_m_s() * seconds;
    yaw_rad += turn_rad_s() * seconds;
  }
  double wanted() const { return wanted_; }

  // From the footprint; 0 inside.
  double distance(double x, double y) const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad), dx = x - x_m, dy = y - y_m;
    const double qx = c * dx + s * dy, qy = c * dy - s * dx;
    const double ox = std::fmax(std::fmax(back_m - qx, qx - front_m), 0.0);
    return std::hypot(ox, std::fmax(std::fabs(qy) - half_m, 0.0));
  }

  // Whether the machine touches a thing with a surface that moves towards it.
  bool touches(const Thing& thing) const {
    if (thing.bottom_m > top_m || rim_m_s <= 0.0) return false;
    if (thing.is_round()) return touches(thing.x_m, thing.y_m, thing.half_x_m);
    const double c = std::cos(thing.yaw_rad), s = std::sin(thing.yaw_rad);
    constexpr int kAlong = 10;  // points of its outline to each side
    for (int i = -kAlong; i <= kAlong; ++i) {
      const double a = thing.half_x_m * i / kAlong, b = thing.half_y_m * i / kAlong;
      const double outline[4][2] = {
          {a, thing.half_y_m}, {a, -thing.half_y_m}, {thing.half_x_m, b}, {-thing.half_x_m, b}};
      for (const auto& p : outline) {
        if (touches(thing.x_m + c * p[0] - s * p[1], thing.y_m + s * p[0] + c * p[1], 0.0)) return true;
      }
    }
    return false;
  }

 private:
  struct Wanted {
    double from_s, rim;
    bool brakes;
  };

  bool touches(double x, double y, double radius) const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad), dx = x - x_m, dy = y - y_m;
    const double qx = c * dx + s * dy, qy = c * dy - s * dx;
    const double nx = std::fmin(std::fmax(qx, back_m), front_m), ny = std::fmin(std::fmax(qy, -half_m), half_m);
    double ox = qx - nx, oy = qy - ny;
    const double off = std::hypot(ox, oy);
    if (off > radius) return false;
    if (off < 1e-9) {  // inside: outwards over the nearest edge
      const double to[4] = {front_m - qx, qx - back_m, half_m - qy, qy + half_m};
      int k = 0;
      for (int j = 1; j < 4; ++j) k = to[j] < to[k] ? j : k;
      ox = k == 0 ? 1.0 : k == 1 ? -1.0 : 0.0, oy = k == 2 ? 1.0 : k == 3 ? -1.0 : 0.0;
    } else {
      ox /= off, oy /= off;
    }
    constexpr double kTowards_m_s = 0.01;  // slower it does not touch, it is touched
    return (speed_m_s() - turn_rad_s() * ny) * ox + turn_rad_s() * nx * oy > kTowards_m_s;
  }

  std::deque<Wanted> queue_;
  double wanted_ = 0.0;
};

}  // namespace pose_wall::test
