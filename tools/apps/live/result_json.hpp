// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A result and the health of the parts as JSON: for recordings, MQTT and the page.

#pragma once

#include <string>
#include <vector>

#include "apps/live/health.hpp"
#include "apps/live/sink.hpp"

namespace pose_wall::tools::live {

// What `pose_wall run --format json` writes of a frame (study/results/result_json.hpp), with what the runtime adds. One
// line, without a break at its end.
std::string result_json(const LiveResult& result);

std::string health_json(const std::vector<PartHealth>& parts);

// The same with a member "zh" of each part, which tells it in Chinese; for the page, whose readers choose the language.
std::string health_in_both_json(const std::vector<PartHealth>& parts);

}  // namespace pose_wall::tools::live
