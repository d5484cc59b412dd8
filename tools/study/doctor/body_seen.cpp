// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/body_seen.hpp"

#include <algorithm>
#include <cmath>

#include "study/doctor/statistics.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr std::uint32_t kSlices = 6;
constexpr double kNear_m = 5.0;
constexpr double kAboveFloor_m = 0.2;  // tracks hide lower ones; ruts and stones do not reach it
constexpr double kMargin_m = 0.1;
// A body begins under the sensor: where beams end that pass over its deck it is still this near.
constexpr double kBegins_m = 2.5;
constexpr std::size_t kCellsMin = 3;
constexpr double kRoofGap_m = 0.3;
constexpr double kAboveSensor_m = 1.5;  // a raised boom
constexpr std::size_t kBoxes = 4;

// The room in which a body may be: not at the floor, the roof, the walls or a face.
class BodyRoom {
 public:
  BodyRoom(const RoadFrame& frame, const RoadAxis& road, const RoadEnds& ends)
      : sensor_(frame.of_base(frame.mount().position_base_m())),
        top_m_(std::fmin(ends.roof_m - kRoofGap_m, sensor_.z() + kAboveSensor_m)),
        left_m_(std::isfinite(road.left_m) ? road.left_m - clearance_m(road.left_m - sensor_.y()) : kNear_m),
        right_m_(std::isfinite(road.right_m) ? road.right_m - clearance_m(road.right_m + sensor_.y()) : kNear_m),
        ahead_m_(ends.face_plus_m.value_or(2.0 * kNear_m) - 0.8),
        behind_m_(ends.face_minus_m.value_or(2.0 * kNear_m) - 0.8) {}

  bool holds(const Eigen::Vector3d& p) const {
    return (p - sensor_).head<2>().norm() < kNear_m && p.z() > kAboveFloor_m && p.z() < top_m_ && p.y() < left_m_ &&
           p.y() > -right_m_ && p.x() < ahead_m_ && p.x() > -behind_m_;
  }
  double from_sensor_m(const Eigen::Vector3d& p) const { return (p - sensor_).head<2>().norm(); }
  double sensor_height_m() const { return sensor_.z(); }
  double top_m() const { return top_m_; }
  // Half of the road belongs to no machine: it could not steer.
  double half_width_m() const { return 0.4 * (left_m_ + right_m_); }

 private:
  // Rock stands out from the plane, and pipes hang on it; less of that where the wall itself is near.
  static double clearance_m(double wall_m) { return std::clamp(0.4 * wall_m, 0.1, 0.5); }

  Eigen::Vector3d sensor_;
  double top_m_, left_m_, right_m_, ahead_m_, behind_m_;
};

bool is_body(const Piece& piece, const RoadFrame& frame, const BodyRoom& room) {
  if (piece.size() < kCellsMin) return false;
  double nearest = kNear_m, lowest = kNear_m, highest = 0.0;
  std::size_t aside = 0;
  for (const NearCell& cell : piece) {
    const Eigen::Vector3d p = frame.of_base(0.5 * (cell.low_base_m + cell.high_base_m));
    nearest = std::min(nearest, room.from_sensor_m(p));
    lowest = std::min(lowest, p.z());
    highest = std::max(highest, p.z());
    aside += std::fabs(p.y()) > std::max(1.5, room.half_width_m()) ? std::size_t{1} : 0;
  }
  // A prop, a face or a wall that was not found reaches from the floor to the roof.
  const bool is_pillar = lowest < 2.0 * kAboveFloor_m && highest > room.top_m() - 0.4;
  return nearest < kBegins_m && !is_pillar && share(aside, piece.size()) < 0.2;
}

void count_cells(const Piece& piece, const RoadFrame& frame, const BodyRoom& room, BodySeen& seen) {
  seen.cells += piece.size();
  for (const NearCell& cell : piece) {
    const Eigen::Vector3d p = frame.of_base(0.5 * (cell.low_base_m + cell.high_base_m));
    seen.cells_below += p.z() < room.sensor_height_m() ? std::size_t{1} : 0;
  }
}

double share_inside(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const std::vector<Box>& boxes) {
  std::size_t inside = 0, all = 0;
  for (const KeptFrame& kept : frames) {
    all += kept.count();
    for (std::size_t i = 0; i < kept.count(); ++i) {
      const Eigen::Vector3d p = frame.to_base(kept.point(i));
      inside +=
          std::any_of(boxes.begin(), boxes.end(), [&p](const Box& box) { return box.holds(p); }) ? std::size_t{1} : 0;
    }
  }
  return share(inside, all);
}

}  // namespace

BodySeen look_for_body(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road,
                       const RoadEnds& ends) {
  BodySeen seen;
  seen.slices = static_cast<std::uint32_t>(std::min<std::size_t>(kSlices, frames.size()));
  if (seen.slices < 2) return seen;
  const BodyRoom room(frame, road, ends);
  NearCells cells;
  std::size_t near = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (std::size_t i = 0; i < frames[f].count(); ++i) {
      const Eigen::Vector3d p_base = frame.to_base(frames[f].point(i));
      if (frame.is_in_told_box(p_base) || !room.holds(frame.of_base(p_base))) continue;
      cells.add(p_base, static_cast<std::uint32_t>(f * seen.slices / frames.size()));
      ++near;
    }
  }
  seen.passing_share = share(cells.passing_points(seen.slices), near);
  std::vector<Piece> body;
  for (Piece& piece : cells.fixed_pieces((4 * seen.slices + 4) / 5)) {
    if (is_body(piece, frame, room)) {
      count_cells(piece, frame, room, seen);
      body.push_back(std::move(piece));
    } else if (piece.size() >= 4 * kCellsMin) {
      seen.unexplained.push_back(box_around(piece));
    }
  }
  seen.boxes_base = boxes_of(std::move(body), kBoxes);
  for (Box& box : seen.boxes_base) {
    box.low_m.array() -= kMargin_m;
    box.high_m.array() += kMargin_m;
  }
  if (!seen.boxes_base.empty()) seen.in_boxes_share = share_inside(frames, frame, seen.boxes_base);
  return seen;
}

}  // namespace pose_wall::tools::doctor
