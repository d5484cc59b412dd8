// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/place_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace pose_wall::planar {
namespace {

// Sums of one round: of H the upper half.
struct Normal {
  double xx = 0.0, xy = 0.0, xt = 0.0, yy = 0.0, yt = 0.0, tt = 0.0;
  double x = 0.0, y = 0.0, t = 0.0;
  double squares = 0.0;
  std::uint32_t explained = 0, seen = 0, all = 0;

  Eigen::Matrix3d whole() const {
    Eigen::Matrix3d out;
    out << xx, xy, xt, xy, yy, yt, xt, yt, tt;
    return out;
  }
};

inline void add_row(double dx, double dy, double turn, double residual, double variance, Normal* sum) {
  // Cauchy's weight: what lies 2.4 sigmas off has half the weight of what fits (the usual 95 % constant).
  constexpr double kPerCauchy2 = 1.0 / (2.385 * 2.385);
  const double weight = 1.0 / (variance + residual * residual * kPerCauchy2);
  const double wx = weight * dx, wy = weight * dy, wt = weight * turn;
  sum->xx += wx * dx;
  sum->xy += wx * dy;
  sum->xt += wx * turn;
  sum->yy += wy * dy;
  sum->yt += wy * turn;
  sum->tt += wt * turn;
  sum->x += wx * residual;
  sum->y += wy * residual;
  sum->t += wt * residual;
}

inline void add_point(const PlaceMap& map, const Eigen::Vector2d& turned, const Eigen::Vector2d& place,
                      const FitRule& rule, Normal* sum) {
  const double px = turned.x() + place.x(), py = turned.y() + place.y();
  ++sum->all;
  const Surface* const surface = map.near(px, py);
  if (surface == nullptr) {
    if (map.is_seen(px, py)) ++sum->seen;
    return;
  }
  ++sum->seen;
  const double x = px - static_cast<double>(surface->x_m), y = py - static_cast<double>(surface->y_m);
  if (x * x + y * y > rule.reach_m * rule.reach_m) return;
  const auto nx = static_cast<double>(surface->normal_x), ny = static_cast<double>(surface->normal_y);
  const double noise_m2 = rule.sigma_m * rule.sigma_m;
  const double across = nx * x + ny * y, across_m2 = noise_m2 + static_cast<double>(surface->across_m2);
  add_row(nx, ny, turned.x() * ny - turned.y() * nx, across, across_m2, sum);
  constexpr double kExplained = 3.0;  // sigmas
  if (across * across < kExplained * kExplained * across_m2) {
    ++sum->explained;
    sum->squares += across * across;
  }
  // A cluster without direction tells both ways; along a wall, where a point lies in its cell tells nothing.
  constexpr float kRound = 0.25F;
  if (surface->across_m2 > kRound * surface->along_m2) {
    add_row(-ny, nx, turned.x() * nx + turned.y() * ny, nx * y - ny * x,
            noise_m2 + static_cast<double>(surface->along_m2), sum);
  }
}

Normal sum_up(const PlaceMap& map, const Look& look, const Pose2& pose, const FitRule& rule) {
  Normal sum;
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - map.middle_m();
  for (std::uint32_t k = 0; k < look.point_count; k += rule.stride) {
    add_point(map, turn * as_double(look.points[k]), place, rule, &sum);
  }
  return sum;
}

// Of one point; seen: whether the map knows its place.
double cost_of(const PlaceMap& map, const Eigen::Vector2d& p, double noise_m2, bool* seen) {
  constexpr double kEnd2_m2 = 0.25 * 0.25;  // a surface ends about a cell beyond its last one
  const Surface* const surface = map.near(p.x(), p.y());
  *seen = true;
  if (surface != nullptr) {
    const double dx = p.x() - static_cast<double>(surface->x_m), dy = p.y() - static_cast<double>(surface->y_m);
    if (dx * dx + dy * dy < kEnd2_m2) {
      const double across = static_cast<double>(surface->normal_x) * dx + static_cast<double>(surface->normal_y) * dy;
      return std::min(kCostMost, across * across / (noise_m2 + static_cast<double>(surface->across_m2)));
    }
  }
  *seen = map.is_seen(p.x(), p.y());
  return *seen ? kCostMost : kCostUnseen;
}

}  // namespace

