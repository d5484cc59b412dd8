// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Something that happens within a run: a wall lost and found again, a sensor that freezes, a stamp that jumps.

#pragma once

#include <cstdint>
#include <optional>

#include "lab/sim/setup.hpp"

namespace pose_wall::tools::campaign {

// In frames: `first` is the first that it touches, `after` the first that it does not touch any more. A jump is over at
// once: both are the first frame behind it.
struct Event {
  std::uint32_t first;
  std::uint32_t after;
};

// Nothing for a scene that stays as it is. Of several, from the first one's begin to the last one's end.
std::optional<Event> event_of(const sim::Setup& setup);

// How many frames show all that happens: an event and its recovery, a sweep of the boom, dust that rises. 0 for a scene
// that stays as it is.
std::uint32_t frames_to_watch(const sim::Setup& setup);

}  // namespace pose_wall::tools::campaign
