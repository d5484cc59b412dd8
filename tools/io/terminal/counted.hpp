// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// "1 frame", "2 frames".

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pose_wall::tools {

inline std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

inline std::string counted(std::size_t count, std::string_view one) {
  return counted(count, one, std::string(one) + "s");
}

}  // namespace pose_wall::tools
