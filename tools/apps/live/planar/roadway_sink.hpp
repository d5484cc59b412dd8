// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Maps the roadway, or finds the machine on a saved map, as a sink of results: it has a thread of its own, and where it
// is slow it loses frames, counted, and delays nobody.

#pragma once

#include <functional>
#include <memory>

#include "apps/live/planar/planar_news.hpp"
#include "apps/live/sink.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

// In the sink's thread, for each frame; it must not wait.
using TellRoadway = std::function<void(const std::shared_ptr<const RoadwayNews>&)>;

std::unique_ptr<Sink> make_roadway_sink(const LoadedConfig& loaded, TellRoadway tell);

}  // namespace pose_wall::tools::live
