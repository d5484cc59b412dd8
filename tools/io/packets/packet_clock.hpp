// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// When the packets of a sensor were sent. Network cards, drivers and disks hand them on in bursts, so arrival tells
// only the date. What lies between two packets is told by the sensor's own clock, where it has one that runs.

#pragma once

#include <cstdint>
#include <optional>

namespace pose_wall::tools {

// Most clocks begin anew with each second.
constexpr std::int64_t kClockSecond_ns = 1'000'000'000;
// At 1,200 turns a minute 330 degrees take 46 ms: what was sent so long before the packet that came last belongs to
// another turn.
constexpr std::int64_t kPacketLateMost_ns = 40'000'000;
// Two turns of the slowest head, 300 a minute. Behind such a pause another part of a recording begins.
constexpr std::int64_t kPacketPause_ns = 400'000'000;

// Moments lie on a line of time that runs as the sensor's clock does. Where that stands still or is set it runs as
// packets arrive. offset_ns() leads from there to the time of arrival: the least delay of the last second or two
// counts. It may change from packet to packet, so a scan takes it once, for its stamp.
class PacketClock {
 public:
  // Of the next packet. `clock_ns` begins anew at `modulus_ns`, so that a packet may be held back for nine tenths of
  // that; 0: never. No clock: the moment goes on as arrivals do.
  std::int64_t moment_ns(std::int64_t arrival_ns, std::optional<std::int64_t> clock_ns, std::int64_t modulus_ns);

  std::int64_t offset_ns() const;

 private:
  // The last packet whose clock was believed.
  struct Anchor {
    std::int64_t moment_ns = 0, arrival_ns = 0;
    std::optional<std::int64_t> clock_ns;
  };

  std::int64_t went_ns(std::int64_t clock_ns, std::int64_t arrived_ns, std::int64_t modulus_ns) const;
  bool is_believed(std::int64_t went_ns, std::int64_t arrived_ns) const;
  void hear_delay(std::int64_t delay_ns, std::int64_t arrival_ns);
  void begin_windows(std::int64_t delay_ns, std::int64_t arrival_ns);

  std::optional<Anchor> anchor_;
  int doubted_ = 0;  // packets in a row
  // Arrival less moment: the least since window_began_ns_, and of the window before.
  std::int64_t window_began_ns_ = 0;  // of arrival
  std::int64_t least_ns_ = 0, least_before_ns_ = 0;
  int windows_ = 0;  // that have ended since they began anew
};

}  // namespace pose_wall::tools
