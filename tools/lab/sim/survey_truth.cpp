// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/survey_truth.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace pose_wall::tools::sim {
namespace {

constexpr double kStep_m = 0.05;    // between probes: half the spacing of a coarse survey's points
constexpr double kOpening_m = 3.0;  // deeper than a niche, and than a wall seen askew by 30 degrees is
constexpr double kHalf = 0.5;       // of the region must be wall, by weight
constexpr double kWidth_m = 0.15;   // c: rock of 7 cm weighs 0.8, a niche of half a metre a twelfth
constexpr double kWidest_m = 2.0, kNarrower = 0.7071;  // where it starts, and what a round leaves of it
constexpr double kBefore = 4.0;                        // of the definition: things stand before walls
constexpr int kRounds = 100;                           // at most; as a rule it settles sooner
constexpr double kSettled_m = 1e-8;  // a round that moves a plane by less: far below what truth.csv is read to

// One probe: where it ended, in coordinates (a, b) of the region and h square to it.
struct Probe {
  double a, b, h;
};

// h = [0] + [1] a + [2] b.
using Plane3 = Eigen::Vector3d;

double height_over(const Plane3& plane, const Probe& p) {
  return p.h - plane.dot(Plane3(1.0, p.a, p.b));
}

// Sums of weighted least squares.
struct Weighted {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double weights = 0.0;

  void add(const Probe& p, double weight) {
    const Plane3 row(1.0, p.a, p.b);
    A += weight * row * row.transpose();
    b += weight * p.h * row;
    weights += weight;
  }
};

struct Settled {
  Plane3 plane = Plane3::Zero();
  double near = 0.0, loss = 0.0;  // sums of weights and of log(1 + (h / c)²)
};

// In widths of the formula, with its factor before the plane.
double square_of(double t) {
  return (t < 0.0 ? kBefore : 1.0) * t * t;
}

double loss_of(const Plane3& plane, const std::vector<Probe>& probes) {
  double loss = 0.0;
  for (const Probe& p : probes) loss += std::log1p(square_of(height_over(plane, p) / kWidth_m));
  return loss;
}

// Narrows c step by step, so that no start decides alone (graduated non-convexity: Blake and Zisserman 1987).
std::optional<Settled> settle(const std::vector<Probe>& probes, Plane3 plane, double c_m) {
  for (int round = 0; round < kRounds; ++round) {
    Weighted sums;
    for (const Probe& p : probes) {
      sums.add(p, 1.0 / (1.0 + square_of(height_over(plane, p) / c_m)));
    }
    const Plane3 before = plane;
    plane = sums.A.ldlt().solve(sums.b);
    if (!plane.allFinite()) return std::nullopt;
    if (c_m == kWidth_m && ((plane - before).norm() < kSettled_m || round + 1 == kRounds))
      return Settled{plane, sums.weights, loss_of(before, probes)};
    c_m = std::max(c_m * kNarrower, kWidth_m);
  }
  return std::nullopt;
}

// The plane that minimises the sum of log(1 + (h / c)²), Cauchy's robust estimate: from all probes, from those of
// each half of the region, and from those of both its ends.
std::optional<Plane3> fit_plane(const std::vector<Probe>& probes, std::size_t sent, double middle_b, double end_a) {
  std::optional<Settled> best;
  const auto start = [&](double wide_m, const auto& takes) {
    Weighted sums;
    for (const Probe& p : probes) {
      if (takes(p)) sums.add(p, 1.0);
    }
    const Plane3 plane = sums.A.ldlt().solve(sums.b);
    if (!plane.allFinite()) return;
    const std::optional<Settled> settled = settle(probes, plane, wide_m);
    if (settled && (!best || settled->loss < best->loss)) best = settled;
  };
  start(kWidest_m, [](const Probe&) { return true; });
  start(kWidth_m, [](const Probe& p) { return p.a > 0.0; });
  start(kWidth_m, [](const Probe& p) { return p.a < 0.0; });
  start(kWidth_m, [middle_b](const Probe& p) { return p.b > middle_b; });
  start(kWidth_m, [middle_b](const Probe& p) { return p.b < middle_b; });
  start(kWidth_m, [end_a](const Probe& p) { return std::abs(p.a) > end_a; });
  if (!best || best->near < kHalf * static_cast<double>(sent)) return std::nullopt;
  return best->plane;
}

// What ends far behind the nearest tenth went through an opening: the end of a crosscut is no wall of this road.
void leave_openings(std::vector<Probe>* probes) {
  if (probes->empty()) return;
  std::vector<double> far(probes->size());
  std::transform(probes->begin(), probes->end(), far.begin(), [](const Probe& p) { return p.h; });
  const auto tenth = far.begin() + static_cast<std::ptrdiff_t>(far.size() / 10);
  std::nth_element(far.begin(), tenth, far.end());
  const double farthest_m = *tenth + kOpening_m;
  probes->erase(std::remove_if(probes->begin(), probes->end(), [&](const Probe& p) { return p.h > farthest_m; }),
                probes->end());
}

// n . p + d = 0 in the survey's frame, n towards base.
struct FoundPlane {
  Vector n;
  double d_m;
};

// From near_a to far_a along a, on either side, and from low_b to high_b along b.
struct Extent {
  double near_a_m, far_a_m, low_b_m, high_b_m;
};

// Rays from a plane through `middle` with axes a and b, that go along c.
std::optional<FoundPlane> probe(const RockSurface& rock, const Vector& middle, const Vector& a, const Vector& b,
                                const Vector& c, const Extent& extent) {
  std::vector<Probe> probes;
  std::size_t sent = 0;
  for (double at_a = -extent.far_a_m; at_a <= extent.far_a_m + 1e-9; at_a += kStep_m) {
    if (std::abs(at_a) < extent.near_a_m - 1e-9) continue;
    for (double at_b = extent.low_b_m; at_b <= extent.high_b_m + 1e-9; at_b += kStep_m) {
      ++sent;
      const Hit hit = rock.trace({middle + at_a * a + at_b * b, c}, kProbe_m);
      if (hit.label != Label::kNone) probes.push_back({at_a, at_b, hit.t_m});
    }
  }
  leave_openings(&probes);
  const std::optional<Plane3> plane =
      fit_plane(probes, sent, 0.5 * (extent.low_b_m + extent.high_b_m), 0.5 * (extent.near_a_m + extent.far_a_m));
  if (!plane) return std::nullopt;
  const Vector on = middle + (*plane)[0] * c;
  const Vector n = ((*plane)[1] * a + (*plane)[2] * b - c).normalized();
  return FoundPlane{n, -n.dot(on)};
}

}  // namespace

