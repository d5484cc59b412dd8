// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How the sensor fares by its own packets, for the health of its source: its alerts, its clock beside this machine's,
// and packets that the network lost.

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "apps/live/health.hpp"
#include "io/packets/packet_words.hpp"

namespace pose_wall::tools::live {

// How far a sensor's clock is ahead of this machine's: of all packets of a while the one that was on its way for the
// shortest time.
class ClockAhead {
 public:
  void hear(const ClockReading& clock, std::int64_t wall_ns);
  void begin_anew() { *this = ClockAhead(); }

  // Whether it counts from a date, and not since the sensor's start.
  bool is_of_a_date() const { return is_of_a_date_; }
  // Nothing before the first packet.
  std::optional<std::int64_t> ahead_ns() const;

 private:
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
  bool is_of_a_date_ = false;
  std::int64_t while_began_ns_ = 0;
  std::int64_t ahead_ns_ = kNone, ahead_before_ns_ = kNone;  // in this while, and in the one before
};

// 2001-09-09: no clock that was set stands before, none that counts since its start gets there.
inline constexpr std::int64_t kFirstDate_ns = 1'000'000'000'000'000'000;

class SensorWatch {
 public:
  // Of each data packet of the sensor that is read, in one thread. metadata: gives that of an Ouster, or "".
  void hear(const Datagram& datagram, const std::function<std::string()>& metadata);
  // When the sensor's clock began to count, by the clock of this machine that people set. 0 where it counts from a
  // date, nothing before the first packet that tells.
  std::optional<std::int64_t> started_ns() const;
  // After the sensor was silent: another one may stand there.
  void begin_anew();

  // From any thread. Adds facts; an alert makes it a warning. Of a silent sensor it tells the last alert alone, and
  // what was lost.
  void tell(bool is_silent, PartHealth* health) const;

 private:
  mutable std::mutex lock_;  // of all below
  std::unique_ptr<PacketWords> words_;
  std::size_t looks_ = 0;  // at packets that told nothing
  ClockAhead ahead_;
  std::uint64_t missing_before_ = 0;
  mutable std::uint64_t missing_told_ = 0;  // a packet that comes late is missed no more, and no count goes back
  mutable bool was_synchronised_ = false;
};

}  // namespace pose_wall::tools::live
