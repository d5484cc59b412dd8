// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Steel sets, props and posts at a wall: strips that stand out of it over its whole height, one decimetre wide.
//
// Point by point they drown in rough rock. But a strip stands out everywhere along its height, and the rock does not:
// the mean over a narrow column keeps the strip's step, while the roughness averages out over the height, and what is
// left of it over more than half a metre goes with the local level of the columns around. So the columns are told
// apart near the sensor first, where rock is seen between the strips; the plane through that rock then tells them apart
// further out, where the strips hide the rock behind them and would bend the plane to themselves.

#pragma once

#include <cstdint>

#include "containers/arena.hpp"
#include "containers/span.hpp"
#include "estimation/two_layers.hpp"
#include "math/four_floats.hpp"

namespace pose_wall {

class StripProfile {
 public:
  void lay_out(Arena& arena);

  // Columns from u_min_m on; what lies beyond the last one plays no part.
  void begin(double u_min_m, double v_min_m, double v_max_m);
  // Another plane: the residuals are added anew, what the columns were judged to be stays.
  void begin_anew();
  // residual_m: signed distance from a plane, positive towards the sensor.
  void add(double u_m, double v_m, double residual_m);
  // Of four points, those that count.
  void add(FourFloats u_m, FourFloats v_m, FourFloats residual_m, FourTruths counts);

  // Whether columns within reach_m of u_centre_m stand out of those around them. Fills surface_probability() there;
  // columns further away get 0: nothing is known of them yet.
  bool find(double u_centre_m, double reach_m, double gate_m);
  // With residuals from the plane through the surface: tells all columns within reach_m apart by the step that was
  // found. Columns that were judged before keep their probability. False where there were no others. reach_m: never
  // less than in the last call.
  bool judge(double u_centre_m, double reach_m);

  // A column that was judged to be a strip's.
  bool is_strip(double u_m) const {
    const std::int32_t column = column_of(u_m);
    return column >= 0 && columns_[static_cast<std::uint32_t>(column)].is_strip();
  }
  // That the wall's own surface is seen in the column of u, 0..1.
  double surface_probability(double u_m) const {
    const std::int32_t column = column_of(u_m);
    return column < 0 ? 0.0 : static_cast<double>(columns_[static_cast<std::uint32_t>(column)].shown);
  }
  // Of four places at once.
  struct FourColumns {
    FourFloats surface_probability;
    FourTruths is_strip;
  };
  FourColumns columns_of(FourFloats u_m) const;
  const TwoLayers& layers() const { return layers_; }

 private:
  static constexpr std::uint32_t kColumns = 1280;
  static constexpr double kColumnsPerMetre = 20.0;
  static constexpr float kStripProbabilityMax = 0.2F;
  struct Column {
    float sum;
    std::uint16_t count;
    std::uint16_t rows;  // one bit for each sixteenth of the height with points
    float probability;
    float shown;  // smallest probability of it and its flanks
    bool judged;
    bool has_level;
    double level_m;  // of the columns around

    bool is_strip() const { return judged && probability < kStripProbabilityMax; }
  };

  std::int32_t column_of(double u_m) const {
    const double place = (u_m - u_min_) * kColumnsPerMetre;
    return place >= 0.0 && place < kColumns ? static_cast<std::int32_t>(place) : -1;
  }
  bool seen(const Column& c) const;
  static double mean(const Column& c) { return static_cast<double>(c.sum) / static_cast<double>(c.count); }
  void find_levels(std::int32_t first, std::int32_t last);
  bool level_around(std::int32_t column, double* level_m) const;
  static double contrast_of(const Column& c) { return mean(c) - c.level_m; }
  void look_at_flanks(std::int32_t first, std::int32_t last);
  bool narrow(std::int32_t first, std::int32_t last, double gate_m) const;

  Span<Column> columns_;
  double u_min_ = 0.0, v_min_ = 0.0, rows_per_m_ = 1.0;
  TwoLayers layers_;
};

}  // namespace pose_wall
