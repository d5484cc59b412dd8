// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The plane of what is really there within a region: what a surveyor with a dense scan computes
// (include/DEFINITIONS.md). It minimises the sum over the area of log(1 + (r/c)²), Cauchy's robust estimate. So
// openings and things need no threshold of their own: what lies far from the plane weighs little.
//
// Where a cell of the region is seen, its height is measured. Where it is not, the waves that the seen cells show
// predict it (uneven_plane.hpp).

#pragma once

#include <cmath>

#include "base/containers/work.hpp"
#include "base/estimation/tangent_frame.hpp"
#include "base/estimation/uneven_plane.hpp"
#include "engine/config.hpp"
#include "engine/region/region_cells.hpp"
#include "engine/types.hpp"

namespace pose_wall {

// h = at[0] + at[1] u + at[2] v.
struct RegionPlane {
  // What the formula starts from: all of the region, its four halves, and both its ends.
  static constexpr int kStarts = 6;
  // The seen cells alone, the other starts, each start behind things, nearer layers, the edges, and four leans or cuts.
  static constexpr std::uint32_t kReadingsMost = 1 + (kStarts - 1) + kStarts + 1 + 1 + 4;

  bool found = false;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double dof = 1.0;           // the variance is known as well as from so many independent pieces
  double rough_m = 0.0;       // spread of the cells about the plane
  double points = 0.0;        // measured, near it, by their weights
  double area_m2 = 0.0;       // of the cells near it
  double length_m = 0.0;      // of the cells near it, along u
  double seen_at_ends = 0.0;  // of the cells ahead, and of those behind: the lesser share that is seen
  double near = 0.0;          // mean weight of the cells: below half the region is no such surface

  // Of a linear function of the plane: standard deviation, and bounds by range bias, bends and other readings.
  double sigma(const Eigen::Vector3d& of) const;
  ProtectionParts bound(const Eigen::Vector3d& of, const Settings& settings) const;
  // Whether its cells show the endless plane as well: one that the formula may as well settle on.
  bool may_be_endless = false;
  // By how much the endless plane that it was predicted from moves it: of offset and slopes.
  Eigen::Vector3d share_of_endless(const Eigen::Vector3d& of) const { return of_endless_.transpose() * of; }
  // By how much an endless plane is uncertain as this one: the waves turn and shift this one about it.
  double sigma_about_endless(const Eigen::Vector3d& of) const { return std::sqrt(of.dot(about_endless_ * of)); }
  bool is_there() const { return found && near >= kHalf + kDoubt; }
  bool is_none() const { return found && near < kHalf - kDoubt; }
  // In the frame of the region's points, with the normal towards the machine.
  Plane plane_in(const Region& region) const;

