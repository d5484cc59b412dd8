// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A route pulled taut: corners left out, cut off and moved as long as it gets cheaper and every sweep stays free.

#pragma once

#include <cstdint>

#include "base/containers/span.hpp"
#include "planar/route/footprint.hpp"
#include "planar/route/leg.hpp"

namespace pose_wall::planar::route {

class Taut {
 public:
  // The corners' room may be larger than their count: cut corners are two. rows_most: of sweeps, then it ends.
  Taut(Sweeps* sweeps, const Costs& costs, Span<Corner> corners, std::uint32_t count, double start_yaw_rad,
       std::uint64_t rows_most)
      : sweeps_(sweeps),
        costs_(costs),
        corners_(corners),
        count_(count),
        start_yaw_rad_(start_yaw_rad),
        rows_end_(sweeps->rows() + rows_most) {}

  void pull();
  std::uint32_t count() const { return count_; }
  double cost_m() const { return cost_between(0, count_ - 1); }

 private:
  static constexpr std::uint32_t kNewMost = 2;  // a cut corner is two

  // Instead of the corners between `from` and `to`: new ones, each left in its gear, and `from` left in gear[0].
  struct Change {
    std::uint32_t from = 0, to = 0, count = 0;
    Eigen::Vector2d place_m[kNewMost];
    std::int32_t gear[kNewMost + 1] = {};
  };

  bool is_spent() const { return sweeps_->rows() >= rows_end_; }
  double arriving_yaw(std::uint32_t k) const { return k == 0 ? start_yaw_rad_ : corners_[k - 1].yaw_rad; }
  double cost_between(std::uint32_t from, std::uint32_t to) const;
  double cusps_about(std::int32_t before, const Corner* corners, std::uint32_t count, std::int32_t behind) const;
  bool try_change(const Change& change);
  bool is_way_free(const Corner* chain, std::uint32_t count, double arriving_rad) const;
  void commit(const Change& change, const Corner* chain);
  bool leave_out();
  bool move_corners(double step_m, std::uint32_t tried_bit);
  bool move_corner(std::uint32_t k, double step_m);
  bool cut_corners();
  bool cut_corner(std::uint32_t k, double before_m, double behind_m);

  Sweeps* sweeps_;
  Costs costs_;
  Span<Corner> corners_;
  std::uint32_t count_;
  double start_yaw_rad_;
  std::uint64_t rows_end_;
};

}  // namespace pose_wall::planar::route
