// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// An explanation for programs.

#pragma once

#include <string>

#include "io/json/json_words.hpp"
#include "study/explain/explanation.hpp"
#include "study/explain/traced_frame.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools::explain {

// One object: the frame, a paragraph for frame, floor and each wall, the outcome, every gate and every plane. Angles in
// rad and lengths in m, as the gates compare them; null where there is no number. Sentences are in the chosen language.
Json explanation_page(const pose_wall_config& config, const FrameOutcome& outcome, const TracedFrame& traced,
                      const Explanation& explanation);

std::string explanation_json(const pose_wall_config& config, const FrameOutcome& outcome, const TracedFrame& traced,
                             const Explanation& explanation);

}  // namespace pose_wall::tools::explain
