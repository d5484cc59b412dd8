// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "sim/survey_truth.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/middle_of.hpp"
#include "sim/random.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr double kStep_m = 0.05;      // between probes: half the spacing of a coarse survey's points
constexpr double kNearest_m = 0.02;   // a fit that is no better than that stays as it is
constexpr double kHalf = 0.5;         // of the probes must lie near the plane
constexpr double kOpening_m = 3.0;    // deeper than a niche, and than a wall seen askew by 30 degrees is
constexpr int kRounds = 20;           // at most; as a rule it settles sooner
constexpr double kSettled_m = 1e-8;   // a round that moves a plane by less: far below what truth.csv is read to
constexpr int kPicks = 300;           // of three probes: with half of them off, an eighth is of the plane alone
constexpr std::size_t kJudges = 300;  // probes that tell how near half of them are
constexpr double kSpread_m2 = 0.5;    // twice the triangle of three probes: smaller ones tell no plane
constexpr double kTukey = 4.685, kSigmaOfMad = 1.4826;  // 95 % efficient under normal errors

// One probe: where it ended, in coordinates (a, b) of the region and h square to it.
struct Probe {
  double a, b, h;
};

// h = [0] + [1] a + [2] b.
using Plane3 = Eigen::Vector3d;

double height_over(const Plane3& plane, const Probe& p) {
  return p.h - plane.dot(Plane3(1.0, p.a, p.b));
}

// The plane through three probes that half of some of them are nearest to (Rousseeuw 1984): whatever the other half
// does, niches and turned machines, it stays. The spread of that half goes with it.
struct MiddlePlane {
  Plane3 plane = Plane3::Zero();
  double median_m = kProbe_m;
};

MiddlePlane middle_plane(const std::vector<Probe>& probes) {
  Random random(kPicks, probes.size());
  const auto pick = [&]() -> const Probe& {
    return probes[static_cast<std::size_t>(random.uniform() * static_cast<double>(probes.size()))];
  };
  MiddlePlane best;
  std::vector<double> off(kJudges);
  for (int k = 0; k < kPicks; ++k) {
    Eigen::Matrix3d A;
    Eigen::Vector3d b;
    for (int i = 0; i < 3; ++i) {
      const Probe& p = pick();
      A.row(i) << 1.0, p.a, p.b;
      b[i] = p.h;
    }
    if (std::abs(A.determinant()) < kSpread_m2) continue;
    const Plane3 plane = A.inverse() * b;
    for (std::size_t i = 0; i < kJudges; ++i)
      off[i] = std::abs(height_over(plane, probes[i * probes.size() / kJudges]));
    const double median_m = middle_of(&off);
    if (median_m < best.median_m) best = {plane, median_m};
  }
  return best;
}

// Least squares with Tukey's weights of that spread, from that plane on: an MM-estimate (Yohai 1987).
std::optional<Plane3> fit_plane(const std::vector<Probe>& probes, std::size_t sent) {
  const double half = kHalf * static_cast<double>(sent);
  if (static_cast<double>(probes.size()) < half) return std::nullopt;
  const MiddlePlane start = middle_plane(probes);
  const double width_m = kTukey * std::max(kSigmaOfMad * start.median_m, kNearest_m);
  Plane3 plane = start.plane;
  std::size_t near = 0;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    near = 0;
    for (const Probe& p : probes) {
      const double u = height_over(plane, p) / width_m;
      if (std::abs(u) >= 1.0) continue;
      ++near;
      const double weight = (1.0 - u * u) * (1.0 - u * u);
      const Plane3 row(1.0, p.a, p.b);
      A += weight * row * row.transpose();
      b += weight * p.h * row;
    }
    const Plane3 before = plane;
    plane = A.ldlt().solve(b);
    if ((plane - before).norm() < kSettled_m) break;
  }
  if (!plane.allFinite() || static_cast<double>(near) < half) return std::nullopt;
  return plane;
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

// Rays from a plane through `middle` with axes a and b, that go along c.
std::optional<FoundPlane> probe(const RockSurface& rock, const Vector& middle, const Vector& a, const Vector& b,
                                const Vector& c, double half_a_m, double low_b_m, double high_b_m) {
  std::vector<Probe> probes;
  std::size_t sent = 0;
  for (double at_a = -half_a_m; at_a <= half_a_m + 1e-9; at_a += kStep_m) {
    for (double at_b = low_b_m; at_b <= high_b_m + 1e-9; at_b += kStep_m) {
      ++sent;
      const Hit hit = rock.trace({middle + at_a * a + at_b * b, c}, kProbe_m);
      if (hit.label != Label::kNone) probes.push_back({at_a, at_b, hit.t_m});
    }
  }
  leave_openings(&probes);
  const std::optional<Plane3> plane = fit_plane(probes, sent);
  if (!plane) return std::nullopt;
  const Vector on = middle + (*plane)[0] * c;
  const Vector n = ((*plane)[1] * a + (*plane)[2] * b - c).normalized();
  return FoundPlane{n, -n.dot(on)};
}

}  // namespace

TruthRow survey_truth(const RockSurface& rock, const Placement& base, const Machine& machine) {
  TruthRow row;
  const Vector ahead_road = base.R_road_base * forward_axis(machine);
  const Vector ahead_level = Vector(ahead_road.x(), ahead_road.y(), 0.0).normalized();
  const Vector left_level = Vector::UnitZ().cross(ahead_level);
  const std::optional<FoundPlane> floor = probe(rock, base.origin_road, ahead_level, left_level, -Vector::UnitZ(),
                                                kFloorAlong_m, -kFloorAcross_m, kFloorAcross_m);
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
    const std::optional<FoundPlane> wall = probe(rock, base.origin_road, ahead, floor->n, side * left, kWallAlong_m,
                                                 kWallLow_m - height_m, kWallHigh_m - height_m);
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
