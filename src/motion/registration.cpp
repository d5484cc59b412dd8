// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/registration.hpp"

#include <cmath>

#include "base/estimation/small_cholesky.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall::motion {
namespace {

constexpr double kDamping = 1e-3;     // Levenberg's, of the diagonal, at the start
constexpr double kStepLeast2 = 1e-9;  // a step of 0.03 mm and mrad is the last
constexpr float kStill2 = 4e-6F;      // 2 mm and mrad: surfaces are found anew for more
// Of a patch that is left out: where it alone holds a direction, its own pull counts a hundredfold, and not without
// end.
constexpr double kLeftOut = 0.99;
constexpr float kNear_m = 0.3F;  // from a plane whose relief is not used: most of a tile's layer

struct Sums {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double cost = 0.0;
  std::uint32_t count = 0;
  // Of observations without and with relief: how many, and their squared misfits in variances.
  double of_kind[2] = {}, squares[2] = {};
};

// Excess of the misfits' variances over noise: rock of this step's surfaces that is finer than the cells.
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

// Walls give roll, too. The roof does not count beside the ground. Things hanging from it are seen from one side only,
// and steel sets under it turned a VLP-16's pitch by half a degree in 6 m.
enum Part : std::uint32_t { kOfGround = 0, kOfWalls = 1, kOfRoof = 2, kParts = 3 };

Part part_of(const Observation& o) {
  return o.ground != 0 ? kOfGround : o.facing == kFacesZ ? kOfRoof : kOfWalls;
}

// One step: the parts of the scan, and the three of the six moves that they determine.
struct Step {
  Part first;
  std::uint32_t last;
  int free[3];
  bool asked[3];
};

// False where the sums do not hold all that is asked.
bool solve(const Sums& sums, double damping, const bool (&asked)[3], Eigen::Vector3d* move) {
  Eigen::Matrix3d A = sums.A;
  Eigen::Vector3d b = sums.b;
  for (int k = 0; k < 3; ++k) {
    A(k, k) += damping * A(k, k) + 1e-9;
    if (asked[k]) continue;
    A.row(k).setZero();
    A.col(k).setZero();
    A(k, k) = 1.0;
    b[k] = 0.0;
  }
  const SmallCholesky<3> factor(A);
  move->setZero();
  if (factor.solved()) *move = factor.solve(b);
  return factor.solved();
}

// The observations on the map as equations: a distance, and how it goes with six small moves. They are drawn up once;
// within a step's centimetres surfaces are planes, and each round of the steps is a sum over numbers that lie in rows.
class Equations {
 public:
  Equations(const Scan& scan, const Alignment& a, std::uint32_t every, bool with_along, StepScratch* scratch)
      : s_(*scratch) {
    const LocalPose local(a.pose, scan.map->corner());
    const Eigen::Vector3f axis[3] = {a.axes.along.cast<float>(), a.axes.left.cast<float>(), a.axes.up.cast<float>()};
    for (std::uint32_t part = kOfGround; part < kParts; ++part) {
      begin_[part] = count_;
      for (std::uint32_t i = 0; i < scan.observation.size(); i += every) {
        const Observation& o = scan.observation[i];
        Fit fit;
        // The lines of a sensor lie further apart on the ground than cells. Where two scans show one cell, each shows
        // the part of it that its own line meets, and the difference is the lines', not the rock's.
        const bool by_plane = part == kOfGround;
        if (part_of(o) != part || !fit_observation(scan, local, o, &fit, by_plane)) continue;
        // Not what faces along more than across: in a hall whose axis lies askew, the walls are both.
        const bool faces =
            faces_along(fit.normal, axis[0]) && std::fabs(axis[0].dot(fit.normal)) > std::fabs(axis[1].dot(fit.normal));
        if (faces && (!with_along || fit.surface.tile->stands_free != 0)) continue;
        add(fit, fit.p - local.t, axis, scan.map->index_of(fit.surface.tile));
      }
      fill_up();
    }
    begin_[kParts] = count_;
  }

  // Four sums of each.
  struct LaneSums {
    FourFloats A[6] = {}, b[3] = {}, cost = {};
    FourFloats trusts = {}, known_trusts = {}, squares = {}, known_squares = {};
    FourInts counted = {};

    Sums sums() const {
      Sums sums;
      for (int r = 0, n = 0; r < 3; ++r) {
        for (int j = 0; j <= r; ++j) sums.A(r, j) = sums.A(j, r) = sum_of_lanes(A[n++]);
        sums.b[r] = sum_of_lanes(b[r]);
      }
      sums.cost = sum_of_lanes(cost);
      sums.count = sum_of_lanes(counted);
      sums.of_kind[1] = sum_of_lanes(known_trusts), sums.of_kind[0] = sum_of_lanes(trusts) - sums.of_kind[1];
      sums.squares[1] = sum_of_lanes(known_squares), sums.squares[0] = sum_of_lanes(squares) - sums.squares[1];
      return sums;
    }
  };

