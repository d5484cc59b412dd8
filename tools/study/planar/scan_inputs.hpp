// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The words INPUT... of a command line as a sequence of planar scans.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/inputs/frame_options.hpp"
#include "study/planar/scan_source.hpp"

namespace pose_wall::tools {

// A log of CARMEN, or frames. verb_settings: names that the verb takes from --set itself; a mistyped one is compared
// with them, too. Throws std::invalid_argument, ConfigError, CarmenError, and std::runtime_error where no input is
// there.
std::unique_ptr<ScanSource> open_scans(const FrameOptions& options, const std::vector<std::string>& verb_settings);

}  // namespace pose_wall::tools
