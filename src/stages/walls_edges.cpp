// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_edges.hpp"

#include "estimation/near_plane.hpp"
#include "math/bits.hpp"
#include "math/larger.hpp"
#include "stages/walls_sight_lines.hpp"

namespace pose_wall {
namespace {

constexpr double kPlace_m = 0.5;
// An end beyond this place (6 m) is not near.
constexpr std::uint32_t kNearPlaces = 12;
constexpr double kOnMin = 2.0;
constexpr double kPastMin = 4.0;
// So many points up to this far behind the plane, within so many places of its end, are its own bend.
constexpr double kBend_m = 0.5;
constexpr std::uint32_t kBendPlaces = 4;
constexpr double kBendMin = 4.0;
// The top is looked for in the wall band and this much above it.
constexpr double kAboveBand_m = 1.0;
// So many points have come over the top, so many times those of the plane at such heights, and from places so far
// apart: a hollow at the shoulder, where roof has come down, is looked into at one place.
constexpr double kOverMin = 4.0;
constexpr double kOverRatio = 3.0;
constexpr double kOverSpan_m = 1.5;
// Conveyors, pipes and vehicles end in the lower part of the wall band (1.7 m by default). On simulated walls even a
// sensor that looks up by 7 degrees has 18 points or more above, far ahead.
constexpr double kHighShare = 0.65;
constexpr double kHighMin = 8.0;
constexpr double kHighReach_m = 15.0;

// What lies behind, by decimetres.
constexpr double kDepth_m = 0.1;
constexpr double kLayerPointsMin = 20.0;
constexpr double kLayerShare = 0.6;
constexpr double kLayerOfPlane = 0.01;  // hollows of rough rock are fewer
constexpr int kLayerPlacesMin = 5;
constexpr double kLayerSpan_m = 6.0;

}  // namespace

FourInts EndPlaces::places_of(FourFloats along_m) {
  const FourFloats place = magnitude_of(along_m) * static_cast<float>(1.0 / kPlace_m), none{};
  const FourTruths is_near = place < static_cast<float>(kPlaces), is_ahead = along_m >= none;
  const FourInts begin = is_ahead ? all_four_ints(static_cast<std::int32_t>(kPlaces)) : all_four_ints(0);
  return is_near ? cut_off(is_near ? place : none) + begin : all_four_ints(static_cast<std::int32_t>(kElsewhere));
}

bool EndPlaces::is_looked_past(std::uint32_t begin) const {
  const double *const on = on_ + begin, *const past = past_ + begin, *const just_behind = just_behind_ + begin;
  std::uint32_t beyond = 0;  // the first place behind the last that has anything on the plane
  for (std::uint32_t k = 0; k < kPlaces; ++k) beyond = on[k] > kOnMin && on[k] > past[k] ? k + 1 : beyond;
  double passing = 0.0, bending = 0.0;
  for (std::uint32_t k = beyond; k < kPlaces; ++k) {
    passing += past[k];
    bending += k < beyond + kBendPlaces ? just_behind[k] : 0.0;
  }
  return beyond > 0 && beyond <= kNearPlaces && passing >= kPastMin && bending < kBendMin;
}

void DepthsBehind::add(double behind_m, double along_m, double points) {
  const double step = behind_m / kDepth_m, place = along_m / kPlace_m + EndPlaces::kPlaces;
  if (!(step >= 0.0 && step < kSteps && place >= 0.0 && place < 2.0 * EndPlaces::kPlaces)) return;
  Step& s = step_[static_cast<std::uint32_t>(step)];
  s.points += points;
  s.places |= 1ULL << static_cast<std::uint32_t>(place);
}

// Most of what lies up to two metres behind lies equally far behind, here and there over a wall's length: a niche is
// shorter, and a road that branches off is deep.
bool DepthsBehind::hold_a_layer(double on_plane) const {
  double all = 0.0, most = 0.0;
  std::uint64_t places = 0;
  for (std::uint32_t k = 0; k < kSteps; ++k) {
    all += step_[k].points;
    if (k + 1 == kSteps || !(step_[k].points + step_[k + 1].points > most)) continue;
    most = step_[k].points + step_[k + 1].points;
    places = step_[k].places | step_[k + 1].places;
  }
  if (!(most >= kLayerPointsMin && most >= kLayerOfPlane * on_plane && most >= kLayerShare * all)) return false;
  std::uint32_t first = 0, last = 63;
  while (((places >> first) & 1U) == 0) ++first;
  while (((places >> last) & 1U) == 0) --last;
  return bits_in(places) >= kLayerPlacesMin && (last - first) * kPlace_m >= kLayerSpan_m;
}

FourInts TopPlaces::cells_of(FourFloats along_m, FourFloats height, FourTruths is_past) {
  const FourFloats place = along_m * static_cast<float>(1.0 / kPlace_m) + 0.5F * kPlaces, none{};
  const FourTruths inside =
      (place >= none) & (place < static_cast<float>(kPlaces)) & (height >= none) & (height < 1.0F);
  const FourInts begin = is_past ? all_four_ints(static_cast<std::int32_t>(kSteps)) : all_four_ints(0);
  const FourInts of_place = cut_off(inside ? place : none) * static_cast<std::int32_t>(kPlaceCells);
  const FourInts step = cut_off(inside ? height * static_cast<float>(kSteps) : none);
  return inside ? of_place + begin + step : all_four_ints(kNoCell);
}

// There is a height with nothing of the plane above it but what has passed over it, wherever the plane is seen below.
bool TopPlaces::is_looked_over() const {
  struct Above {
    double on = 0.0, past = 0.0;
    std::uint32_t first_over = kPlaces, last_over = 0;
  };
  Above above[kSteps];  // by the lowest step that counts as above
  for (std::uint32_t k = 0; k < kPlaces; ++k) {
    const float *const on = &cell_[k * kPlaceCells], *const past = on + kSteps;
    double on_below = 0.0, past_below = 0.0;
    for (std::uint32_t step = 0; step < kSteps; ++step) {
      on_below += static_cast<double>(on[step]);
      past_below += static_cast<double>(past[step]);
    }
    double on_above = 0.0, past_above = 0.0;
    for (std::uint32_t step = kSteps; step-- > 0;) {
      on_above += static_cast<double>(on[step]);
      past_above += static_cast<double>(past[step]);
      on_below -= static_cast<double>(on[step]);
      past_below -= static_cast<double>(past[step]);
      if (!(on_below > kOnMin && on_below > past_below)) continue;  // an opening, or nothing is seen of it here
      Above& a = above[step];
      a.on += on_above;
      a.past += past_above;
      if (!(past_above > on_above)) continue;
      a.first_over = k < a.first_over ? k : a.first_over;
      a.last_over = k;
    }
  }
  for (const Above& a : above) {
    if (!(a.past >= kOverMin && a.past > kOverRatio * a.on)) continue;
    if (a.last_over >= a.first_over && (a.last_over - a.first_over) * kPlace_m >= kOverSpan_m) return true;
  }
  return false;
}

namespace {

// Over a low thing the sensor may see nothing nearer than range_max.
void add_what_is_too_far(const WallScene& scene, const SightLines& lines, double height_m, TopPlaces* tops) {
  constexpr double kMostOfACell = 0.5;
  const auto look_at = [&](std::uint32_t row, std::uint32_t column) {
    const std::uint32_t count = scene.returns_lidar.too_far.count(row, column);
    if (count == 0 || count <= kMostOfACell * scene.returns_lidar.all.count(row, column)) return;
    const SightLines::Crossing c = lines.far(row, column);
    if (!c.near) return;
    const double height = (c.z_level_m - scene.z_min_level_m) / height_m;
    // Rare: one is told as four that are alike.
    const std::int32_t cell = TopPlaces::cells_of(all_four(static_cast<float>(c.along_m)),
                                                  all_four(static_cast<float>(height)), all_four_ints(-1))[0];
    if (cell != TopPlaces::kNoCell) tops->add(cell, static_cast<float>(count));
  };
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    for (std::uint32_t first = 0; first < DirectionGrid::kColumns; first += kFour) {
      if (!scene.returns_lidar.too_far.any_in_four(row, first)) continue;
      for (std::uint32_t lane = 0; lane < kFour; ++lane) look_at(row, first + lane);
    }
  }
}

// Where the rays to four points meet the plane, or would, and where along it the points lie; in floats.
class FourRays {
 public:
  FourRays(const WallScene& scene, const Eigen::Vector3d& along_level, double inside_m)
      : inside_m_(static_cast<float>(inside_m)), sensor_z_level_m_(static_cast<float>(scene.sensor_level_m.z())) {
    const Eigen::Vector3d along_base = scene.R_level_base.transpose() * along_level;
    const Eigen::Vector3d up_base = scene.R_level_base.row(2);
    for (int k = 0; k < 3; ++k) {
      along_base_[k] = static_cast<float>(along_base[k]);
      up_base_[k] = static_cast<float>(up_base[k]);
    }
    sensor_along_m_ = static_cast<float>(along_level.dot(scene.sensor_level_m));
  }

