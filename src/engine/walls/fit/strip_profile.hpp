// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Steel sets, props and posts at a wall: strips that stand out of it over its whole height, one decimetre wide.
//
// Point by point they drown in rough rock. But a strip stands out everywhere along its height, and the rock does not.
// The mean over a narrow column keeps the strip's step, while the roughness averages out over the height. Long waves of
// the rock go with the local level of the columns around. So the columns are judged near the sensor first, where rock
// is seen between the strips. The plane through that rock then judges them further out, where the strips hide the rock
// and would bend the plane to themselves.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/estimation/tangent_points.hpp"
#include "base/simd/four_floats.hpp"
#include "engine/walls/fit/two_layers.hpp"

namespace pose_wall {

class StripProfile {
 public:
  void lay_out(Arena& arena);

  // Columns from u_min_m on; points beyond the last one do not count.
  void begin(double u_min_m, double z_min_m, double z_max_m);
  // Adds those of four points that count, in a plane's coordinates. r_m: towards the sensor; z_m: height.
  void add(FourFloats u_m, FourFloats v_m, FourFloats r_m, FourFloats z_m, FourTruths counts);

  // True if columns within reach_m of u_centre_m stand out of those around them, seen from the plane `over`. Sets
  // surface_probability() there. Columns further away get 0: nothing is known of them yet.
  bool find(const PlaneOver& over, double u_centre_m, double reach_m, double gate_m);
  // Judges all columns within reach_m by the step found so far, seen from the plane through the surface. Columns judged
  // before keep their probability. reach_m: never less than in the last call. Returns the share of points in newly
  // judged columns, of the points in all judged columns.
  double judge(const PlaneOver& over, double u_centre_m, double reach_m);

  // A column that was judged to be a strip's.
  bool is_strip(double u_m) const {
    const std::int32_t column = column_of(u_m);
    return column >= 0 && verdicts_[static_cast<std::uint32_t>(column)].is_strip != 0;
  }
  // Probability that the wall's own surface is seen in the column of u, 0..1.
  double surface_probability(double u_m) const {
    const std::int32_t column = column_of(u_m);
    return column < 0 ? 0.0 : static_cast<double>(verdicts_[static_cast<std::uint32_t>(column)].shown);
  }
  // The same for four places.
  struct FourColumns {
    FourFloats surface_probability;
    FourTruths is_strip;
  };
  FourColumns columns_of(FourFloats u_m) const {
    const FourFloats place = (u_m - static_cast<float>(u_min_)) * static_cast<float>(kColumnsPerMetre), none{};
    const FourTruths known = (place >= none) & (place < all_four(static_cast<float>(kColumns)));
    const FourInts column = cut_off(known ? place : none);
    const auto of = [&](std::uint32_t lane) -> const StripVerdict& {
      return verdicts_[static_cast<std::uint32_t>(column[lane])];
    };
    const StripVerdict &a = of(0), &b = of(1), &c = of(2), &d = of(3);
    const FourFloats shown{a.shown, b.shown, c.shown, d.shown};
    return {known ? shown : none, known & FourTruths{a.is_strip, b.is_strip, c.is_strip, d.is_strip}};
  }
  const TwoLayers& layers() const { return layers_; }

 private:
  static constexpr std::uint32_t kColumns = 1280;   // 64 m: kProfileReach_m to both sides
  static constexpr double kColumnsPerMetre = 20.0;  // of 5 cm: half a steel set's width (README, Steel sets)
  // A column is a strip's by four to one; swept: half 19 moved, twice 19 moved.
  static constexpr float kStripProbabilityMax = 0.2F;
  struct Column {
    FourFloats sums;     // of its points: r, u, v, and their number
    std::uint32_t rows;  // one bit for each sixteenth of the height with points
    float probability;
    bool judged;
    bool has_level;
    double mean_m;   // distance from the plane it is seen from
    double level_m;  // of the columns around

    bool has_points() const { return sums[3] > 0.0F; }
    bool is_strip() const { return judged && probability < kStripProbabilityMax; }
  };
  // The verdict on a column.
  struct StripVerdict {
    float shown;            // smallest probability of it and its flanks
    std::int32_t is_strip;  // a truth
  };

  std::int32_t column_of(double u_m) const {
    const double place = (u_m - u_min_) * kColumnsPerMetre;
    return place >= 0.0 && place < kColumns ? static_cast<std::int32_t>(place) : -1;
  }
  bool seen(const Column& c) const;
  void look_from(const PlaneOver& over);
  void find_levels(std::int32_t first, std::int32_t last);
  bool level_around(std::int32_t column, double* level_m) const;
  static double contrast_of(const Column& c) { return c.mean_m - c.level_m; }
  void look_at_flanks(std::int32_t first, std::int32_t last);
  bool narrow(std::int32_t first, std::int32_t last, double gate_m) const;

  Span<Column> columns_;
  Span<StripVerdict> verdicts_;
  double u_min_ = 0.0, z_min_ = 0.0, rows_per_m_ = 1.0;
  TwoLayers layers_;
};

}  // namespace pose_wall
