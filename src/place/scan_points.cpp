// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/scan_points.hpp"

namespace pose_wall::planar {
namespace {

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
