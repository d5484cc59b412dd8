// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/registration.hpp"

#include <cmath>

#include "estimation/small_cholesky.hpp"

namespace pose_wall::motion {
namespace {

// Standard deviation of a range: what LiDARs of mines' kind have (OS1 1 to 3 cm, VLP-16 3 cm typical accuracy). It sets
// the weights of near against far surfaces only; covariances come from how patches of rock differ.
constexpr float kRangeSigma_m = 0.012F;
// What cells leave of the rock, whatever the range tells.
constexpr float kCellSigma_m = 0.004F;
// Rock about a plane where its relief is not known yet.
constexpr float kRockSigma_m = 0.04F;
constexpr float kTukey = 4.0F;              // deviations beyond which an observation says nothing
constexpr std::uint32_t kGroundLeast = 60;  // observations of ground that settle roll, pitch and height
constexpr double kDamping = 1e-3;           // Levenberg's, of the diagonal, at the start
constexpr float kNear_m = 0.3F;             // from a plane whose relief is not asked: most of a tile's layer
constexpr float kFacesAlong = 0.6F;         // cosine: within 53 degrees, as facing_of has it

// The three parameters of a step: each turns or moves the scan about the place of base.
struct Parameters {
  Eigen::Vector3f turn[3], move[3];
};

struct Sums {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double cost = 0.0;
  std::uint32_t count = 0;
  // Of observations without and with relief: how many, and their squared misfits in variances.
  double of_kind[2] = {}, squares[2] = {};
};

// By how much the misfits' variances exceed what noise gives: rock that is finer than the cells, of this step's
// surfaces. Measured in each round for the next.
struct Scales {
  float variance[2] = {1.0F, 1.0F};

  void learn(const Sums& sums) {
    for (int kind = 0; kind < 2; ++kind) {
      if (!(sums.of_kind[kind] > 30.0)) continue;
      const float found = variance[kind] * static_cast<float>(sums.squares[kind] / sums.of_kind[kind]);
      variance[kind] = found < 0.25F ? 0.25F : found > 50.0F ? 50.0F : found;
    }
  }
};

bool counts(const Observation& o, bool ground_step, bool ground_alone) {
  if (!ground_step) return o.ground == 0;
  // Walls tell roll, too. The roof does not count beside the ground: what hangs from it is seen from one side only, and
  // steel sets under it turned a VLP-16's pitch by half a degree in 6 m.
  return !ground_alone || o.ground != 0 || o.facing != kFacesZ;
}

float tukey(float squares, float cut2) {
  const float left = 1.0F - squares / cut2;
  return left > 0.0F ? left * left : 0.0F;
}

// How far the point lies from the rock, and what noise alone gives that; of a fit that holds surface and incidence.
void measure(Fit* fit) {
  Relief relief;
  fit->has_relief = ReliefMap::relief(fit->surface, &relief);
  const float above_rock_m = fit->surface.above_m - (fit->has_relief ? relief.height_m : 0.0F);
  fit->distance_m = above_rock_m * fit->surface.tile->cosine;
  fit->variance_m2 = kRangeSigma_m * kRangeSigma_m * fit->incidence2 * (fit->has_relief ? relief.spread : 1.0F) +
                     kCellSigma_m * kCellSigma_m + (fit->has_relief ? 0.0F : kRockSigma_m * kRockSigma_m);
}

struct Context {
  const Scan& scan;
  const StepOptions& options;
  const RoadAxes& axes;
  Parameters parameters;
  bool ground_step, ground_alone;
};

void row_of_fit(const Context& c, const Fit& fit, const Eigen::Vector3f& arm, float (&row)[3]) {
  const Eigen::Vector3f lever = arm.cross(fit.normal);
  for (int k = 0; k < 3; ++k) row[k] = c.parameters.turn[k].dot(lever) + c.parameters.move[k].dot(fit.normal);
}

Sums sum_up(const Context& c, const Pose& pose, const Scales& scales, PatchSums* patches) {
  Sums sums;
  const LocalPose local(pose, c.scan.map->corner());
  const bool is_road = c.axes.hold < kHoldOfRoad;
  const Eigen::Vector3f along = c.axes.along.cast<float>();
  for (std::uint32_t i = 0; i < c.scan.observation.size(); i += c.options.every) {
    const Observation& o = c.scan.observation[i];
    Fit fit;
    if (!counts(o, c.ground_step, c.ground_alone) || !fit_observation(c.scan, local, o, &fit)) continue;
    if (is_road && faces_along(fit.normal, along)) continue;
    const int kind = fit.has_relief ? 1 : 0;
    const float variance = fit.variance_m2 * scales.variance[kind];
    const float cut2 = c.options.use_relief ? kTukey * kTukey * variance + 1e-4F : kNear_m * kNear_m;
    const float squares = fit.distance_m * fit.distance_m;
    const float trust = tukey(squares, cut2), weight = trust / variance;
    if (!(weight > 0.0F)) continue;
    sums.of_kind[kind] += static_cast<double>(trust);
    sums.squares[kind] += static_cast<double>(trust * squares / variance);
    float row[3];
    row_of_fit(c, fit, fit.p - local.t, row);
    for (int r = 0; r < 3; ++r) {
      for (int j = 0; j <= r; ++j) sums.A(r, j) += static_cast<double>(weight * row[r] * row[j]);
      sums.b[r] -= static_cast<double>(weight * row[r] * fit.distance_m);
    }
    const float rest = 1.0F - squares / cut2;
    sums.cost -= static_cast<double>(cut2 / variance * rest * rest * rest);  // Tukey's, but for a constant
    ++sums.count;
    if (patches == nullptr) continue;
    const std::uint32_t tile = c.scan.map->index_of(fit.surface.tile);
    for (int k = 0; k < 3; ++k) patches->sum[k][tile] += weight * row[k] * fit.distance_m;
  }
  sums.A(0, 1) = sums.A(1, 0), sums.A(0, 2) = sums.A(2, 0), sums.A(1, 2) = sums.A(2, 1);
  return sums;
}

Pose moved(const Context& c, const Pose& pose, const Eigen::Vector3d& by) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero(), move = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    turn += c.parameters.turn[k].cast<double>() * by[k];
    move += c.parameters.move[k].cast<double>() * by[k];
  }
  return {orthonormal(turn_by(turn) * pose.R), pose.t + move};
}

