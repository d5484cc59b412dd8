// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Livox Mid-360: packets of points, which have no turn; frames are cut by the sensor's time.

#pragma once

#include <cstdint>

#include "packets/scan.hpp"

namespace pose_wall::tools {

constexpr std::int64_t kMid360Frame_ns = 100'000'000;

// 36 bytes of head and as many points as it says, of data type 1 (cartesian, mm), 2 (cartesian, cm) or 3 (spherical).
bool is_mid360_data(ByteView payload);

// Points in the sensor's frame as its manual draws it: x to the front, y to the left, z up. Stamps are the sensor's
// own. Rings are the four lines in which Livox's driver numbers the points.
class Mid360Assembler : public ScanAssembler {
 public:
  // A frame holds packets of `frame_ns`. Throws FrameError unless that is 1 ms to 10 s.
  explicit Mid360Assembler(std::int64_t frame_ns = kMid360Frame_ns);

  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return "packets of a Livox Mid-360"; }
  bool stamps_are_of_arrival() const override { return false; }

 private:
  void end_frame(bool is_complete);

  std::int64_t frame_ns_;
  Scan scan_;
  std::int64_t last_ns_ = 0;  // of the packet added last
};

}  // namespace pose_wall::tools