  // The pose moved by so much. Updates the parts from the first to before the last, each with its remaining pull.
  Sums sum_up(Part first, std::uint32_t last, const int (&free)[3], const float (&by)[6], const Scales& scales,
              bool use_relief) const {
    const FourFloats zero = all_four(0.0F), one = all_four(1.0F);
    const auto outlier2 = static_cast<float>(limit_of<gate::OUTLIER>());
    LaneSums lanes;
    for (std::uint32_t i = begin_[first]; i < begin_[last]; i += kFour) {
      FourFloats distance = load_four(&s_.distance[i]);
      for (int k = 0; k < 6; ++k) distance += load_four(&s_.by_move[k][i]) * by[k];
      const FourFloats known_share = load_four(&s_.known[i]);
      const FourTruths known = known_share > zero;
      const FourFloats variance =
          load_four(&s_.variance[i]) * (known ? all_four(scales.variance[1]) : all_four(scales.variance[0]));
      const FourFloats cut2 = use_relief ? outlier2 * variance + all_four(1e-4F) : all_four(kNear_m * kNear_m);
      const FourFloats squared = distance * distance;
      const FourFloats left = larger_of(one - squared / cut2, zero), trust = left * left;
      const FourFloats weight = trust / variance, pull = weight * distance;
      store_four(pull, &s_.pull[i]);
      store_four(weight, &s_.weight[i]);
      const FourFloats misfit2 = pull * distance;
      lanes.trusts += trust;
      lanes.known_trusts += known_share * trust;
      lanes.squares += misfit2;
      lanes.known_squares += known_share * misfit2;
      lanes.counted -= left > zero;
      lanes.cost -= cut2 / variance * trust * left;  // Tukey's, but for a constant
      FourFloats row[3];
      for (int k = 0; k < 3; ++k) row[k] = load_four(&s_.by_move[free[k]][i]);
      for (int r = 0, n = 0; r < 3; ++r) {
        const FourFloats weighed = weight * row[r];
        for (int j = 0; j <= r; ++j) lanes.A[n++] += weighed * row[j];
        lanes.b[r] -= pull * row[r];
      }
    }
    return lanes.sums();
  }

  // Variance of the three by the patches of rock: each is left out as a whole, and the rest finds its own place. Points
  // of a patch err together, so they count once; and where few patches hold a direction, the ones that do are not their
  // own witnesses. False where they are too few to be each other's.
  bool variance_by_patches(const Step& step, const Sums& sums, std::uint32_t tiles, Eigen::Matrix3d* variance) const {
    for (Span<float>& s : s_.sum) s.first(tiles).fill(0.0F);
    for (std::uint32_t i = begin_[step.first]; i < begin_[step.last]; ++i) {
      const std::uint32_t tile = s_.tile[i];
      for (int r = 0, n = 3; r < 3; ++r) {
        const float by = s_.by_move[step.free[r]][i], weighed = s_.weight[i] * by;
        s_.sum[r][tile] += s_.pull[i] * by;
        for (int j = 0; j <= r; ++j) s_.sum[n++][tile] += weighed * s_.by_move[step.free[j]][i];
      }
    }
    variance->setZero();
    std::uint32_t patches = 0;
    for (std::uint32_t t = 0; t < tiles; ++t) {
      if (s_.sum[3][t] == 0.0F && s_.sum[5][t] == 0.0F && s_.sum[8][t] == 0.0F) continue;  // most are out of sight
      Sums rest = sums;
      for (int r = 0, n = 3; r < 3; ++r) {
        rest.b[r] = static_cast<double>(s_.sum[r][t]);
        for (int j = 0; j <= r; ++j, ++n) {
          rest.A(r, j) -= kLeftOut * static_cast<double>(s_.sum[n][t]);
          rest.A(j, r) = rest.A(r, j);
        }
      }
      Eigen::Vector3d moves_by;
      if (!solve(rest, 0.0, step.asked, &moves_by)) return false;
      *variance += moves_by * moves_by.transpose();
      ++patches;
    }
    return passes<gate::PATCHES>(patches);
  }

 private:
  void add(const Fit& fit, const Eigen::Vector3f& arm, const Eigen::Vector3f (&axis)[3], std::uint32_t tile) {
    const Eigen::Vector3f lever = arm.cross(fit.normal);
    for (int k = 0; k < 3; ++k) {
      s_.by_move[k][count_] = axis[k].dot(fit.normal);
      s_.by_move[3 + k][count_] = axis[k].dot(lever);
    }
    s_.distance[count_] = fit.distance_m;
    s_.variance[count_] = fit.variance_m2;
    s_.known[count_] = fit.has_relief ? 1.0F : 0.0F;
    s_.tile[count_++] = static_cast<std::uint16_t>(tile);
  }

