// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The summary of a recording for programs.

#pragma once

#include <string>

#include "io/json/json_words.hpp"
#include "study/explain/summary.hpp"

namespace pose_wall::tools::explain {

// Levels in rad and m. command: of this recording, without a frame.
Json summary_json(const RecordingSummary& summary, const std::string& command);

}  // namespace pose_wall::tools::explain
