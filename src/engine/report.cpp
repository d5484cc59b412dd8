// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/report.hpp"

#include "base/math/finite.hpp"
#include "base/math/fnv1a.hpp"

namespace pose_wall {
namespace {

pose_wall_plane plane_of(const PlaneFit& fit) {
  pose_wall_plane p{};
  p.reasons = fit.reasons;
  p.iterations = fit.iterations;
  if (!fit.found) return p;
  for (int k = 0; k < 3; ++k) p.normal[k] = fit.plane.n[k];
  p.d_m = fit.plane.d;
  p.rms_m = fit.rms_m;
  p.found = 1;
  p.inliers = fit.inliers;
  return p;
}

pose_wall_plane plane_of(const JudgedWall& wall) {
  pose_wall_plane p = plane_of(wall.fit);
  if (p.found == 0) return p;
  p.lean_rad = wall.lean_rad;
  p.extent_min_m = wall.along_min_m;
  p.extent_max_m = wall.along_max_m;
  p.area_m2 = wall.area_m2;
  return p;
}

void report_counts(const FrameFindings& found, pose_wall_result* result) {
  const IngestCounts& c = found.voxels.counts;
  result->points_in = c.points_in;
  result->dropped_not_finite = c.dropped_not_finite;
  result->dropped_zero = c.dropped_zero;
  result->dropped_near = c.dropped_near;
  result->dropped_far = c.dropped_far;
  result->dropped_body = c.dropped_body;
  result->outliers = found.outliers;
  result->open_points = found.floor.open_points;
  result->wall_points = found.wall_points;
  result->voxel_leaf_m = found.voxels.leaf_m;
  result->work = found.work;
}

}  // namespace

void set_senses(std::int32_t forward_choice, std::uint32_t (*positive_means)[3]) {
  // In the order of the key's choices: +X, -X, +Y, -Y. Positive roll takes the side at -Y down, positive pitch the one
  // at +X.
  constexpr std::uint8_t kMeans[4][2] = {{POSE_WALL_SENSE_RIGHT_DOWN, POSE_WALL_SENSE_NOSE_DOWN},
                                         {POSE_WALL_SENSE_LEFT_DOWN, POSE_WALL_SENSE_NOSE_UP},
                                         {POSE_WALL_SENSE_NOSE_UP, POSE_WALL_SENSE_RIGHT_DOWN},
                                         {POSE_WALL_SENSE_NOSE_DOWN, POSE_WALL_SENSE_LEFT_DOWN}};
  (*positive_means)[0] = kMeans[forward_choice][0];
  (*positive_means)[1] = kMeans[forward_choice][1];
  (*positive_means)[2] = POSE_WALL_SENSE_TURNED_RIGHT;
}

std::uint32_t mark_of(const pose_wall_result& r) {
  std::uint64_t sum = 0x506F736557616C6CULL;
  for (const std::uint64_t word :
       {std::uint64_t{r.config_crc32}, r.publication, static_cast<std::uint64_t>(r.stamp_ns), r.frame_index}) {
    sum = fnv1a_with(sum, word);
    sum ^= sum >> 29U;
  }
  return static_cast<std::uint32_t>(sum >> 32U);
}

void report_findings(const FrameFindings& found, pose_wall_result* result) {
  result->stamp_ns = found.stamp_ns;
  result->frame_reasons = found.reasons | found.floor.fit.reasons;
  result->floor = plane_of(found.floor.fit);
  if (result->floor.found != 0) {
    result->floor.area_m2 = found.floor.area_m2;
    result->floor.extent_min_m = -found.floor.roi_radius_m;
    result->floor.extent_max_m = found.floor.roi_radius_m;
  }
  result->left = plane_of(found.walls.side[0]);
  result->right = plane_of(found.walls.side[1]);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result->R_level_base[3 * row + column] = found.levelling.R_level_base(row, column);
    }
  }
  result->left_right_yaw_difference_rad =
      found.measured.has_yaw_difference ? found.measured.left_right_yaw_difference_rad : not_a_number();
  report_counts(found, result);
}

}  // namespace pose_wall
