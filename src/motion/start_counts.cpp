// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/start_counts.hpp"

#include <cmath>
#include <cstring>

#include "motion/frame_steps.hpp"

namespace pose_wall::motion {
namespace {

// The grid wraps around: what is further apart than this meets in one cell, which only raises a bound.
constexpr std::uint32_t kSide = 256, kBins = 16, kFacings = 3;  // 77 m by 77 m, and 6.4 m of height
constexpr std::uint32_t kWord = 64, kWords = kSide / kWord;     // bits of one, and how many are side by side
constexpr std::uint32_t kRowsAtOnce = 2;                        // words of a register of NEON and of SSE
// Words one above the other; the last ones are the first again, for all rows of a window.
constexpr std::uint32_t kAgain = kStartsInRow + kRowsAtOnce - 1, kColumn = kSide + kAgain;
constexpr std::uint32_t kLayerWords = kWords * kColumn;  // of one facing and bin of height
// A cell along x and y is a step of the grid of starts; a bin of height is as thick as a layer and a margin.
constexpr float kSize_m[3] = {static_cast<float>(kPlaceStep_m), static_cast<float>(kPlaceStep_m), 0.4F};
constexpr float kMargin_m = 2e-3F;  // more than the rounding of a place 200 m from the corner
// Of one column of a tile. A plane that needs more is steeper than 80 degrees to the axis that it faces: it is none.
constexpr std::int32_t kAcrossMost = 16;
constexpr int kCounts = 8;            // digits of a count
constexpr std::uint32_t kAtOnce = 8;  // words that the adders of Harley and Seal take
static_assert(kStartsInRow <= static_cast<int>(kWord) && kAskedMost < (1U << kCounts));

std::int32_t cell_of(float place_m, int axis) {
  return static_cast<std::int32_t>(std::floor(place_m / kSize_m[axis]));
}

struct Range {
  float from_m, to_m;
};

// Of a stretch, the part within a cell.
Range within(const Range& all, std::int32_t cell, int axis) {
  const float from = static_cast<float>(cell) * kSize_m[axis], to = from + kSize_m[axis];
  return {from > all.from_m ? from : all.from_m, to < all.to_m ? to : all.to_m};
}

std::uint32_t layer_of(std::uint8_t facing, std::int32_t bin) {
  return (facing * kBins + (static_cast<std::uint32_t>(bin) & (kBins - 1))) * kLayerWords;
}

// Sets the cells that a tile's surface and the layer about it touch.
class Drawing {
 public:
  Drawing(const Eigen::Vector3d& corner, Span<std::uint64_t> bits) : corner_(corner.cast<float>()), bits_(bits) {}

  std::uint32_t cells() const { return cells_; }

  void draw(const Tile& tile) {
    const int iu = kU[tile.facing], iv = kV[tile.facing];
    const float u = static_cast<float>(tile.u) - corner_[iu], v = static_cast<float>(tile.v) - corner_[iv];
    const Range us = {u - kMargin_m, u + 1.0F + kMargin_m}, vs = {v - kMargin_m, v + 1.0F + kMargin_m};
    for (std::int32_t a = cell_of(us.from_m, iu); a <= cell_of(us.to_m, iu); ++a) {
      for (std::int32_t b = cell_of(vs.from_m, iv); b <= cell_of(vs.to_m, iv); ++b) {
        std::int32_t cell[3];
        cell[iu] = a;
        cell[iv] = b;
        draw_across(tile, within(us, a, iu), within(vs, b, iv), u + 0.5F, v + 0.5F, cell);
      }
    }
  }

 private:
  // Along the tile's axis, over one cell of its square.
  void draw_across(const Tile& tile, const Range& us, const Range& vs, float middle_u, float middle_v,
                   std::int32_t (&cell)[3]) {
    const int axis = tile.facing;
    const float slope_u = std::fabs(tile.slope_u), slope_v = std::fabs(tile.slope_v);
    const float half_u = 0.5F * (us.to_m - us.from_m), half_v = 0.5F * (vs.to_m - vs.from_m);
    const float middle_m = tile.height_m - corner_[axis] + tile.slope_u * (us.from_m + half_u - middle_u) +
                           tile.slope_v * (vs.from_m + half_v - middle_v);
    const float reach_m = slope_u * half_u + slope_v * half_v + kLayer_m + kMargin_m;
    const std::int32_t first = cell_of(middle_m - reach_m, axis);
    std::int32_t count = cell_of(middle_m + reach_m, axis) - first + 1;
    count = count < kAcrossMost ? count : kAcrossMost;
    for (std::int32_t k = 0; k < count; ++k) {
      cell[axis] = first + k;
      const std::uint32_t x = static_cast<std::uint32_t>(cell[0]) & (kSide - 1);
      const std::uint32_t y = static_cast<std::uint32_t>(cell[1]) & (kSide - 1);
      std::uint64_t* const word = &bits_[layer_of(tile.facing, cell[2]) + x / kWord * kColumn + y];
      *word |= std::uint64_t{1} << (x % kWord);
      if (y < kAgain) word[kSide] = *word;
    }
    cells_ += static_cast<std::uint32_t>(count);
  }