void Look::lay_out(Arena& arena) {
  points = arena.take<ScanPoint>(kLookPointsMost);
  patch = arena.take<std::uint8_t>(kLookPointsMost);
  in_patch = arena.take<std::uint32_t>(kPatchesMost);
  sights = arena.take<ScanPoint>(kSightsMost);
}

void Look::take(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m, double scan_sigma_m) {
  const std::uint32_t count = std::min(kLookPointsMost, scan_points.size());
  std::copy(scan_points.begin(), scan_points.begin() + count, points.begin());
  sigma_m = scan_sigma_m;
  sort_into_patches(count);
  take_sights(scan_points, origin_m);
}

void Look::take_sights(Span<const ScanPoint> scan_points, const Eigen::Vector2d& origin_m) {
  const std::uint32_t stride = (scan_points.size() + kSightsMost - 1) / kSightsMost;
  sight_count = 0;
  for (std::uint32_t k = 0; k < scan_points.size(); k += stride) sights[sight_count++] = scan_points[k];
  sight_from = {static_cast<float>(origin_m.x()), static_cast<float>(origin_m.y())};
}

void Look::sort_into_patches(std::uint32_t count) {
  std::int32_t columns[kPatchesMost], rows[kPatchesMost];
  point_count = count;
  patches = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto column = static_cast<std::int32_t>(std::floor(static_cast<double>(points[k].x_m)));
    const auto row = static_cast<std::int32_t>(std::floor(static_cast<double>(points[k].y_m)));
    std::uint32_t at = 0;
    while (at < patches && (columns[at] != column || rows[at] != row)) ++at;
    patch[k] = static_cast<std::uint8_t>(at);
    if (at == kPatchesMost) continue;
    if (at == patches) {
      columns[at] = column;
      rows[at] = row;
      in_patch[at] = 0;
      ++patches;
    }
    ++in_patch[at];
  }
}

Fit fit_pose(const PlaceMap& map, const Look& look, const Pose2& start, const FitRule& rule) {
  Fit out;
  out.pose = start;
  constexpr double kStill_m = 2e-4, kStill_rad = 2e-5;
  for (std::uint32_t round = 0; round < rule.rounds; ++round) {
    const Normal normal = sum_up(map, look, out.pose, rule);
    const Eigen::Vector3d off(out.pose.x_m - rule.prior.x_m, out.pose.y_m - rule.prior.y_m,
                              wrapped(out.pose.yaw_rad - rule.prior.yaw_rad));
    // A metre's information: directions without any stay where they are.
    const Eigen::Matrix3d H = normal.whole() + rule.weight + Eigen::Matrix3d::Identity();
    const Eigen::Vector3d g(normal.x, normal.y, normal.t);
    const Eigen::Vector3d step = H.inverse() * (g + rule.weight * off);
    if (!(step.squaredNorm() < 4.0)) break;
    out.pose = {out.pose.x_m - step.x(), out.pose.y_m - step.y(), wrapped(out.pose.yaw_rad - step.z())};
    if (std::abs(step.x()) < kStill_m && std::abs(step.y()) < kStill_m && std::abs(step.z()) < kStill_rad) break;
  }
  const Normal normal = sum_up(map, look, out.pose, rule);
  out.information = normal.whole();
  out.points = normal.seen;
  out.seen = normal.all > 0 ? static_cast<double>(normal.seen) / normal.all : 0.0;
  out.explained = normal.seen > 0 ? static_cast<double>(normal.explained) / normal.seen : 0.0;
  out.rms_m = normal.explained > 0 ? std::sqrt(normal.squares / normal.explained) : 0.0;
  return out;
}

