// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/match/matcher.hpp"

#include <algorithm>
#include <cmath>

#include "base/containers/heap_sort.hpp"

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kCoarsest = 2;  // level: blocks of 1.6 m, the last of surface_map.hpp
// Finest cells along the side of a level's cell, by the definition of the levels.
constexpr std::int32_t kFineInCoarse[kCoarsest + 1] = {1, SurfaceMap::kShrink,
                                                       SurfaceMap::kShrink* SurfaceMap::kShrink};
constexpr std::int32_t kStep = kFineInCoarse[kCoarsest];  // from coarsest cell to coarsest cell

}  // namespace

// The window as a grid of poses, and the points that are tried.
struct Matcher::Grid {
  const SurfaceMap& map;
  Span<const ScanPoint> points;
  Pose2 middle;  // relative to the map's middle
  double yaw_step_rad;
  std::int32_t yaws;    // steps to each side
  std::int32_t cells;   // fine cells to each side, whole coarsest ones
  std::int32_t reach;   // fine cells to each side that count
  std::uint32_t nodes;  // that a level keeps

  double yaw_of(std::int32_t yaw) const { return middle.yaw_rad + yaw * yaw_step_rad; }
  Pose2 pose_of(const Node& node) const {
    return {map.middle_m().x() + middle.x_m + node.x * kSurfaceCell_m,
            map.middle_m().y() + middle.y_m + node.y * kSurfaceCell_m, wrapped(yaw_of(node.yaw))};
  }
};

void Matcher::lay_out(Arena& arena) {
  nodes_ = arena.take<Node>(kSearchNodesMost);
  parents_ = arena.take<Node>(kSearchNodesMost);
  offsets_ = arena.take<Offset>(kSearchPointsMost);
  chosen_ = arena.take<ScanPoint>(kSearchPointsMost);
  patched_.lay_out(arena, kMatchPointsMost);
}

const PatchedPoints& Matcher::sort(Span<const ScanPoint> points, double sigma_m) {
  patched_.sort(points, sigma_m);
  return patched_;
}

// Cells of the points at a yaw, with the machine at the window's middle.
void Matcher::rotate(const Grid& grid, std::int32_t yaw) const {
  const Turn2 turn(grid.yaw_of(yaw));
  for (std::uint32_t k = 0; k < grid.points.size(); ++k) {
    const ScanPoint& point = grid.points[k];
    const Eigen::Vector2d p = turn * as_double(point);
    constexpr double kFar = 1e6;  // cells; far outside every window
    const auto cell = [](double place_m) {
      const double cells = std::floor(place_m / kSurfaceCell_m);
      return static_cast<std::int32_t>(cells > -kFar && cells < kFar ? cells : kFar);
    };
    offsets_[k] = {cell(p.x() + grid.middle.x_m) + SurfaceMap::kSide / 2,
                   cell(p.y() + grid.middle.y_m) + SurfaceMap::kSide / 2};
  }
}

std::uint32_t Matcher::score(const Grid& grid, std::uint32_t level, const Node& node) const {
  std::uint32_t sum = 0;
  const std::uint32_t shift = 2U * level;
  for (std::uint32_t k = 0; k < grid.points.size(); ++k) {
    sum += grid.map.likelihood(level, (offsets_[k].column + node.x) >> shift, (offsets_[k].row + node.y) >> shift);
  }
  return sum;
}

