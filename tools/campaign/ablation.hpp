// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What each gate is good for: the same runs once more for each gate, with that gate letting everything pass. A gate
// whose absence lets no wrong value through is superfluous on these runs.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "campaign/manifest.hpp"
#include "campaign/record.hpp"
#include "campaign/workers.hpp"

namespace pose_wall::tools::campaign {

// Values of the frames in which a run without the gate differs from the run with all gates.
struct GateWorth {
  std::size_t runs_failed = 0;     // of those with all gates, in which the gate failed
  std::size_t frames_failed = 0;   // likewise
  std::size_t frames_changed = 0;  // any value, level or state is another one without the gate
  std::size_t valid_gained = 0;    // values that are valid only without the gate
  std::size_t valid_lost = 0;      // values that are valid only with it
  std::size_t misleading_more = 0, misleading_fewer = 0;
  std::size_t beyond_more = 0, beyond_fewer = 0;  // values beyond their level, in any state but invalid

  void add(const FrameRecord& with_all, const FrameRecord& without, const AlertLimits& limits);
  // Wrong values that pass only without the gate.
  std::size_t wrong_more() const { return misleading_more + beyond_more; }
};

using Gates = std::vector<std::uint32_t>;  // pose_wall_trace_gate_id

struct AblationRow {
  Gates without;
  GateWorth worth;
  std::string worst;  // scene and sensor in which most wrong values pass without it; "" for none
};

struct Ablation {
  Manifest manifest;
  std::string words;  // of the request
  std::size_t frames = 0;
  std::vector<AblationRow> rows;
};

// "each": every gate alone, in their order. "wall_low,ever": these gates together, one row. Empty where that can be
// parsed, else what is wrong with it.
std::string ablation_fault(const std::string& words);

// Throws as work_on does, and std::invalid_argument with the fault. No other frame may be traced meanwhile.
Ablation run_ablation(const std::string& words, const Manifest& manifest, const std::vector<Run>& runs,
                      const Crew& crew);

std::string ablation_text(const Ablation& ablation);
std::string ablation_json(const Ablation& ablation);

}  // namespace pose_wall::tools::campaign
