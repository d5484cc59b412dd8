// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/evidence.hpp"

#include "base/math/elementary.hpp"
#include "base/simd/four_floats.hpp"
#include "base/simd/four_turns.hpp"
#include "lidar/body_boxes.hpp"
#include "lidar/point_reader.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kFarthest_m = 1000.0;  // no sensor measures further: a wrong unit, or a filling of no-returns

// Within 1e-5 rad, 0.01 of the finest usual beam (Hastings, Approximations for Digital Computers, 1955).
FourFloats arc_tangent2_of_four(FourFloats y, FourFloats x) {
  const FourFloats ax = magnitude_of(x), ay = magnitude_of(y), zero = all_four(0.0F);
  const FourFloats big = larger_of(ax, ay), small = smaller_of(ax, ay);
  const FourFloats q = big > zero ? small / big : zero, s = q * q;
  FourFloats a = ((((0.0208351F * s - 0.0851330F) * s + 0.1801410F) * s - 0.3302995F) * s + 0.9998660F) * q;
  a = ay > ax ? 1.57079637F - a : a;
  a = x < zero ? 3.14159274F - a : a;
  return y < zero ? -a : a;
}

// Points on their way from the cloud to the beams.
struct Block {
  static constexpr std::uint32_t kSize = 128;  // whole fours; all of it stays in the first cache
  float x[kSize], y[kSize], z[kSize];          // as the cloud has them
  std::int32_t fate[kSize];                    // HeightClass, or one of the below
  float range_m[kSize], free_m[kSize];
  std::int32_t beam[kSize], aside[kSize];  // place in the scan: beam, and kAsides of a step from its middle
  std::int32_t word[kSize], slot[kSize];   // of the sector's rays
};
constexpr double kBorder = 0.01;    // of a step: places are floats of up to 6284 steps, and may fall to either side
constexpr double kBandParts = 3.0;  // the middle one of the band's parts is there at any range
constexpr std::int32_t kDropped = -1, kOfBody = -2;  // fates below all classes of height

// Which beam, height and slot a return has.
class Judge {
 public:
  Judge(const pose_wall_cloud& cloud, const ScanSettings& s, const FloorPose& floor)
      : to_base_(s.mount.R_base_lidar, s.mount.sensor_base_m),
        to_level_(floor.R_level_base * s.mount.R_base_lidar),
        sensor_m_(static_cast<float>(sensor_level_m(s, floor).z())),
        near2_(static_cast<float>(s.mount.range_min_m * s.mount.range_min_m)),
        tilt_(static_cast<float>(floor.tilt_rad)),
        tolerance_m_(static_cast<float>(s.floor_tolerance_m)),
        low_m_(static_cast<float>(s.low_m())),
        high_m_(static_cast<float>(s.high_m())),
        overhead_m_(static_cast<float>(s.high_m() + s.overhead_m)),
        reach_m_(static_cast<float>(floor.reach_m)),
        bend_(static_cast<float>(s.bend_rad)),
        less_most_m_(static_cast<float>((s.high_m() - s.low_m()) / kBandParts)),
        angle_min_(static_cast<float>(s.angle_min_rad)),
        per_step_(static_cast<float>(1.0 / s.angle_step_rad)),
        steps_(static_cast<float>(s.steps_of_turn)),
        sectors_per_step_(static_cast<float>(s.sectors / s.steps_of_turn)),
        sector_last_(static_cast<float>(s.sectors) - 0.5F),
        body_(s.mount.body, cloud) {}

  // Four of a block.
  void judge(std::uint32_t k, Block* b) const {
    FourFloats x = load_four(&b->x[k]), y = load_four(&b->y[k]), z = load_four(&b->z[k]);
    const FourFloats range2 = x * x + y * y + z * z, zero = all_four(0.0F);
    constexpr auto kMost2 = static_cast<float>(kFarthest_m * kFarthest_m);  // square of the range
    const FourTruths there = (range2 >= near2_) & (range2 <= kMost2) & (range2 > zero);
    x = there ? x : zero, y = there ? y : zero, z = there ? z : zero;
    FourInts fate = there ? all_four_ints(kBand) : all_four_ints(kDropped);
    if (!body_.empty()) fate = body_.hold(to_base_(x, y, z)) & there ? all_four_ints(kOfBody) : fate;
    const FourPlaces ray = to_level_.turned(x, y, z);
    const FourFloats flat2 = ray.x * ray.x + ray.y * ray.y;
    const FourFloats range = root_of(flat2), height = ray.z + sensor_m_;
    const FourInts heights = class_of(height, range);
    store_four(fate < 0 ? fate : heights, &b->fate[k]);
    store_four(range, &b->range_m[k]);
    store_four(free_of(heights, height, ray.z, range), &b->free_m[k]);
    put_beam(ray, k, b);
    put_slot(ray.z, range, k, b);
  }

