// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall {

constexpr std::int32_t kOk = POSE_WALL_OK;  // a lambda's return has one type

// The statuses are of several enums; all are int32_t to the outside.
constexpr std::int32_t ok_if(bool good, std::int32_t otherwise) {
  return good ? kOk : otherwise;
}

}  // namespace pose_wall
