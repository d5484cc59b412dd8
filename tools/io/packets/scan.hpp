// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One turn of a spinning sensor, put together from its packets.

#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame.hpp"
#include "io/packets/datagram_source.hpp"

namespace pose_wall::tools {

// How a point made from packets lies in memory: no padding within.
struct ScanPoint {
  float x_m = 0.0F, y_m = 0.0F, z_m = 0.0F;  // 0 0 0: no return
  float intensity = 0.0F;
  std::uint32_t t_ns = 0;  // since the frame's stamp
  std::uint16_t ring = 0;  // from the lowest
  std::uint16_t unused = 0;
};

struct Scan {
  std::int64_t stamp_ns = 0;
  std::uint32_t rings = 0;  // rows; the points lie ring by ring
  std::vector<ScanPoint> points;
  bool is_complete = false;
};

// Throws FrameError never: the layout is our own.
Frame frame_of(const Scan& scan);

class ScanAssembler {
 public:
  ScanAssembler() = default;
  ScanAssembler(const ScanAssembler&) = delete;
  ScanAssembler& operator=(const ScanAssembler&) = delete;
  virtual ~ScanAssembler() = default;

  // True when the datagram is data of this sensor.
  virtual bool add(const Datagram& datagram) = 0;

  // At the end of the capture: what has been gathered is a scan.
  virtual void finish() = 0;

  virtual const char* kind() const = 0;

  // True where the sensor's own clock tells no date: scans are stamped with the time at which their packets arrived.
  virtual bool stamps_are_of_arrival() const = 0;

  // What is odd about the datagrams of which none was this sensor's so far, in words; "" where nothing is known.
  virtual std::string hint() const { return ""; }

  std::optional<Scan> take();

 protected:
  void push(Scan scan) { scans_.push_back(std::move(scan)); }

 private:
  std::deque<Scan> scans_;
};

}  // namespace pose_wall::tools
