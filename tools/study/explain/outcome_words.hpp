// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The result of one of the seven quantities, in a few sentences.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/explain/notes.hpp"
#include "study/explain/rivals_seen.hpp"

namespace pose_wall::tools::explain {

// "d_rf: held, 1.92 m ± 0.08 m, 0.30 s old. Not measured: right wall refused." `rivals`: of the frames before it.
std::string outcome_sentence(const pose_wall_result& result, const Notes& notes, std::uint32_t quantity,
                             const RivalsSeen& rivals = {});

// Remedies by the gates of the quantity itself; some may be empty.
std::vector<std::string> outcome_helps(const pose_wall_result& result, const Notes& notes, std::uint32_t quantity);

}  // namespace pose_wall::tools::explain
