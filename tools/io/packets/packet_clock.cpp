// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/packet_clock.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools {
namespace {

// A clock that goes back by more, or ahead by more, was set: then arrival tells what went by. Packets that come late go
// back by less than the turn assembler waits for them; two turns of the slowest head are a pause.
constexpr std::int64_t kBackMost_ns = 40'000'000, kAheadMost_ns = 400'000'000;
// Long enough that some packet comes at once, also from a driver that hands on whole turns.
constexpr std::int64_t kDelayWindow_ns = 1'000'000'000;

}  // namespace

std::optional<std::int64_t> PacketClock::went_ns(std::int64_t arrived_ns, std::optional<std::int64_t> clock_ns,
                                                 std::int64_t modulus_ns) const {
  if (!clock_ns || !clock_ns_) return std::nullopt;
  std::int64_t went_ns = *clock_ns - *clock_ns_;
  if (went_ns == 0) return std::nullopt;  // it stands still
  if (modulus_ns > 0) {
    const double turns = static_cast<double>(arrived_ns - went_ns) / static_cast<double>(modulus_ns);
    went_ns += modulus_ns * std::llround(turns);
  }
  if (went_ns < -kBackMost_ns || went_ns > kAheadMost_ns) return std::nullopt;
  return went_ns;
}

void PacketClock::hear_delay(std::int64_t delay_ns) {
  if (moment_ns_ - window_began_ns_ >= kDelayWindow_ns) {
    least_before_ns_ = least_ns_;
    least_ns_ = delay_ns;
    window_began_ns_ = moment_ns_;
  }
  least_ns_ = std::min(least_ns_, delay_ns);
}

std::int64_t PacketClock::moment_ns(std::int64_t arrival_ns, std::optional<std::int64_t> clock_ns,
                                    std::int64_t modulus_ns) {
  if (!has_begun_) {
    has_begun_ = true;
    moment_ns_ = window_began_ns_ = arrival_ns;
  } else {
    const std::int64_t arrived_ns = arrival_ns - arrival_ns_;
    moment_ns_ += went_ns(arrived_ns, clock_ns, modulus_ns).value_or(arrived_ns);
    hear_delay(arrival_ns - moment_ns_);
  }
  arrival_ns_ = arrival_ns;
  clock_ns_ = clock_ns;
  return moment_ns_;
}

std::int64_t PacketClock::offset_ns() const {
  return std::min(least_ns_, least_before_ns_);
}

}  // namespace pose_wall::tools