  void look_at(FourFloats x, FourFloats y, FourFloats z, FourFloats r) {
    const FourFloats to_plane = inside_m_ / (inside_m_ - r);
    point_along_m = along_base_[0] * x + along_base_[1] * y + along_base_[2] * z - sensor_along_m_;
    point_z_level_m = up_base_[0] * x + up_base_[1] * y + up_base_[2] * z;
    along_m = to_plane * point_along_m;
    z_level_m = sensor_z_level_m_ + to_plane * (point_z_level_m - sensor_z_level_m_);
  }

  FourFloats point_along_m{}, point_z_level_m{}, along_m{}, z_level_m{};

 private:
  float inside_m_, sensor_z_level_m_, sensor_along_m_;
  float along_base_[3], up_base_[3];
};

// What the returns tell of the plane's edges. Rays to the floor right behind the plane pass it too.
class EdgeTally {
 public:
  EdgeTally(const WallScene& scene, double margin_m, EdgeScratch* scratch)
      : z_min_level_m_(static_cast<float>(scene.z_min_level_m)),
        z_max_level_m_(static_cast<float>(scene.z_max_level_m)),
        margin_m_(static_cast<float>(margin_m)),
        well_behind_m_(static_cast<float>(larger(kWellBehind_m, margin_m))),
        height_m_(scene.z_max_level_m + kAboveBand_m - scene.z_min_level_m),
        per_height_(static_cast<float>(1.0 / height_m_)),
        high_level_m_(
            static_cast<float>(scene.z_min_level_m + kHighShare * (scene.z_max_level_m - scene.z_min_level_m))),
        scratch_(*scratch) {
    scratch_.ends.clear();
    scratch_.tops.clear();
    scratch_.depths.clear();
  }

