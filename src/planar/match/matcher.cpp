// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/match/matcher.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "planar/heap_sort.hpp"

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kCoarsest = 2;
constexpr std::int32_t kFineInCoarse[kCoarsest + 1] = {1, SurfaceMap::kShrink,
                                                       SurfaceMap::kShrink* SurfaceMap::kShrink};

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
    return {map.middle_m().x() + middle.x_m + node.x * SurfaceMap::kCell_m,
            map.middle_m().y() + middle.y_m + node.y * SurfaceMap::kCell_m, wrapped(yaw_of(node.yaw))};
  }
};

void Matcher::lay_out(Arena& arena) {
  nodes_ = arena.take<Node>(kSearchNodesMost);
  parents_ = arena.take<Node>(kSearchNodesMost);
  patches_ = arena.take<Patch>(kPatchesMost);
  patch_of_ = arena.take<std::uint32_t>(kMatchPointsMost);
  offsets_ = arena.take<Offset>(kSearchPointsMost);
  chosen_ = arena.take<ScanPoint>(kSearchPointsMost);
}

// Cells of the points at a yaw, with the machine at the window's middle.
void Matcher::rotate(const Grid& grid, std::int32_t yaw) const {
  const Turn2 turn(grid.yaw_of(yaw));
  for (std::uint32_t k = 0; k < grid.points.size(); ++k) {
    const ScanPoint& point = grid.points[k];
    const Eigen::Vector2d p = turn * as_double(point);
    constexpr double kFar = 1e6;  // cells; far outside every window
    const auto cell = [](double place_m) {
      const double cells = std::floor(place_m / SurfaceMap::kCell_m);
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
  constexpr std::int32_t kStep = kFineInCoarse[kCoarsest];
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
  constexpr std::int32_t kApart = 6;  // fine cells: beyond the bells of one surface
  constexpr double kApart_rad = 0.15;
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
  grid.yaw_step_rad = std::min(kYawStepMost_rad, std::max(kYawStepLeast_rad, 2.0 * SurfaceMap::kCell_m / farthest_m));
  constexpr std::int32_t kYawsMost = 700, kCoarseMost = 24;  // half a turn to each side; 38 m
  grid.yaws = std::min(kYawsMost, static_cast<std::int32_t>(std::ceil(window.reach_rad / grid.yaw_step_rad)));
  constexpr std::int32_t kStep = kFineInCoarse[kCoarsest];
  const auto coarse = static_cast<std::int32_t>(std::ceil(window.reach_m / (SurfaceMap::kCell_m * kStep)));
  grid.cells = kStep * std::min(kCoarseMost, std::max(1, coarse));
  grid.reach = static_cast<std::int32_t>(std::ceil(window.reach_m / SurfaceMap::kCell_m));
  std::uint32_t dropped = 0;
  std::uint32_t kept = look_coarse(grid, &dropped);
  kept = look_closer(grid, 1, kept, &dropped);
  kept = look_closer(grid, 0, kept, &dropped);
  keep_best(grid, &found, kept, dropped);
  return found;
}

namespace {

// Sums of one round of Gauss and Newton.
struct Normal {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double squares = 0.0;  // of residuals across, of explained points
  std::uint32_t explained = 0, inside = 0;
};

void add_row(const Eigen::Vector3d& row, double residual, double variance, Normal* normal) {
  // Cauchy's weight: what lies 2.4 sigmas off has half the weight of what fits (the usual 95 % constant).
  constexpr double kCauchy2 = 2.385 * 2.385;
  const double weight = 1.0 / (variance * (1.0 + residual * residual / (variance * kCauchy2)));
  normal->H += weight * row * row.transpose();
  normal->g += weight * residual * row;
}

void add_point(const Eigen::Vector2d& turned, const Eigen::Vector2d& place, const SurfaceMap& map, double noise_m2,
               Normal* normal) {
  const Eigen::Vector2d p = turned + place;
  constexpr double kHalf_m = SurfaceMap::kCell_m * (SurfaceMap::kSide / 2);
  if (!(std::abs(p.x()) < kHalf_m && std::abs(p.y()) < kHalf_m)) return;
  const Surface* const surface = map.near(p.x(), p.y());
  if (surface != nullptr || map.is_seen(p.x(), p.y())) ++normal->inside;
  if (surface == nullptr) return;
  const Eigen::Vector2d off(p.x() - static_cast<double>(surface->x_m), p.y() - static_cast<double>(surface->y_m));
  const Eigen::Vector2d n(static_cast<double>(surface->normal_x), static_cast<double>(surface->normal_y));
  const auto row_of = [&](const Eigen::Vector2d& d) {
    return Eigen::Vector3d(d.x(), d.y(), turned.x() * d.y() - turned.y() * d.x());
  };
  const double across = n.dot(off), across_m2 = noise_m2 + static_cast<double>(surface->across_m2);
  add_row(row_of(n), across, across_m2, normal);
  constexpr double kExplained = 3.0;  // sigmas
  if (across * across < kExplained * kExplained * across_m2) {
    ++normal->explained;
    normal->squares += across * across;
  }
  // A cluster without direction tells both ways; along a wall, where a point lies in its cell tells nothing.
  constexpr double kRound = 0.25;
  if (surface->across_m2 > static_cast<float>(kRound) * surface->along_m2) {
    const Eigen::Vector2d t(-n.y(), n.x());
    add_row(row_of(t), t.dot(off), noise_m2 + static_cast<double>(surface->along_m2), normal);
  }
}

}  // namespace

namespace {

// Squared residual over variance, capped. What lies nowhere near a surface counts as far off where the map was seen.
double misfit(const Eigen::Vector2d& p, const SurfaceMap& map, double noise_m2) {
  constexpr double kMost = 9.0;    // three sigmas
  constexpr double kUnseen = 4.5;  // between that and none: a new surface is no contradiction, and no agreement
  const Surface* const surface = map.near(p.x(), p.y());
  if (surface == nullptr) return map.is_seen(p.x(), p.y()) ? kMost : kUnseen;
  const double across = static_cast<double>(surface->normal_x) * (p.x() - static_cast<double>(surface->x_m)) +
                        static_cast<double>(surface->normal_y) * (p.y() - static_cast<double>(surface->y_m));
  return std::min(kMost, across * across / (noise_m2 + static_cast<double>(surface->across_m2)));
}

}  // namespace

Refined Matcher::refine(Span<const ScanPoint> points, const SurfaceMap& map, const Pose2& start, const Prior& prior,
                        double sigma_m, int rounds) const {
  Refined out;
  out.pose = start;
  constexpr double kStill_m = 1e-4, kStill_rad = 1e-5;
  Normal normal;
  for (int round = 0; round < rounds; ++round) {
    normal = Normal();
    const Turn2 turn(out.pose.yaw_rad);
    const Eigen::Vector2d place = out.pose.place() - map.middle_m();
    for (const ScanPoint& point : points) {
      add_point(turn * as_double(point), place, map, sigma_m * sigma_m, &normal);
    }
    const Eigen::Vector3d off(out.pose.x_m - prior.pose.x_m, out.pose.y_m - prior.pose.y_m,
                              wrapped(out.pose.yaw_rad - prior.pose.yaw_rad));
    // A thousandth of a metre's information: directions without any stay where they are.
    const Eigen::Matrix3d H = normal.H + prior.information + 1e-3 * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d step = H.inverse() * (normal.g + prior.information * off);
    if (!(step.squaredNorm() < 1e6)) return out;
    out.pose = {out.pose.x_m - step.x(), out.pose.y_m - step.y(), wrapped(out.pose.yaw_rad - step.z())};
    if (std::abs(step.x()) < kStill_m && std::abs(step.y()) < kStill_m && std::abs(step.z()) < kStill_rad) break;
  }
  out.information = normal.H;
  const Turn2 turn(out.pose.yaw_rad);
  const Eigen::Vector2d place = out.pose.place() - map.middle_m();
  for (const ScanPoint& point : points) {
    out.misfit += misfit(turn * as_double(point) + place, map, sigma_m * sigma_m);
  }
  out.points = normal.inside;
  out.explained = normal.inside > 0 ? static_cast<double>(normal.explained) / normal.inside : 0.0;
  out.rms_m = normal.explained > 0 ? std::sqrt(normal.squares / normal.explained) : 0.0;
  out.is_valid = normal.explained >= 10;
  return out;
}

// Sorts the points by patches of a square metre. Points beyond the last patch have none.
std::uint32_t Matcher::make_patches(Span<const ScanPoint> points, const Turn2& turn,
                                    const Eigen::Vector2d& place) const {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p =
        turn * Eigen::Vector2d(static_cast<double>(points[i].x_m), static_cast<double>(points[i].y_m)) + place;
    const auto column = static_cast<std::int32_t>(std::floor(p.x())),
               row = static_cast<std::int32_t>(std::floor(p.y()));
    std::uint32_t k = 0;
    while (k < count && (patches_[k].column != column || patches_[k].row != row)) ++k;
    if (k == count && count < patches_.size()) patches_[count++] = {column, row, 0.0};
    patch_of_[i] = k;
  }
  return count;
}

// By how many of its standard errors the mean patch fits worse at another pose. None if that is too little to tell a
// place by: cells and noise prefer where they are, a little and everywhere.
double Matcher::agreed_gain(Span<const ScanPoint> points, const SurfaceMap& map, std::uint32_t patches,
                            const Pose2& match, const Pose2& other, double noise_m2) const {
  for (std::uint32_t k = 0; k < patches; ++k) patches_[k].gain = 0.0;
  const Turn2 turn(match.yaw_rad), other_turn(other.yaw_rad);
  const Eigen::Vector2d place = match.place() - map.middle_m(), other_place = other.place() - map.middle_m();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (patch_of_[i] == patches) continue;
    const Eigen::Vector2d p(static_cast<double>(points[i].x_m), static_cast<double>(points[i].y_m));
    patches_[patch_of_[i]].gain +=
        misfit(other_turn * p + other_place, map, noise_m2) - misfit(turn * p + place, map, noise_m2);
  }
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t k = 0; k < patches; ++k) {
    sum += patches_[k].gain;
    squares += patches_[k].gain * patches_[k].gain;
  }
  constexpr double kTold = 5.0;  // half of the sum, as a logarithm of likelihood
  return 0.5 * sum / kAlike > kTold ? sum / std::sqrt(squares) : 0.0;
}

