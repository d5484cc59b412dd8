// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Cells of space near the sensor in which something stood for the whole recording, and how they hang together.

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace pose_wall::tools::doctor {

constexpr double kCell_m = 0.15;

struct NearCell {
  Eigen::Vector3d low_base_m, high_base_m;  // of the points within it
  std::size_t points = 0;
  std::uint32_t slices = 0;  // bit: part of the recording in which it was seen
};

// A body is one piece to the eye, with gaps where no beam falls.
using Piece = std::vector<NearCell>;

class NearCells {
 public:
  void add(const Eigen::Vector3d& p_base_m, std::uint32_t slice);

  // Cells seen in at least `slices_min` parts of the recording, in pieces; the largest first.
  std::vector<Piece> fixed_pieces(std::uint32_t slices_min) const;
  // Points in cells that were seen in less than half of `slices` parts.
  std::size_t passing_points(std::uint32_t slices) const;

 private:
  using Key = std::array<std::int32_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  std::unordered_map<Key, NearCell, Hash> cells_;
};

struct Box {
  Eigen::Vector3d low_m, high_m;
  double volume_m3() const { return (high_m - low_m).prod(); }
  bool holds(const Eigen::Vector3d& p) const {
    return (p.array() >= low_m.array()).all() && (p.array() <= high_m.array()).all();
  }
};

// As the config has it, outwards to the centimetre.
std::string box_text(const Box& box);

Box box_around(const Piece& piece);

// Cuts the boxes of the pieces where that saves most of their space; no more than `boxes_max`.
std::vector<Box> boxes_of(std::vector<Piece> pieces, std::size_t boxes_max);

}  // namespace pose_wall::tools::doctor
