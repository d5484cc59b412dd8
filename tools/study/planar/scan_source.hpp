// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Planar scans of an input, in its own order, whatever they were recorded in.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

struct SourcedScan {
  std::string name;  // for messages: "aces.clf:12", "a.pcd"
  std::string time;  // s, with all the digits that the input has
  std::vector<float> range_m;
  pose_wall_planar_scan scan{};  // without its ranges, which view() gives
  std::optional<pose_wall_planar_pose> odometry;
  pose_wall_planar_pose place{};  // in base, of what the scan's pose is: the scanner of a log; else base itself
  std::string error;              // why there is no scan; empty: there is one

  pose_wall_planar_scan view() const {
    pose_wall_planar_scan whole = scan;
    whole.range_m = range_m.data();
    return whole;
  }
};

class ScanSource {
 public:
  ScanSource() = default;
  ScanSource(const ScanSource&) = delete;
  ScanSource& operator=(const ScanSource&) = delete;
  virtual ~ScanSource() = default;

  // Nothing at the end.
  virtual std::optional<SourcedScan> next() = 0;
  // How many will come, unreadable ones included.
  virtual std::size_t scans() const = 0;
  virtual bool has_odometry() const { return false; }
  // Facts of the input for a person: a line each.
  virtual std::vector<std::string> notes() const = 0;
  // Inputs that could not be opened; each names its input. The others are read.
  virtual std::vector<std::string> errors() const { return {}; }
  virtual std::vector<std::filesystem::path> files() const = 0;
};

}  // namespace pose_wall::tools
