// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/sight.hpp"

#include <cmath>
#include <cstring>

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kRingCells = kRings * kAzimuths;  // of one kind
constexpr std::uint32_t kCounts = kRingCells + kAzimuths; // a ring behind the last: where passes end
constexpr float kBefore_m = 0.2F;       // a ray that ends on a thing shows nothing so shortly before it
constexpr float kHeightNoise_m = 0.02F; // of a ray, from its range and the floor's plane
constexpr float kPlaceHalf_m = 0.0707F; // half the diagonal of a place of 0.1 m
constexpr std::uint32_t kSides = 24;    // azimuths to each side at most, near the sensor
// Doubtful: so many rays pass for each that returns, and it is a few.
constexpr std::uint32_t kPassesEach = 4, kReturnsFew = 3;
constexpr std::uint8_t kFull = 255;     // counts of returns stay there

}  // namespace

void Sight::lay_out(Arena& arena) {
  low_ = arena.take<std::uint16_t>(kCounts);
  tall_ = arena.take<std::uint16_t>(kCounts);
  high_ = arena.take<std::uint16_t>(kCounts);
  low_return_ = arena.take<std::uint8_t>(kRingCells);
  high_return_ = arena.take<std::uint8_t>(kRingCells);
  seen_ = arena.take<std::uint8_t>(kRingCells);
}

void Sight::open(const StopSettings& settings, const Mount& mount) {
  mount_ = mount;
  band_m_ = static_cast<float>(settings.floor_band_m);
  thing_m_ = static_cast<float>(settings.thing_height_m);
  tall_m_ = static_cast<float>(settings.tall_m);
  top_m_ = static_cast<float>(settings.top_m);
  kink_ = static_cast<float>(settings.kink_max_rad);
  half_width_m_ = static_cast<float>(0.5 * settings.thing_width_m) - kPlaceHalf_m;
  for (std::uint32_t a = 0; a < kAzimuths; ++a) {
    // Along the diamond |x| + |y| = 1, counted from (0, -1) to the left.
    const float p = (static_cast<float>(a) + 0.5F) * (4.0F / kAzimuths);
    const float x = p < 1.0F ? p : p < 3.0F ? 2.0F - p : p - 4.0F;
    const float y = p < 2.0F ? p - 1.0F : 3.0F - p;
    const float length = std::sqrt(x * x + y * y);
    direction_x_[a] = x / length, direction_y_[a] = y / length;
  }
}

void Sight::clear() {
  low_.fill(0), tall_.fill(0), high_.fill(0);
  low_return_.fill(0), high_return_.fill(0);
}

std::uint32_t Sight::azimuth_of(float x, float y) {
  const float sum = std::fabs(x) + std::fabs(y);
  const float t = sum > 0.0F ? y / sum : 0.0F;
  const float p = x >= 0.0F ? 1.0F + t : 3.0F - t;
  return static_cast<std::uint32_t>(p * (kAzimuths / 4.0F)) & (kAzimuths - 1U);
}

// One ray's count in the rings whose middles lie between two distances: it begins in one and ends in another.
void Sight::pass(std::uint16_t* counts, float from_m, float to_m) {
  constexpr float kMost_m = kRings * kRing_m;  // the last ring's end
  if (!(from_m < to_m && from_m < kMost_m)) return;
  const float last = (to_m < kMost_m ? to_m : kMost_m) / kRing_m + 0.5F;
  const auto first = static_cast<std::uint32_t>(from_m / kRing_m + 0.5F), end = static_cast<std::uint32_t>(last);
  if (first >= end) return;
  ++counts[first * kAzimuths];
  --counts[(end < kRings ? end : kRings) * kAzimuths];
}

// Where a ray from the sensor is in each band of heights. Heights fall or rise in a straight line.
void Sight::put_passes(std::uint32_t azimuth, float height_m, float range_m) {
  const float fall = (sensor_height_m_ - height_m) / range_m, H = sensor_height_m_;
  const float end_m = height_m > band_m_ ? range_m - kBefore_m : range_m;
  const float low_m = band_m_ + kHeightNoise_m, thing_m = thing_m_ - kHeightNoise_m;
  constexpr float kLevel = 1e-4F;  // falls or rises less than a millimetre within reach
  const auto at = [&](float level_m) { return (H - level_m) / fall; };
  if (fall > kLevel) {
    const float at_low_m = at(low_m), to_m = at_low_m < end_m ? at_low_m : end_m;
    const float at_thing_m = at(thing_m), at_tall_m = H > tall_m_ ? at(tall_m_) : 0.0F;
    pass(low_.data() + azimuth, at_thing_m > 0.0F ? at_thing_m : 0.0F, to_m);
    pass(tall_.data() + azimuth, at_tall_m, to_m);
    pass(high_.data() + azimuth, H > top_m_ ? at(top_m_) : 0.0F, at_thing_m < end_m ? at_thing_m : end_m);
    return;
  }
  if (!(H > low_m && H < top_m_)) return;
  const float rise_to_top_m = fall < -kLevel ? at(top_m_) : end_m, rise_to_tall_m = fall < -kLevel ? at(tall_m_) : end_m;
  const float rise_to_thing_m = fall < -kLevel ? at(thing_m) : end_m;
  if (H < thing_m) pass(low_.data() + azimuth, 0.0F, rise_to_thing_m < end_m ? rise_to_thing_m : end_m);
  if (H < tall_m_) pass(tall_.data() + azimuth, 0.0F, rise_to_tall_m < end_m ? rise_to_tall_m : end_m);
  pass(high_.data() + azimuth, 0.0F, rise_to_top_m < end_m ? rise_to_top_m : end_m);
}

