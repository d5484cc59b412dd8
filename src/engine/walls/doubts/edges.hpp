// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Looks past a chosen plane: at its ends, over its top and through it.

#pragma once

#include <cstdint>
#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/estimation/plane.hpp"
#include "base/simd/four_floats.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

// Counts measured points by place. A place is half a metre of the plane, on either side of the sensor.
class EndPlaces {
 public:
  static constexpr std::uint32_t kPlaces = 30;  // on either side: 15 m, as far as kHighReach_m
  static constexpr double kPlace_m = 0.5;       // as long as a column of the wall's grid
  // 6 m: curtains and vehicles end within; swept: half and twice change nothing.
  static constexpr std::uint32_t kNearPlaces = 12;
  static constexpr double kOnMin = 2.0;    // one or two points may be strays; swept: half and twice change nothing
  static constexpr double kPastMin = 4.0;  // least points seen past an end; swept: half and twice change nothing

  void clear() { *this = EndPlaces(); }
  // Places of four points. Points too far away go to a place that is never read.
  static FourInts places_of(FourFloats along_m);
  void add_on(std::int32_t place, float points) { on_[place] += static_cast<double>(points); }
  void add_past(std::int32_t place, float points) { past_[place] += static_cast<double>(points); }
  void add_just_behind(std::int32_t place, float points) { just_behind_[place] += static_cast<double>(points); }
  bool both_are_looked_past() const { return is_looked_past(0) && is_looked_past(kPlaces); }

 private:
  static constexpr std::uint32_t kElsewhere = 2 * kPlaces;  // one place after those of both sides: too far away
  // For the end whose places begin here.
  bool is_looked_past(std::uint32_t begin) const;

  double on_[kElsewhere + 1] = {}, past_[kElsewhere + 1] = {}, just_behind_[kElsewhere + 1] = {};
};

// Counts measured points by place and by the height at which their rays meet the plane, in steps from the lowest.
class TopPlaces {
 public:
  static constexpr double kOverMin = 4.0;  // of 1338 planes with walls none had more than 2 (README, Edges)

  void lay_out(Arena& arena) { cell_ = arena.take<float>(kPlaces * kPlaceCells); }
  void clear() { cell_.fill(0.0F); }
  static constexpr std::int32_t kNoCell = -1;  // outside; no cell is negative
  // Cells of four points; height: 0 (lowest) to 1. Points outside have kNoCell.
  static FourInts cells_of(FourFloats along_m, FourFloats height, FourTruths is_past);
  void add(std::int32_t cell, float points) { cell_[static_cast<std::uint32_t>(cell)] += points; }
  bool is_looked_over() const;

 private:
  static constexpr std::uint32_t kPlaces = 2 * EndPlaces::kPlaces;  // both sides of EndPlaces
  // Of some 10 cm, over the band and kAboveBand_m; swept: half and twice change nothing.
  static constexpr std::uint32_t kSteps = 32;
  static constexpr std::uint32_t kPlaceCells = 2 * kSteps;  // on the plane, and past it
  Span<float> cell_;
};

// Counts measured points behind a plane by their depth behind it, and marks the places along it.
class DepthsBehind {
 public:
  // Noise makes no layer of so many points; swept: half and twice change nothing.
  static constexpr double kPointsMin = 20.0;

  void clear() { *this = DepthsBehind(); }
  void add(double behind_m, double along_m, double points);
  // on_plane: number of points on the plane itself.
  bool hold_a_layer(double on_plane) const;

 private:
  static constexpr std::uint32_t kSteps = 20;  // decimetres: 2 m, as kMayStep_m
  struct Step {
    double points = 0.0;
    std::uint64_t places = 0;  // one bit for each half metre
  };
  Step step_[kSteps];
};

// Results of the look past the edges of a chosen plane, place by place along it: two ends and the top.
struct WallEdges {
  // The sensor looks past both ends near itself: a curtain or a vehicle hides the wall. A wall goes on until it is out
  // of sight. One that bends away is seen just behind its end, and behind an opening there is more of it.
  bool island = false;
  // The sensor looks over the top, even if only far ahead where its rays have risen: a conveyor, or pipes. A wall
  // reaches up to the roof, or higher than the sensor looks.
  bool low = false;
  // Almost no return, from the plane or from before it, above the height of most things along walls. The sensor hardly
  // looks up, and cannot separate a wall from a conveyor.
  bool top_unseen = false;
  // Another surface shows behind it, through gaps and past its foot and top, parallel and as long: a wall behind pipes
  // and props that hide nearly all of it.
  bool layer_behind = false;
};

struct EdgeScratch {
  EndPlaces ends;
  TopPlaces tops;
  DepthsBehind depths;

  void lay_out(Arena& arena) { tops.lay_out(arena); }
};

// margin_m: returns this near to the plane belong to it.
WallEdges look_past(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double margin_m,
                    EdgeScratch* scratch);

}  // namespace pose_wall
