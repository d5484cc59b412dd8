// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Turns of a spinning sensor: firings of all its lasers, cut where the azimuth passes 0.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "packets/scan.hpp"

namespace pose_wall::tools {

// All lasers once, at one azimuth.
struct Firing {
  double azimuth_deg = 0.0;  // 0 to 360
  std::int64_t time_ns = 0;
  std::vector<ScanPoint> points;  // by ring; their t_ns counts from time_ns
};

class TurnAssembler : public ScanAssembler {
 public:
  void finish() override;

 protected:
  // True for the sensor that was heard first; another one on the same wire is passed over.
  bool is_first_heard(const Datagram& datagram);

  // `step_deg`: how far the head turns from one firing to the next, as far as is known.
  void add_firing(const Firing& firing, double step_deg);

 private:
  struct Moment {
    double azimuth_deg;
    std::int64_t time_ns;
  };

  void end_turn(bool is_complete);

  std::vector<Moment> moments_;    // of the firings of this turn
  std::vector<ScanPoint> points_;  // firing by firing
  std::optional<std::uint32_t> sensor_;
  double step_deg_ = 0.0;
  bool turn_begun_ = false;  // the first turn began before the capture did
};

// From one azimuth to the next, the way the head turns.
double turned_deg(double from_deg, double to_deg);

}  // namespace pose_wall::tools