Eigen::Vector3d solve(const Sums& sums, double damping, const bool (&free)[3]) {
  Eigen::Matrix3d A = sums.A;
  Eigen::Vector3d b = sums.b;
  for (int k = 0; k < 3; ++k) {
    A(k, k) += damping * A(k, k) + 1e-9;
    if (free[k]) continue;
    A.row(k).setZero();
    A.col(k).setZero();
    A(k, k) = 1.0;
    b[k] = 0.0;
  }
  const SmallCholesky<3> factor(A);
  return factor.solved() ? factor.solve(b) : Eigen::Vector3d::Zero();
}

// Sandwich: A^-1 (sum over patches of g g') A^-1.
Eigen::Matrix3d covariance_of(const Sums& sums, const bool (&free)[3], PatchSums* patches, std::uint32_t tiles) {
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();
  for (std::uint32_t t = 0; t < tiles; ++t) {
    const Eigen::Vector3d g(static_cast<double>(patches->sum[0][t]), static_cast<double>(patches->sum[1][t]),
                            static_cast<double>(patches->sum[2][t]));
    if (g.squaredNorm() > 0.0) B += g * g.transpose();  // most tiles are out of sight
  }
  Eigen::Matrix3d inverse;
  for (int k = 0; k < 3; ++k) {
    Sums unit = sums;
    unit.b = Eigen::Vector3d::Unit(k);
    inverse.col(k) = solve(unit, 0.0, free);
    if (!free[k]) inverse.col(k).setZero();
  }
  return inverse * B * inverse.transpose();
}

// Levenberg-Marquardt on three parameters. Gives the covariance of the last round.
Eigen::Matrix3d iterate(const Context& c, const bool (&free)[3], PatchSums* patches, Alignment* a) {
  double damping = kDamping, last_cost = 1e300;
  Pose last = a->pose;
  Sums sums;
  Scales scales;
  for (int round = 0; round < c.options.rounds; ++round) {
    sums = sum_up(c, a->pose, scales, nullptr);
    if (sums.count < 12) return Eigen::Matrix3d::Zero();
    if (c.options.use_relief) scales.learn(sums);
    if (sums.cost > last_cost) {
      a->pose = last;
      damping *= 10.0;
    } else {
      last = a->pose;
      last_cost = sums.cost;
      damping *= 0.1;
    }
    const Eigen::Vector3d by = solve(sums, damping, free);
    a->pose = moved(c, a->pose, by);
    if (!(by.squaredNorm() > 1e-9)) break;  // 0.03 mm and mrad
  }
  if (!c.options.use_relief) return Eigen::Matrix3d::Zero();
  const std::uint32_t tiles = c.scan.map->tiles();
  for (int k = 0; k < 3; ++k) patches->sum[k].first(tiles).fill(0.0F);
  sums = sum_up(c, a->pose, scales, patches);
  (c.ground_step ? a->ground : a->matched) = sums.count;
  return covariance_of(sums, free, patches, tiles);
}

}  // namespace

