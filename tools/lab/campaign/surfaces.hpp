// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Real roads in a campaign: each surface is one run a sensor, along the path that `pose_wall sim --surface` proposes.

#pragma once

#include <string>

#include "lab/sim/rock_surface.hpp"

namespace pose_wall::tools::campaign {

// Read once, by the thread that asks first. Throws SurveyError, for what is no road, too.
const sim::Survey& survey_of(const std::string& file);

}  // namespace pose_wall::tools::campaign
