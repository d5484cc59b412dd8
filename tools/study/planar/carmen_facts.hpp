// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a log of CARMEN holds, for `pose_wall info`.

#pragma once

#include <string>

#include "io/planar_files/carmen_log.hpp"

namespace pose_wall::tools {

// A name and what was found, a line each.
std::string carmen_facts_text(const CarmenLog& log);

// One object, without a language.
std::string carmen_facts_json(const std::string& input, const CarmenLog& log);

// Metres between restarts that `localise` is worth trying with: few enough for several restarts in this log, and where
// it is long so many that a scanner of half a turn finds its place between two of them.
int worthy_restart_m(const CarmenLog& log);

}  // namespace pose_wall::tools
