// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Relief of a road's floor and walls with the spectrum of real rock (lab/sim/rock_scales.hpp), in tables that a ray
// reads quickly.

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lab/sim/rock_scales.hpp"

namespace pose_wall::test {

// Heights over a face of the road, positive into the road.
class RockFaceTable {
 public:
  // Of the face from low_m to high_m across; along the road it is 128 m long and then begins anew.
  RockFaceTable(const tools::sim::RockScales& scales, const tools::sim::NoiseTile& tile, double low_m, double high_m)
      : low_m_(static_cast<float>(low_m)), rows_(static_cast<std::uint32_t>((high_m - low_m) * kPerMetre) + 1) {
    heights_.resize(std::size_t{rows_} * kColumns);
    for (std::uint32_t row = 0; row < rows_; ++row) {
      for (std::uint32_t column = 0; column < kColumns; ++column) {
        const double height_m = scales.at(tile, column / kPerMetre, low_m + row / kPerMetre);
        heights_[row * kColumns + column] = static_cast<float>(height_m);
      }
    }
    const auto ends = std::minmax_element(heights_.begin(), heights_.end());
    lowest_m_ = *ends.first, highest_m_ = *ends.second;
  }

  float lowest_m() const { return lowest_m_; }
  float highest_m() const { return highest_m_; }
  float at(float along_m, float across_m) const {
    const float u = (along_m + kBehind_m) * kSteps, most = static_cast<float>(rows_) - 1.001F;
    const float v = std::clamp((across_m - low_m_) * kSteps, 0.0F, most);
    const auto i = static_cast<std::uint32_t>(u), j = static_cast<std::uint32_t>(v);
    const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
    const float* const low = &heights_[j * kColumns];
    const float* const high = low + kColumns;
    const std::uint32_t a = i & (kColumns - 1U), b = (i + 1U) & (kColumns - 1U);
    const float below = low[a] + (low[b] - low[a]) * fu, above = high[a] + (high[b] - high[a]) * fu;
    return below + (above - below) * fv;
  }

 private:
  static constexpr std::uint32_t kColumns = 2048;  // a power of two
  static constexpr double kPerMetre = 16.0;        // three steps in the shortest length of the spectrum
  static constexpr float kSteps = static_cast<float>(kPerMetre);
  static constexpr float kBehind_m = 128.0F;  // no road is driven so far back

  std::vector<float> heights_;
  float low_m_, lowest_m_ = 0.0F, highest_m_ = 0.0F;
  std::uint32_t rows_;
};

class Rock {
 public:
  // One of the four kinds that were measured, or judged beside them.
  explicit Rock(std::uint64_t seed) : Rock(kind_of(seed), seed, tools::sim::NoiseTile(seed)) {}

  float floor_at(float along_m, float across_m) const { return floor_.at(along_m, across_m); }
  float wall_at(bool is_left, float along_m, float z_m) const { return (is_left ? left_ : right_).at(along_m, z_m); }
  const RockFaceTable& floor() const { return floor_; }
  const RockFaceTable& wall(bool is_left) const { return is_left ? left_ : right_; }

 private:
  using Kind = tools::sim::RockKind;
  using Face = tools::sim::RockFace;

  static Kind kind_of(std::uint64_t seed) {
    constexpr Kind kKinds[] = {Kind::kSmooth, Kind::kShotcrete, Kind::kBlasted, Kind::kCut};
    return kKinds[seed % 4];
  }
  Rock(Kind kind, std::uint64_t seed, const tools::sim::NoiseTile& tile)
      : floor_(tools::sim::RockScales(kind, Face::kFloor, 1.0, false, seed + 1), tile, -4.0, 4.0),
        left_(tools::sim::RockScales(kind, Face::kWall, 1.0, false, seed + 2), tile, -0.5, 4.0),
        right_(tools::sim::RockScales(kind, Face::kWall, 1.0, false, seed + 3), tile, -0.5, 4.0) {}

  RockFaceTable floor_, left_, right_;
};

}  // namespace pose_wall::test
