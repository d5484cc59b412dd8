// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A run of motion in its file: the rows of `pose_wall motion`, and where base truly was beside each.

#pragma once

#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "lab/campaign/plan.hpp"
#include "lab/sim/simulator.hpp"
#include "study/motion/motion_runner.hpp"
#include "study/motion/motion_table.hpp"
#include "study/motion/pose_truth.hpp"

namespace pose_wall::tools::campaign {

struct MotionRecord {
  Run run;
  MotionTable table;
  PoseTruth truth;
  std::vector<double> contrast, patches;  // by row; NaN where nothing was searched
};

std::vector<std::string> motion_record_head();
std::vector<std::string> motion_record_cells(const Run& run, const MotionOutcome& outcome,
                                             const sim::Simulator& simulator, std::uint32_t frame);

// Throws CsvError.
MotionRecord motion_record_of(const CsvTable& table);

}  // namespace pose_wall::tools::campaign
