// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The folder of a campaign: campaign.json, and records/SCENE/SENSOR/DRAW.csv for every run that is finished.

#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "lab/campaign/manifest.hpp"
#include "lab/campaign/record.hpp"

namespace pose_wall::tools::campaign {

// The folder holds records of another campaign.
class StaleError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

std::filesystem::path record_file(const std::filesystem::path& folder, const Run& run);

// Makes the folder, or finds in it what was interrupted. `fresh`: older records go. Throws StaleError that says what
// differs.
void prepare_folder(const std::filesystem::path& folder, const Manifest& manifest, bool fresh);

// Runs without a record.
std::vector<Run> pending_runs(const std::filesystem::path& folder, const std::vector<Run>& runs);

bool has_records(const std::filesystem::path& folder);

// The files of all finished runs, in no order. Throws std::runtime_error where there is none.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& folder);

// Hands over the tables of all records there are, by scene or class (in the order of their table), sensor and draw; one
// at a time, for those of a large campaign fill a memory. Throws std::runtime_error that names the file.
void for_each_record(const std::filesystem::path& folder, const Manifest& manifest,
                     const std::function<void(const CsvTable&)>& take);
// Of the engine, all in that order.
std::vector<RunRecord> read_records(const std::filesystem::path& folder, const Manifest& manifest);

// frames.csv: the rows of all records under one head.
void write_frames(const std::filesystem::path& folder, const std::vector<RunRecord>& records);

}  // namespace pose_wall::tools::campaign
