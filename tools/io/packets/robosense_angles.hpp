// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where the lasers of a RoboSense point, by its device packet. Models put their angles in different places and units:
// angles that are not those of the model's design are of another model, or not written.

#pragma once

#include <optional>
#include <vector>

#include "io/beams/beam_table.hpp"
#include "io/packets/robosense_models.hpp"

namespace pose_wall::tools {

// Elevations and azimuths of `lines` lasers in the order of packets, rings numbered, times left 0. Nothing where these
// bytes hold no such angles.
std::optional<std::vector<Laser>> robosense_angles(const RoboSenseTraits& traits, ByteView device, std::size_t lines);

// The elevations of an RS-LiDAR-16's design. The maker's first driver takes them where a device packet has none.
std::vector<Laser> robosense_rs16_design();

// Whether the place where an RS-LiDAR-16 has its elevations was never written.
bool has_no_rs16_angles(ByteView device);

}  // namespace pose_wall::tools
