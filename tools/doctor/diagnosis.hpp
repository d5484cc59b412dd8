// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// All that the doctor found in a recording, what it proposes, and its verdict.

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "doctor/mount_story.hpp"
#include "doctor/proposal.hpp"
#include "doctor/recording.hpp"
#include "doctor/sensor_seen.hpp"
#include "doctor/stamp_health.hpp"

namespace pose_wall::tools::doctor {

// The frames by the proposed settings.
struct Check {
  std::array<double, POSE_WALL_QUANTITIES> measured{}, valid{}, level{};  // shares; median protection level
  std::string reasons;
};

struct Ahead {
  std::string axis;  // +X, -X, +Y, -Y; empty where no road is seen
  bool is_known = false;
  std::string reason;
};

struct Verdict {
  std::vector<std::string> against;  // not usable because of these
  std::vector<std::string> buts;     // usable, but
  std::vector<std::string> confirm;  // what somebody must look at
  bool is_usable() const { return against.empty(); }
  std::string line() const;
};

struct Diagnosis {
  SensorSeen sensor;
  StampHealth stamps;
  std::optional<MountChoice> mount;  // none: no frame to look at
  Ahead ahead;
  std::optional<Check> check;  // none: no floor or no road
  Proposal proposal;
  Verdict verdict;
};

Diagnosis diagnose(const Recording& recording, const LoadedConfig& told, std::optional<double> height_m);

// Fills in the verdict: the last step of the above.
Verdict judge(const Diagnosis& diagnosis);

}  // namespace pose_wall::tools::doctor
