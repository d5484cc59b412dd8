// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a gate's limit buys and what it costs: the same runs with the limit of the table, then with others in its place.
// The engine that takes notes measures them, for it alone lets a limit be set; it is the engine, without motion.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/campaign/card.hpp"
#include "lab/campaign/runner.hpp"
#include "pose_wall_trace.h"

namespace pose_wall::tools::campaign {

struct SweepRequest {
  std::uint32_t gate = 0;      // pose_wall_trace_gate_id
  std::vector<double> limits;  // in the gate's unit
};

// "wall_length=1.5,2,3", and what is wrong with it; "" where nothing is.
std::string sweep_fault(const std::string& words);
// Throws std::invalid_argument with the fault.
SweepRequest parse_sweep(const std::string& words);

// How often one gate was asked, and what it then held its values against. Of the floor one radius counts.
struct GateCounts {
  std::size_t asked = 0;
  std::size_t not_passed = 0;
  double limit_least = 0.0;  // NaN where it was never asked
  double limit_most = 0.0;
  std::size_t notes_dropped = 0;  // of all gates, for lack of room: then the counts are too low

  GateCounts();
  void add(const pose_wall_trace& trace, std::uint32_t of_gate);
  void merge(const GateCounts& other);
};

struct SweepRow {
  bool is_of_table = false;
  double limit = 0.0;  // NaN for the table's
  Totals judged;       // of the classes that a card judges
  GateCounts gate;
  std::size_t frames_changed = 0;  // of all runs: any value, level or state is another one than in the table's row
};

struct Sweep {
  SweepRequest request;
  Manifest manifest;           // of the campaign that measures the same runs
  std::vector<SweepRow> rows;  // the table's limit first
};

// Throws as work_on does. No other frame may be traced meanwhile: limits are of the whole program.
Sweep run_sweep(const SweepRequest& request, const Manifest& manifest, const std::vector<Run>& runs, const Crew& crew);

std::string sweep_text(const Sweep& sweep);
std::string sweep_json(const Sweep& sweep);

}  // namespace pose_wall::tools::campaign
