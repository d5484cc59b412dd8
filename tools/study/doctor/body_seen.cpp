// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/body_seen.hpp"

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
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
// A bracket holds the sensor beside the machine by no more than this: nearer things could not pass the rock.
constexpr double kBracket_m = 0.3;
// A machine keeps more than this from what stands beside it; the beams on its own deck leave narrower gaps across.
constexpr double kBeside_m = 0.1;
// Roadheaders are 8 to 13 m long, so none reaches this far from its sensor both ahead and behind.
constexpr double kRunsOn_m = 7.0;
constexpr double kSeen_m = kRunsOn_m + 1.0;  // beams fall a metre apart on the side of what lies along the road there

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
    return from_sensor_m(p) < kSeen_m && p.z() > kAboveFloor_m && p.z() < top_m_ && p.y() < left_m_ &&
           p.y() > -right_m_ && p.x() < ahead_m_ && p.x() > -behind_m_;
  }
  bool is_near(const Eigen::Vector3d& p) const { return from_sensor_m(p) < kNear_m; }
  // Left of the sensor.
  double aside_m(double left_m) const { return left_m - sensor_.y(); }
  // Whether what begins and ends there along the road has no end that is seen: a face ends what can be seen, too.
  bool runs_on(double from_m, double to_m) const {
    return to_m > std::fmin(sensor_.x() + kRunsOn_m, ahead_m_ - kCell_m) &&
           from_m < std::fmax(sensor_.x() - kRunsOn_m, kCell_m - behind_m_);
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

// What a piece spans in the road.
struct Span {
  Eigen::Vector3d low_m = Eigen::Vector3d::Constant(1e9), high_m = Eigen::Vector3d::Constant(-1e9);

  void take(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    low_m = low_m.cwiseMin(low);
    high_m = high_m.cwiseMax(high);
  }
};

Eigen::Vector3d middle_of(const NearCell& cell, const RoadFrame& frame) {
  return frame.of_base(0.5 * (cell.low_base_m + cell.high_base_m));
}

Span span_of(const NearCell& cell, const RoadFrame& frame) {
  Span span;
  for (const double x : {cell.low_base_m.x(), cell.high_base_m.x()}) {
    for (const double y : {cell.low_base_m.y(), cell.high_base_m.y()}) {
      for (const double z : {cell.low_base_m.z(), cell.high_base_m.z()}) {
        const Eigen::Vector3d corner = frame.of_base({x, y, z});
        span.take(corner, corner);
      }
    }
  }
  return span;
}

Span span_of(const Piece& piece, const RoadFrame& frame) {
  Span span;
  for (const NearCell& cell : piece) {
    const Span one = span_of(cell, frame);
    span.take(one.low_m, one.high_m);
  }
  return span;
}

// A vehicle beside the machine hangs together with it by the gaps that rings leave. Across the road they leave less.
std::vector<Piece> split_across(Piece piece, const RoadFrame& frame) {
  std::sort(piece.begin(), piece.end(), [&frame](const NearCell& a, const NearCell& b) {
    return span_of(a, frame).low_m.y() < span_of(b, frame).low_m.y();
  });
  std::vector<Piece> parts;
  double to_m = -1e9;
  for (const NearCell& cell : piece) {
    const Span span = span_of(cell, frame);
    if (parts.empty() || span.low_m.y() > to_m + kBeside_m) parts.emplace_back();
    parts.back().push_back(cell);
    to_m = std::max(to_m, span.high_m.y());
  }
  return parts;
}

// The same thing farther away: fixed cells that go on at its height and its side.
bool goes_on(const Piece& piece, const std::vector<Piece>& far, const RoadFrame& frame, const BodyRoom& room) {
  const Span near = span_of(piece, frame);
  Span all = near;
  for (const Piece& beyond : far) {
    for (const NearCell& cell : beyond) {
      const Span span = span_of(cell, frame);
      const bool is_in_line = span.high_m.y() > near.low_m.y() - kCell_m &&
                              span.low_m.y() < near.high_m.y() + kCell_m &&
                              span.high_m.z() > near.low_m.z() - kCell_m && span.low_m.z() < near.high_m.z() + kCell_m;
      if (is_in_line) all.take(span.low_m, span.high_m);
    }
  }
  return room.runs_on(all.low_m.x(), all.high_m.x());
}

// Nothing: it is as a body is. `carrier`: what the pieces under the sensor span. No part of the machine beside them is
// wider, as the deck that shows on both sides of the boom.
const char* why_no_body(const Piece& piece, const std::vector<Piece>& far, const RoadFrame& frame, const BodyRoom& room,
                        const Span& carrier) {
  double nearest = kNear_m;
  std::size_t aside = 0;
  for (const NearCell& cell : piece) {
    const Eigen::Vector3d p = middle_of(cell, frame);
    nearest = std::min(nearest, room.from_sensor_m(p));
    aside += std::fabs(p.y()) > std::max(1.5, room.half_width_m()) ? std::size_t{1} : 0;
  }
  const Span span = span_of(piece, frame);
  if (goes_on(piece, far, frame, room)) return translatable("it runs on along the road in both directions");
  // A prop, a face or a wall that was not found reaches from the floor to the roof.
  if (span.low_m.z() < 2.0 * kAboveFloor_m && span.high_m.z() > room.top_m() - 0.4) {
    return translatable("it reaches from the floor to the roof");
  }
  const bool is_off = room.aside_m(span.low_m.y()) > kBracket_m || room.aside_m(span.high_m.y()) < -kBracket_m;
  const bool is_beside =
      is_off && (span.low_m.y() < carrier.low_m.y() - kBeside_m || span.high_m.y() > carrier.high_m.y() + kBeside_m);
  if (is_beside || share(aside, piece.size()) >= 0.2) return translatable("it stands beside the sensor");
  return nearest < kBegins_m ? nullptr : translatable("it begins far from the sensor");
}

void count_cells(const Piece& piece, const RoadFrame& frame, const BodyRoom& room, BodySeen& seen) {
  seen.cells += piece.size();
  for (const NearCell& cell : piece) {
    const Eigen::Vector3d p = middle_of(cell, frame);
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

// Of the things near the sensor, those that stayed in place in most parts of the recording, and how they go on.
struct Fixed {
  std::vector<Piece> near, far;
};

Fixed look_for_fixed(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const BodyRoom& room,
                     BodySeen& seen) {
  NearCells near, far;
  std::size_t points = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto slice = static_cast<std::uint32_t>(f * seen.slices / frames.size());
    for (std::size_t i = 0; i < frames[f].count(); ++i) {
      const Eigen::Vector3d p_base = frame.to_base(frames[f].point(i)), p = frame.of_base(p_base);
      if (frame.is_in_told_box(p_base) || !room.holds(p)) continue;
      (room.is_near(p) ? near : far).add(p_base, slice);
      points += room.is_near(p) ? std::size_t{1} : 0;
    }
  }
  seen.passing_share = share(near.passing_points(seen.slices), points);
  const std::uint32_t slices_min = (4 * seen.slices + 4) / 5;
  return {near.fixed_pieces(slices_min), far.fixed_pieces(slices_min)};
}

}  // namespace

BodySeen look_for_body(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road,
                       const RoadEnds& ends) {
  BodySeen seen;
  seen.slices = static_cast<std::uint32_t>(std::min<std::size_t>(kSlices, frames.size()));
  if (seen.slices < 2) return seen;
  const BodyRoom room(frame, road, ends);
  Fixed fixed = look_for_fixed(frames, frame, room, seen);
  std::vector<Piece> pieces, body;
  for (Piece& whole : fixed.near) {
    for (Piece& piece : split_across(std::move(whole), frame)) pieces.push_back(std::move(piece));
  }
  Span carrier;
  for (const Piece& piece : pieces) {
    if (piece.size() < kCellsMin || why_no_body(piece, fixed.far, frame, room, Span()) != nullptr) continue;
    const Span span = span_of(piece, frame);
    carrier.take(span.low_m, span.high_m);
  }
  for (Piece& piece : pieces) {
    const char* const why = why_no_body(piece, fixed.far, frame, room, carrier);
    if (why == nullptr && piece.size() >= kCellsMin) {
      count_cells(piece, frame, room, seen);
      body.push_back(std::move(piece));
    } else if (why != nullptr && piece.size() >= 4 * kCellsMin) {
      seen.left_out.push_back({box_around(piece), why});
    }
  }
  std::stable_sort(body.begin(), body.end(), [](const Piece& a, const Piece& b) { return a.size() > b.size(); });
  seen.boxes_base = boxes_of(std::move(body), kBoxes);
  for (Box& box : seen.boxes_base) {
    box.low_m.array() -= kMargin_m;
    box.high_m.array() += kMargin_m;
  }
  if (!seen.boxes_base.empty()) seen.in_boxes_share = share_inside(frames, frame, seen.boxes_base);
  return seen;
}

}  // namespace pose_wall::tools::doctor
