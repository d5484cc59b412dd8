// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "verbs/rate.hpp"

#include <fmt/format.h>

#include <optional>

#include "frames/text_cursor.hpp"

namespace pose_wall::tools {

std::string rate_fault(const std::string& word) {
  const std::optional<double> rate_hz = parse_number<double>(word);
  if (rate_hz && *rate_hz >= 0.001 && *rate_hz <= 1e6) return "";
  return fmt::format("'{}' is refused; a number from 0.001 to 1000000 is allowed", word);
}

}  // namespace pose_wall::tools
