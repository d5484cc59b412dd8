// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/beams.hpp"

#include <cstddef>
#include <limits>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"
#include "part/status.hpp"
#include "part/struct_sizes.hpp"
#include "place/pose2.hpp"

namespace pose_wall::planar {
namespace {

constexpr StructSizes kScanSizes = {0, offsetof(pose_wall_planar_scan, free_m), sizeof(pose_wall_planar_scan)};

bool is_mount(const pose_wall_planar_pose& pose) {
  constexpr double kFarthest_m = 100.0;  // no sensor hangs further from its machine than this
  return is_within(pose.x_m, -kFarthest_m, kFarthest_m) && is_within(pose.y_m, -kFarthest_m, kFarthest_m) &&
         is_within(pose.yaw_rad, -2.0 * kPi, 2.0 * kPi);
}

// Neighbouring beams that are summed up to one point.
struct Run {
  Eigen::Vector2d first = Eigen::Vector2d::Zero(), sum = Eigen::Vector2d::Zero();
  std::uint32_t count = 0;

  void add(const Eigen::Vector2d& p) {
    if (count == 0) first = p;
    sum += p;
    ++count;
  }
};

// The number of points needed, of which those that fit are written.
std::uint32_t gather(const BeamScan& scan, double spacing_m, Span<ScanPoint> room) {
  std::uint32_t needed = 0;
  Run run;
  const auto close = [&] {
    if (run.count == 0) return;
    const Eigen::Vector2d mean = run.sum / run.count;
    if (needed < room.size()) room[needed] = {static_cast<float>(mean.x()), static_cast<float>(mean.y())};
    ++needed;
    run = Run();
  };
  for (const Beam& beam : scan.beams) {
    if (beam.end != BeamEnd::thing) continue;
    const Eigen::Vector2d p = scan.end_m(beam);
    if (run.count > 0 && !((p - run.first).squaredNorm() < spacing_m * spacing_m)) close();
    run.add(p);
  }
  close();
  return needed;
}

}  // namespace

std::int32_t check_scan(const pose_wall_planar_scan* scan) {
  if (scan == nullptr) return POSE_WALL_E_NULL;
  const std::int32_t status = check_struct_size(scan->struct_size, kScanSizes);
  if (status != POSE_WALL_OK) return status;
  if (scan->range_m == nullptr) return POSE_WALL_E_NULL;
  constexpr double kTurn_rad = 2.0 * kPi, kRangeMost_m = 1000.0;  // as the header says
  const double step_rad = scan->angle_step_rad < 0.0 ? -scan->angle_step_rad : scan->angle_step_rad;
  const bool fits = scan->beams >= 1 && scan->beams <= POSE_WALL_PLANAR_BEAMS_MAX && is_mount(scan->sensor) &&
                    is_within(scan->angle_min_rad, -kTurn_rad, kTurn_rad) && step_rad > 0.0 &&
                    (scan->beams - 1.0) * step_rad <= kTurn_rad + 1e-6 && scan->range_min_m >= 0.0 &&
                    scan->range_max_m > scan->range_min_m && scan->range_max_m <= kRangeMost_m &&
                    is_within(scan->sigma_m, 0.001, 1.0);
  return ok_if(fits, POSE_WALL_PLANAR_E_SCAN);
}

BeamScan read_beams(const pose_wall_planar_scan& scan, Span<Beam> beams) {
  BeamScan out;
  out.origin_m = {scan.sensor.x_m, scan.sensor.y_m};
  out.stamp_ns = scan.stamp_ns;
  out.sigma_m = scan.sigma_m;
  const float* const free_m = scan.struct_size >= sizeof(scan) ? scan.free_m : nullptr;
  const auto nearest_m = static_cast<float>(scan.range_min_m), farthest_m = static_cast<float>(scan.range_max_m);
  // A direction is the one before, turned by a step. So many steps add rounding errors of 1e-14, a float has 6e-8.
  constexpr std::uint32_t kTurnsMost = 64;
  const Turn2 step(scan.angle_step_rad);
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  for (std::uint32_t k = 0; k < scan.beams; ++k) {
    const float range_m = scan.range_m[k];
    Beam& beam = beams[k];
    if (k % kTurnsMost == 0) {
      const Turn2 turn(scan.sensor.yaw_rad + scan.angle_min_rad + k * scan.angle_step_rad);
      direction = {turn.c, turn.s};
    } else {
      direction = step * direction;
    }
    beam.direction_x = static_cast<float>(direction.x());
    beam.direction_y = static_cast<float>(direction.y());
    beam.range_m = 0.0F;
    beam.end = BeamEnd::unknown;
    if (range_m > 0.0F && range_m >= nearest_m && range_m <= farthest_m) {
      beam.range_m = range_m;
      beam.end = BeamEnd::thing;
    } else if (range_m > std::numeric_limits<float>::max()) {
      beam.range_m = farthest_m;
      beam.end = BeamEnd::open;
    } else if (free_m != nullptr && free_m[k] > 0.0F) {
      beam.range_m = free_m[k] < farthest_m ? free_m[k] : farthest_m;
      beam.end = BeamEnd::open;
    }
  }
  out.beams = beams.first(scan.beams);
  return out;
}

Span<const ScanPoint> even_points(const BeamScan& scan, double spacing_m, Span<ScanPoint> room) {
  constexpr int kRounds = 8;  // 2^8 spacings: the beams of any scan
  std::uint32_t needed = 0;
  for (int round = 0; round < kRounds; ++round, spacing_m *= 2.0) {
    needed = gather(scan, spacing_m, room);
    if (needed <= room.size()) break;
  }
  return room.first(needed <= room.size() ? needed : room.size());
}

}  // namespace pose_wall::planar
