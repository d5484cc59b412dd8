// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Of the daemon as a process, under the names that all clients of Prometheus give them.

#pragma once

#include "apps/live/page/open_metrics.hpp"

namespace pose_wall::tools::live {

void add_process_metrics(OpenMetrics* metrics);

}  // namespace pose_wall::tools::live
