// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/sight.hpp"

#include <cmath>
#include <cstring>

namespace pose_wall::planar {
namespace {

constexpr std::uint32_t kRingCells = kRings * kAzimuths;  // of one kind
constexpr std::uint32_t kCounts = (kRings + 1) * kRow;    // a ring behind the last: where passes end
constexpr float kReach_m = kRings * kRing_m;              // where the last ring ends
constexpr float kBefore_m = 0.2F;               // a ray that ends on a thing shows nothing so shortly before it
constexpr float kHeightNoise_m = 0.02F;         // of a ray, from its range and the floor's plane
constexpr float kLevel = 1e-4F;                 // a slope: less than a millimetre within reach
constexpr float kPlaceHalf_m = 0.0707F;         // half the diagonal of a place of 0.1 m
constexpr std::uint32_t kEdge = kAzimuths / 4;  // steps of one edge of the diamond
constexpr std::uint32_t kSides = 24;            // azimuths to each side at most, near the sensor
// One ray in the counts of a word, and their bits; as Sight has their shifts.
constexpr std::uint64_t kLowOne = 1ULL, kTallOne = 1ULL << 16U, kHighOne = 1ULL << 32U, kTopOne = 1ULL << 48U;
// Steps of a diamond's edge are twice as wide in the middle as at its corners. This much of a parabola on each half of
// the edge makes them even to 4 %: the usual short form of the arc tangent, 0.273 * 4 / pi.
constexpr float kBend = 0.3476F;

}  // namespace

void Sight::lay_out(Arena& arena) {
  passes_ = arena.take<std::uint64_t>(kCounts);
  returns_ = arena.take<std::uint8_t>(2 * kRingCells);
  heights_ = arena.take<std::uint16_t>(kRingCells);
  seen_ = arena.take<std::uint8_t>(kRingCells);
  steepest_fall_ = arena.take<float>(kAzimuths / kSliceAzimuths);
  steepest_rise_ = arena.take<float>(kAzimuths / kSliceAzimuths);
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
    // Along the diamond |x| + |y| = 1, counted from (0, -1) to the left: first without the bend.
    const float edge = (static_cast<float>(a % kEdge) + 0.5F) * (2.0F / kEdge) - 1.0F;
    const float away =
        (1.0F + kBend - std::sqrt((1.0F + kBend) * (1.0F + kBend) - 4.0F * kBend * std::fabs(edge))) / (2.0F * kBend);
    const float p = static_cast<float>(a / kEdge) + 0.5F + (edge < 0.0F ? -0.5F : 0.5F) * away;
    const float x = p < 1.0F ? p : p < 3.0F ? 2.0F - p : p - 4.0F;
    const float y = p < 2.0F ? p - 1.0F : 3.0F - p;
    const float length = std::sqrt(x * x + y * y);
    direction_x_[a] = x / length, direction_y_[a] = y / length;
  }
}

void Sight::clear() {
  passes_.fill(0);
  returns_.fill(0);
  steepest_fall_.fill(0.0F);
  steepest_rise_.fill(0.0F);
}

FourInts azimuths_of(FourFloats x, FourFloats y) {
  constexpr float kNotZero = 1e-20F;  // m: where there is no direction
  const FourFloats t = y / larger_of(magnitude_of(x) + magnitude_of(y), all_four(kNotZero));
  const FourFloats across = 2.0F * magnitude_of(t) - 1.0F, bend = 0.5F * kBend * across * (1.0F - magnitude_of(across));
  const FourFloats at = 2.0F - signed_by(1.0F - (t + signed_by(bend, t)), x);
  return cut_off(at * (kAzimuths / 4.0F)) & static_cast<std::int32_t>(kAzimuths - 1);
}

std::uint32_t Sight::azimuth_of(float x, float y) {
  return static_cast<std::uint32_t>(azimuths_of(all_four(x), all_four(y))[0]);
}

// The first ring whose middle lies at this distance, in rings, or behind it.
FourInts ring_from(FourFloats rings) {
  return cut_off(rings + 0.5F);
}

using Words = std::uint32_t[kFour];

// The word of a ring in each lane's azimuth. Shifts: there is no product of four integers in SSE2.
FourInts word_of(FourInts ring, FourInts azimuth) {
  static_assert(kRow == (1U << 9U) + (1U << 3U), "a product of kRow");
  return (ring << 9) + (ring << 3) + azimuth;
}

