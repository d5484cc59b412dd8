// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Packets of a sensor that were recorded in a bag, as frames.

#pragma once

#include <memory>
#include <string>

#include "io/bags/bag_source.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::tools {

// `topic` is one of packets that the bag holds. Where no metadata is named, that of an Ouster is the text that its
// driver recorded on the topic `metadata` beside it. Times are those that its driver gave each packet. Throws
// FrameError as PacketFrames does.
std::unique_ptr<FrameSource> open_bag_packets(std::unique_ptr<Bag> bag, const std::string& topic,
                                              const SensorOptions& options);

}  // namespace pose_wall::tools