  // Pads to a whole four with points too far off to count.
  void fill_up() {
    constexpr float kFar_m = 100.0F;  // beyond every cut: of no weight
    for (; count_ % kFour != 0; ++count_) {
      for (Span<float>& by : s_.by_move) by[count_] = 0.0F;
      s_.distance[count_] = kFar_m;
      s_.variance[count_] = 1e-4F;
      s_.known[count_] = 0.0F;
      s_.tile[count_] = 0;
    }
  }

  StepScratch& s_;
  std::uint32_t count_ = 0, begin_[kParts + 1];
};

// Levenberg-Marquardt on three of the six moves. False where too little counts.
bool iterate(const Equations& equations, const Step& step, const StepOptions& options, const Scales& scales,
             float (&by)[6], Sums* sums) {
  const auto at = [&](const float(&moves)[6]) {
    return equations.sum_up(step.first, step.last, step.free, moves, scales, options.use_relief);
  };
  double damping = kDamping;
  *sums = at(by);
  for (int round = 0; round < options.rounds; ++round) {
    if (!passes<gate::EQUATIONS>(sums->count)) return false;
    Eigen::Vector3d move;
    (void)solve(*sums, damping, step.asked, &move);
    float trial[6];
    for (int k = 0; k < 6; ++k) trial[k] = by[k];
    for (int k = 0; k < 3; ++k) trial[step.free[k]] += static_cast<float>(move[k]);
    const Sums found = at(trial);
    if (found.cost > sums->cost) {  // refused: once more from here, more carefully
      damping *= 10.0;
    } else {
      for (int k = 0; k < 6; ++k) by[k] = trial[k];
      *sums = found;
      damping *= 0.1;
    }
    if (!(move.squaredNorm() > kStepLeast2)) break;
  }
  return passes<gate::EQUATIONS>(sums->count);
}

// False where too little counts to tell how sure the step is.
bool take_step(const Equations& equations, const Step& step, const StepOptions& options, std::uint32_t tiles,
               float (&by)[6], Alignment* a) {
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  Scales scales;
  Sums sums;
  bool told = iterate(equations, step, options, scales, by, &sums);
  if (told && options.use_relief) {
    // The residuals of the first rounds give the noise for the last ones.
    scales.learn(sums);
    told = iterate(equations, step, options, scales, by, &sums);
    scales.learn(sums);
    sums = equations.sum_up(step.first, step.last, step.free, by, scales, true);
    (step.first == kOfGround ? a->ground : a->matched) = sums.count;
    told = told && equations.variance_by_patches(step, sums, tiles, &C);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) a->covariance(step.free[i], step.free[j]) = C(i, j);
  }
  return told;
}

// along, left and up, and turns about them.
Pose moved(const Alignment& a, const float (&by)[6]) {
  const Eigen::Vector3d* const axis[3] = {&a.axes.along, &a.axes.left, &a.axes.up};
  Eigen::Vector3d turn = Eigen::Vector3d::Zero(), move = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    move += *axis[k] * static_cast<double>(by[k]);
    turn += *axis[k] * static_cast<double>(by[3 + k]);
  }
  return {orthonormal(turn_by(turn) * a.pose.R), a.pose.t + move};
}

}  // namespace

void StepScratch::lay_out(Arena& arena) {
  constexpr std::uint32_t kMost = kObservationsMost + kParts * kFour;  // each part ends in a whole four
  for (Span<float>& by : by_move) by = arena.take<float>(kMost);
  distance = arena.take<float>(kMost);
  variance = arena.take<float>(kMost);
  known = arena.take<float>(kMost);
  weight = arena.take<float>(kMost);
  pull = arena.take<float>(kMost);
  tile = arena.take<std::uint16_t>(kMost);
  for (Span<float>& s : sum) s = arena.take<float>(kTilesMost);
}

bool take_steps(const Scan& scan, const StepOptions& options, StepScratch* scratch, Alignment* a) {
  std::uint32_t ground = 0;
  for (const Observation& o : scan.observation) ground += o.ground;
  a->ground_alone = passes<gate::GROUND>(ground);
  const Equations equations(scan, *a, options.every, options.with_along, scratch);
  const std::uint32_t tiles = scan.map->tiles();
  float by[6] = {};
  const Step one = {kOfGround, a->ground_alone ? kOfRoof : kParts, {3, 4, 2}, {true, true, true}};
  a->told = take_step(equations, one, options, tiles, by, a);
  const Step two = {kOfWalls, kParts, {0, 1, 5}, {options.with_along, true, true}};
  a->told = take_step(equations, two, options, tiles, by, a) && a->told;
  a->pose = moved(*a, by);
  float far2 = 0.0F;
  for (const float move : by) far2 += move * move;
  return far2 > kStill2;
}

}  // namespace pose_wall::motion
