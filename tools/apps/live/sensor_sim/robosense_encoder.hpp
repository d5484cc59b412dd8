// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Packets of RoboSense's spinning sensors: data and, for a port of its own, what the sensor says of itself. Written
// anew from the maker's descriptions: nothing but the table of beams is shared with the decoder.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/live/sensor_sim/packet_encoder.hpp"
#include "io/beams/beam_table.hpp"

namespace pose_wall::tools::live {

// In single return mode.
class RoboSenseEncoder final : public PacketEncoder {
 public:
  explicit RoboSenseEncoder(const BeamTable& beams) : beams_(beams) {}

  std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) override;
  std::string device_packet(std::int64_t turn_ns) const override;

 private:
  std::string packet(const RangeImage& image, std::uint32_t first, std::int64_t time_ns) const;

  const BeamTable& beams_;
};

}  // namespace pose_wall::tools::live
