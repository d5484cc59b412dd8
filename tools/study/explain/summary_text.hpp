// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The summary of a recording for a terminal.

#pragma once

#include <string>

#include "study/explain/summary.hpp"

namespace pose_wall::tools::explain {

// command: of this recording, without a frame: "pose_wall explain -c vlp16.yaml frames".
std::string summary_text(const RecordingSummary& summary, const std::string& command);

// The command that explains one frame.
std::string command_for(const std::string& command, std::uint64_t frame);

}  // namespace pose_wall::tools::explain
