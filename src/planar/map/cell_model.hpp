// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A cell in one byte, and what a beam does to it.
//
//     0             never seen
//     1 to 127      log-odds of a thing: (byte - 64) / 16
//     top bit set   written to by the present scan: later beams of this scan leave it as it is

#pragma once

#include <cstdint>

#include "pose_wall_planar_map.h"

namespace pose_wall::planar {

constexpr std::uint8_t kNeverSeen = 0;     // of a new tile
constexpr std::uint8_t kEvenOdds = 64;     // the middle of 1 to 127: a thing is as likely as none
constexpr std::uint8_t kTouched = 0x80;    // the top bit, which no value has
constexpr std::uint8_t kValueMost = 0x7F;  // all bits but that one
constexpr double kStepsOfLogOdds = 16.0;   // a range of -3.9 to 3.9: probabilities of 0.02 to 0.98

struct CellModel {
  CellModel() = default;
  explicit CellModel(const pose_wall_planar_map_settings& settings);

  std::uint8_t hit[256];  // the byte after it
  // Of a beam that goes through the cell's middle half, and of one that passes beside it: that one leaves things alone,
  // for most cells of a wall are part rock, part air.
  std::uint8_t miss[2][256];
  std::int8_t per_cent[128];            // probability of a thing; never seen: -1
  std::uint8_t thing_from, free_up_to;  // values
  std::uint8_t least, most;             // no beam moves a value beyond these
};

// The evidence of both.
std::uint8_t sum_of(const CellModel& model, std::uint8_t a, std::uint8_t b);

// Of a value that was seen.
double probability_of(std::uint8_t value);

}  // namespace pose_wall::planar
