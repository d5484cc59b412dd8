// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// LSLidar C16, C32, C8 and CH32R of firmware 2 to 5: data packets of twelve blocks, and device packets.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/packets/lslidar_models.hpp"
#include "io/packets/turn_assembler.hpp"

namespace pose_wall::tools {

// What was said of the sensor. An empty list is no choice: the first packet tells.
struct LslidarChoice {
  std::vector<LslidarModel> models;          // one of these
  const BeamTable* of_first_kind = nullptr;  // lasers of a C16 of firmware 2 or 3, where they are named
  const char* title = "";
  const char* word = "";
};

// Frames are cut where the azimuth passes 0. Axes as in ROS: x at azimuth 0 (the maker's y), y to the left, z up. Of
// two returns the farther is taken. Stamps are of arrival (packet_clock.hpp): the sensor's clock has no date, or one of
// which the packets do not tell the unit. A sensor of firmware 2 or 3 is read from its first device packet on: data of
// the two seconds before is kept until then. add and finish throw FrameError where none came, or where what it says
// cannot be.
class LslidarAssembler : public TurnAssembler {
 public:
  explicit LslidarAssembler(LslidarChoice choice = {}) : choice_(std::move(choice)) {}

  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return kind_.c_str(); }
  bool stamps_are_of_arrival() const override { return true; }

 private:
  struct Held {
    Bytes payload;
    std::int64_t captured_ns;
  };

  void begin(LslidarModel model);
  void hear_device(ByteView device);
  void start_if_known(bool is_last);
  [[noreturn]] void refuse_without_device() const;
  void start(const BeamTable& beams);
  void learn_clock();
  void add_blocks(ByteView packet, std::int64_t captured_ns);
  // Of the two returns the farther; the same twice where there is one.
  void fill_firing(ByteView first, ByteView second, double azimuth_deg);

  LslidarChoice choice_;
  const LslidarTraits* traits_ = nullptr;  // none: no data was heard
  BeamTable beams_;                        // of this sensor; no lasers: not yet known
  double block_ns_ = 0.0;
  std::int64_t clock_unit_ns_ = 0;  // 0: it stands still, or runs as none
  Bytes device_;                    // the first; empty: none was heard
  std::vector<Held> held_;
  std::string kind_ = "packets of an LSLidar";
  Firing firing_;
  double last_step_deg_ = 0.36;  // from block to block: 600 turns a minute of a C16 until two were seen
};

}  // namespace pose_wall::tools
