// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Demands that do not hold, a line each.

#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace pose_wall::tools::campaign {

class Faults {
 public:
  template <typename... Values>
  void demand(bool holds, fmt::format_string<Values...> form, Values&&... values) {
    if (!holds) lines_.push_back(fmt::format(form, std::forward<Values>(values)...));
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

}  // namespace pose_wall::tools::campaign