TruthRow survey_truth(const RockSurface& rock, const Placement& base, const Machine& machine, const Sensor& sensor) {
  TruthRow row;
  const Vector ahead_road = base.R_road_base * forward_axis(machine);
  const Vector ahead_level = Vector(ahead_road.x(), ahead_road.y(), 0.0).normalized();
  const Vector left_level = Vector::UnitZ().cross(ahead_level);
  const std::optional<FoundPlane> floor =
      probe(rock, base.origin_road, ahead_level, left_level, -Vector::UnitZ(),
            {sensor.floor_from_m, sensor.floor_to_m, -kFloorAcross_m, kFloorAcross_m});
  if (!floor) return row;
  const Vector up_base = base.R_road_base.transpose() * floor->n;
  row.value[0] = std::atan2(up_base.y(), up_base.z());
  row.value[1] = std::atan2(-up_base.x(), std::hypot(up_base.y(), up_base.z()));

  // Along the floor from here on.
  const Vector ahead = (ahead_road - ahead_road.dot(floor->n) * floor->n).normalized();
  const Vector left = floor->n.cross(ahead);
  const double height_m = floor->n.dot(base.origin_road) + floor->d_m;
  Vector along = Vector::Zero();
  std::size_t quantity = 3;
  for (const int side : {1, -1}) {
    const std::optional<FoundPlane> wall = probe(rock, base.origin_road, ahead, floor->n, side * left,
                                                 {0.0, kWallAlong_m, kWallLow_m - height_m, kWallHigh_m - height_m});
    for (const double s : {machine.s_front_m, machine.s_back_m}) {
      const Vector P = base.origin_road + s * ahead_road;
      if (wall) row.value[quantity] = std::abs(wall->n.dot(P) + wall->d_m);
      ++quantity;
    }
    if (!wall) continue;
    const Vector t = floor->n.cross(wall->n).normalized();
    along += t.dot(ahead) > 0.0 ? t : -t;
  }
  if (along.norm() > 0.0) row.value[2] = std::atan2(ahead.cross(along).dot(floor->n), ahead.dot(along));
  return row;
}

}  // namespace pose_wall::tools::sim
