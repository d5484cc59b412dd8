// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The demo's running table: per shown frame a line of what the engine says and, below it, what is true.

#pragma once

#include <array>
#include <string>

#include "pose_wall.h"

namespace pose_wall::tools {

class LiveTable {
 public:
  // Colours by state when the table goes to a terminal, else a mark behind each value that is not valid.
  explicit LiveTable(bool colours) : colours_(colours) {}

  std::string head() const;
  std::string rows(std::uint64_t frame, double time_s, const pose_wall_result& result,
                   const std::array<double, POSE_WALL_QUANTITIES>& truth, double engine_ms) const;
  std::string key() const;

 private:
  std::string cell(std::uint32_t quantity, const pose_wall_value& value) const;
  std::string painted(const std::string& text, std::uint32_t state) const;
  std::string dimmed(const std::string& text) const;

  bool colours_;
};

}  // namespace pose_wall::tools
