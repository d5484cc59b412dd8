// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Names and texts of the engine as people read them. The engine speaks English; its table of names
// (src/engine/names.def) counts as marked for translation.

#pragma once

#include <cstdint>
#include <string>

#include "io/language/language.hpp"
#include "io/numbers/quantities.hpp"
#include "pose_wall.h"

namespace pose_wall::tools {

inline std::string state_words(std::uint32_t state) {
  return tr(pose_wall_state_name(state));
}

// "range bias"
inline std::string spoken_part(std::uint32_t part) {
  return tr(part_words(part).c_str());
}

// "right side down"; empty where nobody knows.
inline std::string positive_words(const pose_wall_result& result, std::uint32_t quantity) {
  const std::string sense = positive_means(result, quantity);
  return sense.empty() ? "" : tr(sense.c_str());
}

inline std::string reason_words(std::uint32_t bit) {
  return tr(pose_wall_reason_text(bit));
}

}  // namespace pose_wall::tools
