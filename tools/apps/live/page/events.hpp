// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the page's script gets as events: one frame as the report packs its frames, the head, the health.

#pragma once

#include <string>
#include <vector>

#include "apps/live/health.hpp"
#include "apps/live/sink.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

// Server-sent events, whole with their ends (HTML Living Standard, 9.2).
std::string hello_event(const LoadedConfig& loaded);
std::string frame_event(const LiveResult& result);
std::string health_event(const std::vector<PartHealth>& parts);

}  // namespace pose_wall::tools::live