// Into the heap of the best nodes, the worst of them on top.
void Matcher::offer(const Grid& grid, const Node& node, std::uint32_t* kept, std::uint32_t* dropped) const {
  const auto better = [](const Node& a, const Node& b) {
    if (a.score != b.score) return a.score > b.score;
    if (a.yaw != b.yaw) return a.yaw < b.yaw;
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  if (*kept < grid.nodes) {
    nodes_[(*kept)++] = node;
    std::push_heap(nodes_.begin(), nodes_.begin() + *kept, better);
    return;
  }
  if (!better(node, nodes_[0])) {
    *dropped = std::max(*dropped, node.score);
    return;
  }
  *dropped = std::max(*dropped, nodes_[0].score);
  std::pop_heap(nodes_.begin(), nodes_.begin() + *kept, better);
  nodes_[*kept - 1] = node;
  std::push_heap(nodes_.begin(), nodes_.begin() + *kept, better);
}

std::uint32_t Matcher::look_coarse(const Grid& grid, std::uint32_t* dropped) const {
  std::uint32_t kept = 0;
  for (std::int32_t yaw = -grid.yaws; yaw <= grid.yaws; ++yaw) {
    rotate(grid, yaw);
    for (std::int32_t y = -grid.cells; y < grid.cells; y += kStep) {
      for (std::int32_t x = -grid.cells; x < grid.cells; x += kStep) {
        Node node{0, static_cast<std::int16_t>(yaw), static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
        node.score = score(grid, kCoarsest, node);
        offer(grid, node, &kept, dropped);
      }
    }
  }
  return kept;
}

// The cells inside the kept ones, yaw by yaw so that points are turned once.
std::uint32_t Matcher::look_closer(const Grid& grid, std::uint32_t level, std::uint32_t parents,
                                   std::uint32_t* dropped) const {
  std::copy(nodes_.begin(), nodes_.begin() + parents, parents_.begin());
  const auto before = [](const Node& a, const Node& b) {
    if (a.yaw != b.yaw) return a.yaw < b.yaw;
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  heap_sort(parents_.begin(), parents_.begin() + parents, before);
  const std::int32_t step = kFineInCoarse[level];
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < parents; ++k) {
    const Node& parent = parents_[k];
    if (k == 0 || parent.yaw != parents_[k - 1].yaw) rotate(grid, parent.yaw);
    for (std::int32_t y = 0; y < SurfaceMap::kShrink; ++y) {
      for (std::int32_t x = 0; x < SurfaceMap::kShrink; ++x) {
        Node node{0, parent.yaw, static_cast<std::int16_t>(parent.x + x * step),
                  static_cast<std::int16_t>(parent.y + y * step)};
        // Blocks reach beyond the window's edge.
        if (level == 0 && (std::abs(node.x) > grid.reach || std::abs(node.y) > grid.reach)) continue;
        node.score = score(grid, level, node);
        offer(grid, node, &kept, dropped);
      }
    }
  }
  return kept;
}

void Matcher::keep_best(const Grid& grid, Found* found, std::uint32_t kept, std::uint32_t dropped) const {
  if (kept == 0) return;
  const Node* best = &nodes_[0];
  for (std::uint32_t k = 1; k < kept; ++k) {
    if (nodes_[k].score > best->score) best = &nodes_[k];
  }
  const double most = 255.0 * grid.points.size();
  found->pose = grid.pose_of(*best);
  found->score = best->score / most;
  found->is_whole = dropped <= best->score;
  constexpr std::int32_t kApart = 6;   // fine cells: beyond the bells of one surface
  constexpr double kApart_rad = 0.15;  // turns the points 4 m away by as much
  std::uint32_t second = 0;
  for (std::uint32_t k = 0; k < kept; ++k) {
    const Node& node = nodes_[k];
    const bool is_apart = std::abs(node.x - best->x) > kApart || std::abs(node.y - best->y) > kApart ||
                          std::abs(node.yaw - best->yaw) * grid.yaw_step_rad > kApart_rad;
    if (!is_apart || node.score <= second) continue;
    second = node.score;
    found->second = grid.pose_of(node);
  }
  found->second_score = second / most;
}

Found Matcher::search(Span<const ScanPoint> points, const SurfaceMap& map, const SearchWindow& window) const {
  Found found;
  found.pose = window.middle;
  if (points.size() == 0 || map.is_empty()) return found;
  const std::uint32_t stride = (points.size() + kSearchPointsMost - 1) / kSearchPointsMost;
  std::uint32_t count = 0;
  double farthest2_m2 = 1.0;
  for (std::uint32_t k = 0; k < points.size(); k += stride) {
    const auto x = static_cast<double>(points[k].x_m), y = static_cast<double>(points[k].y_m);
    chosen_[count++] = points[k];
    farthest2_m2 = std::max(farthest2_m2, x * x + y * y);
  }
  Grid grid{map, Span<const ScanPoint>(chosen_.data(), count), window.middle, 0.0, 0, 0,
            0,   std::min(window.nodes, kSearchNodesMost)};
  grid.middle.x_m -= map.middle_m().x();
  grid.middle.y_m -= map.middle_m().y();
  // A step of yaw moves the outer points by no more than two cells; the bells reach that far.
  constexpr double kYawStepMost_rad = 0.02, kYawStepLeast_rad = 0.005;
  const double farthest_m = std::sqrt(farthest2_m2);
  grid.yaw_step_rad = std::min(kYawStepMost_rad, std::max(kYawStepLeast_rad, 2.0 * kSurfaceCell_m / farthest_m));
  constexpr std::int32_t kYawsMost = 700, kCoarseMost = 24;  // half a turn to each side; 38 m
  grid.yaws = std::min(kYawsMost, static_cast<std::int32_t>(std::ceil(window.reach_rad / grid.yaw_step_rad)));
  const auto coarse = static_cast<std::int32_t>(std::ceil(window.reach_m / (kSurfaceCell_m * kStep)));
  grid.cells = kStep * std::min(kCoarseMost, std::max(1, coarse));
  grid.reach = static_cast<std::int32_t>(std::ceil(window.reach_m / kSurfaceCell_m));
  std::uint32_t dropped = 0;
  std::uint32_t kept = look_coarse(grid, &dropped);
  kept = look_closer(grid, 1, kept, &dropped);
  kept = look_closer(grid, 0, kept, &dropped);
  keep_best(grid, &found, kept, dropped);
  return found;
}

}  // namespace pose_wall::planar
