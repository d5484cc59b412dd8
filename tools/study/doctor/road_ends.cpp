// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/road_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "study/doctor/statistics.hpp"

namespace pose_wall::tools::doctor {
namespace {

constexpr std::size_t kFrames = 12;
constexpr double kAlongMin_m = 1.0, kAlongMax_m = 20.0;
// Of the room between walls, floor and roof; a face is broken ground, so its cells need not agree closely.
constexpr std::size_t kAcross = 6, kHigh = 3, kCells = kAcross * kHigh;
constexpr double kCellsFilled = 0.6, kAgree_m = 0.8;

struct Room {
  double right_m, left_m, low_m, high_m;
};

// Inside the walls by a margin that leaves out what hangs on them.
Room room_of(const RoadAxis& road, double roof_m) {
  const double left = std::isfinite(road.left_m) ? road.left_m : 0.8 * road.right_m;
  const double right = std::isfinite(road.right_m) ? road.right_m : 0.8 * road.left_m;
  const double margin = std::clamp(0.12 * (left + right), 0.2, 0.6);
  const double top = std::isfinite(roof_m) ? roof_m : 2.5;
  return {-right + margin, left - margin, std::min(0.5, 0.25 * top), top - std::clamp(0.2 * top, 0.3, 0.7)};
}

using Cells = std::array<std::vector<double>, kCells>;

// By cell of the section, how far along what stands in it.
void fill(Cells& cells, const Room& room, const Eigen::Vector3d& p, double along_m) {
  const double across = (p.y() - room.right_m) / (room.left_m - room.right_m);
  const double high = (p.z() - room.low_m) / (room.high_m - room.low_m);
  if (!(across >= 0.0 && across < 1.0 && high >= 0.0 && high < 1.0 && along_m >= kAlongMin_m)) return;
  cells[static_cast<std::size_t>(across * kAcross) * kHigh + static_cast<std::size_t>(high * kHigh)].push_back(along_m);
}

// A face fills most cells, all at about one distance, and nothing is seen behind it.
std::optional<double> face_of(const Cells& cells) {
  std::vector<double> reaches;
  for (const std::vector<double>& cell : cells) {
    if (cell.size() >= 5) reaches.push_back(quantile(cell, 0.7));
  }
  if (share(reaches.size(), kCells) < kCellsFilled) return std::nullopt;
  const double face_m = median(reaches);
  if (face_m > kAlongMax_m) return std::nullopt;
  std::size_t agree = 0, behind = 0, all = 0;
  const double tolerance = std::max(kAgree_m, 0.1 * face_m);
  for (const double reach : reaches) agree += std::fabs(reach - face_m) <= tolerance ? std::size_t{1} : 0;
  for (const std::vector<double>& cell : cells) {
    for (const double along : cell) {
      all += along > face_m - tolerance ? std::size_t{1} : 0;
      behind += along > face_m + tolerance ? std::size_t{1} : 0;
    }
  }
  return share(agree, kCells) >= kCellsFilled && share(behind, all) < 0.05 ? std::optional<double>(face_m)
                                                                           : std::nullopt;
}

template <typename Visit>
void visit_points(const std::vector<KeptFrame>& frames, const RoadFrame& frame, Visit visit) {
  const std::size_t step = std::max<std::size_t>(1, frames.size() / kFrames);
  for (std::size_t f = 0; f < frames.size(); f += step) {
    for (std::size_t i = 0; i < frames[f].count(); ++i) visit(frame.of_lidar(frames[f].point(i)));
  }
}

// The level below which nine tenths lie of what is above a metre, between the walls and not far away.
double roof_of(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road) {
  constexpr double kAside_m = 3.0;  // where no walls are seen
  double left = std::isfinite(road.left_m) ? road.left_m : road.right_m;
  double right = std::isfinite(road.right_m) ? road.right_m : road.left_m;
  if (!std::isfinite(left)) left = right = kAside_m;
  std::vector<double> heights;
  visit_points(frames, frame, [&](const Eigen::Vector3d& p) {
    const bool between = p.y() > -right + 0.2 * (left + right) && p.y() < left - 0.2 * (left + right);
    if (between && std::fabs(p.x()) < 15.0 && p.z() > 1.0 && p.z() < 12.0) heights.push_back(p.z());
  });
  return heights.size() < 200 ? std::numeric_limits<double>::quiet_NaN() : quantile(heights, 0.9);
}

}  // namespace

RoadEnds look_at_ends(const std::vector<KeptFrame>& frames, const RoadFrame& frame, const RoadAxis& road) {
  RoadEnds ends;
  ends.roof_m = roof_of(frames, frame, road);
  const Room room = room_of(road, ends.roof_m);
  Cells plus, minus;
  visit_points(frames, frame, [&](const Eigen::Vector3d& p) {
    fill(plus, room, p, p.x());
    fill(minus, room, p, -p.x());
  });
  ends.face_plus_m = face_of(plus);
  ends.face_minus_m = face_of(minus);
  return ends;
}

}  // namespace pose_wall::tools::doctor
