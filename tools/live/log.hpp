// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The daemon's log: one line a fact, to standard error. Where the journal reads it, the journal adds the time.

#pragma once

#include <string>

#include "live/health.hpp"

namespace pose_wall::tools::live {

// From any thread; a line is written whole.
void log_line(Grade grade, const std::string& part, const std::string& fact);

// Writes only what changed: a part's grade or summary.
class HealthLog {
 public:
  void note(const std::vector<PartHealth>& parts);

 private:
  std::vector<PartHealth> last_;
};

}  // namespace pose_wall::tools::live
