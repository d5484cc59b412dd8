// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/bare_layout_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numeric>
#include <utility>

#include "frames/text_cursor.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

// Of one size the more telling comes first. KITTI has xyzi, nuScenes xyzir, Waymo's exports xyzi__, a dump of PCL's
// PointXYZI xyz_i___.
constexpr std::string_view kCandidates[] = {"xyz",    "xyzi",  "xyz_",   "xyzir",    "xyzi_",   "xyzirt",
                                            "xyzi__", "xyz64", "xyzi64", "xyz_i___", "xyz_____"};

// Samples start at multiples of this: a whole number of points of every candidate. (2^5 * 3 * 5 bytes.)
constexpr std::size_t kBlockBytes = 480;
constexpr std::size_t kBlocksMax = 512;
constexpr std::size_t kGuessPointsMin = 64;  // fewer do not show what their columns are
constexpr double kPlausibleShareMin = 0.99;  // of the points
constexpr double kCoordinateMin_m = 1e-4,
                 kCoordinateMax_m = 1e6;   // nearer than a tenth of a millimetre measures nothing
constexpr double kIntensityMax = 65535.0;  // of 16 bits
constexpr double kRingMax = 255.0;
constexpr double kExplainedMin = 0.01;   // 20 times what chance explains in kBlocksMax blocks
constexpr double kExplainedRatio = 4.0;  // the right layout explains so much more than a wrong one
constexpr double kMultipleRatio = 1.5;   // two points taken as one explain the same

double value_at(const std::byte* at, std::uint32_t value_bytes) {
  if (value_bytes == 8) {
    double value = 0.0;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
  float value = 0.0F;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

bool is_plausible(char letter, double value) {
  const double size = std::fabs(value);
  switch (letter) {
    case 'x':
    case 'y':
    case 'z':
      return value == 0.0 || (size >= kCoordinateMin_m && size <= kCoordinateMax_m) || std::isnan(value);
    case 'i':
      return (value >= 0.0 && value <= kIntensityMax) || std::isnan(value);
    case 'r':
      return value >= 0.0 && value <= kRingMax && value == std::floor(value);
    case 't':
      return std::isfinite(value);
    default:
      return true;
  }
}

// Blocks spread evenly over the file.
std::vector<const std::byte*> sample(const Bytes& bytes) {
  std::vector<const std::byte*> blocks;
  const std::size_t whole = bytes.size() / kBlockBytes;
  const std::size_t taken = std::min(whole, kBlocksMax);
  for (std::size_t i = 0; i < taken; ++i) blocks.push_back(bytes.data() + i * whole / taken * kBlockBytes);
  return blocks;
}

struct Score {
  BareLayout layout;
  std::size_t points = 0;  // that hold a return
  double plausible = 0.0;  // share of the points
  double explained = 0.0;  // share of the variance of log2|value|, by column

  bool is_likely() const { return plausible >= kPlausibleShareMin; }
};

// Sums of log2|value| of the values that are not zero.
struct ColumnSums {
  double count = 0.0, sum = 0.0, squares = 0.0;

  void add(double value) {
    if (value == 0.0 || !std::isfinite(value)) return;
    const double size = std::clamp(std::log2(std::fabs(value)), -40.0, 40.0);
    count += 1.0;
    sum += size;
    squares += size * size;
  }
};

double explained_share(const std::vector<ColumnSums>& columns) {
  ColumnSums all;
  double between = 0.0;
  for (const ColumnSums& column : columns) {
    all.count += column.count;
    all.sum += column.sum;
    all.squares += column.squares;
    if (column.count > 0.0) between += column.sum * column.sum / column.count;
  }
  if (all.count == 0.0) return 0.0;
  const double of_mean = all.sum * all.sum / all.count;
  const double total = all.squares - of_mean;
  return total > 0.0 ? (between - of_mean) / total : 0.0;
}

bool look_at_point(const std::byte* point, const BareLayout& layout, std::vector<ColumnSums>* columns, Score* score) {
  bool plausible = true, is_return = false;
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const double value = value_at(point + i * layout.value_bytes, layout.value_bytes);
    plausible = plausible && is_plausible(layout.columns[i], value);
    is_return = is_return || (i < 3 && std::isfinite(value) && value != 0.0);
    (*columns)[i].add(value);
  }
  if (is_return) ++score->points;
  return plausible;
}

Score score_of(const BareLayout& layout, const std::vector<const std::byte*>& blocks) {
  Score score;
  score.layout = layout;
  std::vector<ColumnSums> columns(layout.columns.size());
  std::size_t plausible = 0, points = 0;
  for (const std::byte* block : blocks) {
    for (std::size_t at = 0; at + layout.point_step() <= kBlockBytes; at += layout.point_step(), ++points) {
      if (look_at_point(block + at, layout, &columns, &score)) ++plausible;
    }
  }
  score.plausible = points > 0 ? static_cast<double>(plausible) / static_cast<double>(points) : 1.0;
  score.explained = explained_share(columns);
  return score;
}

// Those whose points fill the file, of each number of bytes the most telling that its values allow.
std::vector<Score> likely_layouts(const Bytes& bytes, const std::vector<const std::byte*>& blocks) {
  std::vector<Score> likely;
  for (const std::string_view word : kCandidates) {
    const BareLayout layout = *parse_bare_layout(word);
    if (bytes.size() % layout.point_step() != 0) continue;
    const auto is_told = [&layout](const Score& other) { return other.layout.same_bytes(layout); };
    if (std::any_of(likely.begin(), likely.end(), is_told)) continue;
    const Score score = score_of(layout, blocks);
    if (score.is_likely()) likely.push_back(score);
  }
  return likely;
}

// Two or more points of the first are one of the second, and its columns tell no more.
bool is_multiple(const Score& one, const Score& more) {
  return one.layout.value_bytes == more.layout.value_bytes && more.layout.point_step() > one.layout.point_step() &&
         more.layout.point_step() % one.layout.point_step() == 0 && more.explained < kMultipleRatio * one.explained;
}

void drop_multiples(std::vector<Score>* likely) {
  const auto found = [likely](const Score& more) {
    return std::any_of(likely->begin(), likely->end(), [&more](const Score& one) { return is_multiple(one, more); });
  };
  std::vector<Score> kept;
  std::copy_if(likely->begin(), likely->end(), std::back_inserter(kept),
               [&found](const Score& s) { return !found(s); });
  *likely = std::move(kept);
}

// What the columns tell that both layouts have in common: those of every greatest common divisor of both steps. Nothing
// where the values are of two types.
double explained_by_both(const BareLayout& a, const BareLayout& b, const std::vector<const std::byte*>& blocks) {
  const std::size_t columns = std::gcd(a.columns.size(), b.columns.size());
  if (a.value_bytes != b.value_bytes || columns == 1) return 0.0;
  return score_of({std::string(columns, '_'), a.value_bytes}, blocks).explained;
}

// A wrong layout tells no more than what it has in common with the right one.
bool wins_clearly(const std::vector<Score>& likely, const std::vector<const std::byte*>& blocks) {
  if (likely.empty() || likely.front().explained < kExplainedMin) return false;
  const Score& first = likely.front();
  return std::all_of(likely.begin() + 1, likely.end(), [&](const Score& other) {
    const double common = explained_by_both(first.layout, other.layout, blocks);
    return (other.explained - common) * kExplainedRatio <= first.explained - common;
  });
}

// Too few values to tell: the two common layouts are asked about, by the size alone.
BareGuess guess_by_size(std::size_t bytes) {
  BareGuess guess;
  for (const char* word : {"xyzi", "xyz"}) {
    const BareLayout layout = *parse_bare_layout(word);
    if (bytes % layout.point_step() == 0) guess.possible.push_back(layout);
  }
  guess.is_clear = guess.possible.size() == 1 || bytes == 0;
  return guess;
}

}  // namespace

