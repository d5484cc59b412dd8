// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "io/csv/csv_table.hpp"
#include "io/numbers/quantities.hpp"
#include "lab/campaign/record_file.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr std::array<const char*, 6> kPhases = {"", "before", "event", "after", "drive_in", "first"};

std::uint32_t bit_of(const std::string& reason) {
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if (reason == pose_wall_reason_name(bit)) return 1U << bit;
  }
  throw CsvError(fmt::format("'{}' is no reason", reason));
}

std::vector<std::string> parts_of(const std::string& cell) {
  std::vector<std::string> parts;
  std::istringstream words(cell);
  for (std::string word; std::getline(words, word, '|');) parts.push_back(word);
  return parts;
}

std::uint32_t reasons_of(const std::string& names) {
  std::uint32_t bits = 0;
  for (const std::string& name : parts_of(names)) bits |= bit_of(name);
  return bits;
}

std::uint32_t state_of(const std::string& name) {
  for (std::uint32_t state = POSE_WALL_INVALID; state <= POSE_WALL_VALID; ++state) {
    if (name == pose_wall_state_name(state)) return state;
  }
  throw CsvError(fmt::format("'{}' is no state", name));
}

Phase phase_of(const std::string& name) {
  for (std::size_t i = 0; i < kPhases.size(); ++i) {
    if (name == kPhases[i]) return static_cast<Phase>(i);
  }
  throw CsvError(fmt::format("'{}' is no phase of a run", name));
}

constexpr std::size_t kFirstQuantity = 9;  // columns before it
constexpr std::size_t kPerQuantity = 8;

FrameRecord frame_of(const CsvTable& table, std::size_t row) {
  FrameRecord frame;
  frame.frame = whole_number<std::uint32_t>(table.cell(row, 5));
  frame.stamp_ns = whole_number<std::int64_t>(table.cell(row, 6));
  frame.phase = phase_of(table.cell(row, 7));
  frame.reasons = reasons_of(table.cell(row, 8));
  std::size_t column = kFirstQuantity;
  for (QuantityRecord& q : frame.quantity) {
    q.truth = table.number(row, column);
    q.surveyed = table.number(row, column + 1);
    q.measured = {table.number(row, column + 2), table.number(row, column + 3), table.number(row, column + 4),
                  table.number(row, column + 5), state_of(table.cell(row, column + 6))};
    q.reasons = reasons_of(table.cell(row, column + 7));
    column += kPerQuantity;
  }
  return frame;
}

}  // namespace

double QuantityRecord::judged_truth(double alert_limit) const {
  if (!std::isfinite(surveyed)) return truth;
  if (!std::isfinite(truth)) return surveyed;
  const double low = std::min(truth, surveyed), high = std::max(truth, surveyed);
  const double told = std::isfinite(measured.value) ? measured.value : measured.raw;
  if (!std::isfinite(told)) return truth;
  if (high - low > 2.0 * alert_limit) return std::abs(told - low) < std::abs(told - high) ? low : high;
  return std::clamp(told, low, high);
}

bool is_in_shares(const FrameRecord& frame) {
  return frame.phase != Phase::kDriveIn && frame.phase != Phase::kFirst;
}

bool met_work_limit(const FrameRecord& frame) {
  std::uint32_t reasons = frame.reasons;
  for (const QuantityRecord& q : frame.quantity) reasons |= q.reasons;
  return (reasons & POSE_WALL_R_WORK_LIMIT) != 0;
}

bool same_outcome(const FrameRecord& a, const FrameRecord& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (std::size_t q = 0; q < a.quantity.size(); ++q) {
    const Measured &m = a.quantity[q].measured, &n = b.quantity[q].measured;
    if (m.state != n.state || !same(m.value, n.value) || !same(m.raw, n.raw)) return false;
    if (!same(m.sigma, n.sigma) || !same(m.protection_level, n.protection_level)) return false;
  }
  return true;
}

Judged judge(const FrameRecord& frame, std::size_t quantity, const AlertLimits& limits) {
  const QuantityRecord& v = frame.quantity[quantity];
  return tools::judge(v.measured, v.judged_truth(limit_of(quantity, limits)), is_angle(quantity),
                      limit_of(quantity, limits));
}

std::vector<std::string> record_head() {
  std::vector<std::string> head = run_head();
  head.insert(head.end(), {"set", "frame", "stamp_ns", "phase", "frame_reason"});
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string name = pose_wall_quantity_name(q);
    head.insert(head.end(), {name + "_truth", name + "_surveyed", name, name + "_raw", name + "_sigma", name + "_pl",
                             name + "_state", name + "_reason"});
  }
  return head;
}

std::string record_lines(const RunRecord& record) {
  std::string lines;
  for (const FrameRecord& frame : record.frames) {
    std::vector<std::string> cells = run_cells(record.run);
    cells.insert(cells.end(), {fmt::format("{}", fmt::join(record.run.settings, "|")), std::to_string(frame.frame),
                               std::to_string(frame.stamp_ns), kPhases[static_cast<std::size_t>(frame.phase)],
                               reason_names(frame.reasons)});
    for (const QuantityRecord& q : frame.quantity) {
      for (const double number :
           {q.truth, q.surveyed, q.measured.value, q.measured.raw, q.measured.sigma, q.measured.protection_level}) {
        cells.push_back(csv_number(number));
      }
      cells.insert(cells.end(), {pose_wall_state_name(q.measured.state), reason_names(q.reasons)});
    }
    lines += csv_line(cells);
  }
  return lines;
}

std::string record_table(const RunRecord& record) {
  return csv_line(record_head()) + record_lines(record);
}

void write_record(const std::filesystem::path& file, const RunRecord& record, const std::string& campaign) {
  write_record_file(file, record_table(record), campaign);
}

RunRecord record_of(const CsvTable& table) {
  if (table.head() != record_head()) throw CsvError("not the columns of a record");
  RunRecord record;
  record.run = run_of(table);
  record.run.settings = parts_of(table.cell(0, 4));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    record.frames.push_back(frame_of(table, row));
    ++(record.frames.back().phase == Phase::kDriveIn ? record.run.drive_in_frames : record.run.frames);
  }
  return record;
}

RunRecord read_record(const std::filesystem::path& file, const std::string& campaign) {
  RunRecord record;
  read_record_file(file, campaign, [&record](const CsvTable& table) { record = record_of(table); });
  return record;
}

}  // namespace pose_wall::tools::campaign
