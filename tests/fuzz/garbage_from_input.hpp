// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points that show no road, and roads with damage, by a few bytes of an input.

#pragma once

#include <cmath>

#include "fuzz/fuzz_target.hpp"

extern "C" {
#include "roadway.h"
}

namespace pose_wall::test {

inline float float_of(std::uint64_t bits) {
  const auto low = static_cast<std::uint32_t>(bits);
  float number;
  std::memcpy(&number, &low, sizeof number);
  return number;
}

// In [-1, 1).
inline float share_of(std::uint64_t bits) {
  return static_cast<float>(static_cast<double>(bits >> 40) / 8388608.0 - 1.0);
}

enum class Garbage { kAnyBits, kBall, kShell, kLine, kFewPlaces, kCube, kInput, kNone, kCount };

inline void garbage_point(Garbage kind, std::uint64_t chance, double reach_m, float (&p)[3]) {
  const std::uint64_t more = scramble(chance), most = scramble(more);
  const auto reach = static_cast<float>(reach_m);
  const float a = share_of(chance), b = share_of(more), c = share_of(most);
  const float norm = std::sqrt(a * a + b * b + c * c) + 1e-6F;
  switch (kind) {
    case Garbage::kAnyBits:
      p[0] = float_of(chance), p[1] = float_of(more), p[2] = float_of(most);
      return;
    case Garbage::kShell:
      p[0] = reach * a / norm, p[1] = reach * b / norm, p[2] = reach * c / norm;
      return;
    case Garbage::kLine:
      p[0] = reach * a, p[1] = 0.3F * reach * a + 0.01F * b, p[2] = -0.2F * reach * a + 0.01F * c;
      return;
    case Garbage::kFewPlaces:
      p[0] = static_cast<float>(chance % 3) - 1.0F, p[1] = static_cast<float>(more % 3) - 1.0F, p[2] = 1.0F;
      return;
    case Garbage::kCube:
      // Corners of the finest grid that a voxel's key can hold, and beyond.
      p[0] = std::ldexp(a, static_cast<int>(more % 40)), p[1] = std::ldexp(b, static_cast<int>(most % 40)), p[2] = c;
      return;
    default:
      p[0] = reach * a, p[1] = reach * b, p[2] = reach * c;
  }
}

// Returns how many there are.
inline std::uint32_t garbage_points(Input* input, float (*points)[3], std::uint32_t room) {
  const auto kind = static_cast<Garbage>(input->below(static_cast<std::uint32_t>(Garbage::kCount)));
  if (kind == Garbage::kNone) return 0;
  if (kind == Garbage::kInput) {
    const auto held = static_cast<std::uint32_t>(input->left() / sizeof points[0]);
    const std::uint32_t count = held < room ? held : room;
    for (std::uint32_t i = 0; i < count; ++i) {
      for (float& coordinate : points[i]) coordinate = input->take<float>();
    }
    return count;
  }
  const std::uint32_t count = input->take<std::uint16_t>() % room;
  const double reach_m = input->between(0.1, 40.0);
  const std::uint64_t seed = std::uint64_t{input->byte()} << 32U;
  for (std::uint32_t i = 0; i < count; ++i) garbage_point(kind, scramble(seed + i), reach_m, points[i]);
  return count;
}

// Some points become any bits, some are lost. Returns how many there are then.
inline std::uint32_t damage_points(Input* input, float (*points)[3], std::uint32_t count) {
  const std::uint8_t how = input->byte();
  const std::uint64_t seed = std::uint64_t{how} << 32U;
  if ((how & 3U) == 1U) {
    const std::uint32_t every = 1 + input->byte();
    for (std::uint32_t i = 0; i < count; i += every) {
      points[i][scramble(seed + i) % 3] = float_of(scramble(seed ^ i));
    }
  }
  return (how & 3U) == 2U ? static_cast<std::uint32_t>(count * (input->byte() / 256.0)) : count;
}

}  // namespace pose_wall::test
