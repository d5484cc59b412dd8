// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/sight.hpp"

#include <cmath>
#include <cstring>

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kRingCells = kRings * kAzimuths;  // of one kind
constexpr std::uint32_t kCounts = (kRings + 1) * kRow;    // a ring behind the last: where passes end
constexpr float kBefore_m = 0.2F;        // a ray that ends on a thing shows nothing so shortly before it
constexpr float kHeightNoise_m = 0.02F;  // of a ray, from its range and the floor's plane
constexpr float kLevel = 1e-4F;          // a slope: less than a millimetre within reach
constexpr float kPlaceHalf_m = 0.0707F;  // half the diagonal of a place of 0.1 m
constexpr std::uint32_t kSides = 24;     // azimuths to each side at most, near the sensor
// Doubtful: so many rays pass for each that returns, and it is a few.
constexpr std::uint32_t kPassesEach = 4, kReturnsFew = 3;
// One ray in the counts of a word, and their bits; as Sight has their shifts.
constexpr std::uint64_t kLowOne = 1ULL, kTallOne = 1ULL << 16U, kHighOne = 1ULL << 32U, kTopOne = 1ULL << 48U;
// And the bits of these counts:
constexpr std::uint64_t kLowMask = 0xFFFFULL, kTallMask = kLowMask << 16U, kTopMask = kLowMask << 48U;
constexpr std::uint8_t kFull = 255;  // counts of returns stay there

}  // namespace

void Sight::lay_out(Arena& arena) {
  passes_ = arena.take<std::uint64_t>(kCounts);
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
  hang_m_ = top_m_ - thing_m_ + kHeightNoise_m;
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
  passes_.fill(0);
  low_return_.fill(0), high_return_.fill(0);
}

std::uint32_t Sight::azimuth_of(float x, float y) {
  const float sum = std::fabs(x) + std::fabs(y);
  const float t = sum > 0.0F ? y / sum : 0.0F;
  const float p = x >= 0.0F ? 1.0F + t : 3.0F - t;
  return static_cast<std::uint32_t>(p * (kAzimuths / 4.0F)) & (kAzimuths - 1U);
}

// The first ring whose middle lies at this distance or behind it, kRings at most.
FourInts ring_from(FourFloats distance_m) {
  const FourFloats last = all_four(static_cast<float>(kRings));
  const FourFloats ring = distance_m * (1.0F / kRing_m) + 0.5F;
  return cut_off(smaller_of(larger_of(ring, all_four(0.0F)), last));
}

FourInts azimuths_of(const FourPlaces& p) {
  const FourFloats t = p.y / (magnitude_of(p.x) + magnitude_of(p.y));
  const FourFloats at = p.x >= all_four(0.0F) ? 1.0F + t : 3.0F - t;
  return cut_off(at * (kAzimuths / 4.0F)) & static_cast<std::int32_t>(kAzimuths - 1);
}

// Where rays that fall are in each band of heights: heights are straight lines from the sensor to the return.
void Sight::put_falling(FourInts azimuth, FourFloats height_m, FourFloats range_m, FourTruths those) {
  const float H = sensor_height_m_;
  const FourFloats per_m = range_m / (H - height_m);
  const FourFloats end_m = height_m > all_four(band_m_) ? range_m - kBefore_m : range_m;
  const auto from = [&](float level_m) { return ring_from(smaller_of((H - level_m) * per_m, end_m)); };
  const FourInts top = from(top_m_), tall = from(tall_m_), thing = from(thing_m_ - kHeightNoise_m);
  const FourInts low = from(band_m_ + kHeightNoise_m), hang = from(hang_m_);
  those &= top < low;
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if (those[lane] == 0) continue;
    std::uint64_t* const cells = passes_.data() + azimuth[lane];
    cells[static_cast<std::uint32_t>(top[lane]) * kRow] += kHighOne + kTopOne;
    cells[static_cast<std::uint32_t>(hang[lane]) * kRow] -= kTopOne;
    cells[static_cast<std::uint32_t>(tall[lane]) * kRow] += kTallOne;
    cells[static_cast<std::uint32_t>(thing[lane]) * kRow] += kLowOne - kHighOne;
    cells[static_cast<std::uint32_t>(low[lane]) * kRow] -= kLowOne + kTallOne;
  }
}

