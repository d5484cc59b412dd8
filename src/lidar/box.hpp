// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A box of base that belongs to the machine.

#pragma once

namespace pose_wall {

struct Box {
  double x_min, x_max, y_min, y_max, z_min, z_max;

  // A box without volume holds nothing; that is how "no box" is stored.
  bool holds_something() const { return x_max > x_min && y_max > y_min && z_max > z_min; }
  // Whether one that came with a frame can be used.
  bool is_sound() const {
    constexpr double kMost_m = 1000.0;  // no machine is as large: more is a wrong unit
    return is_within(x_min, x_max, kMost_m) && is_within(y_min, y_max, kMost_m) && is_within(z_min, z_max, kMost_m);
  }
  bool contains(double x, double y, double z) const {
    return x >= x_min && x <= x_max && y >= y_min && y <= y_max && z >= z_min && z <= z_max;
  }

 private:
  static bool is_within(double low, double high, double most) { return low >= -most && low <= high && high <= most; }
};

inline Box box_of(const double (&edges_m)[6]) {
  return {edges_m[0], edges_m[1], edges_m[2], edges_m[3], edges_m[4], edges_m[5]};
}

}  // namespace pose_wall