  bool has_seen_high() const { return seen_high_ >= kHighMin; }
  double on_plane() const { return on_plane_; }
  double height_m() const { return height_m_; }

  // Distances from the plane of those that count, their weights, and their rays.
  void add(FourFloats r_m, FourFloats weights, FourTruths counts, const FourRays& rays) {
    const FourTruths is_past = r_m < -margin_m_;
    if (!has_seen_high()) look_high(weights, counts & ~is_past, rays);
    const FourTruths tells = counts & (r_m <= margin_m_);
    if (!any_of(tells)) return;
    const FourTruths for_tops = tells & (~is_past | (r_m < -well_behind_m_));
    const FourInts top = TopPlaces::cells_of(rays.along_m, (rays.z_level_m - z_min_level_m_) * per_height_, is_past);
    const FourTruths on_plane = tells & ~is_past & in_band(rays.point_z_level_m);
    const FourInts end = EndPlaces::places_of(rays.point_along_m);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (for_tops[lane] != 0 && top[lane] != TopPlaces::kNoCell) scratch_.tops.add(top[lane], weights[lane]);
      if (on_plane[lane] != 0) scratch_.ends.add_on(end[lane], weights[lane]);
    }
    const FourFloats none{};
    on_plane_ += sum_of_lanes(on_plane ? larger_of(weights, all_four(1.0F)) : none);
    const FourTruths elsewhere = tells & ~on_plane;
    if (any_of(elsewhere)) add_elsewhere(r_m, weights, elsewhere, end, rays);
  }

