// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The reasons for a frame's results, in plain sentences, in the order of the pipeline.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/explain/notes.hpp"
#include "study/explain/rivals_seen.hpp"

namespace pose_wall::tools::explain {

enum class Acceptance { kAccepted, kDoubted, kRefused };
const char* acceptance_name(Acceptance acceptance);   // "accepted", "doubted", "refused": for programs
std::string acceptance_words(Acceptance acceptance);  // for people

struct Paragraph {
  std::uint32_t subject;
  Acceptance acceptance;
  std::vector<std::string> sentences;
  std::vector<std::string> helps;  // what would help, each once
};

struct Explanation {
  std::vector<Paragraph> paragraphs;  // frame, floor, left wall, right wall
  std::vector<std::string> outcome;   // some sentences for each of the seven quantities
  std::vector<std::string> outcome_helps;
};

// `rivals`: of the frames before it.
Explanation explain_frame(const pose_wall_config& config, const pose_wall_result& result, const pose_wall_trace& trace,
                          const RivalsSeen& rivals = {});

}  // namespace pose_wall::tools::explain