// Where rays that fall are in each band of heights: heights are straight lines from the sensor to the return. Rings per
// metre of height, and where the ray ends, in rings.
void Sight::put_falling(FourInts azimuth, FourFloats per_m, FourFloats end, FourTruths those) {
  const auto from = [&](float fall_m) { return word_of(ring_from(smaller_of(fall_m * per_m, end)), azimuth); };
  // A sensor in the machine's height sees from its own place on.
  const FourInts top = fall_.top_m > 0.0F ? from(fall_.top_m) : azimuth, low = from(fall_.low_m);
  const std::uint32_t lanes = bits_of(those & (top < low));
  Words at[4];
  store_four(top, at[0]), store_four(from(fall_.tall_m), at[1]);
  store_four(from(fall_.thing_m), at[2]), store_four(low, at[3]);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if ((lanes >> lane & 1U) == 0) continue;
    passes_[at[0][lane]] += kHighOne;
    passes_[at[1][lane]] += kTallOne;
    passes_[at[2][lane]] += kLowOne - kHighOne;
    passes_[at[3][lane]] -= kLowOne + kTallOne;
  }
  if (!(fall_.hang_m > 0.0F)) return;  // the sensor is below all that hangs
  store_four(from(fall_.hang_m), at[1]);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if ((lanes >> lane & 1U) == 0) continue;
    passes_[at[0][lane]] += kTopOne;
    passes_[at[1][lane]] -= kTopOne;
  }
}

// The same for rays that rise or are level; they are in the machine's height from the sensor on.
void Sight::put_level(FourInts azimuth, FourFloats per_m, FourFloats end, FourTruths those) {
  const auto until = [&](float rise_m) { return word_of(ring_from(smaller_of(rise_m * per_m, end)), azimuth); };
  const std::uint32_t lanes = bits_of(those);
  Words at[5];
  store_four(azimuth, at[0]), store_four(until(rise_.hang_m), at[1]), store_four(until(rise_.top_m), at[2]);
  store_four(until(rise_.tall_m), at[3]), store_four(until(rise_.thing_m), at[4]);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if ((lanes >> lane & 1U) == 0) continue;
    passes_[at[0][lane]] += kHighOne + kTallOne + kLowOne;
    passes_[at[1][lane]] += kTopOne;
    passes_[at[2][lane]] -= kHighOne + kTopOne;
    passes_[at[3][lane]] -= kTallOne;
    passes_[at[4][lane]] -= kLowOne;
  }
}

void Sight::put_returns(FourInts azimuth, FourFloats fall_m, FourFloats range_m, FourTruths those) {
  those &= (fall_m < all_four(band_fall_m_)) & (fall_m > all_four(top_fall_m_)) & (range_m < all_four(kReach_m));
  const std::uint32_t lanes = bits_of(those);
  if (lanes == 0) return;
  constexpr float kEighths = 8.0F / kRing_m;  // of a ring, to a metre
  const FourInts eighths = cut_off(smaller_of(range_m * kEighths, all_four(8.0F * kRings - 1.0F)));
  const FourInts high = (fall_m <= all_four(thing_fall_m_)) & static_cast<std::int32_t>(kRingCells);
  static_assert(kAzimuths == 1U << 9U, "a shift of the ring");
  const FourInts steps = cut_off((sensor_height_m_ - fall_m) * (1.0F / kHeightStep_m));
  Words cell, inside, height;
  store_four(((eighths >> 3) << 9) + azimuth + high, cell);
  store_four((eighths & 7) << kCountBits, inside);
  store_four(steps, height);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if ((lanes >> lane & 1U) == 0) continue;
    std::uint8_t& word = returns_[cell[lane]];
    const std::uint32_t count = word & kCountMost;
    word = static_cast<std::uint8_t>(inside[lane] | (count < kCountMost ? count + 1 : count));
    if (cell[lane] < kRingCells || count == kCountMost) continue;
    std::uint16_t& sum = heights_[cell[lane] - kRingCells];
    sum = static_cast<std::uint16_t>((count == 0 ? 0U : sum) + height[lane]);
  }
}

// Where rays go, whatever stops them.
void Sight::put_slopes(FourInts azimuth, FourFloats fall_m, FourFloats range_m, FourTruths those) {
  const FourFloats slope = fall_m / range_m;
  const std::uint32_t lanes = bits_of(those);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if ((lanes >> lane & 1U) == 0) continue;
    const auto a = static_cast<std::uint32_t>(azimuth[lane]) / kSliceAzimuths;
    if (slope[lane] > steepest_fall_[a]) steepest_fall_[a] = slope[lane];
    if (-slope[lane] > steepest_rise_[a]) steepest_rise_[a] = -slope[lane];
  }
}