 private:
  FourInts class_of(FourFloats height, FourFloats range) const {
    const FourFloats ground = tolerance_m_ + tilt_ * range, beyond = range - reach_m_;
    const FourFloats bend = bend_ * larger_of(beyond, all_four(0.0F)), less = smaller_of(bend, all_four(less_most_m_));
    const FourFloats band = larger_of(low_m_ + less, ground);
    const FourInts none = all_four_ints(0);
    // each comparison that holds is one class higher; a truth is -1
    return none - ((height >= ground) + (height >= band) + (height > high_m_ - less) + (height > high_m_) +
                   (height > overhead_m_));
  }

  // So far the ray was inside the band: to its return, or to where it left through the bottom or the top.
  FourFloats free_of(FourInts heights, FourFloats height, FourFloats rise, FourFloats range) const {
    const FourFloats zero = all_four(0.0F);
    const FourInts band = all_four_ints(kBand);
    const FourTruths below = heights<band, above = heights> band;
    const FourFloats edge = below ? all_four(low_m_ - sensor_m_) : all_four(high_m_ - sensor_m_);
    const FourTruths was_inside = below ? (edge < zero) & (rise < edge) : (edge > zero) & (rise > edge);
    // Where the band shrinks, a return beside it was inside the whole band to its own range.
    const FourTruths at_end = (below & (height >= low_m_)) | (above & (height <= high_m_));
    const FourFloats part = was_inside ? edge / rise : zero;
    return (below | above) & ~at_end ? part * range : range;
  }

  // Where in the scan, in steps from half a step before beam 0.
  void put_beam(const FourPlaces& ray, std::uint32_t k, Block* b) const {
    const FourFloats zero = all_four(0.0F);
    FourFloats place = (arc_tangent2_of_four(ray.y, ray.x) - angle_min_) * per_step_ + 0.5F;
    place = place < zero ? place + steps_ : place;
    place = place >= steps_ ? place - steps_ : place;
    place = place > zero ? place : zero;
    const FourInts beam = cut_off(place);
    store_four(beam, &b->beam[k]);
    // The far edge of a beam is half a step away: of a kAsides less than that, so that it fits.
    const FourFloats aside = (place - __builtin_convertvector(beam, FourFloats) - 0.5F) * (1.0F / kAsides);
    const FourFloats most = all_four(32767.0F);
    store_four(cut_off(larger_of(smaller_of(aside, most), -most)), &b->aside[k]);
    const FourInts sector = cut_off(smaller_of(place * sectors_per_step_, all_four(sector_last_)));
    store_four(sector * static_cast<std::int32_t>(kSlotWords), &b->word[k]);
  }

  static void put_slot(FourFloats rise, FourFloats range, std::uint32_t k, Block* b) {
    constexpr float kHalf = kSlots / 2;  // to the horizon
    const FourFloats run = magnitude_of(rise) + static_cast<float>(kSlotBend) * range;
    const FourFloats bent = run > 0.0F ? rise / run : run;
    const FourFloats slot = (bent + 1.0F) * kHalf;
    store_four(cut_off(smaller_of(slot, all_four(kSlots - 0.5F))), &b->slot[k]);
  }

  FourTurns to_base_, to_level_;
  float sensor_m_, near2_, tilt_, tolerance_m_, low_m_, high_m_, overhead_m_, reach_m_, bend_, less_most_m_;
  float angle_min_, per_step_, steps_, sectors_per_step_, sector_last_;
  BodyBoxes body_;
};

class Pass {
 public:
  Pass(const pose_wall_cloud& cloud, const ScanSettings& settings, const FloorPose& floor, Evidence* evidence)
      : cloud_(cloud),
        judge_(cloud, settings, floor),
        beams_(settings.beams),
        range_min_m_(static_cast<float>(settings.range_min_m)),
        range_max_m_(static_cast<float>(settings.range_max_m)),
        sensor_is_above_(sensor_level_m(settings, floor).z() > settings.high_m()),
        reader_(cloud),
        out_(*evidence) {}

  void run() {
    Block block;
    std::uint32_t gathered = 0;
    for (std::uint32_t row = 0; row < rows_of(cloud_); ++row) {
      const unsigned char* point = row_of(cloud_, row);
      for (std::uint32_t column = 0; column < cloud_.width;) {
        const std::uint32_t room = Block::kSize - gathered, left = cloud_.width - column;
        const std::uint32_t count = left < room ? left : room;
        reader_.row(point, count, &block.x[gathered], &block.y[gathered], &block.z[gathered]);
        column += count;
        point += static_cast<std::size_t>(count) * cloud_.point_step;
        gathered += count;
        if (gathered < Block::kSize) continue;
        take(gathered, &block);
        gathered = 0;
      }
    }
    take(gathered, &block);
  }

 private:
  void take(std::uint32_t count, Block* b) {
    out_.counts.points_in += count;
    for (std::uint32_t k = count; k < Block::kSize && k % kFour != 0; ++k) b->x[k] = b->y[k] = b->z[k] = 0.0F;
    const Judge judge = judge_;  // a local copy, so that no store can seem to change it
    for (std::uint32_t k = 0; k < count; k += kFour) judge.judge(k, b);
    for (std::uint32_t k = 0; k < count; ++k) {
      if (b->fate[k] >= 0) {
        put(*b, k);
      } else {
        ++(b->fate[k] == kOfBody ? out_.counts.of_body : out_.counts.dropped);
      }
    }
  }