PatchVerdict judge_patches(const PlaceMap& map, const Look& look, const Pose2& pose, PatchCosts* costs) {
  float sums[kPatchesMost] = {};
  std::uint32_t seen_in[kPatchesMost] = {};
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - map.middle_m();
  const double noise_m2 = look.sigma_m * look.sigma_m;
  for (std::uint32_t k = 0; k < look.point_count; ++k) {
    const std::uint32_t at = look.patch[k];
    if (at == kPatchesMost) continue;
    bool seen = false;
    sums[at] += static_cast<float>(cost_of(map, turn * as_double(look.points[k]) + place, noise_m2, &seen));
    seen_in[at] += seen ? 1U : 0U;
  }
  constexpr double kFits = 2.5;  // right places have 0.5 to 1.5, other rock 4 to 7
  PatchVerdict out;
  std::uint32_t fit = 0;
  for (std::uint32_t at = 0; at < look.patches; ++at) {
    const double cost = static_cast<double>(sums[at]) / look.in_patch[at];
    costs->cost[at] = static_cast<std::uint8_t>(cost * (255.0 / kCostMost) + 0.5);
    if (look.in_patch[at] < kPatchPointsLeast) continue;
    ++out.judged;
    out.cost += cost;
    if (2 * seen_in[at] < look.in_patch[at]) continue;
    ++out.seen;
    if (cost < kFits) ++fit;
  }
  out.fits = out.seen > 0 ? static_cast<double>(fit) / out.seen : 0.0;
  return out;
}

double worse_by(const Look& look, const PatchCosts& best, const PatchCosts& other) {
  std::int64_t sum = 0, squares = 0;
  for (std::uint32_t at = 0; at < look.patches; ++at) {
    if (look.in_patch[at] < kPatchPointsLeast) continue;
    const std::int64_t gain = static_cast<std::int64_t>(other.cost[at]) - best.cost[at];
    sum += gain;
    squares += gain * gain;
  }
  return squares > 0 ? static_cast<double>(sum) / std::sqrt(static_cast<double>(squares)) : 0.0;
}

double seen_through(const PlaceMap& map, const Look& look, const Pose2& pose) {
  constexpr double kStep_m = 0.5 * PlaceMap::kCell_m, kBefore_m = 0.5,
                   kBefore = 0.05;  // of the range: a wall met at a low angle
  constexpr std::uint32_t kStepsMost = 600, kFirst = 6, kHitsLeast = 2;
  std::uint32_t through = 0;
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = turn * as_double(look.sight_from) + pose.place() - map.middle_m();
  for (std::uint32_t k = 0; k < look.sight_count; ++k) {
    const Eigen::Vector2d way = turn * (as_double(look.sights[k]) - as_double(look.sight_from));
    const double range_m = way.norm(), end_m = range_m * (1.0 - kBefore) - kBefore_m;
    if (!(end_m > kStep_m)) continue;
    const Eigen::Vector2d unit = way / range_m;
    const std::uint32_t steps = std::min(kStepsMost, static_cast<std::uint32_t>(end_m / kStep_m));
    std::uint32_t hits = 0;
    for (std::uint32_t i = kFirst; i <= steps && hits < kHitsLeast; ++i) {
      const Eigen::Vector2d p = place + unit * (kStep_m * i);
      hits += map.is_surface(p.x(), p.y()) ? 1U : 0U;
    }
    through += hits >= kHitsLeast ? 1U : 0U;
  }
  return look.sight_count > 0 ? static_cast<double>(through) / look.sight_count : 0.0;
}