 private:
  FourTruths in_band(FourFloats z_level_m) const {
    return (z_level_m >= z_min_level_m_) & (z_level_m <= z_max_level_m_);
  }

  void look_high(FourFloats weights, FourTruths counts, const FourRays& rays) {
    const FourTruths high =
        counts & (rays.z_level_m >= high_level_m_) & (magnitude_of(rays.along_m) <= static_cast<float>(kHighReach_m));
    const FourFloats none{};
    seen_high_ += sum_of_lanes(high ? weights : none);
  }

  // Past the plane, or on it above and below the band.
  void add_elsewhere(FourFloats r_m, FourFloats weights, FourTruths counts, const FourInts& end, const FourRays& rays) {
    const FourTruths point_in_band = in_band(rays.point_z_level_m);
    const FourTruths deep = counts & (r_m < -well_behind_m_) & (rays.point_z_level_m >= z_min_level_m_) &
                            (rays.point_z_level_m <= z_max_level_m_ + static_cast<float>(kAboveBand_m));
    const FourTruths bends = counts & point_in_band & (r_m > static_cast<float>(-kBend_m));
    const FourFloats none{};
    const FourTruths passes = counts & (r_m < none) & in_band(rays.z_level_m);
    const FourInts passed = EndPlaces::places_of(rays.along_m);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const double weight = static_cast<double>(weights[lane]);
      if (deep[lane] != 0) {
        scratch_.depths.add(-static_cast<double>(r_m[lane]), static_cast<double>(rays.point_along_m[lane]),
                            larger(weight, 1.0));
      }
      if (bends[lane] != 0) scratch_.ends.add_just_behind(end[lane], weights[lane]);
      if (passes[lane] != 0) scratch_.ends.add_past(passed[lane], weights[lane]);
    }
  }

  float z_min_level_m_, z_max_level_m_, margin_m_, well_behind_m_;
  double height_m_;
  float per_height_, high_level_m_;
  EdgeScratch& scratch_;
  double seen_high_ = 0.0, on_plane_ = 0.0;
};

}  // namespace

WallEdges look_past(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double margin_m,
                    EdgeScratch* scratch) {
  const double inside_m = wall.signed_distance(scene.sensor_level_m);
  if (!(inside_m > 0.0)) return {};
  EdgeTally tally(scene, margin_m, scratch);
  const Plane wall_base{scene.R_level_base.transpose() * wall.n, wall.d};
  const Slab slab(wall_base, kAnyDepth_m, inside_m);
  FourRays rays(scene, along_level, inside_m);
  const PointSet& points = scene.cloud_base;
  for_each_four_about(scene.cloud_base, slab, [&](std::uint32_t i, FourTruths counts) {
    const FourFloats x = load_four(&points.x[i]), y = load_four(&points.y[i]), z = load_four(&points.z[i]);
    const FourFloats r = slab.distances().of(x, y, z);
    // What looks away from the plane tells nothing, and what ends before it only how high the sensor looks.
    const double limit_m = tally.has_seen_high() && margin_m <= inside_m ? margin_m : inside_m;
    const FourTruths tells = counts & (r < static_cast<float>(limit_m));
    if (!any_of(tells)) return;
    rays.look_at(x, y, z, r);
    tally.add(r, load_four(&points.weight[i]), tells, rays);
  });
  add_what_is_too_far(scene, SightLines(scene, wall, along_level), tally.height_m(), &scratch->tops);
  return {scratch->ends.both_are_looked_past(), scratch->tops.is_looked_over(), !tally.has_seen_high(),
          scratch->depths.hold_a_layer(tally.on_plane())};
}

}  // namespace pose_wall
