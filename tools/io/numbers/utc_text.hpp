// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <ctime>
#include <string>

namespace pose_wall::tools {

// "2026-11-30T08:15:02Z", as ISO 8601 and RFC 3339 have it.
inline std::string utc_text(std::time_t time) {
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[sizeof "2026-11-30T08:15:02Z"] = "";
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace pose_wall::tools
