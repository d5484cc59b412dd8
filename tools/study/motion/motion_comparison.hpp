// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A motion table beside the true poses: drift, errors in six directions beside what was promised, and states.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/motion/motion_table.hpp"
#include "study/motion/pose_truth.hpp"

namespace pose_wall::tools {

// Errors in one direction, m or rad.
class DirectionErrors {
 public:
  // An error without a level is beyond it; one without a sigma, or with none that is finite, has no z.
  void add(double error, double sigma, double level);
  void merge(const DirectionErrors& other);

  std::size_t count() const { return count_; }
  std::size_t beyond() const { return beyond_; }
  double rmse() const;     // NaN for none
  double largest() const;  // absolute; NaN for none
  double mean_z2() const;  // NaN for none

 private:
  std::size_t count_ = 0, beyond_ = 0, with_z_ = 0;
  double sum_of_squares_ = 0.0, sum_z2_ = 0.0, largest_ = 0.0;
};

// An error as it was at the end and where it was largest.
struct TravelError {
  double at_end = 0.0;   // m or rad, with its sign
  double largest = 0.0;  // absolute
  std::uint64_t largest_at_frame = 0;

  void add(double error, std::uint64_t frame);
};

// Translation errors at the ends of segments of 10 m of true path, one from every frame on, as shares of the path.
struct SegmentDrift {
  std::size_t count = 0;
  double mean = 0.0, worst = 0.0;
  std::uint64_t worst_from_frame = 0;
};

// How often the way along was called measured, and was wrong by more than its level then.
struct Misleading {
  std::size_t measured = 0, misleading = 0;
  double worst_excess = 0.0;  // largest error beyond its level, as a multiple of it; infinite where there is no level
  std::uint64_t worst_frame = 0;

  void add(double error, double level, std::uint64_t frame);
  void merge(const Misleading& other);
};

struct MotionComparison {
  std::string matched_by;  // "stamp_ns" or "frame"
  std::size_t matched = 0;
  std::size_t other_stamps = 0;  // of those matched by frame: are they of the same frame at all?
  std::size_t table_rows_alone = 0, truth_rows_alone = 0;
  std::array<std::size_t, POSE_WALL_ALONG_MEASURED + 2> states{};  // by pose_wall_along_state; the last: unreadable

  bool along_is_road = false;  // else: from the first true place to the one that is furthest from it.
                               // Each row's own road where the truth tells it
  std::uint64_t first_frame = 0, last_frame = 0;  // where both have a pose; they are laid on each other at the first
  double way_m = 0.0;                             // true path from the first to the last
  double true_along_m = 0.0, measured_along_m = 0.0;
  std::array<TravelError, 3> travel{};  // along, across, up
  TravelError turn;                     // the angle of the whole turn, rad
  SegmentDrift drift;
  // Turns are about the axes of base at the first frame.
  std::array<DirectionErrors, POSE_WALL_MOTION_DIRECTIONS> pose, step;
  Misleading misleading_poses, misleading_steps;
  std::vector<std::optional<Eigen::Vector3d>> true_place_start_m;  // by the table's rows, in its own start
};

inline constexpr double kSegment_m = 10.0;

// Rows belong together as pair_rows says. Throws CsvError where no two rows with a pose do.
MotionComparison compare_motion(const MotionTable& table, const PoseTruth& truth);

}  // namespace pose_wall::tools
