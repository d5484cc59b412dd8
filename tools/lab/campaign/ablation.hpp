// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What each gate is good for: the same runs once more for each gate, with that gate letting everything pass. A gate
// whose absence lets no wrong value through is superfluous on these runs.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lab/campaign/gates_left_out.hpp"
#include "lab/campaign/manifest.hpp"
#include "lab/campaign/record.hpp"
#include "lab/campaign/workers.hpp"

namespace pose_wall::tools::campaign {

// Of the frames in which a run without the gates differs from the run with all gates.
struct GateWorth {
  std::size_t runs_failed = 0;     // of those with all gates, in which the gate failed
  std::size_t frames_failed = 0;   // likewise
  std::size_t frames_changed = 0;  // any value, level or state is another one without the gate
  StandingChanges values;          // beyond their level: in any state but invalid

  void add(const FrameRecord& with_all, const FrameRecord& without, const AlertLimits& limits);
};

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

// `words` as gate_rows takes them. Throws as work_on does, and std::invalid_argument with the fault. No other frame may
// be traced meanwhile.
Ablation run_ablation(const std::string& words, const Manifest& manifest, const std::vector<Run>& runs,
                      const Crew& crew);

std::string ablation_text(const Ablation& ablation);
std::string ablation_json(const Ablation& ablation);

}  // namespace pose_wall::tools::campaign
