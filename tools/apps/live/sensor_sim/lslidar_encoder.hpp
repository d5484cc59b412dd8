// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Simulated turns as a spinning LSLidar would send them. Written anew from the facts of the layout, so that it and the
// decoder are each a check of the other.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/live/sensor_sim/packet_encoder.hpp"

namespace pose_wall::tools::live {

// One return; the clock of firmware 4 and 5 is set by GPS: nanoseconds.
class LslidarEncoder final : public PacketEncoder {
 public:
  // Throws std::invalid_argument for a sensor whose packets are not known.
  explicit LslidarEncoder(const BeamTable& beams);

  std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) override;
  std::string device_packet(std::int64_t turn_ns) const override;

 private:
  const BeamTable& beams_;
  int firmware_;
  char model_;  // as it names itself at the end of a packet
};

}  // namespace pose_wall::tools::live