BareGuess guess_bare_layout(const Bytes& bytes) {
  const std::vector<const std::byte*> blocks = sample(bytes);
  std::vector<Score> likely = likely_layouts(bytes, blocks);
  const bool has_points =
      std::any_of(likely.begin(), likely.end(), [](const Score& s) { return s.points >= kGuessPointsMin; });
  if (bytes.size() < kGuessPointsMin * 16 || (!likely.empty() && !has_points)) return guess_by_size(bytes.size());
  drop_multiples(&likely);
  std::stable_sort(likely.begin(), likely.end(),
                   [](const Score& a, const Score& b) { return a.explained > b.explained; });
  BareGuess guess;
  guess.is_clear = wins_clearly(likely, blocks);
  for (const Score& score : likely) guess.possible.push_back(score.layout);
  return guess;
}

std::string unclear_layout_text(const BareGuess& guess, std::size_t bytes) {
  const std::string way = say("--layout says which ({})", bare_layout_rule());
  if (guess.possible.empty()) {
    return say("no header is known, and {} bytes do not look like bare points of float32 or float64; {}", bytes, way);
  }
  const std::string first = bare_layout_words(guess.possible.front());
  if (guess.possible.size() == 1) {
    return say("there is no header, and the values do not show how many make a point; {} is possible; {}", first, way);
  }
  return say("there is no header, and the values leave a choice: {}, or {}; --layout {} or --layout {} says which",
             first, bare_layout_words(guess.possible[1]), bare_layout_word(guess.possible[0]),
             bare_layout_word(guess.possible[1]));
}

Frame read_guessed_points(Bytes bytes) {
  const BareGuess guess = guess_bare_layout(bytes);
  if (const BareLayout* layout = guess.clear()) return read_bare_points(std::move(bytes), *layout);
  throw FrameError(unclear_layout_text(guess, bytes.size()));
}

}  // namespace pose_wall::tools
