// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/bare_layout_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numeric>
#include <utility>

#include "io/frames/column_kinds.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// Of one size the more telling comes first. KITTI has xyzi, nuScenes xyzir, Waymo's exports xyzi__, a dump of PCL's
// PointXYZI xyz_i___, one of a Velodyne driver's points xyz_irt_, or xyz_i_t_ where its ring is a whole number.
constexpr std::string_view kCandidates[] = {
    "xyz",   "xyzt",   "xyzi",     "xyz_",     "xyzir",    "xyzit",    "xyzi_",    "xyzirt",   "xyzitr",  "xyzi__",
    "xyz64", "xyzi64", "xyz_irt_", "xyz_itr_", "xyz_i_t_", "xyz_ir__", "xyz_it__", "xyz_i___", "xyz_____"};

// Nobody is known to write times in the place of intensities.
constexpr std::string_view kAskedAbout = "xyzt";

// Samples start at multiples of this: a whole number of points of every candidate, and of two to four in a row.
// (2^5 * 3 * 5 and 2^6 * 3^2 * 5 bytes.)
constexpr std::size_t kBlockBytes = 480, kLongBlockBytes = 2880;
constexpr std::size_t kLongBlocksMin = 8;
constexpr std::size_t kSampledBytes = 245'760;
constexpr std::size_t kGuessPointsMin = 64;  // fewer do not show what their columns are
constexpr double kPlausibleShareMin = 0.99;  // of the points
constexpr double kCoordinateMin_m = 1e-4,
                 kCoordinateMax_m = 1e6;   // nearer than a tenth of a millimetre measures nothing
constexpr double kIntensityMax = 65535.0;  // of 16 bits
constexpr double kExplainedMin = 0.01;     // 20 times what chance explains in kBlocksMax blocks
constexpr double kExplainedRatio = 4.0;    // the right layout explains so much more than a wrong one
constexpr double kMultipleRatio = 1.5;     // two points taken as one explain the same
// Points of one layout differ little from their neighbours: by rings that see the floor or the roof, less than this
// factor in the mean of |value|.
constexpr double kNeighbourMost_log2 = 1.75;
constexpr double kNeighbourValuesMin = 32.0;
constexpr std::size_t kPointsInOneMax = 4;
constexpr std::size_t kAskedColumnsMax = 16;

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
    default:
      return true;
  }
}

// Blocks spread evenly over the file.
struct Sample {
  std::vector<const std::byte*> blocks;
  std::size_t block_bytes = kBlockBytes, file_bytes = 0;

  // Calls visit(point) for every point of these bytes in the blocks.
  template <typename Visit>
  void for_each(std::size_t point_bytes, const Visit& visit) const {
    for (const std::byte* block : blocks) {
      for (std::size_t at = 0; at + point_bytes <= block_bytes; at += point_bytes) visit(block + at);
    }
  }
};

Sample sample(const Bytes& bytes) {
  Sample sample;
  sample.file_bytes = bytes.size();
  if (bytes.size() >= kLongBlocksMin * kLongBlockBytes) sample.block_bytes = kLongBlockBytes;
  const std::size_t whole = bytes.size() / sample.block_bytes;
  const std::size_t taken = std::min(whole, kSampledBytes / sample.block_bytes);
  for (std::size_t i = 0; i < taken; ++i) {
    sample.blocks.push_back(bytes.data() + i * whole / taken * sample.block_bytes);
  }
  return sample;
}

struct Score {
  BareLayout layout;
  std::size_t points = 0;  // that hold a return
  double plausible = 0.0;  // share of the points
  double explained = 0.0;  // share of the variance of log2|value|, by column
  bool is_known = true;    // else it is only asked about

  bool is_likely() const { return plausible >= kPlausibleShareMin; }
};

// Sums of log2|value| of the values that are not zero.
struct ColumnSums {
  double count = 0.0, sum = 0.0, squares = 0.0, whole = 0.0;
  double least = 1e300, most = -1e300;

