// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What one frame saw around the sensor: how many rays passed over each place at which height, and what returned there.
//
// Cells are polar about the sensor. Azimuths are in equal steps of a diamond's edge, so that no arc tangent is needed:
// a step is from 0.0078 to 0.0157 rad. A ray that ends on the floor, or beyond, counts in each cell over whose middle
// it passes within a band of heights; a ray that ends on a thing counts up to 0.2 m before it.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "planar/stop/ground.hpp"
#include "planar/stop/rays.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kAzimuths = 512;       // steps of a turn
constexpr std::uint32_t kRings = 80;           // up to 8 m from the sensor
constexpr float kRing_m = 0.1F;                // as wide as a place
constexpr std::uint32_t kRow = kAzimuths + 8;  // words of a ring: no power of two, or all rings share a cache's set
constexpr double kAzimuthMost_rad = 0.015625;  // the widest step: 2 * 4 / 512

class Sight {
 public:
  void lay_out(Arena& arena);
  void open(const StopSettings& settings, const Mount& mount);
  // Reads a frame. Returns how many returns were used.
  std::uint32_t look(const Rays& rays, const Ground& ground);

  enum Seen : std::uint8_t { kLow = 1, kTall = 2, kTop = 4, kAll = 7 };

  // How a place at (x, y) about the sensor was seen in this frame: kLow where the smallest thing would have been hit,
  // kTall where a person would have been, kTop where a thing that hangs into the machine's height would have been.
  std::uint8_t seen(float x, float y) const;
  // No place is seen so further away than this.
  float seen_most_m() const { return seen_most_m_; }
  // Whether rays passed there above thing_height_m.
  bool passed_high(float x, float y) const;

  struct Return {
    float x, y;  // about the sensor
    bool is_high;
    bool is_doubtful;  // most rays pass
  };
  // visit(Return) for each cell with returns, low and high ones apart.
  template <typename Visit>
  void each_return(const Visit& visit) const {
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      const std::uint8_t* const low = low_return_.data() + ring * kAzimuths;
      const std::uint8_t* const high = high_return_.data() + ring * kAzimuths;
      for (std::uint32_t eight = 0; eight < kAzimuths; eight += 8) {
        if (are_zero(low + eight) && are_zero(high + eight)) continue;
        for (std::uint32_t a = eight; a < eight + 8; ++a) {
          const std::uint32_t cell = ring * kRow + a;
          if (low[a] != 0) visit(returned(ring, a, false, low[a], count_of(cell, kLowShift)));
          if (high[a] != 0) visit(returned(ring, a, true, high[a], count_of(cell, kHighShift)));
        }
      }
    }
  }

 private:
  // Four counts in one word: a ray changes five words, whatever it passes. Counts that overflow need 65,536 rays in one
  // cell.
  static constexpr unsigned kLowShift = 0, kTallShift = 16, kHighShift = 32, kTopShift = 48;  // bits

  static bool are_zero(const std::uint8_t* eight) {
    std::uint64_t word;
    std::memcpy(&word, eight, sizeof(word));
    return word == 0;
  }
  static std::uint32_t azimuth_of(float x, float y);
  std::uint32_t count_of(std::uint32_t cell, unsigned shift) const {
    return static_cast<std::uint16_t>(passes_[cell] >> shift);
  }
  Return returned(std::uint32_t ring, std::uint32_t azimuth, bool is_high, std::uint8_t count,
                  std::uint32_t passes) const;
  void clear();
  void add_up();
  void widen();
  void put(const FourPlaces& p, FourFloats height_m, FourFloats range_m, FourTruths those);
  void put_falling(FourInts azimuth, FourFloats height_m, FourFloats range_m, FourTruths those);
  void put_level(FourInts azimuth, FourFloats height_m, FourFloats range_m, FourTruths those);
  void put_returns(FourInts azimuth, FourFloats height_m, FourFloats range_m, FourTruths those);

  Span<std::uint64_t> passes_;                   // rays by cell, one ring more than cells
  Span<std::uint8_t> low_return_, high_return_;  // saturated
  Span<std::uint8_t> seen_;                      // widened over azimuths
  float direction_x_[kAzimuths], direction_y_[kAzimuths];
  Mount mount_;
  float sensor_height_m_ = 0.0F;
  float band_m_ = 0.0F, thing_m_ = 0.0F, tall_m_ = 0.0F, top_m_ = 0.0F, hang_m_ = 0.0F;
  float kink_ = 0.0F, reach_m_ = 0.0F, half_width_m_ = 0.0F, seen_most_m_ = 0.0F;
};

}  // namespace pose_wall::planar
