// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which RoboSense packets are of. RS-LiDAR-16, RS-LiDAR-32 and Bpearl send the same head, and so do the Helios: a byte
// of it, the form of its time, the angles of the device packet, and the time that a packet takes tell them apart. All
// that is heard has to agree.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/packets/robosense_models.hpp"

namespace pose_wall::tools {

struct RoboSenseTold {
  const RoboSenseTraits* traits;
  const RoboSenseRhythm* rhythm;
};

// Throws FrameError with who says what where these disagree, or where nothing tells.
RoboSenseTold identify_robosense(const std::vector<ByteView>& packets, ByteView device,
                                 std::optional<RoboSenseModel> stated);

// What a data packet's head alone says. All models of its layout where it says nothing.
std::vector<RoboSenseModel> robosense_models_of_head(ByteView packet, RoboSenseLayout layout);

// What of a head decides how its packet is read: packets in which it is the same are read alike.
std::string robosense_head_settings(ByteView packet, RoboSenseLayout layout);

std::size_t robosense_lines(const RoboSenseTraits& traits, ByteView packet);
std::size_t robosense_returns(const RoboSenseTraits& traits, ByteView packet, ByteView device);
// By the speed that a device packet names; 0 where it names none.
double robosense_degrees_per_us(ByteView device);

}  // namespace pose_wall::tools