namespace {

void find_walls(const Look& look, const Turn2& turn, Span<PatchWall> walls) {
  std::fill(walls.begin(), walls.end(), PatchWall{});
  for (std::uint32_t k = 0; k < look.point_count; ++k) {
    if (look.patch[k] == kPatchesMost) continue;
    PatchWall& own = walls[look.patch[k]];
    const float x = look.points[k].x_m - std::floor(look.points[k].x_m);
    const float y = look.points[k].y_m - std::floor(look.points[k].y_m);
    own = {own.n + 1.0F, own.x + x, own.y + y, own.xx + x * x, own.xy + x * y, own.yy + y * y, 0.0F, 0.0F, 0.0F, 0.0F};
  }
  for (std::uint32_t at = 0; at < look.patches; ++at) {
    PatchWall& own = walls[at];
    const auto n = static_cast<double>(own.n);
    const double mx = static_cast<double>(own.x) / n, my = static_cast<double>(own.y) / n;
    const double half = 0.5 * (static_cast<double>(own.xx - own.yy) / n - mx * mx + my * my);
    const double xy = static_cast<double>(own.xy) / n - mx * my;
    const double along_rad = half * half + xy * xy > 0.0 ? 0.5 * arc_tangent2(xy, half) : 0.0;
    const Eigen::Vector2d along = turn * Eigen::Vector2d(cosine(along_rad), sine(along_rad));
    own.along_x = static_cast<float>(along.x());
    own.along_y = static_cast<float>(along.y());
  }
}

void move_along_walls(const PlaceMap& map, const Look& look, const Turn2& turn, const Eigen::Vector2d& place,
                      Span<PatchWall> walls) {
  constexpr double kShift_m = 0.4;  // a bump of rock and its hollow; README.md
  const double noise_m2 = look.sigma_m * look.sigma_m;
  for (std::uint32_t k = 0; k < look.point_count; ++k) {
    if (look.patch[k] == kPatchesMost) continue;
    PatchWall& own = walls[look.patch[k]];
    const Eigen::Vector2d p = turn * as_double(look.points[k]) + place;
    const Eigen::Vector2d shift =
        kShift_m * Eigen::Vector2d(static_cast<double>(own.along_x), static_cast<double>(own.along_y));
    bool seen = false;
    own.ahead += static_cast<float>(cost_of(map, p + shift, noise_m2, &seen));
    own.behind += static_cast<float>(cost_of(map, p - shift, noise_m2, &seen));
  }
}

}  // namespace

std::uint32_t relief_patches(const PlaceMap& map, const Look& look, const Pose2& pose, PatchCosts* room,
                             Span<PatchWall> walls) {
  const Turn2 turn(pose.yaw_rad);
  find_walls(look, turn, walls);
  judge_patches(map, look, pose, room);
  move_along_walls(map, look, turn, pose.place() - map.middle_m(), walls);
  constexpr double kWorse = 0.4;  // noise makes less of it
  std::uint32_t count = 0;
  for (std::uint32_t at = 0; at < look.patches; ++at) {
    if (look.in_patch[at] < kPatchPointsLeast) continue;
    const double here = room->cost[at] * (kCostMost / 255.0);
    const double moved = static_cast<double>(std::min(walls[at].ahead, walls[at].behind)) / look.in_patch[at];
    if (moved > here + kWorse) ++count;
  }
  return count;
}

Slid slide_of(const PlaceMap& map, const Look& look, const Fit& fit, double excluded, PatchCosts* room) {
  Slid out;
  const Eigen::Matrix3d& H = fit.information;
  const double yaw = H(2, 2) > 0.0 ? H(2, 2) : 1.0;
  const double xx = H(0, 0) - H(0, 2) * H(0, 2) / yaw, yy = H(1, 1) - H(1, 2) * H(1, 2) / yaw;
  const double xy = H(0, 1) - H(0, 2) * H(1, 2) / yaw;
  const double strong_rad = 0.5 * arc_tangent2(2.0 * xy, xx - yy);
  out.direction = {-sine(strong_rad), cosine(strong_rad)};
  constexpr double kShifts_m[] = {3.2, 1.6, 0.8, 0.4, 0.2};
  judge_patches(map, look, fit.pose, &room[0]);
  for (const double shift_m : kShifts_m) {
    bool is_excluded = true;
    for (const double sign : {1.0, -1.0}) {
      Pose2 shifted = fit.pose;
      shifted.x_m += sign * shift_m * out.direction.x();
      shifted.y_m += sign * shift_m * out.direction.y();
      judge_patches(map, look, shifted, &room[1]);
      is_excluded = is_excluded && worse_by(look, room[0], room[1]) > excluded;
    }
    if (is_excluded) continue;
    out.reach_m = shift_m;
    break;
  }
  return out;
}

}  // namespace pose_wall::planar