Slide Matcher::slide(Span<const ScanPoint> points, const SurfaceMap& map, const Refined& match, double sigma_m) const {
  Slide out;
  // The information about the place that is left when yaw is free.
  const Eigen::Matrix3d& H = match.information;
  const double yaw = H(2, 2) > 0.0 ? H(2, 2) : 1.0;
  const double xx = H(0, 0) - H(0, 2) * H(0, 2) / yaw, yy = H(1, 1) - H(1, 2) * H(1, 2) / yaw;
  const double xy = H(0, 1) - H(0, 2) * H(1, 2) / yaw;
  const double strong_rad = 0.5 * arc_tangent2(2.0 * xy, xx - yy);
  out.direction = {-sine(strong_rad), cosine(strong_rad)};
  const std::uint32_t patches = make_patches(points, Turn2(match.pose.yaw_rad), match.pose.place() - map.middle_m());
  // The rest is fitted anew at every shift: a direction that is a degree off would leave the wall.
  constexpr double kHeld = 1e8;  // of information along the direction: 0.1 mm
  constexpr int kRounds = 3;
  const Eigen::Vector3d along(out.direction.x(), out.direction.y(), 0.0);
  const auto is_excluded = [&](double shift_m) {
    constexpr double kExcluded = 4.0;  // standard errors
    const Eigen::Vector2d place = match.pose.place() + shift_m * out.direction;
    const Prior held{{place.x(), place.y(), match.pose.yaw_rad}, kHeld * along * along.transpose()};
    const Refined other = refine(points, map, held.pose, held, sigma_m, kRounds);
    return agreed_gain(points, map, patches, match.pose, other.pose, sigma_m * sigma_m) > kExcluded;
  };
  constexpr double kShifts_m[] = {3.2, 1.6, 0.8, 0.4, 0.2, 0.1};
  for (const double shift_m : kShifts_m) {
    if (is_excluded(shift_m) && is_excluded(-shift_m)) continue;
    out.reach_m = shift_m;
    break;
  }
  return out;
}

Eigen::Matrix3d Matcher::information(const Refined& match, const Slide& slide) const {
  Eigen::Matrix3d information = match.information / kAlike;
  if (slide.reach_m == 0.0) return information;
  const Eigen::Vector3d d(slide.direction.x(), slide.direction.y(), 0.0);
  const Eigen::Vector3d held = information * d;
  const double along = d.dot(held), most = 1.0 / (slide.reach_m * slide.reach_m);
  if (along > most) information -= held * held.transpose() * ((along - most) / (along * along));
  return information;
}

}  // namespace pose_wall::planar
