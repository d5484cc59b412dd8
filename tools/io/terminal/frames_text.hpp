// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// "1 frame", "2 frames", in the chosen language.

#pragma once

#include <cstddef>
#include <string>

#include "io/language/language.hpp"

namespace pose_wall::tools {

inline std::string frames_text(std::size_t frames) {
  return frames == 1 ? std::string(tr("1 frame")) : say("{} frames", frames);
}

}  // namespace pose_wall::tools
