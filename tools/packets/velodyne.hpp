// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Velodyne VLP-16 (Puck, Puck LITE, Puck Hi-Res): data packets of 1206 bytes.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "packets/scan.hpp"

namespace pose_wall::tools {

// Frames are cut where the azimuth passes 0. Axes as in ROS: x at azimuth 0, y to the left, z up. Of two returns the
// last is taken. Stamps are those of the capture: the sensor itself counts within the hour.
class VelodyneAssembler : public ScanAssembler {
 public:
  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return "packets of a Velodyne VLP-16"; }
  bool stamps_are_of_arrival() const override { return true; }

 private:
  struct Firing {  // of all 16 lasers
    double azimuth_deg = 0.0;
    std::int64_t time_ns = 0;
    std::array<ScanPoint, 16> points{};
  };

  void add_blocks(ByteView payload, std::int64_t captured_ns);
  Firing firing_of(ByteView lasers, double azimuth_deg, double turn_deg, std::int64_t time_ns) const;
  void add_firing(const Firing& firing);
  void end_turn(bool is_complete);

  std::vector<Firing> firings_;
  std::optional<std::uint32_t> sensor_;
  std::uint8_t product_ = 0;
  double last_turn_deg_ = 0.4;  // between two blocks: 600 turns a minute until two were seen
  bool turn_begun_ = false;     // the first turn began before the capture did
};

}  // namespace pose_wall::tools