 private:
  friend class RegionFit;
  double sigma_of_seen(const Eigen::Vector3d& of) const;
  void take(const UnevenFit& fit);
  RegionPlane on_endless(const UnevenFit& fit, const Eigen::Array<bool, 2, 1>& goes_on) const;
  static constexpr double kHalf = 0.5;  // of the definition
  // The sensor sees other parts than the surveyor. With walls from 0.42 on, 14 of 2,688 values of mine scenes were
  // misleading, all where the surveyor saw none; from 0.58 on none was (campaign seed 90210, 2026-11-28).
  static constexpr double kDoubt = 0.08;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d of_endless_ = Eigen::Matrix3d::Zero(), about_endless_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d bias_response_ = Eigen::Vector3d::Zero();  // change per metre of range bias
  Eigen::Matrix<double, 3, 2> missing_of_bend_ = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Vector2d bend_per_m_ = Eigen::Vector2d::Zero();
  // How far another plane that it may be lies from it.
  struct Reading {
    Eigen::Vector3d apart = Eigen::Vector3d::Zero();
    // It needs no guess of what is not seen, or is unlikely: it counts beyond the random part.
    bool within_random = false;
    bool of_edge = false;  // without the outermost row
  };
  Reading readings_[kReadingsMost];
  std::uint32_t count_ = 0;
};

// A plane of all surface in view as the region's h = correction * (1, u, v). errors: covariance, bias and degrees of
// freedom of its height and slopes in the frame that it was fitted in, and whether there are any.
UnevenFit over_region(const Region& region, const Plane& plane, const TangentFrame& frame, const UnevenFit& errors);

// Standard deviation of an endless plane as a region's, by sigma_about_endless().
inline double with_waves(double sigma, double waves) {
  return std::sqrt(sigma * sigma + waves * waves);
}

// Whether waves, and what is not known of both planes, explain how far these lie apart. Else part of the region is
// another surface: a wall's foot, a bench. The standard deviation of the endless one holds the waves.
inline bool may_be_waves(double apart, double sigma_of_endless, double sigma_of_region) {
  constexpr double kSigmas = 3.0;  // no such surface lies so far off in one frame of 370
  return std::fabs(apart) <= kSigmas * with_waves(sigma_of_endless, sigma_of_region);
}

class RegionFit {
 public:
  void lay_out(Arena& arena);
  // endless: the plane h = correction · (1, u, v) that all of the surface in view shows, or nothing. Then also writes
  // what it predicts of the region with what is seen there; found if it does.
  RegionPlane fit(const BoundedPoints& points, const Region& region, const Settings& settings, UnevenPlane* waves,
                  Work* work, const UnevenFit& endless, RegionPlane* by_endless);
  // Of the last fit: how far the surface about u lies from this plane, where most of it is another surface; else 0.
  double step_at(double u_m, const Eigen::Vector3d& plane) const;

 private:
  static constexpr int kStarts = RegionPlane::kStarts;  // as many planes to begin with
  // A plane that the formula settles on, from all cells or those of a part of the region.
  struct Settled {
    bool solved = false;
    Eigen::Vector3d start = Eigen::Vector3d::Zero();  // by least squares
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    double loss = 0.0;
  };
  // c: the formula's width while it narrows. lean: by how much the weights grow towards the far ends along u and v.
  // edge: along u and v, from where cells beyond it are left out. before_m: what lies so far before the plane is left
  // out.
  struct Manner {
    double c_m;
    Eigen::Vector2d lean = Eigen::Vector2d::Zero(), edge = Eigen::Vector2d::Zero();
    double before_m = 1e9;
  };

  // Patches and responses of the first seen cells show the surface, those of the rest are predicted. A: of the weights.
  struct Taken {
    std::uint32_t seen = 0, all = 0;
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  };

  // Cells of the region, row by row: for four at a time, the last ones filled up.
  struct Shown {
    Span<float> u, v, h, from_middle_u, from_middle_v;
    std::uint32_t count = 0;
  };

  std::uint32_t count_seen(RegionPlane* out) const;
  void list_shown(float RegionCell::*layer_m);
  void describe(const Eigen::Vector3d& plane, RegionPlane* out) const;
  template <typename WeightOf>
  bool least_squares(const WeightOf& weight_of, Eigen::Vector3d* plane) const;
  bool settle(const Manner& manner, Eigen::Vector3d* plane) const;
  int settle_all(Settled (*settled)[kStarts]) const;
  template <typename LossOf>
  double mean_over_cells(const Eigen::Vector3d& plane, const LossOf& loss) const;
  double loss_of(const Eigen::Vector3d& plane) const;
  double loss_without_things(const Eigen::Vector3d& plane) const;
  Taken take_cells(Span<const PatchSums> sums, const Eigen::Vector3d& settled, double noise2, RegionPlane* out);
  bool predict(const BoundedPoints& points, const Region& region, const Settings& settings,
               const Eigen::Vector3d& settled, UnevenPlane* waves, const UnevenFit& endless, RegionPlane* out,
               UnevenFit* by_endless);
  double weight_near(const RegionCell& place) const;
  double seen_behind_at_edges(const Eigen::Vector3d& plane) const;
  void read_otherwise(const Settled (&settled)[kStarts], int best, RegionPlane* out);

  RegionCells cells_;
  Shown shown_;
  Span<SurfacePatch> patches_;
  Span<Eigen::Vector3d> responses_;
};

}  // namespace pose_wall
