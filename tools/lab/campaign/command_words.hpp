// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A campaign as the words of a command.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lab/campaign/plan.hpp"

namespace pose_wall::tools::campaign {

// The settings in every engine of the campaign: a file, and KEY=VALUE over it.
struct EngineChoice {
  std::string config_file;  // or none
  std::vector<std::string> settings;
};

// " --set KEY=VALUE" for each.
std::string set_words(const std::vector<std::string>& settings);

// " --config FILE" and " --set KEY=VALUE" as often as they are there.
std::string engine_words(const EngineChoice& choice);

// "pose_wall campaign", and whose.
std::string verb_words(const PlanRequest& request);

// " --drive-in METRES"; nothing where the machine does not drive in.
std::string drive_in_words(double drive_in_m);

// " --scans instant"; nothing for scans that take time.
std::string scans_words(Scans scans);

// Makes the campaign again, but for its folder.
std::string campaign_command(const PlanRequest& request, const EngineChoice& choice);

// What was asked for, by name; what was not says what stands in its place.
std::vector<std::pair<std::string, std::string>> request_words(const PlanRequest& request);

}  // namespace pose_wall::tools::campaign