  void add(double value) {
    if (value == 0.0 || !std::isfinite(value)) return;
    const double size = std::clamp(std::log2(std::fabs(value)), -40.0, 40.0);
    whole += value == std::floor(value) ? 1.0 : 0.0;
    least = std::min(least, value);
    most = std::max(most, value);
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

Score score_of(const BareLayout& layout, const Sample& sample) {
  Score score;
  score.layout = layout;
  std::vector<ColumnSums> columns(layout.columns.size());
  std::size_t plausible = 0, points = 0;
  sample.for_each(layout.point_step(), [&](const std::byte* point) {
    ++points;
    if (look_at_point(point, layout, &columns, &score)) ++plausible;
  });
  score.plausible = points > 0 ? static_cast<double>(plausible) / static_cast<double>(points) : 1.0;
  score.explained = explained_share(columns);
  return score;
}

ColumnKind kind_of(const BareLayout& layout, std::size_t column, const Sample& sample) {
  ColumnLook look;
  sample.for_each(layout.point_step(), [&](const std::byte* point) {
    const auto value = [&](std::size_t i) { return value_at(point + i * layout.value_bytes, layout.value_bytes); };
    look.add(value(column), value(0), value(1), value(2));
  });
  return look.kind();
}

// Whether the columns that are told as rings and times are.
bool fits_kinds(const BareLayout& layout, const Sample& sample) {
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const char letter = layout.columns[i];
    if (letter == 'r' && kind_of(layout, i, sample) != ColumnKind::kRing) return false;
    if (letter == 't' && kind_of(layout, i, sample) != ColumnKind::kTime) return false;
  }
  return true;
}

// Those whose points fill the file, of each number of bytes the most telling that its values allow.
std::vector<Score> likely_layouts(const Sample& sample) {
  std::vector<Score> likely;
  for (const std::string_view word : kCandidates) {
    const BareLayout layout = *parse_bare_layout(word);
    if (sample.file_bytes % layout.point_step() != 0) continue;
    const auto is_told = [&layout](const Score& other) { return other.layout.same_bytes(layout); };
    if (std::any_of(likely.begin(), likely.end(), is_told)) continue;
    Score score = score_of(layout, sample);
    score.is_known = word != kAskedAbout;
    if (score.is_likely() && fits_kinds(layout, sample)) likely.push_back(score);
  }
  return likely;
}

// Values of two kinds: they cannot be the same coordinate of neighbouring points.
bool differ_in_kind(const ColumnSums& a, const ColumnSums& b) {
  if (std::min(a.count, b.count) < kNeighbourValuesMin) return std::max(a.count, b.count) >= 4.0 * kNeighbourValuesMin;
  const auto is_whole = [](const ColumnSums& sums) {  // a wall at 2500 mm is whole, too, but always the same
    return sums.whole >= kPlausibleShareMin * sums.count && sums.least < sums.most;
  };
  const auto is_broken = [](const ColumnSums& sums) { return sums.whole <= 0.5 * sums.count; };
  if ((is_whole(a) && is_broken(b)) || (is_whole(b) && is_broken(a))) return true;
  return std::fabs(a.sum / a.count - b.sum / b.count) >= kNeighbourMost_log2;
}

// So many points of the layout in a row are one point of another: some of them hold other things than coordinates.
// 1 where all points are alike.
std::size_t points_in_one(const BareLayout& layout, const Sample& sample) {
  const std::size_t columns = layout.columns.size();
  for (std::size_t points = 2; points <= kPointsInOneMax; ++points) {
    const std::size_t step = points * layout.point_step();
    if (sample.file_bytes % step != 0 || sample.block_bytes % step != 0) continue;
    std::vector<ColumnSums> sums(points * columns);
    sample.for_each(step, [&](const std::byte* point) {
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i].add(value_at(point + i * layout.value_bytes, layout.value_bytes));
      }
    });
    for (std::size_t i = columns; i < sums.size(); ++i) {
      if (i % columns < 3 && differ_in_kind(sums[i % columns], sums[i])) return points;
    }
  }
  return 1;
}

// x y z, and behind them what the values show.
BareLayout layout_by_kinds(std::size_t columns, std::uint32_t value_bytes, const Sample& sample) {
  BareLayout layout{"xyz" + std::string(columns - 3, '_'), value_bytes};
  for (std::size_t i = 3; i < columns; ++i) {
    const ColumnKind kind = kind_of(layout, i, sample);
    const char letter = kind == ColumnKind::kRing ? 'r' : kind == ColumnKind::kTime ? 't' : 'i';
    if (kind == ColumnKind::kConstant || layout.columns.find(letter) != std::string::npos) continue;
    layout.columns[i] = letter;
    if (!score_of(layout, sample).is_likely()) layout.columns[i] = '_';
  }
  return layout;
}

// Takes out those whose points are parts of larger ones, and puts in the larger ones, to be asked about where they are
// of no known layout.
std::vector<Score> take_parts_out(std::vector<Score>* likely, const Sample& sample) {
  std::vector<Score> parts, kept;
  for (const Score& score : *likely) (points_in_one(score.layout, sample) > 1 ? parts : kept).push_back(score);
  for (const Score& part : parts) {
    const std::size_t columns = points_in_one(part.layout, sample) * part.layout.columns.size();
    if (columns > kAskedColumnsMax) continue;
    const BareLayout whole = layout_by_kinds(columns, part.layout.value_bytes, sample);
    const auto is_told = [&whole](const Score& other) { return other.layout.same_bytes(whole); };
    if (std::any_of(kept.begin(), kept.end(), is_told)) continue;
    Score asked = score_of(whole, sample);
    asked.is_known = false;
    kept.push_back(asked);
  }
  *likely = std::move(kept);
  return parts;
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
double explained_by_both(const BareLayout& a, const BareLayout& b, const Sample& sample) {
  const std::size_t columns = std::gcd(a.columns.size(), b.columns.size());
  if (a.value_bytes != b.value_bytes || columns == 1) return 0.0;
  return score_of({std::string(columns, '_'), a.value_bytes}, sample).explained;
}

// A wrong layout tells no more than what it has in common with the right one.
bool wins_clearly(const std::vector<Score>& likely, const Sample& sample) {
  if (likely.empty() || !likely.front().is_known || likely.front().explained < kExplainedMin) return false;
  const Score& first = likely.front();
  return std::all_of(likely.begin() + 1, likely.end(), [&](const Score& other) {
    const double common = explained_by_both(first.layout, other.layout, sample);
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
  const Sample values = sample(bytes);
  std::vector<Score> likely = likely_layouts(values);
  const bool has_points =
      std::any_of(likely.begin(), likely.end(), [](const Score& s) { return s.points >= kGuessPointsMin; });
  if (bytes.size() < kGuessPointsMin * 16 || (!likely.empty() && !has_points)) return guess_by_size(bytes.size());
  const std::vector<Score> parts = take_parts_out(&likely, values);
  drop_multiples(&likely);
  std::stable_sort(likely.begin(), likely.end(),
                   [](const Score& a, const Score& b) { return a.explained > b.explained; });
  BareGuess guess;
  guess.is_clear = wins_clearly(likely, values);
  for (const Score& score : likely) guess.possible.push_back(score.layout);
  if (!likely.empty() && bare_layout_word(likely.front().layout) == kAskedAbout) {
    guess.possible.insert(guess.possible.begin() + 1, *parse_bare_layout("xyzi"));
  }
  for (const Score& part : parts) guess.possible.push_back(part.layout);
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
