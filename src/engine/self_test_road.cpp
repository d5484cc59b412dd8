// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/self_test_road.hpp"

#include "base/math/elementary.hpp"
#include "base/math/golden_ratio.hpp"

namespace pose_wall {
namespace {

// The road of the self test: metres from the sensor to its surfaces, and its steel sets. Made up; kSelfTestTruth
// follows from them:
constexpr double kToLeft_m = 2.6, kToRight_m = 2.2, kToFloor_m = 1.5, kToRoof_m = 1.9, kToFace_m = 30.0;
constexpr double kSteel_m = 0.14, kSteelShare = 0.15;
constexpr double kNoise_m = 0.02;  // from end to end
// Half tangents: with them sine and cosine are quotients. 0.02 is 2.29 degrees.
constexpr double kRoll_t = 0.01, kPitch_t = -0.015, kTurnedLeft_t = 0.02;
constexpr double kElevation_t = 0.2;  // of the outermost lines: 22.6 degrees up and down

struct Turn {
  double c, s;
};

Turn turn_by(double half_tangent) {
  const double t2 = half_tangent * half_tangent;
  return {(1.0 - t2) / (1.0 + t2), 2.0 * half_tangent / (1.0 + t2)};
}

// (a, b) turned from the axis of a to that of b.
void turn(const Turn& by, double* a, double* b) {
  const double turned_a = by.c * *a - by.s * *b;
  *b = by.s * *a + by.c * *b;
  *a = turned_a;
}

// In [-0.5, 0.5), by chance.
double chance(std::uint64_t of) {
  of = (of + 1) * kGoldenTurn64;
  of = (of ^ (of >> 29)) * 0xBF58476D1CE4E5B9ULL;
  return static_cast<double>(static_cast<std::uint32_t>(of >> 32)) / 4294967296.0 - 0.5;
}

// Range to a plane of the road at a distance ahead or behind along an axis; beyond everything where it is not there.
double range_m(double along, double ahead_m, bool ahead, double behind_m, bool behind) {
  constexpr double kNothing_m = 1e9;  // beyond all of the road
  if (along > 0.0 && ahead) return ahead_m / along;
  return along < 0.0 && behind ? behind_m / -along : kNothing_m;
}

bool on_steel(double x_m) {
  const double place = x_m + 1000.0;
  if (!(place > 0.0 && place < 2000.0)) return false;
  return place - static_cast<double>(static_cast<std::uint32_t>(place)) < kSteelShare;
}

double range_of_ray_m(const SelfTestScene& scene, const double (&ray_base)[3]) {
  double x = ray_base[0], y = ray_base[1], z = ray_base[2];
  turn(turn_by(kRoll_t), &y, &z);
  turn(turn_by(kPitch_t), &z, &x);
  turn(turn_by(kTurnedLeft_t), &x, &y);
  double to_side_m = range_m(y, kToLeft_m, scene.left, kToRight_m, scene.right);
  if (scene.steel && on_steel(to_side_m * x)) to_side_m *= 1.0 - kSteel_m / (y > 0.0 ? kToLeft_m : kToRight_m);
  const double to_level_m = range_m(z, kToRoof_m, true, kToFloor_m, scene.floor);
  const double to_face_m = range_m(x, kToFace_m, true, kToFace_m, true);
  const double nearer_m = to_side_m < to_level_m ? to_side_m : to_level_m;
  return nearer_m < to_face_m ? nearer_m : to_face_m;
}

}  // namespace

// Angles: twice the arc tangent of the half tangents; yaw is from the machine to the road. Distances at right
// angles to the wall, from 2 m ahead and 2 m behind: the sine of yaw is 0.039984.
const double kSelfTestTruth[7] = {0.019999333, -0.029997750, -0.039994667, 2.520032, 2.679968, 2.279968, 2.120032};

std::uint32_t scan_self_test_road(const SelfTestScene& scene, std::uint32_t frame, float (*points_base_m)[3]) {
  std::uint32_t count = 0;
  for (std::uint32_t line = 0; line < kSelfTestLines; ++line) {
    const double share = (static_cast<double>(line) + 0.5) / kSelfTestLines;
    const Turn up = turn_by(kElevation_t * (2.0 * share - 1.0)), step = turn_by(kPi / kSelfTestTurns);
    double x = 1.0, y = 0.0;
    for (std::uint32_t k = 0; k < kSelfTestTurns; ++k) {
      turn(step, &x, &y);
      const double ray[3] = {up.c * x, up.c * y, up.s};
      const double range = range_of_ray_m(scene, ray);
      if (!(range < 60.0)) continue;
      const std::uint64_t luck = (static_cast<std::uint64_t>(frame) << 32) + line * kSelfTestTurns + k;
      const double measured_m = range + kNoise_m * chance(luck);
      for (int axis = 0; axis < 3; ++axis) points_base_m[count][axis] = static_cast<float>(measured_m * ray[axis]);
      ++count;
    }
  }
  return count;
}

}  // namespace pose_wall
