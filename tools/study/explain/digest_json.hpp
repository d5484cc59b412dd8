// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The digest of a recording for programs.

#pragma once

#include <string>

#include "io/json/json_words.hpp"
#include "study/explain/digest.hpp"

namespace pose_wall::tools::explain {

// Levels in rad and m. command: of this recording, without a frame.
Json digest_json(const Digest& digest, const std::string& command);

}  // namespace pose_wall::tools::explain
