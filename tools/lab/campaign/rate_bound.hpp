// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How rare an event can be called after it was counted.

#pragma once

#include <cstddef>

namespace pose_wall::tools::campaign {

// The exact (Clopper-Pearson) one-sided upper bound, 95 % sure, of the rate of an event seen `events` times in `trials`
// independent trials. Zero events: close to 3 / trials. 1 without trials.
double rate_bound_95(std::size_t events, std::size_t trials);

}  // namespace pose_wall::tools::campaign
