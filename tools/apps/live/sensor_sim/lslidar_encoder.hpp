// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Simulated turns as an LSLidar C16 would send them, of firmware 3 or 4. Written anew from the facts of the layout, so
// that it and the decoder are each a check of the other.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/live/sensor_sim/packet_encoder.hpp"

namespace pose_wall::tools::live {

// One return; the clock of firmware 4 is set by GPS: nanoseconds.
class LslidarEncoder final : public PacketEncoder {
 public:
  explicit LslidarEncoder(const BeamTable& beams) : beams_(beams) {}

  std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) override;
  std::string device_packet(std::int64_t turn_ns) const override;

 private:
  bool is_v3() const { return &beams_ == &lslidar_c16_v3(); }
  const BeamTable& beams_;
};

}  // namespace pose_wall::tools::live
