// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The planar library's table of gates is gates.def. Rules use them by name: base/gates/gate.hpp says how.

#pragma once

#include <cstdint>

#include "base/gates/constant_row.hpp"

namespace pose_wall {
namespace planar::gate {

enum Id : std::uint32_t {
#define GATE(id, ...) id,
#include "planar/gates.def"
#undef GATE
  kCount
};

}  // namespace planar::gate

#define GATE(id, name, sense, limit, ...) POSE_WALL_CONSTANT_GATE(planar::gate::id, sense, limit)
#include "planar/gates.def"
#undef GATE

}  // namespace pose_wall
