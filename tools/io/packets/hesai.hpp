// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Hesai's spinning sensors (hesai_models.hpp lists them): packets of blocks, a firing of all lasers each.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/packets/hesai_models.hpp"
#include "io/packets/turn_assembler.hpp"

namespace pose_wall::tools {

// Frames are cut where the azimuth passes 0. Axes as in ROS: x at azimuth 0 (Hesai's own y), y to the left, z up. Of
// two or three returns the farthest is taken. Stamps are of arrival (packet_clock.hpp): a sensor that nobody gave the
// time has a date of its own.
class HesaiAssembler : public TurnAssembler {
 public:
  // The model of the first packet where none is stated; `angles` is a table as parse_hesai_angles reads it, the design
  // values where it is empty. Where no model is stated, add throws FrameError for a table that does not fit it.
  HesaiAssembler(std::optional<HesaiModel> stated, std::string angles);

  bool add(const Datagram& datagram) override;
  const char* kind() const override { return kind_.c_str(); }
  bool stamps_are_of_arrival() const override { return true; }

 private:
  struct Beam {
    Laser laser;
    double cos_elevation, sin_elevation;
  };

  void set_model(HesaiModel model);
  void learn_step(double azimuth_deg);
  void fill_firing(ByteView payload, std::size_t block, std::size_t returns, std::int64_t packet_ns);

  std::string angles_;
  const HesaiTraits* traits_ = nullptr;  // none: not yet known
  std::vector<Beam> beams_;
  std::optional<double> last_azimuth_deg_;  // of packets of one firing
  double last_since_deg_ = 0.0;             // from the one before to it
  double last_step_deg_ = 0.0;              // from firing to firing: 600 turns a minute until two were seen
  std::string kind_ = "packets of a Hesai";
  Firing firing_;
};

}  // namespace pose_wall::tools
