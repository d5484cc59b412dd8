// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace pose_wall::tools {

// "96.7 %"; "-" of nothing.
inline std::string share_text(std::size_t part, std::size_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace pose_wall::tools