void Sight::put(float x, float y, float height_m, float range_m) {
  const std::uint32_t azimuth = azimuth_of(x, y);
  put_passes(azimuth, height_m, range_m);
  if (!(height_m > band_m_ && height_m < top_m_ && range_m < kRings * kRing_m)) return;
  const auto ring = static_cast<std::uint32_t>(range_m / kRing_m);
  std::uint8_t& count = (height_m < thing_m_ ? low_return_ : high_return_)[ring * kAzimuths + azimuth];
  if (count < kFull) ++count;
}

std::uint32_t Sight::look(const Rays& rays, const Ground& ground) {
  clear();
  const float a = static_cast<float>(ground.slope_x), b = static_cast<float>(ground.slope_y);
  const Eigen::Vector3d& s = mount_.sensor_base_m;
  sensor_height_m_ =
      static_cast<float>(s.z() - ground.height_m - ground.slope_x * s.x() - ground.slope_y * s.y());
  const float H = sensor_height_m_, room_m = top_m_ - H, below_m = -band_m_;
  // Where no floor is seen it may be lower or higher than the plane: only near places can then be seen low.
  reach_m_ = ground.seen ? kRings * kRing_m : 0.5F * (thing_m_ - band_m_) / kink_ + 0.5F;
  const float widest_m = half_width_m_ / static_cast<float>(kAzimuthMost_rad);
  seen_most_m_ = (reach_m_ < widest_m ? reach_m_ : widest_m) + kRing_m;
  std::uint32_t used = 0;
  constexpr float kNearest_m = 0.05F;  // straight below the sensor there is no azimuth
  rays.each_four([&](const FourPlaces& p, FourTruths those) {
    const FourFloats height = H + p.z - a * p.x - b * p.y, range = root_of(p.x * p.x + p.y * p.y);
    used += sum_of_lanes(-those);
    // Below the floor: a mirror image, of which the way is unknown. Upwards and out of the machine's height: no use.
    those &= (height >= below_m) & (range > kNearest_m) & ((height < H) | (height - H <= room_m * range));
    if (!any_of(those)) return;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (those[lane] != 0) put(p.x[lane], p.y[lane], height[lane], range[lane]);
    }
  });
  add_up();
  widen();
  return used;
}

void Sight::add_up() {
  std::uint16_t* const counts[] = {low_.data(), tall_.data(), high_.data()};
  for (std::uint16_t* const count : counts) {
    for (std::uint32_t k = kAzimuths; k < kRingCells; ++k) {
      count[k] = static_cast<std::uint16_t>(count[k] + count[k - kAzimuths]);
    }
  }
}

// A place is seen where any azimuth lets a ray pass that lies within the smallest thing, were it there.
void Sight::widen() {
  std::uint8_t row[kAzimuths + 2 * kSides];
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    const std::uint16_t *low = low_.data() + ring * kAzimuths, *tall = tall_.data() + ring * kAzimuths;
    std::uint8_t* const out = seen_.data() + ring * kAzimuths;
    const float r_m = (static_cast<float>(ring) + 0.5F) * kRing_m;
    const float steps = half_width_m_ / (r_m * static_cast<float>(kAzimuthMost_rad));
    if (!(steps >= 1.0F) || r_m > reach_m_) {
      std::memset(out, 0, kAzimuths);
      continue;
    }
    for (std::uint32_t a = 0; a < kAzimuths; ++a) {
      row[kSides + a] = static_cast<std::uint8_t>((low[a] != 0 ? kLow : 0) | ((low[a] | tall[a]) != 0 ? kTall : 0));
    }
    std::memcpy(row, row + kAzimuths, kSides);
    std::memcpy(row + kSides + kAzimuths, row + kSides, kSides);
    const auto whole = static_cast<std::uint32_t>(steps) - 1U;
    const std::uint32_t sides = whole < kSides ? whole : kSides;
    std::memcpy(out, row + kSides - sides, kAzimuths);
    for (std::uint32_t side = kSides - sides + 1; side <= kSides + sides; ++side) {
      for (std::uint32_t a = 0; a < kAzimuths; ++a) out[a] = static_cast<std::uint8_t>(out[a] | row[side + a]);
    }
  }
}

std::uint8_t Sight::seen(float x, float y) const {
  const float r_m = std::sqrt(x * x + y * y), half_m = half_width_m_;
  const auto first = static_cast<std::uint32_t>((r_m > half_m ? r_m - half_m : 0.0F) / kRing_m + 0.5F);
  const auto end = static_cast<std::uint32_t>((r_m + half_m) / kRing_m + 0.5F);
  const std::uint32_t azimuth = azimuth_of(x, y);
  std::uint8_t seen = 0;
  for (std::uint32_t ring = first; ring < end && ring < kRings; ++ring) {
    seen = static_cast<std::uint8_t>(seen | seen_[ring * kAzimuths + azimuth]);
  }
  return seen;
}

bool Sight::passed_high(float x, float y) const {
  const auto ring = static_cast<std::uint32_t>(std::sqrt(x * x + y * y) / kRing_m);
  return ring < kRings && high_[ring * kAzimuths + azimuth_of(x, y)] != 0;
}

Sight::Return Sight::returned(std::uint32_t ring, std::uint32_t azimuth, bool is_high, std::uint8_t count,
                              std::uint16_t passes) const {
  const float r_m = (static_cast<float>(ring) + 0.5F) * kRing_m;
  return {r_m * direction_x_[azimuth], r_m * direction_y_[azimuth], is_high,
          count <= kReturnsFew && passes >= kPassesEach * count};
}

}  // namespace pose_wall::planar
