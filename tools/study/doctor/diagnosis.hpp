// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// All that the doctor found in a recording, what it proposes, and its verdict.

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/doctor/preview.hpp"
#include "study/doctor/proposal.hpp"
#include "study/doctor/recording.hpp"
#include "study/doctor/stamp_health.hpp"
#include "study/doctor/supposed_mount.hpp"
#include "study/info/sensor_look.hpp"

namespace pose_wall::tools::doctor {

struct Ahead {
  std::string axis;  // +X, -X, +Y, -Y; empty where no road is seen
  bool is_known = false;
  std::string reason;
};

enum class Grade { kUsable, kUsableInPart, kNotUsable };
// "usable", "in_part", "not": for programs.
const char* grade_name(Grade grade);

struct RecordingVerdict {
  Grade grade = Grade::kNotUsable;
  std::string reason;                // the valid shares, or why there are none to trust
  std::vector<std::string> buts;     // what makes it less sure
  std::vector<std::string> confirm;  // what somebody must look at
  bool is_usable() const { return grade != Grade::kNotUsable; }
  std::string headline() const;  // grade and reason
  std::string line() const;      // and all the buts
};

// The rule by which the grade is given.
std::string rule_text();

struct Diagnosis {
  SensorFacts sensor;
  StampHealth stamps;
  ScanTimeFacts times;
  std::optional<MountChoice> mount;  // none: no frame to look at
  Ahead ahead;
  std::optional<Preview> preview;  // none: no frame to look at
  Proposal proposal;
  RecordingVerdict verdict;
};

// The preview of the settings that are proposed.
using MakePreview = std::function<Preview(const LoadedConfig& proposed)>;

// That forward_axis was guessed, and what to write if the other end of the road is ahead.
std::string guess_text(const std::string& axis);

Diagnosis diagnose(const Recording& recording, const LoadedConfig& told, std::optional<double> height_m,
                   const MakePreview& make_preview);

// Fills in the verdict: the last step of the above.
RecordingVerdict judge(const Diagnosis& diagnosis);

}  // namespace pose_wall::tools::doctor
