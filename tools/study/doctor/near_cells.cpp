// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/near_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <map>
#include <utility>

namespace pose_wall::tools::doctor {
namespace {

// Rings leave gaps of this many cells on a flat deck below the sensor.
constexpr std::int32_t kGap = 3;
// A cut must save this much of what a box spans without holding anything.
constexpr double kCutTo = 0.65;

std::size_t count_bits(std::uint32_t bits) {
  return std::bitset<32>(bits).count();
}

struct Cut {
  Piece below, above;
  double volume_m3 = 0.0;
};

Cut cut_at(const Piece& piece, int axis, double at_m) {
  Cut cut;
  for (const NearCell& cell : piece) {
    (0.5 * (cell.low_base_m[axis] + cell.high_base_m[axis]) < at_m ? cut.below : cut.above).push_back(cell);
  }
  if (!cut.below.empty() && !cut.above.empty()) {
    cut.volume_m3 = box_around(cut.below).volume_m3() + box_around(cut.above).volume_m3();
  }
  return cut;
}

// The best of the cuts at every second cell along each axis; empty halves when none saves enough.
Cut best_cut(const Piece& piece) {
  const Box box = box_around(piece);
  Cut best;
  best.volume_m3 = kCutTo * box.volume_m3();
  for (int axis = 0; axis < 3; ++axis) {
    for (double at_m = box.low_m[axis] + kCell_m; at_m < box.high_m[axis]; at_m += 2.0 * kCell_m) {
      Cut cut = cut_at(piece, axis, at_m);
      if (!cut.below.empty() && !cut.above.empty() && cut.volume_m3 < best.volume_m3) best = std::move(cut);
    }
  }
  return best;
}

}  // namespace

std::size_t NearCells::Hash::operator()(const Key& key) const {
  std::uint64_t hash = 0;
  for (const std::int32_t part : key) hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15U;
  return hash ^ hash >> 32U;
}

void NearCells::add(const Eigen::Vector3d& p_base_m, std::uint32_t slice) {
  Key key{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    key[axis] = static_cast<std::int32_t>(std::floor(p_base_m[static_cast<int>(axis)] / kCell_m));
  }
  NearCell& cell = cells_[key];
  cell.low_base_m = cell.points == 0 ? p_base_m : cell.low_base_m.cwiseMin(p_base_m);
  cell.high_base_m = cell.points == 0 ? p_base_m : cell.high_base_m.cwiseMax(p_base_m);
  ++cell.points;
  cell.slices |= 1U << slice;
}

std::vector<Piece> NearCells::fixed_pieces(std::uint32_t slices_min) const {
  std::map<Key, const NearCell*> left;  // in the order of the keys: the same pieces on every machine
  for (const auto& [key, cell] : cells_) {
    if (cell.points >= 3 && count_bits(cell.slices) >= slices_min) left.emplace(key, &cell);
  }
  std::vector<Piece> pieces;
  while (!left.empty()) {
    std::vector<Key> todo = {left.begin()->first};
    Piece piece = {*left.begin()->second};
    left.erase(left.begin());
    while (!todo.empty()) {
      const Key from = todo.back();
      todo.pop_back();
      auto it = left.lower_bound({from[0] - kGap, from[1] - kGap, from[2] - kGap});
      while (it != left.end() && it->first[0] <= from[0] + kGap) {
        const bool near = std::abs(it->first[1] - from[1]) <= kGap && std::abs(it->first[2] - from[2]) <= kGap;
        if (near) {
          todo.push_back(it->first);
          piece.push_back(*it->second);
        }
        it = near ? left.erase(it) : std::next(it);
      }
    }
    pieces.push_back(std::move(piece));
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.size() > b.size(); });
  return pieces;
}

std::size_t NearCells::passing_points(std::uint32_t slices) const {
  std::size_t points = 0;
  for (const auto& [key, cell] : cells_) {
    if (2 * count_bits(cell.slices) < slices) points += cell.points;
  }
  return points;
}

Box box_around(const Piece& piece) {
  Box box{piece.front().low_base_m, piece.front().high_base_m};
  for (const NearCell& cell : piece) {
    box.low_m = box.low_m.cwiseMin(cell.low_base_m);
    box.high_m = box.high_m.cwiseMax(cell.high_base_m);
  }
  // A deck is flat, and a box without height saves nothing to a cut.
  box.high_m = box.high_m.cwiseMax((box.low_m.array() + 0.5 * kCell_m).matrix());
  return box;
}

std::vector<Box> boxes_of(std::vector<Piece> pieces, std::size_t boxes_max) {
  if (pieces.size() > boxes_max) pieces.resize(boxes_max);
  for (std::size_t i = 0; i < pieces.size() && pieces.size() < boxes_max;) {
    Cut cut = best_cut(pieces[i]);
    if (cut.below.empty()) {
      ++i;
      continue;
    }
    pieces[i] = std::move(cut.below);
    pieces.push_back(std::move(cut.above));
  }
  std::vector<Box> boxes;
  boxes.reserve(pieces.size());
  for (const Piece& piece : pieces) boxes.push_back(box_around(piece));
  return boxes;
}

std::string box_text(const Box& box) {
  // Outwards to the centimetre.
  const auto down = [](double m) { return std::max(std::floor(100.0 * m) / 100.0, -20.0); };
  const auto up = [](double m) { return std::min(std::ceil(100.0 * m) / 100.0, 20.0); };
  return fmt::format("{:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {:.2f}", down(box.low_m.x()), up(box.high_m.x()),
                     down(box.low_m.y()), up(box.high_m.y()), down(box.low_m.z()), up(box.high_m.z()));
}

}  // namespace pose_wall::tools::doctor
