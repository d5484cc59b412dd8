// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include "peer_contest.hpp"

namespace pose_wall::bench {

// Stage by stage: ms of each contestant and how many times pose_wall's that is.
void print_stages(const Contest& contest);
// How many of the seven values came out, and how far off they were.
void print_accuracy(const Contest& contest);

}  // namespace pose_wall::bench
