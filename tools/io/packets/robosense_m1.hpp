// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// RoboSense M1, a solid-state sensor: packets of 1210 bytes with an angle for each point. Facts: rs_driver 4eeadace.

#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

#include "io/packets/packet_clock.hpp"
#include "io/packets/scan.hpp"

namespace pose_wall::tools {

constexpr std::size_t kRoboSenseM1Bytes = 1210;

bool is_robosense_m1_data(ByteView payload);

// A frame ends where the number of packets begins anew, ten times a second. Axes as in ROS: x ahead, y to the left, z
// up. It has no rows; the ring of a point is its channel, five side by side. Stamps are those of arrival. Two returns
// are refused.
class RoboSenseM1Assembler : public ScanAssembler {
 public:
  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return "packets of a RoboSense M1"; }
  bool stamps_are_of_arrival() const override { return true; }

 private:
  static constexpr std::size_t kNumbers = 2048;  // a frame of one return has 630

  void end_frame(bool is_complete);
  void add_blocks(ByteView payload, std::int64_t packet_ns);

  std::vector<ScanPoint> points_;
  std::bitset<kNumbers> seen_;  // numbers of this frame's packets
  std::size_t first_ = 0, last_ = 0;
  PacketClock clock_;
  std::int64_t began_ns_ = 0, last_ns_ = 0;  // of the frame, and its newest packet
  std::optional<std::uint64_t> return_number_;
};

}  // namespace pose_wall::tools
