// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The furnished class: a fixed set of roads as live sensors meet them, so that what they lost once is not lost again.
// Scans take their time and are told so. The sensors come in turn, the Ousters twice: their frames are the dearest.
// Each sensor is driven on half of its roads. Two of three roads are rich.

#pragma once

#include <array>

#include "judge/trial.hpp"

namespace pose_wall::judge {

constexpr int kFurnishedRoads = 60, kFurnishedFrames = 3;

inline Case furnished_road(int k) {
  constexpr std::uint64_t kFirst = 20261127;  // a date
  constexpr std::array<const char*, 10> kTurn = {"os1_64_beams", "vlp16_beams",  "os0_128_beams", "hdl32_beams",
                                                 "rs16",         "os1_64_beams", "vlp32c",        "os0_128_beams",
                                                 "xt32",         "mid360_down"};
  const int round = k / static_cast<int>(kTurn.size());
  Case tried;
  tried.seed = kFirst + static_cast<std::uint64_t>(k);
  tried.frames = kFurnishedFrames;
  tried.times = true;
  tried.sensor = sensor_row(kTurn.at(static_cast<std::size_t>(k) % kTurn.size()));
  tried.going = (round + k) % 2 == 0 ? Going::kStands : Going::kDrives;
  tried.furnishing = k % 3 == 0 ? Furnishing::kDrawn : Furnishing::kRich;
  return tried;
}

}  // namespace pose_wall::judge
