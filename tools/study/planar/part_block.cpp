// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/part_block.hpp"

#include <fmt/format.h>

#include "io/language/language.hpp"
#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

void require_ok(std::int32_t status, const char* purpose) {
  if (status == POSE_WALL_OK) return;
  throw PlanarError(fmt::format("{}: {}", tr(purpose), pose_wall_planar_status_text(status)));
}

}  // namespace pose_wall::tools
