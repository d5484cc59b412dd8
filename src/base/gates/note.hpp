// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What only the traced libraries hold (POSE_WALL_TRACE). In a delivered one a note is nothing at all, and not even its
// arguments are computed. No note changes a result.

#pragma once

#ifdef POSE_WALL_TRACE
#define POSE_WALL_NOTE(...) __VA_ARGS__
#else
#define POSE_WALL_NOTE(...) static_cast<void>(0)
#endif
