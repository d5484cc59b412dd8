// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/doubts/edges.hpp"

#include "base/estimation/near_plane.hpp"
#include "base/math/bits.hpp"
#include "base/math/finite.hpp"
#include "engine/walls/doubts/sight_lines.hpp"

namespace pose_wall {
namespace {

constexpr double kPlace_m = EndPlaces::kPlace_m;  // the places of EndPlaces
// So many points just behind the plane, within 2 m of its end, show its own bend:
constexpr std::uint32_t kBendPlaces = 4;  // swept: half and twice change nothing
constexpr double kBendMin = 4.0;          // swept: half and twice change nothing

// Points over the top for each of the plane as high; swept: half 1 moved, twice nothing.
constexpr double kOverRatio = 3.0;
// A hollow at the shoulder opens at one place; swept: half and twice change nothing.
constexpr double kOverSpan_m = 1.5;

constexpr double kDepth_m = 0.1;  // steps of depth: a layer lies within two (README, Edges)
// Of all up to 2 m behind; a branching road is deep; swept: half 1 lost, twice 4 moved.
constexpr double kLayerShare = 0.6;
constexpr double kLayerOfPlane = 0.01;  // hollows of rough rock hold fewer; swept: half and twice change nothing
constexpr int kLayerPlacesMin = 5;      // half metres with points of the layer; swept: half nothing, twice 1 moved
constexpr double kLayerSpan_m = 6.0;    // niches are shorter; 984 frames of 164 classes lost no value (seed 517)

constexpr double kBend_m = 0.5;      // a wall may bend so far behind its plane; swept: half and twice change nothing
constexpr double kHighShare = 0.65;  // conveyors, pipes and vehicles end below: 1.7 m of the default band
constexpr double kHighMin = 8.0;     // simulated walls show 18 points, even to a sensor that looks up by 7 degrees
// There such a sensor sees 1.8 m higher than itself; swept: half 2 lost, twice nothing.
constexpr double kHighReach_m = 15.0;

// Over a low thing the sensor may see nothing nearer than range_max. Returns the number of such returns.
double add_what_is_too_far(const WallScene& scene, const SightLines& lines, double height_m, TopPlaces* tops) {
  constexpr double kMostOfACell = 0.5;  // most of a cell's returns must be too far
  double added = 0.0;
  const auto look_at = [&](std::uint32_t row, std::uint32_t column) {
    const std::uint32_t count = scene.returns_lidar.too_far.count(row, column);
    if (count == 0 || count <= kMostOfACell * scene.returns_lidar.all.count(row, column)) return;
    const SightLines::Crossing c = lines.far(row, column);
    if (!c.near) return;
    const double height = (c.z_level_m - scene.z_min_level_m) / height_m;
    // Rare, so one place is computed as four equal ones.
    const std::int32_t cell = TopPlaces::cells_of(all_four(static_cast<float>(c.along_m)),
                                                  all_four(static_cast<float>(height)), all_four_ints(-1))[0];
    if (cell == TopPlaces::kNoCell) return;
    tops->add(cell, static_cast<float>(count));
    added += count;
  };
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    for (std::uint32_t first = 0; first < DirectionGrid::kColumns; first += kFour) {
      if (!scene.returns_lidar.too_far.any_in_four(row, first)) continue;
      for (std::uint32_t lane = 0; lane < kFour; ++lane) look_at(row, first + lane);
    }
  }
  return added;
}

// The places of four points along the plane, and of the rays to them where they meet it; in floats.
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

  void go_to(FourFloats x, FourFloats y, FourFloats z) {
    point_along_m = along_base_[0] * x + along_base_[1] * y + along_base_[2] * z - sensor_along_m_;
    point_z_level_m = up_base_[0] * x + up_base_[1] * y + up_base_[2] * z;
  }
  // For the points of the last go_to(), at this distance from the plane.
  void cross_at(FourFloats r) {
    const FourFloats to_plane = way_to_plane(inside_m_, r);
    along_m = to_plane * point_along_m;
    z_level_m = on_the_way(sensor_z_level_m_, point_z_level_m, to_plane);
  }

  FourFloats point_along_m{}, point_z_level_m{}, along_m{}, z_level_m{};

 private:
  float inside_m_, sensor_z_level_m_, sensor_along_m_;
  float along_base_[3], up_base_[3];
};

// Heights and distances that both looks use.
struct EdgeLimits {
  EdgeLimits(const WallScene& scene, double margin)
      : z_min_level_m(static_cast<float>(scene.z_min_level_m)),
        z_max_level_m(static_cast<float>(scene.z_max_level_m)),
        margin_m(static_cast<float>(margin)),
        well_behind_m(static_cast<float>(larger(kWellBehind_m, margin))),
        height_m(scene.z_max_level_m + kAboveBand_m - scene.z_min_level_m) {}

