// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How often each gate was asked and failed in a frame, of the traced library alone (base/gates/note.hpp).

#pragma once

#ifdef POSE_WALL_TRACE
#include <cstdint>

#include "pose_wall_motion_trace.h"

namespace pose_wall::motion::trace {

// On this thread, until nullptr is given. Without a trace, notes are lost.
void write_to(pose_wall_motion_trace* frame);
void note_gate(std::uint32_t id, bool passed);

// The limit that was set in place of the table's, or that.
double limit_or(std::uint32_t id, double of_table);
void set_limit(std::uint32_t id, double limit);
bool lets_pass(std::uint32_t id);
void let_pass(std::uint32_t id);
void forget_limits();

}  // namespace pose_wall::motion::trace
#endif
