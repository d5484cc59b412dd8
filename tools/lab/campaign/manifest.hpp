// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// campaign.json: what the records of a folder were made with.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lab/campaign/command_words.hpp"
#include "lab/campaign/part.hpp"
#include "lab/campaign/plan.hpp"
#include "study/truth/alert_limits.hpp"

namespace pose_wall::tools::campaign {

struct Manifest {
  // All that decides what the records hold: program, version, settings, plan; by name.
  std::vector<std::pair<std::string, std::string>> identity;
  AlertLimits limits;
  std::size_t runs = 0;
  std::size_t frames = 0;
  PlanRequest plan;           // as it was asked for
  std::optional<Part> part;   // the folder's, of the campaign's runs; none: all of them
  std::size_t part_runs = 0;  // of the part
  EngineChoice engine;
  bool motion_is_on = true;  // the engine's key `motion`

  std::string command() const { return campaign_command(plan, engine); }
  // Stands in each record.
  std::string fingerprint() const;
};

Manifest make_manifest(const PlanRequest& request, const std::vector<Run>& runs, const EngineChoice& choice);

// A line in words per thing that differs; empty when both are of one campaign, and of the same part of it.
std::string difference(const Manifest& records, const Manifest& now);

// Who has what in these lines: "the records have small, this campaign has large".
struct Holders {
  std::string first = "the records have";
  std::string second = "this campaign has";
};
// The same without the part.
std::string identity_difference(const Manifest& first, const Manifest& second, const Holders& holders);

// Whether a campaign was run there, by this version or by an older one that wrote less.
bool holds_campaign(const std::filesystem::path& folder);

// Both throw std::runtime_error that names the file.
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);
Manifest read_manifest(const std::filesystem::path& folder);

}  // namespace pose_wall::tools::campaign