  FourTruths in_band(FourFloats z_level_m) const { return (z_level_m >= z_min_level_m) & (z_level_m <= z_max_level_m); }

  float z_min_level_m, z_max_level_m, margin_m, well_behind_m;
  double height_m;
};

// The first look, usually the last: whether anything is seen past the plane at all, how far it goes on, and how high
// the sensor looks.
class EdgeGlance {
 public:
  EdgeGlance(const WallScene& scene, const EdgeLimits& limits)
      : limits_(limits),
        high_level_m_(
            static_cast<float>(scene.z_min_level_m + kHighShare * (scene.z_max_level_m - scene.z_min_level_m))) {}

  bool has_seen_high() const { return seen_high_ >= kHighMin; }

  // Distances from the plane of those that count, their weights, and their rays.
  void add(FourFloats r_m, FourFloats weights, FourTruths counts, FourRays* rays) {
    const FourTruths is_past = r_m < -limits_.margin_m;
    if (!has_seen_high()) {
      rays->cross_at(r_m);
      look_high(weights, counts & ~is_past, *rays);
    }
    const FourFloats none{}, away_m = magnitude_of(rays->point_along_m);
    const FourTruths tells = counts & (r_m <= limits_.margin_m), past = tells & is_past;
    past_ += past ? larger_of(weights, all_four(1.0F)) : none;
    const FourTruths far =
        tells & ~is_past & (away_m >= static_cast<float>(EndPlaces::kNearPlaces * EndPlaces::kPlace_m));
    const FourTruths in_band = limits_.in_band(rays->point_z_level_m);
    const FourTruths is_ahead = rays->point_along_m >= none;
    const FourFloats on = away_m < static_cast<float>(EndPlaces::kPlaces * EndPlaces::kPlace_m) ? weights : none;
    const FourFloats goes_on = far ? (in_band ? on : -weights) : none;
    ahead_ += is_ahead ? goes_on : none;
    behind_ += is_ahead ? none : goes_on;
  }

  // True if a tally would find no edge. That takes two things. Fewer points lie past the plane than any edge needs. And
  // at one end at least the plane goes on beyond the places near the sensor. It has so many more points there than rays
  // past it that some place has more than these and than kOnMin.
  bool rules_out_edges(double too_far) const {
    constexpr double kPastMin = EndPlaces::kPastMin;                            // as in EndPlaces
    constexpr double kFarPlaces = EndPlaces::kPlaces - EndPlaces::kNearPlaces;  // places beyond the near ones
    constexpr double kGoesOnMin = kFarPlaces * EndPlaces::kOnMin + kPastMin;  // then some place holds more than kOnMin
    static_assert(kPastMin <= TopPlaces::kOverMin && kPastMin <= DepthsBehind::kPointsMin, "what any edge takes");
    if (!(sum_of_lanes(past_) + too_far < kPastMin)) return false;
    return sum_of_lanes(ahead_) > kGoesOnMin || sum_of_lanes(behind_) > kGoesOnMin;
  }

 private:
  void look_high(FourFloats weights, FourTruths counts, const FourRays& rays) {
    const FourTruths high =
        counts & (rays.z_level_m >= high_level_m_) & (magnitude_of(rays.along_m) <= static_cast<float>(kHighReach_m));
    const FourFloats none{};
    seen_high_ += sum_of_lanes(high ? weights : none);
  }

  const EdgeLimits& limits_;
  float high_level_m_;
  double seen_high_ = 0.0;
  FourFloats past_{}, ahead_{}, behind_{};
};

// Counts the returns at the plane's edges. Rays to the floor right behind the plane pass it too.
class EdgeTally {
 public:
  EdgeTally(const EdgeLimits& limits, EdgeScratch* scratch)
      : limits_(limits), per_height_(static_cast<float>(1.0 / limits.height_m)), scratch_(*scratch) {
    scratch_.ends.clear();
    scratch_.tops.clear();
    scratch_.depths.clear();
  }

  double on_plane() const { return on_plane_; }

