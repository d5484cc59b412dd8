// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The parts of a campaign brought together in one folder.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lab/campaign/manifest.hpp"

namespace pose_wall::tools::campaign {

// Copies the records of all parts to `output`, which then is as one run would have left it, but for the card. Checks
// first: every part is there once and is finished, all of one campaign. `fresh`: older records in `output` go. Throws
// std::invalid_argument that names the folder and says what is allowed, else std::runtime_error.
Manifest merge_parts(const std::vector<std::string>& folders, const std::filesystem::path& output, bool fresh);

}  // namespace pose_wall::tools::campaign
