// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/doubts/edge_places.hpp"

#include "base/math/bits.hpp"

namespace pose_wall {
namespace {

constexpr double kPlace_m = EndPlaces::kPlace_m;
// So many points just behind the plane, within so many places of its end, are its own bend.
constexpr std::uint32_t kBendPlaces = 4;
constexpr double kBendMin = 4.0;
// What comes over the top is so many times that of the plane at such heights, and from places so far apart: a hollow at
// the shoulder, where roof has come down, is looked into at one place.
constexpr double kOverRatio = 3.0;
constexpr double kOverSpan_m = 1.5;

// What lies behind, by decimetres.
constexpr double kDepth_m = 0.1;
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
      // An opening, or nothing is seen of it here.
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

}  // namespace pose_wall
