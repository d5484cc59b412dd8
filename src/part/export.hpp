// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The visibility of an archive's functions; for all three.

#pragma once

#if defined(__GNUC__)
#define POSE_WALL_EXPORT __attribute__((visibility("default")))
#else
#define POSE_WALL_EXPORT
#endif
