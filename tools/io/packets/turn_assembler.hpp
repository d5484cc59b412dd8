// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Turns of a spinning sensor: firings of all its lasers, cut where the azimuth passes 0.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/packets/packet_clock.hpp"
#include "io/packets/scan.hpp"

namespace pose_wall::tools {

// Which moment of a packet the sensor's clock tells, beside a constant.
enum class ClockIs { kOfBegin, kOfEnd };

// From one azimuth to the next, the way the head turns.
double turned_deg(double from_deg, double to_deg);

// The steps of azimuth within a packet. Where a sensor's field of view is set, one of them may be a hole of it: nothing
// was sent there, and the head turned on all the while.
class PacketSteps {
 public:
  // Of a packet's blocks, or pairs of blocks, in order. Where they do not tell the step it is `known_deg`: there is one
  // alone, or a hole stands beside few others.
  PacketSteps(const std::vector<double>& azimuths_deg, double known_deg);

  // Beside its number's, when a block was measured: from the moment that the sensor's clock tells of its packet.
  double moved_ns(std::size_t block, double block_ns, ClockIs clock_is) const {
    const double from_end_ns = -in_holes_ns(block, block_ns);
    return clock_is == ClockIs::kOfEnd ? from_end_ns : from_end_ns + in_holes_ns(0, block_ns);
  }
  // How long the head turned through holes from a block on to the packet's end.
  double in_holes_ns(std::size_t block, double block_ns) const;
  // From this block to the next one, as far as the head turns while it fires.
  double after_deg(std::size_t block) const;

 private:
  static bool is_hole(double step_deg, double usual_deg);

  std::vector<double> steps_deg_;
  double step_deg_;  // the usual one
};

// All lasers once, at one azimuth.
struct Firing {
  double azimuth_deg = 0.0;       // 0 to 360
  std::int64_t time_ns = 0;       // a moment of the assembler's PacketClock
  std::vector<ScanPoint> points;  // by ring; their t_ns counts from time_ns
};

// A turn ends where the azimuth falls, which is at 0 unless the sensor's field of view leaves 0 out. A firing that
// falls back by a few degrees only is late: packets came in another order, and it joins the turn that it is of.
class TurnAssembler : public ScanAssembler {
 public:
  void finish() override;
  std::string hint() const override;

 protected:
  // The moment that the times of a packet's blocks count from. Arrival is that of its end: where the clock is that of
  // its begin, and may stand still, the way through holes lies between them. Whatever else does is the same for each
  // packet.
  std::int64_t packet_moment_ns(std::int64_t arrival_ns, std::optional<std::int64_t> clock_ns, std::int64_t modulus_ns,
                                const PacketSteps& steps, double block_ns, ClockIs clock_is);
  // `step_deg`: how far the head turns from one firing to the next, as far as is known.
  void add_firing(const Firing& firing, double step_deg);

 private:
  struct Moment {
    double azimuth_deg;
    std::int64_t time_ns;
  };
  struct Turn {
    std::vector<Moment> moments;    // of its firings, by azimuth
    std::vector<ScanPoint> points;  // firing by firing
    bool has_begun = false;         // false: it began before the recording did
    std::size_t late = 0;           // firings

    bool empty() const { return moments.empty(); }
  };

  void begin_turn(double azimuth_deg);
  bool is_of_another_turn(const Firing& firing, double ahead_deg) const;
  static void append(Turn* turn, const Firing& firing);
  static void insert_late(Turn* turn, const Firing& firing);
  void cut_turn();
  void push_turn(Turn turn, bool is_complete);
  void push_waiting();

  PacketClock clock_;
  Turn turn_, waiting_;  // under way; and the one before, while packets of it may still come
  double step_deg_ = 0.0;
  double begins_deg_ = 0.0, ends_deg_ = 360.0;  // of the field of view, as two turns one after another had it
  double last_began_deg_ = 0.0, last_ended_deg_ = 360.0;
  std::int64_t turn_ns_ = 200'000'000;  // what a turn takes; the slowest head's until one was seen
  bool turns_back_ = false;
};

}  // namespace pose_wall::tools
