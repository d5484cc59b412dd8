// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// RoboSense RS-LiDAR-16, RS-LiDAR-32, Helios, Bpearl and Airy: data packets (MSOP) and device packets (DIFOP), which
// come from two ports of one sensor.

#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "io/packets/robosense_device.hpp"
#include "io/packets/turn_assembler.hpp"

namespace pose_wall::tools {

// Frames are cut where the azimuth passes 0. Axes as in ROS: x at azimuth 0, y to the left, z up. Of two returns the
// farther is taken. Stamps are of arrival (packet_clock.hpp): the sensor's calendar has no known time zone. Data is
// held until a device packet comes, which a sensor sends about once a second. add and finish throw FrameError where
// packets contradict each other or what is stated, and finish where no device packet came.
class RoboSenseAssembler : public TurnAssembler {
 public:
  // `device`: the bytes of a device packet that was saved; "": none.
  explicit RoboSenseAssembler(std::optional<RoboSenseModel> stated, const std::string& device = "");

  bool add(const Datagram& datagram) override;
  void finish() override;
  const char* kind() const override { return kind_.c_str(); }
  bool stamps_are_of_arrival() const override { return true; }
  std::string hint() const override;

 private:
  struct Held {
    Bytes payload;
    std::int64_t captured_ns;
  };
  struct Beam {
    Laser laser;
    double cos_elevation, sin_elevation;
  };

  void take_device(ByteView device);
  bool hold(const Datagram& datagram);
  void settle();
  void add_blocks(ByteView payload, std::int64_t captured_ns);
  void fill_firing(ByteView payload, std::size_t block, std::size_t firing);
  std::size_t return_at(std::size_t block, std::size_t firing, std::size_t laser, std::size_t which) const;
  void place(const Beam& beam, double range_m, double azimuth_deg, ScanPoint* point) const;

  std::optional<RoboSenseModel> stated_;
  std::optional<RoboSenseLayout> layout_;  // of the first data
  Bytes device_;                           // the newest device packet
  bool device_is_metadata_ = false;
  std::optional<RoboSenseSetup> setup_;  // none: not yet known
  std::vector<Beam> beams_;
  std::string head_settings_;  // of the packets that are held, or that the setup is for
  std::deque<Held> held_;      // until the setup is known
  std::size_t unlike_ = 0;     // packets in a row that do not fit the setup
  std::string kind_ = "packets of a RoboSense";
  Firing firing_;
  double firing_step_deg_ = 0.0;
};

}  // namespace pose_wall::tools
