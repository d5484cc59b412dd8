// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The age of a publication for its reader, and the remains of one that is too old. By the reader's thread alone, since
// the worker may hang.

#pragma once

#include <cstdint>

#include "pose_wall_runtime.h"
#include "saturated.hpp"

namespace pose_wall::runtime {

class Freshness {
 public:
  // watchdog_ns 0: nothing is ever stale.
  Freshness(const pose_wall_publication& p, std::int64_t now_ns, std::int64_t watchdog_ns)
      : age_ns_(known_age_ns(difference(now_ns, p.received_ns), watchdog_ns)) {
    // Silence is published anew before it gets this old, with the age of its values.
    const bool is_frame = p.cause == POSE_WALL_RUNTIME_FRAME;
    told_ns_ = known_age_ns(difference(now_ns, is_frame ? p.received_ns : p.published_ns), watchdog_ns);
    stale_ = watchdog_ns > 0 && told_ns_ >= watchdog_ns;
  }

  std::int64_t age_ns() const { return age_ns_; }
  bool is_stale() const { return stale_; }
  // Time since the result was published.
  double elapsed_s() const {
    constexpr double kHour_s = 3600.0;  // for an unknown time, like the watchdog
    return told_ns_ == INT64_MAX ? kHour_s : static_cast<double>(told_ns_) * 1e-9;
  }

 private:
  // A clock that was set right by a little, and one that hides an unknown time.
  static std::int64_t known_age_ns(std::int64_t by_clock_ns, std::int64_t watchdog_ns) {
    if (by_clock_ns >= 0) return by_clock_ns;
    return by_clock_ns >= -watchdog_ns ? 0 : INT64_MAX;
  }

  std::int64_t age_ns_ = 0, told_ns_ = 0;
  bool stale_ = false;
};

inline void make_invalid(double elapsed_s, pose_wall_value* v) {
  v->reasons |= POSE_WALL_R_NO_FRAME;
  v->state = v->raw_state = POSE_WALL_INVALID;
  v->raw = v->raw_protection_level = __builtin_nan("");
  v->confidence = 0.0;
  if ((v->reasons & POSE_WALL_R_NEVER_MEASURED) != 0) return;
  v->age_s += elapsed_s;
  // Nothing bounds how far the truth has moved away meanwhile.
  v->protection_level = v->part[POSE_WALL_PART_AGE] = __builtin_inf();
  v->cause = POSE_WALL_PART_AGE;
}

// The last values stay readable, but not usable. The mark keeps its subject.
inline void make_stale(double elapsed_s, pose_wall_result* result) {
  pose_wall_result left{};
  left.struct_size = result->struct_size;
  left.frame_reasons = result->frame_reasons | POSE_WALL_R_NO_FRAME;
  left.mark = result->mark;
  left.config_crc32 = result->config_crc32;
  left.source_id = result->source_id;
  for (int k = 0; k < 3; ++k) left.positive_means[k] = result->positive_means[k];
  left.publication = result->publication;
  left.stamp_ns = result->stamp_ns;
  left.frame_index = result->frame_index;
  for (int k = 0; k < 9; k += 4) left.R_level_base[k] = 1.0;
  left.left_right_yaw_difference_rad = __builtin_nan("");
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    left.quantity[q] = result->quantity[q];
    make_invalid(elapsed_s, &left.quantity[q]);
  }
  *result = left;
}

}  // namespace pose_wall::runtime