void Sight::put(FourInts azimuth, FourFloats fall_m, FourFloats range_m, FourTruths those) {
  const FourFloats level_m = kLevel * range_m, rings = range_m * (1.0F / kRing_m);
  const FourTruths falls = fall_m > level_m;
  const FourFloats per_m = rings / larger_of(magnitude_of(fall_m), level_m);
  const FourFloats before = fall_m < all_four(band_fall_m_) ? all_four(kBefore_m / kRing_m) : all_four(0.0F);
  const FourFloats end = smaller_of(larger_of(rings - before, all_four(0.0F)), all_four(kRings));
  const FourTruths falling = those & falls, rising = those & ~falls;
  if (any_of(falling)) put_falling(azimuth, per_m, end, falling);
  if (is_within_ && any_of(rising)) put_level(azimuth, per_m, end, rising);
  put_returns(azimuth, fall_m, range_m, those);
  put_slopes(azimuth, fall_m, range_m, those);
}

// How far rays fall, or rise, from the sensor to each height; 0 to heights that they never come to.
void Sight::set_heights() {
  const float H = sensor_height_m_, thing_m = thing_m_ - kHeightNoise_m, low_m = band_m_ + kHeightNoise_m;
  const auto above = [](float m) { return m > 0.0F ? m : 0.0F; };
  fall_ = {above(H - top_m_), above(H - hang_m_), above(H - tall_m_), above(H - thing_m), above(H - low_m)};
  rise_ = {above(top_m_ - H), above(hang_m_ - H), above(tall_m_ - H), above(thing_m - H), 0.0F};
  is_within_ = H > low_m && H < top_m_;
  band_fall_m_ = H - band_m_, thing_fall_m_ = H - thing_m_, top_fall_m_ = H - top_m_;
}

std::uint32_t Sight::look(const Rays& rays, const Ground& ground, CloudPrint* print) {
  clear();
  print->clear();
  const float a = static_cast<float>(ground.slope_x), b = static_cast<float>(ground.slope_y);
  const Eigen::Vector3d& s = mount_.sensor_base_m;
  sensor_height_m_ = static_cast<float>(s.z() - ground.height_m - ground.slope_x * s.x() - ground.slope_y * s.y());
  set_heights();
  const float room_m = top_m_ > sensor_height_m_ ? top_m_ - sensor_height_m_ : 0.0F;
  const float floor_m = sensor_height_m_ + band_m_;
  // Where no floor is seen it may be lower or higher than the plane: only near places can then be seen low.
  reach_m_ = ground.seen ? kRings * kRing_m : 0.5F * (thing_m_ - band_m_) / kink_ + 0.5F;
  const float widest_m = half_width_m_ / static_cast<float>(kAzimuthMost_rad);
  seen_most_m_ = (reach_m_ < widest_m ? reach_m_ : widest_m) + kRing_m;
  FourInts used = all_four_ints(0);
  constexpr float kNearest_m = 0.05F;  // straight below the sensor there is no azimuth
  const auto look_at = [&](const FourPlaces& raw, FourTruths returns, FourFloats x, FourFloats y, FourFloats fall,
                           FourTruths those) {
    static_assert(kAzimuths == 2 * CloudPrint::kSectors, "a shift of the azimuth");
    // In the sensor's own azimuth: a packet is a slice of it, whatever the mount.
    print->add_four(azimuths_of(raw.x, raw.y) >> 1, words_of(raw), returns);
    const FourInts azimuth = azimuths_of(x, y);
    const FourFloats range = root_of(x * x + y * y);
    used -= those;
    // Below the floor: a mirror image, of which the way is unknown. Upwards and out of the machine's height: no use.
    those &= (fall <= floor_m) & (range > kNearest_m) & (fall >= -room_m * range);
    if (any_of(those)) put(azimuth, fall, range, those);
  };
  rays.each_four(a, b, look_at);
  add_up();
  widen();
  bound();
  return sum_of_lanes(used);
}

void Sight::add_up() {
  std::uint64_t* const cells = passes_.data();
  for (std::uint32_t k = kRow; k < kCounts; ++k) cells[k] += cells[k - kRow];
}