  Eigen::Vector3f corner_;
  Span<std::uint64_t> bits_;
  std::uint32_t cells_ = 0;
};

// A word of two rows, one above the other.
using Words = std::uint64_t __attribute__((vector_size(kRowsAtOnce * sizeof(std::uint64_t))));

// Counts of 64 places of two rows, digit by digit: bit i of digit[d] is digit d of place i.
class BitCounts {
 public:
  void add(Words ones) {
    for (Words& digit : digit_) carry_into(&digit, &ones);
  }
  // Eight at once, by full adders (Harley and Seal).
  void add(const Words (&x)[kAtOnce]) {
    Words twos[4], fours[2];
    for (int k = 0; k < 4; ++k) twos[k] = add_two(x[2 * k], x[2 * k + 1], &digit_[0]);
    for (int k = 0; k < 2; ++k) fours[k] = add_two(twos[2 * k], twos[2 * k + 1], &digit_[1]);
    Words carry = add_two(fours[0], fours[1], &digit_[2]);
    for (int d = 3; d < kCounts; ++d) carry_into(&digit_[d], &carry);
  }
  // Those of places 8 k to 8 k + 7 of a row, a byte each, the first lowest.
  std::uint64_t eight(std::uint32_t row, std::uint32_t k) const {
    // A bit in each byte: the lowest one of all, and the k-th one of the k-th.
    constexpr std::uint64_t kOnes = 0x0101010101010101ULL, kDiagonal = 0x8040201008040201ULL;
    std::uint64_t counts = 0;
    for (int d = 0; d < kCounts; ++d) {
      const std::uint64_t each = ((digit_[d][row] >> (8 * k) & 0xFF) * kOnes) & kDiagonal;
      counts |= ((each + 0x7F * kOnes) >> 7 & kOnes) << d;
    }
    return counts;
  }

 private:
  static void carry_into(Words* digit, Words* carry) {
    const Words both = *digit & *carry;
    *digit ^= *carry;
    *carry = both;
  }
  // Gives the carry.
  static Words add_two(Words a, Words b, Words* digit) {
    const Words c = *digit, one = a ^ b;
    *digit = one ^ c;
    return (a & b) | (one & c);
  }

  Words digit_[kCounts] = {};
};

inline Words words_at(const std::uint64_t* at) {
  Words words;
  std::memcpy(&words, at, sizeof words);
  return words;
}

inline Words bits_at(const std::uint64_t* bits, const BitWindow& w, std::uint32_t row) {
  const Words low = words_at(bits + row + w.low), high = words_at(bits + row + w.high);
  return low >> w.shift | high << 1 << (kWord - 1 - w.shift);
}

// Of a row and the next one.
BitCounts count_rows(const std::uint64_t* bits, Span<const BitWindow> windows, std::uint32_t row) {
  BitCounts counts;
  std::uint32_t i = 0;
  for (; i + kAtOnce <= windows.size(); i += kAtOnce) {
    Words eight[kAtOnce];
    for (std::uint32_t k = 0; k < kAtOnce; ++k) eight[k] = bits_at(bits, windows[i + k], row);
    counts.add(eight);
  }
  for (; i < windows.size(); ++i) counts.add(bits_at(bits, windows[i], row));
  return counts;
}

// Where each observation looks from the first place of the first row.
void open_windows(const ReliefMap& map, Span<const Observation> asked, Span<const std::uint8_t> facing,
                  const Pose& turned, int places, Span<BitWindow> windows) {
  const LocalPose local(turned, map.corner());
  for (std::uint32_t i = 0; i < asked.size(); ++i) {
    const Observation& o = asked[i];
    const Eigen::Vector3f p = local(Eigen::Vector3f(o.x, o.y, o.z));
    const std::uint32_t x = static_cast<std::uint32_t>(cell_of(p.x(), 0) - places) & (kSide - 1);
    const std::uint32_t y = static_cast<std::uint32_t>(cell_of(p.y(), 1) - places) & (kSide - 1);
    const std::uint32_t first = layer_of(facing[i], cell_of(p.z(), 2)) + y, word = x / kWord;
    windows[i] = {first + word * kColumn, first + (word + 1) % kWords * kColumn, x % kWord};
  }
}

// Bounds in their unit, from whole 256ths of it: shares are rounded up and costs down, so that a bound stays one.
class Levels {
 public:
  Levels(std::uint32_t asked, int places) {
    for (std::uint32_t count = 0; count <= asked; ++count) {
      share_[count] = static_cast<std::uint32_t>(kParts * count / asked) + 1;
    }
    for (int x = -places; x <= places; ++x) cost_[x + places] = parts_of({0, x, 0});
  }
  static std::uint32_t parts_of(const Start& start) { return static_cast<std::uint32_t>(kParts * start.cost()); }

