// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The numbers of /health for monitors.

#pragma once

#include <vector>

#include "apps/live/health.hpp"
#include "apps/live/page/open_metrics.hpp"

namespace pose_wall::tools::live {

// What people alert on, under names that stay.
void add_stable_metrics(OpenMetrics* metrics, const std::vector<PartHealth>& parts);
// Grades, and all facts that are numbers. Names of facts may change with a version.
void add_part_metrics(OpenMetrics* metrics, const std::vector<PartHealth>& parts);

}  // namespace pose_wall::tools::live
