// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What monitors ask of the daemon: whether it must be started anew (live), whether its results are of any use just now
// (ready), and all its numbers.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/live/images.hpp"
#include "apps/live/page/open_metrics.hpp"
#include "apps/live/planar/planar_news.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::tools::live {

// All that is known at a moment.
struct Moment {
  std::int64_t now_ns = 0;        // by the clock that nobody sets
  std::vector<PartHealth> parts;  // the runtime first, then the source
  std::vector<std::string> hung;  // what hangs
  Newest newest;
  ResultSums sums;
  std::uint32_t config_crc32 = 0;     // of the engine's settings
  std::optional<StopNews> stop;       // where the key `planar` is on
  std::vector<std::int64_t> stop_ns;  // how long it was in each of its states
  std::optional<pose_wall_runtime_statistics> statistics;
};

struct Probe {
  bool is_well = false;
  std::vector<std::string> why;  // where it is not
};

// What a new start may mend: a thread hangs.
Probe live_probe(const Moment& moment);
// The newest result is fresh and of a frame: the sensor speaks. Says nothing of what may steer.
Probe ready_probe(const Moment& moment);
// {"schema": 1, "live": false, "why": ["..."]}; name: of the member.
std::string probe_json(const char* name, const Probe& probe);

// The numbers. A result that is not fresh has no values, and nothing may steer.
std::string metrics_text(const Moment& moment, MetricsFormat format = MetricsFormat::kOpenMetrics);

}  // namespace pose_wall::tools::live
