// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a run leaves behind: one row per frame, each quantity beside its truth.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/csv/truth_csv.hpp"
#include "lab/campaign/plan.hpp"
#include "pose_wall.h"
#include "study/truth/alert_limits.hpp"
#include "study/truth/error_statistics.hpp"

namespace pose_wall::tools::campaign {

// Where a frame stands to its run's event; kDriveIn: on the way to where the scene begins; kFirst: the first that its
// engine ever sees, of which no motion is known.
enum class Phase { kNone, kBefore, kEvent, kAfter, kDriveIn, kFirst };

struct QuantityRecord {
  double truth;  // of the ideal road
  Measured measured;
  std::uint32_t reasons;       // pose_wall_reason bits
  double surveyed = kNoTruth;  // of the rock that is really there; in mine classes alone

  // What the value is judged by, and its raw one, which is never far. Rock that bulges has two truths, and what lies
  // between them is not wrong: the nearest of the two, or the value itself. Truths more than two alert limits apart are
  // of two things, and nothing is between them.
  double judged_truth(double alert_limit) const;
};

struct FrameRecord {
  std::uint32_t frame = 0;
  std::int64_t stamp_ns = 0;
  Phase phase = Phase::kNone;
  std::uint32_t reasons = 0;  // of the frame
  std::array<QuantityRecord, POSE_WALL_QUANTITIES> quantity{};
};

// Whether shares count it: what an engine tells on the way in, or of its first frame, is told apart.
bool is_in_shares(const FrameRecord& frame);
// Whether the engine ran out of its work budget (work_max) in it.
bool met_work_limit(const FrameRecord& frame);

// Whether values, levels and states are the same.
bool same_outcome(const FrameRecord& a, const FrameRecord& b);

Judged judge(const FrameRecord& frame, std::size_t quantity, const AlertLimits& limits);

struct RunRecord {
  Run run;
  std::vector<FrameRecord> frames;
};

std::vector<std::string> record_head();
// The rows without the head, as they stand in a file.
std::string record_lines(const RunRecord& record);
// With it.
std::string record_table(const RunRecord& record);

// A record belongs to the campaign whose fingerprint its first line bears. The file appears whole or not at all.
// Throws std::runtime_error that names the file.
void write_record(const std::filesystem::path& file, const RunRecord& record, const std::string& campaign);

// Throws CsvError.
RunRecord record_of(const CsvTable& table);
// Throws std::runtime_error that names the file, for a record of another campaign too.
RunRecord read_record(const std::filesystem::path& file, const std::string& campaign);

}  // namespace pose_wall::tools::campaign