  void put(const Block& b, std::uint32_t k) {
    const std::int32_t height = b.fate[k];
    ++out_.counts.of[height];
    const auto beam = static_cast<std::uint32_t>(b.beam[k]), slot = static_cast<std::uint32_t>(b.slot[k]);
    SectorRays* const rays = out_.rays.data() + static_cast<std::uint32_t>(b.word[k]) / kSlotWords;
    rays->word[slot / 32] |= 1U << slot % 32;
    if (height == kHigh || (height > kBand && sensor_is_above_))
      end_sector(static_cast<std::uint32_t>(b.word[k]) / kSlotWords, b.range_m[k]);
    if (beam >= beams_) {
      ++out_.counts.out_of_scan;
    } else if (height == kBand) {
      keep(b.range_m[k], beam, b.aside[k]);
    } else {
      float& free_m = out_.free_m[beam];
      free_m = b.free_m[k] > free_m ? b.free_m[k] : free_m;  // a store costs less than a branch that follows the rock
      if (height == kLow && b.range_m[k] < out_.low_m[beam]) out_.low_m[beam] = b.range_m[k];
      if ((height == kHigh || height == kOverhead) && b.range_m[k] < out_.overhead_m[beam])
        out_.overhead_m[beam] = b.range_m[k];
    }
  }

  // A ray from above the band that ended above it never came down to what it should have seen.
  void end_sector(std::uint32_t sector, float range_m) {
    if (range_m < out_.sector_end_m[sector]) out_.sector_end_m[sector] = range_m;
  }

  void keep(float range_m, std::uint32_t beam, std::int32_t aside) {
    if (!(range_m <= range_max_m_)) {  // its ray passed all of the scan
      ++out_.counts.out_of_scan;
      out_.free_m[beam] = range_max_m_;
      return;
    }
    if (range_m < range_min_m_) ++out_.counts.out_of_scan;
    float& nearest_m = out_.nearest_m[beam];
    nearest_m = range_m < nearest_m ? range_m : nearest_m;
    if (out_.return_count == out_.returns.size()) {
      ++out_.counts.uncounted;
      return;
    }
    out_.returns[out_.return_count++] = {range_m, static_cast<std::uint16_t>(beam), static_cast<std::int16_t>(aside)};
  }

  const pose_wall_cloud& cloud_;
  Judge judge_;
  std::uint32_t beams_;
  float range_min_m_, range_max_m_;
  bool sensor_is_above_;
  PointReader reader_;
  Evidence& out_;
};

// The nearest low thing or thing of each sector. A beam on the border of two counts in both. What lies beside the
// angles of the scan was not kept, so that sectors that reach there end at the sensor.
void end_sectors(const ScanSettings& s, Evidence* evidence) {
  const double per_step = s.sectors / s.steps_of_turn;
  const Span<float>& end_m = evidence->sector_end_m;
  const auto shorten = [&](double place, float range_m) {
    const auto sector = static_cast<std::uint32_t>(place * per_step);
    float& end = end_m[sector < s.sectors ? sector : s.sectors - 1];
    if (range_m < end) end = range_m;
  };
  for (std::uint32_t beam = 0; beam < s.beams; ++beam) {
    const float near = evidence->nearest_m[beam], low = evidence->low_m[beam], range_m = near < low ? near : low;
    if (!(range_m < kNothing_m)) continue;
    shorten(beam > 0 ? beam - kBorder : 0.0, range_m);
    shorten(beam + 1.0 + kBorder, range_m);
  }
  if (s.goes_round) return;
  for (std::uint32_t beam = s.beams; beam < s.steps_of_turn; ++beam) shorten(beam, 0.0F);
  shorten(s.beams, 0.0F);
  shorten(s.steps_of_turn, 0.0F);
}

}  // namespace

void Evidence::lay_out(Arena& arena, std::uint32_t beams, std::uint32_t sectors) {
  nearest_m = arena.take<float>(beams);
  low_m = arena.take<float>(beams);
  overhead_m = arena.take<float>(beams);
  free_m = arena.take<float>(beams);
  rays = arena.take<SectorRays>(sectors);
  sector_end_m = arena.take<float>(sectors);
  returns = arena.take<BandReturn>(POSE_WALL_PLANAR_SCAN_RETURNS);
}

void Evidence::clear() {
  for (const Span<float>& ranges : {nearest_m, low_m, overhead_m, sector_end_m}) ranges.fill(kNothing_m);
  free_m.fill(0.0F);
  rays.fill(SectorRays{});
  return_count = 0;
  counts = PassCounts{};
}

Eigen::Vector3d sensor_level_m(const ScanSettings& settings, const FloorPose& floor) {
  return floor.R_level_base * settings.mount.sensor_base_m + Eigen::Vector3d(0.0, 0.0, floor.base_height_m);
}

void gather_evidence(const pose_wall_cloud& cloud, const ScanSettings& settings, const FloorPose& floor,
                     Evidence* evidence) {
  evidence->clear();
  Pass(cloud, settings, floor, evidence).run();
  end_sectors(settings, evidence);
}

}  // namespace pose_wall::planar
