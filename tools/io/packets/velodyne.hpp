// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Velodyne VLP-16 (Puck, Puck LITE), Puck Hi-Res, HDL-32E and VLP-32C: data packets of 1206 bytes.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/packets/turn_assembler.hpp"
#include "io/packets/velodyne_models.hpp"

namespace pose_wall::tools {

// Frames are cut where the azimuth passes 0. Axes as in ROS: x at azimuth 0, y to the left, z up. Of two returns the
// last is taken. Stamps are of arrival (packet_clock.hpp): the sensor itself counts within the hour. The first packets
// tell which model it is; add and finish throw FrameError where they contradict themselves, or what is stated.
class VelodyneAssembler : public TurnAssembler {
 public:
  explicit VelodyneAssembler(std::optional<VelodyneModel> stated = std::nullopt) : stated_(stated) {}

  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return kind_.c_str(); }
  bool stamps_are_of_arrival() const override { return true; }

 private:
  struct Held {
    Bytes payload;
    std::int64_t captured_ns;
  };

  void identify();
  void add_blocks(ByteView payload, std::int64_t captured_ns);
  void fill_firing(ByteView lasers, double azimuth_deg, double turn_deg, std::int64_t time_ns);

  std::optional<VelodyneModel> stated_;
  const VelodyneTraits* traits_ = nullptr;  // none: not yet known
  std::uint8_t product_ = 0;
  std::vector<Held> held_;  // until the model is known
  std::string kind_ = "packets of a Velodyne";
  Firing firing_;
  double last_turn_deg_ = 0.4;  // between two blocks: 600 turns a minute of a VLP-16 until two were seen
};

}  // namespace pose_wall::tools
