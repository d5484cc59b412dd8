// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The way back to an event.

#pragma once

#include <string>

#include "campaign/manifest.hpp"
#include "campaign/worst_events.hpp"

namespace pose_wall::tools::campaign {

// A command that measures the event's frame once more, to the last digit: by frame files where `pose_wall run` can make
// the campaign's stamps and settings from them, else by the run itself as a campaign of its own.
std::string recipe(const WorstEvent& event, const Manifest& manifest);

// Of the run itself, so many frames of it.
std::string run_recipe(const Run& run, std::uint32_t frames, const Manifest& manifest);

}  // namespace pose_wall::tools::campaign
