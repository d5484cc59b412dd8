// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// LSLidar CH128X1, whose light goes over a mirror of four faces: data packets of 171 points, or of 109 with two
// returns, and device packets.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/packets/lslidar_device.hpp"
#include "io/packets/packet_clock.hpp"
#include "io/packets/scan.hpp"

namespace pose_wall::tools {

// Data of a CH128X1, or of another of LSLidar's with a mirror: packets do not tell which.
bool is_lslidar_hybrid(ByteView payload);

// Of LSLidar's hybrid packets: whose they may be; else "".
std::string unread_lslidar_hybrid(ByteView payload);

// A frame begins at a mark that stands among the points. Axes: x to the middle of the field of view (azimuth 90), y to
// the left, z up. Rings are the sensor's lines. Stamps are those of the capture. It is read from its first device
// packet on, which tells the angles of the mirror's faces: data of the two seconds before is kept until then. add and
// finish throw FrameError where none came, or where what it says is no CH128X1's.
class LslidarHybridAssembler : public ScanAssembler {
 public:
  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return "packets of an LSLidar CH128X1"; }
  bool stamps_are_of_arrival() const override { return true; }

 private:
  struct Held {
    Bytes payload;
    std::int64_t captured_ns;
  };

  void start_if_known(bool is_last);
  void add_points(ByteView packet, std::int64_t captured_ns);
  void end_behind_pause(std::int64_t end_ns);
  void end_frame(bool is_complete);

  std::optional<LslidarFaces> faces_;
  std::vector<Held> held_;
  double packet_ns_ = 0.0;          // 0: not started
  std::int64_t clock_unit_ns_ = 0;  // 0: it stands still, or runs as none
  PacketClock clock_;
  bool frame_begun_ = false;
  std::int64_t last_end_ns_ = 0;
  Scan scan_;
};

}  // namespace pose_wall::tools
