// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What a whole search says: one place, several, or none.

#pragma once

#include <cstdint>

#include "planar/localise/place_search.hpp"

namespace pose_wall::planar {

enum class Finding : std::uint32_t { unknown, ambiguous, unique };

// What keeps a place from being unique, the first that does; as pose_wall_planar_localise_reason.
enum class Why : std::uint32_t {
  none,
  searching,
  no_fit,
  several,
  crowded,
  misfit,
  unseen,
  through,
  few,
  slides,
  smooth,
  scan_differs,
  contradicted,
  repeated
};

struct CandidatePlace {
  Pose2 pose;             // of base when it was seen
  double weight = 0.0;    // all together 1
  double worse_by = 0.0;  // standard errors of the mean patch, than the best
  double fits = 0.0;      // share of the patches
  double spread_m = 0.0;  // how far apart the places are that stand for this one
};

constexpr std::uint32_t kCandidatesMost = 32;  // those that were fitted with all points; `all` counts the rest

// Evidence that the finding rests on.
struct Evidence {
  double fits = 0.0, explained = 0.0, seen = 0.0, rms_m = 0.0, through = 0.0, slide_m = 0.0;
  double rival = 0.0;  // standard errors by which the best other place fits worse
  std::uint32_t patches = 0;
  std::uint32_t relief = 0;  // patches with relief of their own
};

struct SearchVerdict {
  Finding finding = Finding::unknown;
  Why why = Why::searching;
  CandidatePlace candidates[kCandidatesMost];
  std::uint32_t count = 0;
  std::uint32_t all = 0;  // also those that had no room
  Evidence best;
};

// map_is_whole: the machine cannot be where the map has nothing. Otherwise one place needs relief, too: of walls
// without any there may be others, which the map lacks. `walls`: room for kPatchesMost.
void judge(const PlaceMap& map, const Surroundings& around, const PlaceSearch& search, bool map_is_whole,
           Span<PatchWall> walls, SearchVerdict* out);

}  // namespace pose_wall::planar
