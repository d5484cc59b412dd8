// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the data packets of one sender tell of it beside its points: return mode, turn rate, source of time, and how
// many of them are missing; and how it fares. A value of which the packets are no certain witness is left out.

#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "io/frames/frame_source.hpp"
#include "io/packets/datagram_source.hpp"

namespace pose_wall::tools {

// Packets that are missing, by numbers that rise by a `unit` from each packet to the next and begin anew at `modulus`.
// One that came twice, or late, is not missing.
class MissingPackets {
 public:
  void hear(std::int64_t number, double unit, std::int64_t modulus);

  // Whether the numbers rise at all.
  bool is_told() const { return steps_ > 0; }
  std::uint64_t missing() const { return missing_; }
  // Those that came again, and those that came behind a later one.
  std::uint64_t repeated() const { return repeated_; }
  std::uint64_t late() const { return late_; }
  // Of all that were sent.
  double share() const;

 private:
  std::deque<std::int64_t> last_ones_;
  std::int64_t last_ = 0;
  std::uint64_t heard_ = 0, missing_ = 0, steps_ = 0, repeated_ = 0, late_ = 0;
};

// A sensor's clock beside the times at which its packets arrived.
class ClockBesideArrival {
 public:
  // `modulus_ns`: at which it begins anew; 0: never.
  void hear(std::int64_t clock_ns, std::int64_t arrival_ns, std::int64_t modulus_ns);

  // A sentence; "" where the two agree, or too little was heard.
  std::string oddity() const;

 private:
  std::int64_t last_ns_ = 0, went_ns_ = 0, first_arrival_ns_ = 0, last_arrival_ns_ = 0;
  std::uint64_t heard_ = 0;
};

// A sensor's clock at a packet.
struct ClockReading {
  std::int64_t clock_ns = 0;
  std::int64_t modulus_ns = 0;  // at which it begins anew; 0: never
};

// What the newest packet of a sensor says of its own state, as far as its packets tell.
struct SensorState {
  std::optional<std::string> alert;      // a sentence in English, as retold() takes it; "": all is well
  std::optional<bool> is_synchronised;   // to a clock outside
  std::optional<ClockReading> clock;     // nothing: none that could be compared
  std::optional<std::uint64_t> missing;  // packets, by their numbers
};

// Is told of all datagrams of one sender.
class PacketWords {
 public:
  PacketWords() = default;
  PacketWords(const PacketWords&) = delete;
  PacketWords& operator=(const PacketWords&) = delete;
  virtual ~PacketWords() = default;

  virtual void hear(const Datagram& datagram) = 0;
  // Of all that was heard.
  virtual void describe(SourceSender* sender) const = 0;
  // Of the newest packet.
  virtual SensorState state() const = 0;
  // state().clock, for each packet.
  virtual std::optional<ClockReading> clock() const = 0;
};

// For the sensor whose data this is; nothing where it is of none that tells more. `metadata`: that of an Ouster, or "".
std::unique_ptr<PacketWords> packet_words_for(ByteView payload, const std::string& metadata);

}  // namespace pose_wall::tools
