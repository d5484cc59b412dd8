// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Which of a few returns are a thing's, and which are dust's.

#include <cmath>

#include "planar/stop/places.hpp"

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kFew = 3;  // returns that dust brings to a cell of the sight
// Of dust: the sweep's thousand places and an hour's 36,000 frames.
constexpr float kOnceAnHour = 1.0F / (1000.0F * 36000.0F);

// Returns of a frame around a place: less than the smallest thing brings from 6 m, by a VLP-16's one ring. It brings
// more from nearer, at least as it is wider there.
constexpr std::uint32_t kWide = 4;
constexpr float kWideFrom_m = 6.0F, kNearest_m = 0.1F;  // nearer, counts of 255 would not hold them
float wide_at(float x, float y) {
  const float range_m = std::sqrt(x * x + y * y);
  if (range_m >= kWideFrom_m) return static_cast<float>(kWide);
  return static_cast<float>(kWide) * kWideFrom_m / (range_m > kNearest_m ? range_m : kNearest_m);
}
constexpr float kFactorialOfWide = 24.0F;  // of the distribution's term

}  // namespace

// Whether rays went through every smallest thing that could have returned there: then it is dust, or thinner than what
// is found for certain. Where no ray of the frame comes so low, or so high, what was seen before counts.
bool Places::is_gone_through(const Sight& sight, const Way& way, const Turn2& turn, const Eigen::Vector2d& origin_m,
                             float x, float y, std::uint32_t now_ms) const {
  const float range_m = std::sqrt(x * x + y * y);
  const float ux = x / range_m, uy = y / range_m;
  // Middles of things that touch the place: round ones from beside it to behind it, and corners of square ones.
  const auto is_near_in_memory = [&](std::uint32_t when_ms) {
    return is_remembered(when_ms, way, now_ms) && way.error_m(when_ms) <= protection_m_;  // else it is of a neighbour
  };
  constexpr float kHalf = 0.70711F;    // sine of 45 degrees
  constexpr float kInFront_m = 0.05F;  // with what seen() looks to each side, within the smallest thing
  constexpr FourFloats kBehind[2] = {{0.0F, kHalf, kHalf, 0.0F}, {1.0F, 1.0F, 1.0F, kHalf}};
  constexpr FourFloats kAside[2] = {{-1.0F, -kHalf, kHalf, 1.0F}, {0.0F, -1.0F, 1.0F, 0.0F}};
  for (int k = 0; k < 2; ++k) {
    const FourFloats behind = kBehind[k] * thing_half_m_, aside = kAside[k] * thing_half_m_;
    const FourFloats px = x + behind * ux - aside * uy, py = y + behind * uy + aside * ux;
    // A ray that is low in front of the middle would have hit the thing as well.
    const FourInts seen = sight.seen(px, py) | sight.seen(px - kInFront_m * ux, py - kInFront_m * uy);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const auto unseen = static_cast<std::uint32_t>(~seen[lane] & Sight::kAll);
      if (unseen == 0) continue;
      if (((Sight::kTall | sight.could_see(px[lane], py[lane])) & unseen) != 0) return false;
      const Eigen::Vector2d at =
          turn * Eigen::Vector2d(static_cast<double>(px[lane]), static_cast<double>(py[lane])) + origin_m;
      const Place* const place = known_at(place_of(at.x()), place_of(at.y()));
      if (place == nullptr) return false;
      if ((unseen & Sight::kLow) != 0 && !is_near_in_memory(place->low_ms)) return false;
      if ((unseen & Sight::kTop) != 0 && !is_near_in_memory(place->top_ms)) return false;
    }
  }
  return true;
}

// A few low or high returns are a thing's at once where others of the frame are around them, for the smallest thing is
// as wide as all places around. Else they are once others were there for two thirds of the delay: with a frame's period
// of a third, before the delay has passed.
Places::Around Places::look_around(Place* place, const Sight::Return& hit, std::uint32_t now_ms) {
  constexpr std::uint32_t kMost = 255;  // what the counts hold
  const int kind = hit.is_high ? 1 : 0;
  std::uint32_t first_ms = now_ms, in_frame = hit.returns, in_delay = hit.returns;
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const near = known_at(place->ix + dx, place->iy + dy);
      if (near == nullptr || near->doubt_ms == 0 || now_ms - near->doubt_ms > delay_ms_) continue;
      if (near->doubt_first_ms < first_ms) first_ms = near->doubt_first_ms;
      if (near->doubt_ms == now_ms) in_frame += near->doubts_in_frame[kind];
      in_delay += near->doubts[kind];
    }
  }
  const bool goes_on = place->doubt_ms != 0 && now_ms - place->doubt_ms <= delay_ms_;
  for (int k = 0; k < 2; ++k) {
    if (!goes_on) place->doubts[k] = 0;
    if (place->doubt_ms != now_ms) place->doubts_in_frame[k] = 0;
  }
  const auto add = [&](std::uint8_t* count) {
    const std::uint32_t sum = *count + hit.returns;
    *count = static_cast<std::uint8_t>(sum < kMost ? sum : kMost);
  };
  add(&place->doubts_in_frame[kind]);
  add(&place->doubts[kind]);
  place->doubt_first_ms = first_ms;
  place->doubt_ms = now_ms;
  const float wide = wide_at(hit.x, hit.y);
  return {static_cast<float>(in_frame) >= wide,
          3 * (now_ms - first_ms) >= 2 * delay_ms_ && static_cast<float>(in_delay) >= wide};
}

// A thin thing returns in frame after frame, a grain of dust once. Of dust as thick as around the place, so many frames
// in turn would have a return here once in an hour, somewhere in the way. by_chance: that one frame has one.
bool Places::is_thin_thing(Place* place, float by_chance, std::uint32_t now_ms) {
  std::uint32_t run = 0;
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const near = known_at(place->ix + dx, place->iy + dy);
      if (near == nullptr || near->dust_ms == 0) continue;
      if (near->dust_ms == last_ms_ && near->dust_run > run) run = near->dust_run;
      if (near->dust_ms == now_ms && near->dust_run > run + 1U) run = near->dust_run - 1U;
    }
  }
  constexpr std::uint32_t kRunMost = 255;  // what the count holds
  if (run < kRunMost) ++run;
  place->dust_ms = now_ms;
  place->dust_run = static_cast<std::uint8_t>(run);
  float all_by_chance = 1.0F;
  for (std::uint32_t k = 0; k < run; ++k) all_by_chance *= by_chance;
  return all_by_chance <= kOnceAnHour;
}

// Whether a return is not believed yet: it is one of a few, and they are dust or may be.
bool Places::brings_doubt_only(const Sight& sight, const Way& way, const Turn2& turn, const Eigen::Vector2d& origin_m,
                               const Sight::Return& hit, Place* place, std::uint32_t now_ms) {
  if (hit.returns > kFew) return false;
  const bool is_gone = is_gone_through(sight, way, turn, origin_m, hit.x, hit.y, now_ms);
  const Around around = look_around(place, hit, now_ms);
  if (!is_gone) return !(around.is_wide || around.is_lasting);
  if (place->dust_ms != now_ms) dust_.add(place->ix, place->iy);
  // Four returns at once come by chance, too, in dust: those of a Poisson process. Near the sensor it takes more of
  // them.
  const float by_chance = dust_.share_around(place->ix, place->iy);
  const bool is_no_chance = by_chance * by_chance * by_chance * by_chance <= kFactorialOfWide * kOnceAnHour;
  return !(is_thin_thing(place, by_chance, now_ms) || (around.is_wide && is_no_chance));
}

}  // namespace pose_wall::planar
