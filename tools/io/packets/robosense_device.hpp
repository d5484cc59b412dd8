// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a RoboSense's device packet (DIFOP) and the heads of its data say: which model it is, where its lasers point,
// how many returns it sends, and in which unit. Where these contradict each other, or what was stated, nothing is read.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/beams/beam_table.hpp"
#include "io/packets/robosense_models.hpp"

namespace pose_wall::tools {

// All that is needed to make points of data packets.
struct RoboSenseSetup {
  const RoboSenseTraits* traits = nullptr;
  std::size_t returns = 1;
  std::vector<Laser> lasers;  // in the order of packets; those of an Airy of 48 lines are 48
  double firing_us = 0.0;
  double unit_m = 0.0;
  double step_deg = 0.0;    // that the head turns from firing to firing, by its device packet
  bool turns_back = false;  // a Bpearl may be set to turn counterclockwise

  // How many lasers' returns a block holds, and of how many blocks all lasers' returns of one moment consist.
  std::size_t firings_of_block() const;
  std::size_t blocks_of_firing() const;
};

// `packets`: data of one sensor in the order in which they came, at least one, all of one layout. Throws FrameError
// where they contradict each other, and where something is not known; it names who says what.
RoboSenseSetup robosense_setup(const std::vector<ByteView>& packets, ByteView device,
                               std::optional<RoboSenseModel> stated);

// Whether blocks share their azimuth as they do with so many returns. True where nothing tells, as at a standstill.
bool is_grouped_as(const RoboSenseSetup& setup, ByteView payload);

// What of a device packet changes with settings and sensors. It is the same as long as data is read alike.
std::string robosense_settings(ByteView device);
// "1A2B3C4D5E6F"; "" where it is not written.
std::string robosense_serial(ByteView device);

}  // namespace pose_wall::tools