// The kinds of rays that pass in four cells: a ray that is low is a tall one's as well.
void Sight::put_kinds(const std::uint64_t* passes, std::uint8_t* kinds) {
  using EightCounts = std::uint16_t __attribute__((vector_size(16)));
  using TwoWords = std::uint64_t __attribute__((vector_size(16)));
  constexpr EightCounts kKinds = {kLow | kTall, kTall, 0, kTop, kLow | kTall, kTall, 0, kTop};
  EightCounts front, back;
  std::memcpy(&front, passes, sizeof(front));
  std::memcpy(&back, passes + 2, sizeof(back));
  // The kinds of two cells in one word's lowest bytes.
  const auto front_kinds = reinterpret_cast<EightCounts>(front != 0) & kKinds;
  const auto both_kinds = front_kinds | (reinterpret_cast<EightCounts>(back != 0) & kKinds) << 8;
  TwoWords words;
  std::memcpy(&words, &both_kinds, sizeof(words));
  words |= words >> 32;
  words |= words >> 16;
  const std::uint64_t even = words[0], odd = words[1];
  kinds[0] = static_cast<std::uint8_t>(even), kinds[1] = static_cast<std::uint8_t>(odd);
  kinds[2] = static_cast<std::uint8_t>(even >> 8U), kinds[3] = static_cast<std::uint8_t>(odd >> 8U);
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
    for (std::uint32_t a = 0; a < kAzimuths; a += 4) put_kinds(passes + a, row + kSides + a);
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

// A sensor that looks ahead sees half of the places around it: the rest needs no look.
void Sight::bound() {
  seen_within_ = {};
  for (std::uint32_t eight = 0; eight < kAzimuths; eight += 8) {
    std::uint32_t ring = kRings;
    while (ring > 0 && are_zero(seen_.data() + (ring - 1) * kAzimuths + eight)) --ring;
    if (ring == 0) continue;
    for (std::uint32_t a = eight; a < eight + 8; ++a) {
      constexpr float kCell_m = 0.2F;  // from the middle of a cell to places that look it up
      const float far_m = static_cast<float>(ring) * kRing_m;
      const float x = far_m * direction_x_[a], y = far_m * direction_y_[a];
      Bounds& in = seen_within_;
      in.low_x = x - kCell_m < in.low_x ? x - kCell_m : in.low_x;
      in.high_x = x + kCell_m > in.high_x ? x + kCell_m : in.high_x;
      in.low_y = y - kCell_m < in.low_y ? y - kCell_m : in.low_y;
      in.high_y = y + kCell_m > in.high_y ? y + kCell_m : in.high_y;
    }
  }
}

FourInts Sight::seen(FourFloats x, FourFloats y) const {
  const FourFloats r_m = root_of(x * x + y * y);
  const FourInts azimuth = azimuths_of(x, y);
  const FourInts first = ring_from(larger_of(r_m - half_width_m_, all_four(0.0F)) * (1.0F / kRing_m));
  const FourInts end = ring_from(smaller_of((r_m + half_width_m_) * (1.0F / kRing_m), all_four(kRings - 0.5F)));
  FourInts seen = all_four_ints(0);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    std::uint32_t all = 0;
    for (std::int32_t ring = first[lane]; ring < end[lane]; ++ring) {
      all |= seen_[static_cast<std::uint32_t>(ring) * kAzimuths + static_cast<std::uint32_t>(azimuth[lane])];
    }
    seen[lane] = static_cast<std::int32_t>(all);
  }
  return seen;
}

std::uint32_t Sight::could_see(float x, float y) const {
  const float range_m = std::sqrt(x * x + y * y);
  const std::uint32_t slice = azimuth_of(x, y) / kSliceAzimuths;
  const float falls_m = steepest_fall_[slice] * range_m, rises_m = steepest_rise_[slice] * range_m;
  const bool low = falls_m >= fall_.thing_m, tall = falls_m >= fall_.tall_m;
  const bool top = falls_m >= fall_.top_m && rises_m >= rise_.hang_m;
  std::uint32_t kinds = 0;
  if (low) kinds |= kLow;
  if (tall) kinds |= kTall;
  if (top) kinds |= kTop;
  return kinds;
}

bool Sight::passed_at(float x, float y, float height_m) const {
  const float range_m = std::sqrt(x * x + y * y), fall_m = sensor_height_m_ - height_m;
  const auto ring = static_cast<std::uint32_t>(range_m / kRing_m);
  const std::uint32_t azimuth = azimuth_of(x, y), slice = azimuth / kSliceAzimuths;
  return ring < kRings && count_of(ring * kRow + azimuth, kHighShift) != 0 &&
         steepest_fall_[slice] * range_m >= fall_m && steepest_rise_[slice] * range_m >= -fall_m;
}

Sight::Return Sight::returned(std::uint32_t ring, std::uint32_t azimuth, bool is_high, std::uint8_t word) const {
  const std::uint32_t count = word & kCountMost, eighth = word >> kCountBits;
  const float r_m = (static_cast<float>(ring) + (static_cast<float>(eighth) + 0.5F) * 0.125F) * kRing_m;
  const std::uint32_t sum = is_high ? heights_[ring * kAzimuths + azimuth] : 0;
  const float height_m = static_cast<float>(sum) * kHeightStep_m / static_cast<float>(count);
  return {r_m * direction_x_[azimuth], r_m * direction_y_[azimuth], is_high, count, height_m};
}

}  // namespace pose_wall::planar
