// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What one frame saw around the sensor: how many rays passed over each place at which height, and what returned there.
//
// Cells are polar about the sensor. Azimuths are in steps along a diamond's edge, bent so that no arc tangent is needed
// and a step is from 0.0115 to 0.0126 rad. A ray that ends on the floor, or beyond, counts in each cell over whose
// middle it passes within a band of heights. A ray that ends on a thing counts up to 0.2 m before it.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "lidar/cloud_print.hpp"
#include "planar/stop/ground.hpp"
#include "planar/stop/rays.hpp"
#include "planar/stop/settings.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kAzimuths = 512;       // steps of a turn
constexpr std::uint32_t kRings = 80;           // up to 8 m from the sensor
constexpr float kRing_m = 0.1F;                // as wide as a place
constexpr std::uint32_t kRow = kAzimuths + 8;  // words of a ring: no power of two, or all rings share a cache's set
constexpr float kHeightStep_m = 0.025F;        // of returns: 255 steps hold the highest top_m
constexpr double kAzimuthMost_rad = 0.0126;    // the widest step; a test looks at all of them

class Sight {
 public:
  void lay_out(Arena& arena);
  void open(const StopSettings& settings, const Mount& mount);
  // Reads a frame. Returns how many returns were used. The print is of all in range, those of the machine too.
  std::uint32_t look(const Rays& rays, const Ground& ground, CloudPrint* print);

  enum Seen : std::uint8_t { kLow = 1, kTall = 2, kTop = 4, kAll = 7 };

  // How places at (x, y) about the sensor were seen in this frame: kLow where the smallest thing would have been hit,
  // kTall where a person would have been, kTop where a thing that hangs into the machine's height would have been.
  FourInts seen(FourFloats x, FourFloats y) const;
  // How a place could be seen if nothing stood before it.
  std::uint32_t could_see(float x, float y) const;
  // No place is seen further away than this, nor outside of these bounds.
  float seen_most_m() const { return seen_most_m_; }
  struct Bounds {
    float low_x, high_x, low_y, high_y;
  };
  const Bounds& seen_within() const { return seen_within_; }
  // Whether rays passed there above thing_height_m, and rays of that direction come as low and as high as a height
  // above the floor: one would have ended on what returned from there.
  bool passed_at(float x, float y, float height_m) const;
  // Which azimuth a direction is in.
  static std::uint32_t azimuth_of(float x, float y);

  struct Return {
    float x, y;  // about the sensor
    bool is_high;
    std::uint32_t returns;  // up to 31
    float height_m;         // of high ones, in their mean
  };
  // visit(Return) for each cell with returns, low and high ones apart.
  template <typename Visit>
  void each_return(const Visit& visit) const {
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      const std::uint8_t* const low = returns_.data() + ring * kAzimuths;
      const std::uint8_t* const high = low + kRings * kAzimuths;
      for (std::uint32_t eight = 0; eight < kAzimuths; eight += 8) {
        if (are_zero(low + eight) && are_zero(high + eight)) continue;
        for (std::uint32_t a = eight; a < eight + 8; ++a) {
          if (low[a] != 0) visit(returned(ring, a, false, low[a]));
          if (high[a] != 0) visit(returned(ring, a, true, high[a]));
        }
      }
    }
  }

 private:
  // Four counts in one word: a ray changes five words, whatever it passes. Counts that overflow need 65,536 rays in one
  // cell.
  static constexpr unsigned kLowShift = 0, kTallShift = 16, kHighShift = 32, kTopShift = 48;  // bits

  static constexpr std::uint32_t kSliceAzimuths =
      8;                                     // narrow beside the tilt of a mount, and wide enough for any sensor
  static constexpr unsigned kCountBits = 5;  // of a word of returns
  static constexpr std::uint32_t kCountMost = (1U << kCountBits) - 1U;  // what the bits hold

  static bool are_zero(const std::uint8_t* eight) {
    std::uint64_t word;
    std::memcpy(&word, eight, sizeof(word));
    return word == 0;
  }
  std::uint32_t count_of(std::uint32_t cell, unsigned shift) const {
    return static_cast<std::uint16_t>(passes_[cell] >> shift);
  }
  Return returned(std::uint32_t ring, std::uint32_t azimuth, bool is_high, std::uint8_t word) const;
  // From the sensor to each height.
  struct Heights {
    float top_m, hang_m, tall_m, thing_m, low_m;  // no less than 0
  };
  void clear();
  void set_heights();
  void add_up();
  static void put_kinds(const std::uint64_t* passes, std::uint8_t* kinds);
  void widen();
  void bound();
  void put(FourInts azimuth, FourFloats fall_m, FourFloats range_m, FourTruths those);
  void put_falling(FourInts azimuth, FourFloats per_m, FourFloats end, FourTruths those);
  void put_level(FourInts azimuth, FourFloats per_m, FourFloats end, FourTruths those);
  void put_slopes(FourInts azimuth, FourFloats fall_m, FourFloats range_m, FourTruths those);
  void put_returns(FourInts azimuth, FourFloats fall_m, FourFloats range_m, FourTruths those);

  Span<std::uint64_t> passes_;   // rays by cell, one ring more than cells
  Span<std::uint8_t> returns_;   // low ones, then high ones: count, saturated, and eighth of the ring of the last one
  Span<std::uint16_t> heights_;  // of the high ones that count, their sum in steps of kHeightStep_m above the floor
  Span<std::uint8_t> seen_;      // widened over azimuths
  // Of rays in each slice of 5.6 degrees, in metres of height to a metre; not below 0.
  Span<float> steepest_fall_, steepest_rise_;
  float direction_x_[kAzimuths], direction_y_[kAzimuths];
  Mount mount_;
  float sensor_height_m_ = 0.0F;
  Bounds seen_within_{};
  Heights fall_{}, rise_{};
  float band_fall_m_ = 0.0F, thing_fall_m_ = 0.0F, top_fall_m_ = 0.0F;  // from the sensor to these heights
  bool is_within_ = false;  // the sensor is in the machine's height, above low things' floor
  float band_m_ = 0.0F, thing_m_ = 0.0F, tall_m_ = 0.0F, top_m_ = 0.0F, hang_m_ = 0.0F;
  float kink_ = 0.0F, reach_m_ = 0.0F, half_width_m_ = 0.0F, seen_most_m_ = 0.0F;
};

}  // namespace pose_wall::planar