// The same for rays that rise or are level; they are in the machine's height from the sensor on.
void Sight::put_level(FourInts azimuth, FourFloats height_m, FourFloats range_m, FourTruths those) {
  const float H = sensor_height_m_, thing_m = thing_m_ - kHeightNoise_m;
  if (!(H > band_m_ + kHeightNoise_m && H < top_m_) || !any_of(those)) return;
  const FourFloats least = kLevel * range_m, rise = height_m - H, per_m = range_m / (rise > least ? rise : least);
  const FourFloats end_m = height_m > all_four(band_m_) ? range_m - kBefore_m : range_m;
  const auto until = [&](float level_m) { return ring_from(smaller_of((level_m - H) * per_m, end_m)); };
  const FourInts top = until(top_m_), tall = until(tall_m_), thing = until(thing_m);
  const FourInts hang = H < hang_m_ ? until(hang_m_) : all_four_ints(0);
  const std::uint64_t tall_one = H < tall_m_ ? kTallOne : 0U, low_one = H < thing_m ? kLowOne : 0U;
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if (those[lane] == 0) continue;
    std::uint64_t* const cells = passes_.data() + azimuth[lane];
    cells[0] += kHighOne + tall_one + low_one;
    cells[static_cast<std::uint32_t>(hang[lane]) * kRow] += kTopOne;
    cells[static_cast<std::uint32_t>(top[lane]) * kRow] -= kHighOne + kTopOne;
    if (tall_one != 0) cells[static_cast<std::uint32_t>(tall[lane]) * kRow] -= tall_one;
    if (low_one != 0) cells[static_cast<std::uint32_t>(thing[lane]) * kRow] -= low_one;
  }
}

void Sight::put_returns(FourInts azimuth, FourFloats height_m, FourFloats range_m, FourTruths those) {
  those &= (height_m > all_four(band_m_)) & (height_m < all_four(top_m_)) & (range_m < all_four(kRings * kRing_m));
  if (!any_of(those)) return;
  const FourInts ring = cut_off(range_m * (1.0F / kRing_m));
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if (those[lane] == 0) continue;
    const std::uint32_t at = static_cast<std::uint32_t>(ring[lane]);
    const std::uint32_t cell = (at < kRings ? at : kRings - 1) * kAzimuths + static_cast<std::uint32_t>(azimuth[lane]);
    std::uint8_t& count = (height_m[lane] < thing_m_ ? low_return_ : high_return_)[cell];
    if (count < kFull) ++count;
  }
}

void Sight::put(const FourPlaces& p, FourFloats height_m, FourFloats range_m, FourTruths those) {
  const FourInts azimuth = azimuths_of(p);
  const FourTruths falls = sensor_height_m_ - height_m > kLevel * range_m;
  put_falling(azimuth, height_m, range_m, those & falls);
  put_level(azimuth, height_m, range_m, those & ~falls);
  put_returns(azimuth, height_m, range_m, those);
}

std::uint32_t Sight::look(const Rays& rays, const Ground& ground) {
  clear();
  const float a = static_cast<float>(ground.slope_x), b = static_cast<float>(ground.slope_y);
  const Eigen::Vector3d& s = mount_.sensor_base_m;
  sensor_height_m_ = static_cast<float>(s.z() - ground.height_m - ground.slope_x * s.x() - ground.slope_y * s.y());
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
    if (any_of(those)) put(p, height, range, those);
  });
  add_up();
  widen();
  return used;
}

void Sight::add_up() {
  std::uint64_t* const cells = passes_.data();
  for (std::uint32_t k = kRow; k < kCounts; ++k) cells[k] += cells[k - kRow];
}

// A place is seen where any azimuth lets a ray pass that lies within the smallest thing, were it there.
void Sight::widen() {
  std::uint8_t row[kAzimuths + 2 * kSides];
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    const std::uint64_t* const passes = passes_.data() + ring * kRow;
    std::uint8_t* const out = seen_.data() + ring * kAzimuths;
    const float r_m = (static_cast<float>(ring) + 0.5F) * kRing_m;
    const float steps = half_width_m_ / (r_m * static_cast<float>(kAzimuthMost_rad));
    if (!(steps >= 1.0F) || r_m > reach_m_) {
      std::memset(out, 0, kAzimuths);
      continue;
    }
    for (std::uint32_t a = 0; a < kAzimuths; ++a) {
      const bool is_low = (passes[a] & kLowMask) != 0, is_tall = (passes[a] & (kLowMask | kTallMask)) != 0;
      const bool is_top = (passes[a] & kTopMask) != 0;
      row[kSides + a] = static_cast<std::uint8_t>((is_low ? kLow : 0) | (is_tall ? kTall : 0) | (is_top ? kTop : 0));
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
  return ring < kRings && count_of(ring * kRow + azimuth_of(x, y), kHighShift) != 0;
}

Sight::Return Sight::returned(std::uint32_t ring, std::uint32_t azimuth, bool is_high, std::uint8_t count,
                              std::uint32_t passes) const {
  const float r_m = (static_cast<float>(ring) + 0.5F) * kRing_m;
  return {r_m * direction_x_[azimuth], r_m * direction_y_[azimuth], is_high,
          count <= kReturnsFew && passes >= kPassesEach * count};
}

}  // namespace pose_wall::planar