  // Distances from the plane of those that count, their weights, and their rays.
  void add(FourFloats r_m, FourFloats weights, FourTruths tells, const FourRays& rays) {
    const FourTruths is_past = r_m < -limits_.margin_m;
    const FourTruths for_tops = tells & (~is_past | (r_m < -limits_.well_behind_m));
    const FourInts top =
        TopPlaces::cells_of(rays.along_m, (rays.z_level_m - limits_.z_min_level_m) * per_height_, is_past);
    const FourTruths on_plane = tells & ~is_past & limits_.in_band(rays.point_z_level_m);
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
  // Past the plane, or on it above and below the band.
  void add_elsewhere(FourFloats r_m, FourFloats weights, FourTruths counts, const FourInts& end, const FourRays& rays) {
    const FourTruths point_in_band = limits_.in_band(rays.point_z_level_m);
    const FourTruths deep = counts & (r_m < -limits_.well_behind_m) & (rays.point_z_level_m >= limits_.z_min_level_m) &
                            (rays.point_z_level_m <= limits_.z_max_level_m + static_cast<float>(kAboveBand_m));
    const FourTruths bends = counts & point_in_band & (r_m > static_cast<float>(-kBend_m));
    const FourFloats none{};
    const FourTruths passes = counts & (r_m < none) & limits_.in_band(rays.z_level_m);
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

  const EdgeLimits& limits_;
  float per_height_;
  EdgeScratch& scratch_;
  double on_plane_ = 0.0;
};

}  // namespace

FourInts EndPlaces::places_of(FourFloats along_m) {
  const FourFloats place = magnitude_of(along_m) * static_cast<float>(1.0 / kPlace_m), none{};
  const FourTruths is_near = place < static_cast<float>(kPlaces), is_ahead = along_m >= none;
  const FourInts begin = is_ahead ? all_four_ints(static_cast<std::int32_t>(kPlaces)) : all_four_ints(0);
  return is_near ? cut_off(is_near ? place : none) + begin : all_four_ints(static_cast<std::int32_t>(kElsewhere));
}

bool EndPlaces::is_looked_past(std::uint32_t begin) const {
  const double *const on = on_ + begin, *const past = past_ + begin, *const just_behind = just_behind_ + begin;
  std::uint32_t beyond = 0;  // the first place behind the last one with points on the plane
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

// True if most points up to two metres behind lie equally far behind, here and there over a wall's length. A niche is
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
  if (!(most >= kPointsMin && most >= kLayerOfPlane * on_plane && most >= kLayerShare * all)) return false;
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

// True if above some height only rays that passed over the plane are seen, wherever the plane is seen below.
bool TopPlaces::is_looked_over() const {
  struct Above {
    double on = 0.0, past = 0.0;
    std::uint32_t first_over = kPlaces, last_over = 0;
  };
  Above above[kSteps];  // index: the lowest step that counts as above
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
      // An opening, or the plane is not seen here.
      if (!(on_below > EndPlaces::kOnMin && on_below > past_below)) continue;
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

WallEdges look_past(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double margin_m,
                    EdgeScratch* scratch) {
  const double inside_m = wall.signed_distance(scene.sensor_level_m);
  if (!(inside_m > 0.0)) return {};
  const EdgeLimits limits(scene, margin_m);
  const Plane wall_base{scene.R_level_base.transpose() * wall.n, wall.d};
  const Slab slab(wall_base, kAnyDepth_m, inside_m);
  const PointSet& points = scene.cloud_base;
  FourRays rays(scene, along_level, inside_m);
  EdgeGlance glance(scene, limits);
  EdgeTally tally(limits, scratch);
  WallEdges out;
  for (const bool at_a_glance : {true, false}) {
    for_each_four_about(scene.cloud_base, slab, [&](std::uint32_t i, FourTruths counts) {
      const FourFloats x = load_four(&points.x[i]), y = load_four(&points.y[i]), z = load_four(&points.z[i]);
      const FourFloats r = slab.distances().of(x, y, z);
      // Rays away from the plane do not count, and those that end before it only show how high the sensor looks.
      const double limit_m = glance.has_seen_high() && margin_m <= inside_m ? margin_m : inside_m;
      const FourTruths tells = counts & (r < static_cast<float>(limit_m));
      if (!any_of(tells)) return;
      const FourFloats weights = load_four(&points.weight[i]);
      rays.go_to(x, y, z);
      if (at_a_glance) {
        glance.add(r, weights, tells, &rays);
      } else {
        rays.cross_at(r);
        tally.add(r, weights, tells & (r <= limits.margin_m), rays);
      }
    });
    if (!at_a_glance) break;
    out.top_unseen = !glance.has_seen_high();
    const SightLines lines(scene, wall, along_level);
    if (glance.rules_out_edges(add_what_is_too_far(scene, lines, limits.height_m, &scratch->tops))) return out;
  }
  out.island = scratch->ends.both_are_looked_past();
  out.low = scratch->tops.is_looked_over();
  out.layer_behind = scratch->depths.hold_a_layer(tally.on_plane());
  return out;
}

}  // namespace pose_wall
