// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/level_curve.hpp"

#include <cmath>

#include "io/numbers/quantities.hpp"

namespace pose_wall::tools::campaign {
namespace {

// Reasons that keep no value back. Valid values have them as well:
constexpr std::uint32_t kHarmless = POSE_WALL_R_STAMP_BACK | POSE_WALL_R_STAMP_LEAP | POSE_WALL_R_RATE_LIMITED |
                                    POSE_WALL_R_LEAF_GROWN | POSE_WALL_R_PRIOR;
// The level holds these; as in src/engine/types.hpp.
constexpr std::uint32_t kDoubts = POSE_WALL_R_FLOOR_AMBIGUOUS | POSE_WALL_R_WALL_AMBIGUOUS |
                                  POSE_WALL_R_WALL_SEEN_THROUGH | POSE_WALL_R_EXTRAPOLATED | POSE_WALL_R_CURVED;

bool is_kept_back_by_level_alone(const QuantityRecord& value) {
  return value.measured.state == POSE_WALL_DEGRADED &&
         (value.reasons & ~(kHarmless | kDoubts)) == POSE_WALL_R_ALERT_LIMIT;
}

}  // namespace

bool is_valid_under(double scale, const QuantityRecord& value, double alert_limit) {
  if (value.measured.state != POSE_WALL_VALID && !is_kept_back_by_level_alone(value)) return false;
  return scale * value.measured.protection_level <= alert_limit;
}

void ScaledCounts::add(const FrameRecord& frame, double scale, const AlertLimits& limits) {
  bool any_misleading = false, any_beyond = false;
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    QuantityRecord v = frame.quantity[q];
    const bool valid = is_valid_under(scale, v, limit_of(q, limits));
    v.measured.protection_level *= scale;
    if (v.measured.state >= POSE_WALL_DEGRADED) v.measured.state = valid ? POSE_WALL_VALID : POSE_WALL_DEGRADED;
    const Judged judged = judge(v.measured, v.truth, is_angle(q), limit_of(q, limits));
    any_misleading |= judged.misleading;
    any_beyond |= judged.value_beyond_protection || judged.raw_beyond_protection;
    if (!std::isfinite(v.truth) || !is_in_shares(frame)) continue;
    ++(is_angle(q) ? angles : distances);
    if (valid) ++(is_angle(q) ? valid_angles : valid_distances);
  }
  ++frames;
  if (any_misleading) ++misleading;
  if (any_beyond) ++beyond;
}

void add_run(LevelCurve& curve, const RunRecord& record, const AlertLimits& limits) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    for (const FrameRecord& frame : record.frames) curve[i].add(frame, kLevelScales[i], limits);
  }
}

}  // namespace pose_wall::tools::campaign
