// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The way back to an event.

#pragma once

#include <string>

#include "lab/campaign/manifest.hpp"
#include "lab/campaign/motion_card.hpp"
#include "lab/campaign/worst_events.hpp"

namespace pose_wall::tools::campaign {

// A command that measures the event's frame once more, to the last digit: by frame files where `pose_wall run` can make
// the campaign's stamps and settings from them, else by the run itself as a campaign of its own.
std::string recipe(const WorstEvent& event, const Manifest& manifest);

// Of motion always by the run itself.
std::string recipe(const MotionEvent& event, const Manifest& manifest);

}  // namespace pose_wall::tools::campaign
