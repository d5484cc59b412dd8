// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/result_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kNoCell = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kUnreadRow = "unreadable";

class ResultTableReader {
 public:
  explicit ResultTableReader(const CsvTable& table) : table_(table) {}

  FrameOutcome outcome(std::size_t row) {
    row_ = row;
    FrameOutcome out;
    out.frame = whole<std::uint64_t>("frame");
    out.source = text("source");
    out.stamp_ns = whole<std::int64_t>("stamp_ns");
    out.total_ms = number("total_ms");
    if (const double angle_rad = number(kLimitColumns[0]); angle_rad > 0.0) out.limits.angle_rad = angle_rad;
    if (const double distance_m = number(kLimitColumns[1]); distance_m > 0.0) out.limits.distance_m = distance_m;
    if (text("status") == kUnreadRow) {
      out.error = text("error");
      if (out.error.empty()) out.error = kUnreadRow;
      return out;
    }
    pose_wall_result& result = out.result.emplace(api::make_result());
    result.confidence = number("confidence");
    result.frame_reasons = reasons("frame_reason");
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) result.quantity[q] = value(q);
    read_counts(result);
    for (std::uint32_t stage = 0; stage < POSE_WALL_STAGES; ++stage) {
      const double ms = number(fmt::format("{}_ms", pose_wall_stage_name(stage)));
      result.stage_ns[stage] = std::isfinite(ms) ? std::llround(1e6 * ms) : 0;
    }
    return out;
  }

 private:
  // Empty for a column that is not there.
  std::string text(const std::string& name) const {
    const std::optional<std::size_t> column = table_.find_column(name);
    return column ? table_.cell(row_, *column) : std::string();
  }

  double number(const std::string& name) const {
    const std::optional<std::size_t> column = table_.find_column(name);
    return column ? table_.number(row_, *column) : kNoCell;
  }

  [[noreturn]] void refuse(const std::string& name, const char* what) const {
    throw CsvError(say("line {}, column {}: '{}' is no {}", table_.line(row_), name, text(name), tr(what)));
  }

  template <typename Integer>
  Integer whole(const char* name) const {
    const std::optional<Integer> number = parse_number<Integer>(text(name));
    if (!number) refuse(name, translatable("whole number"));
    return *number;
  }

  std::uint32_t state(const std::string& name) const {
    const std::string cell = text(name);
    for (std::uint32_t state = POSE_WALL_INVALID; state <= POSE_WALL_VALID; ++state) {
      if (cell == pose_wall_state_name(state)) return state;
    }
    refuse(name, translatable("state"));
  }

  // Names joined by '|'.
  std::uint32_t reasons(const std::string& name) const {
    const std::string cell = text(name);
    std::uint32_t bits = 0;
    for (std::size_t from = 0; from < cell.size();) {
      const std::size_t to = std::min(cell.find('|', from), cell.size());
      const std::string one = cell.substr(from, to - from);
      std::uint32_t bit = 0;
      while (bit < POSE_WALL_REASON_COUNT && one != pose_wall_reason_name(bit)) ++bit;
      if (bit == POSE_WALL_REASON_COUNT) refuse(name, translatable("list of reasons"));
      bits |= 1U << bit;
      from = to + 1;
    }
    return bits;
  }

  std::uint32_t cause(const std::string& name) const {
    const std::string cell = text(name);
    for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
      if (cell == pose_wall_part_name(part)) return part;
    }
    return POSE_WALL_PARTS;
  }

  pose_wall_value value(std::uint32_t q) const {
    const std::string name = pose_wall_quantity_name(q);
    pose_wall_value v{};
    v.value = number(name);
    v.raw = number(name + "_raw");
    v.sigma = number(name + "_sigma");
    v.protection_level = number(name + "_pl");
    v.state = state(name + "_state");
    v.confidence = number(name + "_confidence");
    v.age_s = number(name + "_age_s");
    v.reasons = reasons(name + "_reason");
    v.raw_protection_level = number(name + "_raw_pl");
    v.cause = cause(name + "_cause");
    for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
      v.part[part] = number(fmt::format("{}_pl_{}", name, pose_wall_part_name(part)));
    }
    return v;
  }

  void read_counts(pose_wall_result& r) const {
    const std::pair<const char*, std::uint32_t*> counts[] = {{"points_in", &r.points_in},
                                                             {"dropped_not_finite", &r.dropped_not_finite},
                                                             {"dropped_zero", &r.dropped_zero},
                                                             {"dropped_near", &r.dropped_near},
                                                             {"dropped_far", &r.dropped_far},
                                                             {"dropped_body", &r.dropped_body},
                                                             {"voxels", &r.voxels},
                                                             {"outliers", &r.outliers},
                                                             {"open_points", &r.open_points},
                                                             {"wall_points", &r.wall_points}};
    for (const auto& [name, count] : counts) *count = parse_number<std::uint32_t>(text(name)).value_or(0);
  }

  const CsvTable& table_;
  std::size_t row_ = 0;
};

}  // namespace

std::vector<std::string> missing_result_columns(const CsvTable& table) {
  std::vector<std::string> needed = {"frame", "source", "stamp_ns", "status"};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    for (const char* ending : {"", "_raw", "_sigma", "_pl", "_state"}) {
      needed.push_back(std::string(pose_wall_quantity_name(q)) + ending);
    }
  }
  std::vector<std::string> missing;
  for (const std::string& name : needed) {
    if (!table.find_column(name)) missing.push_back(name);
  }
  return missing;
}

std::vector<FrameOutcome> read_result_table(const CsvTable& table) {
  const std::vector<std::string> missing = missing_result_columns(table);
  if (!missing.empty()) throw CsvError(say("the table of run lacks the columns {}", fmt::join(missing, ", ")));
  ResultTableReader reader(table);
  std::vector<FrameOutcome> outcomes;
  for (std::size_t row = 0; row < table.rows(); ++row) outcomes.push_back(reader.outcome(row));
  return outcomes;
}

}  // namespace pose_wall::tools
