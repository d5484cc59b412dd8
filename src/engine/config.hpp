// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Settings as the engine reads them: one named member per row of config_keys.def. The public pose_wall_config stores
// the same rows by index, so that it can be set by name and checked against the table.

#pragma once

#include <cstdint>

#include "lidar/box.hpp"
#include "pose_wall.h"

namespace pose_wall {

struct Settings {
#define POSE_WALL_TEXT(name, group, text, help)
#define POSE_WALL_CHOICE(name, group, index, text, choices, help) std::int32_t name;
#define POSE_WALL_NUMBER(name, group, unit, value, text, minimum, maximum, help) double name;
#define POSE_WALL_COUNT(name, group, unit, value, text, minimum, maximum, help) std::uint32_t name;
#define POSE_WALL_BOX(name, group, unit, limit, help) Box name;
#include "engine/config_keys.def"
#undef POSE_WALL_TEXT
#undef POSE_WALL_CHOICE
#undef POSE_WALL_NUMBER
#undef POSE_WALL_COUNT
#undef POSE_WALL_BOX

  double protection_sigmas;  // by integrity_risk, before the stretch to Student's t (base/estimation/protection.hpp)
};

constexpr std::int32_t kRegionOn = 1;  // of the choices of the key `region`
constexpr std::int32_t kMotionOn = 0;  // of the choices of the key `motion`

// Of a config that pose_wall_config_check() takes.
Settings read_settings(const pose_wall_config& config);

// No point of a frame lies further than this from the origin of base.
double reach_of(const Settings& settings);

// Number of steps that a frame of so many returns and voxels may take (base/containers/work.hpp): work_max if it is
// set.
std::uint64_t work_most(const Settings& settings, std::uint64_t returns, std::uint64_t voxels);

// The alert limit of one of the seven quantities, in its own unit (rad or m).
double alert_limit(std::uint32_t quantity, const Settings& settings);

}  // namespace pose_wall
