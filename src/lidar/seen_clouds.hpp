// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Recognises points that come again. What a driver or a network delivers anew is as old as its first copy, whatever its
// stamp: whole clouds, rings of them, and the sectors of lost packets that a driver leaves as they were.

#pragma once

#include <cstdint>

#include "lidar/cloud_print.hpp"

namespace pose_wall {

struct Repeat {
  bool is_one = false;
  double age_s = 0.0;  // since the first copy that is known; below 0 where the clock went back since then
};

struct SeenCloud {
  std::uint64_t print = 0;    // 0: none
  std::int64_t stamp_ns = 0;  // of its first copy
};

// The last different clouds. A recording played in a loop comes round later than that, or counts as a ring.
struct SeenClouds {
  static constexpr std::uint32_t kCount = 64;  // 3 to 6 s: as many as a driver may hold. Issue of the guard, 2026-11
  // Fewer returns of a scene that stands still may come out alike. 64 of which two in three repeat do so once in 1e11.
  static constexpr std::uint32_t kReturnsLeast = 64;

  // A new cloud takes the place of the oldest; a repeat none.
  Repeat keep(std::uint64_t print, std::int64_t stamp_ns);

  SeenCloud cloud[kCount];  // the newest first
};

// What the last clouds showed by sector. A part of one that comes again is a run of sectors, two or
// more, with the same prints.
struct SeenSectors {
  // As many as the buffers that a driver fills in turn. What stays old for longer is in each cloud since then, and as
  // old as in the first of them.
  static constexpr std::uint32_t kCount = 8;
  // In a run. 256 returns of which nine in ten repeat come out alike once in 1e12; of real noise and steps of 5 mm two
  // in three do. Sectors without returns do not end a run, and 10 degrees of a VLP-16 hold 560 shots in whole sectors.
  static constexpr std::uint32_t kReturnsLeast = 256;

  Repeat keep(const CloudPrint& now, std::int64_t stamp_ns);

  std::uint32_t print[CloudPrint::kSectors][kCount] = {};  // 0: no return
  std::int64_t stamp_ns[kCount] = {};                      // of the first copy of their oldest part
  std::uint32_t next = 0;
};

// Whether points came before: the guard of freshness of engine, motion and stop. Localisation keeps prints of scans.
struct RepeatGuard {
  // Whether the cloud, or a part of it, was seen before. Keeps it.
  Repeat keep(const CloudPrint& now, std::int64_t stamp_ns);

  SeenClouds clouds;
  SeenSectors sectors;
};

}  // namespace pose_wall