void PatchSums::lay_out(Arena& arena) {
  for (Span<float>& s : sum) s = arena.take<float>(kTilesMost);
}

bool faces_along(const Eigen::Vector3f& normal, const Eigen::Vector3f& along) {
  return std::fabs(along.dot(normal)) > kFacesAlong;
}

bool fit_observation(const Scan& scan, const LocalPose& pose, const Observation& o, Fit* fit) {
  const Eigen::Vector3f base(o.x, o.y, o.z);
  fit->p = pose(base);
  if (!scan.map->find(fit->p, o.facing, &fit->surface)) return false;
  fit->normal = fit->surface.tile->normal();
  const Eigen::Vector3f ray = base - scan.sensor_base_m;
  const float towards = (pose.R * ray).dot(fit->normal);
  fit->incidence2 = towards * towards / ray.squaredNorm();
  measure(fit);
  return true;
}

bool fit_shifted(const Scan& scan, const Eigen::Vector3f& p, const Fit& before, bool by_plane, float* misfit) {
  Fit fit;
  if (!scan.map->find_again(p, before.surface.tile, &fit.surface)) return false;
  fit.incidence2 = before.incidence2;
  measure(&fit);
  if (!fit.has_relief && !by_plane) return false;
  *misfit = fit.distance_m / std::sqrt(fit.variance_m2);
  return true;
}

void find_axes(const Scan& scan, const Eigen::Vector3d& forward_map, Alignment* a) {
  const LocalPose local(a->pose, scan.map->corner());
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  constexpr std::uint32_t kEvery = 4;  // an axis needs no more
  for (std::uint32_t i = 0; i < scan.observation.size(); i += kEvery) {
    Fit fit;
    if (!fit_observation(scan, local, scan.observation[i], &fit) || !(std::fabs(fit.distance_m) < 0.15F)) continue;
    if (fit.surface.tile->stands_free != 0) continue;
    const Eigen::Vector3d n = fit.normal.cast<double>();
    N += n * n.transpose();
  }
  const double all = N.trace();
  if (!(all > 10.0)) return;
  // Inverse iteration: the smallest eigenvalue is far below the others on a road, and any axis does in a hall.
  N.diagonal().array() += 1e-6 * all;
  const SmallCholesky<3> factor(N);
  if (!factor.solved()) return;
  Eigen::Vector3d axis = a->axes.along;
  for (int k = 0; k < 8; ++k) {
    axis = factor.solve(axis);
    axis /= std::sqrt(axis.squaredNorm());
  }
  if (axis.dot(forward_map) < 0.0) axis = -axis;
  const double least = axis.dot(N * axis);
  a->axes.along = axis;
  a->axes.hold = 2.0 * least / (all - least);
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(axis);
  const double flat = std::sqrt(left.squaredNorm());
  a->axes.left = flat > 0.1 ? Eigen::Vector3d(left / flat) : Eigen::Vector3d(Eigen::Vector3d::UnitY());
  a->axes.up = axis.cross(a->axes.left);
}

void step_one(const Scan& scan, const StepOptions& options, PatchSums* patches, Alignment* a) {
  std::uint32_t ground = 0;
  for (const Observation& o : scan.observation) ground += o.ground;
  a->ground_alone = ground >= kGroundLeast;
  Context c = {scan, options, a->axes, {}, true, a->ground_alone};
  const Eigen::Vector3f zero = Eigen::Vector3f::Zero();
  c.parameters = {{a->axes.along.cast<float>(), a->axes.left.cast<float>(), zero},
                  {zero, zero, a->axes.up.cast<float>()}};
  const bool free[3] = {true, true, true};
  const Eigen::Matrix3d C = iterate(c, free, patches, a);
  constexpr int kAt[] = {3, 4, 2};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) a->covariance(kAt[i], kAt[j]) = C(i, j);
  }
}

void step_two(const Scan& scan, const StepOptions& options, PatchSums* patches, Alignment* a) {
  Context c = {scan, options, a->axes, {}, false, false};
  const Eigen::Vector3f zero = Eigen::Vector3f::Zero();
  c.parameters = {{zero, zero, a->axes.up.cast<float>()},
                  {a->axes.along.cast<float>(), a->axes.left.cast<float>(), zero}};
  const bool free[3] = {options.with_along, true, true};
  const Eigen::Matrix3d C = iterate(c, free, patches, a);
  constexpr int kAt[] = {0, 1, 5};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) a->covariance(kAt[i], kAt[j]) = C(i, j);
  }
}

}  // namespace pose_wall::motion