  std::uint8_t of(std::uint32_t count, std::uint32_t cost_of_row, std::uint32_t in_row) const {
    const std::uint32_t share = share_[count], cost = cost_of_row + cost_[in_row];
    const std::uint32_t level = share > cost ? (share - cost + 255) / 256 : 0;
    return static_cast<std::uint8_t>(level < 255 ? level : 255);
  }

 private:
  static constexpr double kParts = 256.0 / kBoundUnit;  // of a whole share: 256 of a bound's unit
  std::uint32_t share_[kAskedMost + 1] = {}, cost_[kStartsInRow] = {};
};

// The best first, by counting; of the last level that has room as many as fit.
std::uint32_t sort_best(Span<const std::uint8_t> bounds, const std::uint32_t (&of_level)[256],
                        Span<std::uint32_t> best) {
  std::uint32_t next[256] = {}, count = 0;
  std::uint32_t level = 255;
  for (; level > 0 && count < best.size(); --level) {
    next[level] = count;
    count += of_level[level];
  }
  for (std::uint32_t i = 0; i < bounds.size(); ++i) {
    if (bounds[i] > level && next[bounds[i]] < best.size()) best[next[bounds[i]]++] = i;
  }
  return count < best.size() ? count : best.size();
}

}  // namespace

Start StartGrid::at(std::uint32_t index) const {
  const std::uint32_t row = index / in_row();
  return {static_cast<int>(row / in_row()) - yaws, static_cast<int>(index % in_row()) - places,
          static_cast<int>(row % in_row()) - places};
}

void StartScratch::lay_out(Arena& arena) {
  bits = arena.take<std::uint64_t>(kFacings * kBins * kLayerWords);
  bound = arena.take<std::uint8_t>(kStartsInRow * kStartsInRow * kStartsInRow);
  best = arena.take<std::uint32_t>(kExactMost);
  asked = arena.take<Observation>(kAskedMost);
  facing = arena.take<std::uint8_t>(kStartsInRow * kAskedMost);
  window = arena.take<BitWindow>(kAskedMost);
}

void find_facings(const Eigen::Matrix3d& R_map_base, Span<const Observation> asked, Span<std::uint8_t> facing) {
  const Eigen::Matrix3f R = R_map_base.cast<float>();
  for (std::uint32_t i = 0; i < asked.size(); ++i) {
    const Observation& o = asked[i];
    facing[i] = o.facing;
    facing_of(R * Eigen::Vector3f(o.normal[0], o.normal[1], o.normal[2]), &facing[i]);
  }
}

std::uint32_t count_starts(const ReliefMap& map, Span<const Observation> asked, const Pose& pose, const StartGrid& grid,
                           StartScratch* scratch, Work* work) {
  if (asked.size() == 0) return 0;
  scratch->bits.fill(0);
  Drawing drawing(map.corner(), scratch->bits);
  for (std::uint32_t t = 0; t < map.tiles(); ++t) {
    if (map.tile(t).fresh == 0) drawing.draw(map.tile(t));
  }
  work->add(drawing.cells(), steps::kCellDrawn);
  const Levels levels(asked.size(), grid.places);
  std::uint32_t of_level[256] = {}, at = 0;
  const Span<BitWindow> windows = scratch->window.first(asked.size());
  const std::uint64_t rows = grid.starts() / grid.in_row(), yaws = rows / grid.in_row();
  work->add(yaws * asked.size(), steps::kWindowOpened);
  work->add(rows * ((asked.size() + kAtOnce - 1) / kAtOnce), steps::kEightWindows);
  work->add(grid.starts(), steps::kStartBounded);
  for (int yaw = -grid.yaws; yaw <= grid.yaws; ++yaw) {
    const Pose turned = {grid.turn(yaw) * pose.R, pose.t};
    const Span<std::uint8_t> facing = grid.of_yaw(scratch->facing, asked.size(), yaw);
    find_facings(turned.R, asked, facing);
    open_windows(map, asked, facing, turned, grid.places, windows);
    BitCounts counts;
    for (std::uint32_t row = 0; row < grid.in_row(); ++row) {
      const std::uint32_t odd = row % kRowsAtOnce;
      if (odd == 0) counts = count_rows(scratch->bits.data(), windows, row);
      const std::uint32_t cost = Levels::parts_of({yaw, 0, static_cast<int>(row) - grid.places});
      std::uint64_t eight = 0;
      for (std::uint32_t i = 0; i < grid.in_row(); ++i, ++at) {
        eight = i % 8 == 0 ? counts.eight(odd, i / 8) : eight >> 8;
        const std::uint8_t level = levels.of(static_cast<std::uint32_t>(eight & 0xFF), cost, i);
        scratch->bound[at] = level;
        ++of_level[level];
      }
    }
  }
  return sort_best(scratch->bound.first(at), of_level, scratch->best);
}

}  // namespace pose_wall::motion
