// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/packet_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pose_wall::tools {
namespace {

// One packet may be damaged, or later than is believed. So many in a row tell that the clock was set.
constexpr int kDoubtedMost = 3;
// Long enough that some packet comes at once, also from a driver that hands on whole turns.
constexpr std::int64_t kDelayWindow_ns = 1'000'000'000;
// No packet arrives before it is sent. The least delay of two windows may be too long by a burst: half a turn.
constexpr std::int64_t kEarlyMost_ns = 50'000'000;
// Beside the sensor's clock arrival leaps by so much where the computer's was set; no buffer holds packets longer.
constexpr std::int64_t kArrivalLeap_ns = 1'000'000'000;
// A year: such a time of arrival is damaged, and nothing is told by it.
constexpr std::int64_t kDamaged_ns = 31'536'000'000'000'000;

}  // namespace

// From the anchor. Whole turns of the clock are those that arrival tells, of which delays are a part.
std::int64_t PacketClock::went_ns(std::int64_t clock_ns, std::int64_t arrived_ns, std::int64_t modulus_ns) const {
  std::int64_t went_ns = clock_ns - *anchor_->clock_ns;
  if (modulus_ns <= 0) return went_ns;
  went_ns %= modulus_ns;
  if (went_ns < -kPacketLateMost_ns) went_ns += modulus_ns;
  if (went_ns > modulus_ns - kPacketLateMost_ns) went_ns -= modulus_ns;
  constexpr double kDelayMost = 0.9;  // of a turn of the clock
  const double turns = static_cast<double>(arrived_ns - went_ns) / static_cast<double>(modulus_ns);
  const double whole = std::floor(turns + 1.0 - kDelayMost);
  return whole > 0.0 ? went_ns + modulus_ns * static_cast<std::int64_t>(whole) : went_ns;
}

// A packet follows the last one soon, or is late by as much as kPacketLateMost_ns, or follows a pause.
bool PacketClock::is_believed(std::int64_t went_ns, std::int64_t arrived_ns) const {
  const bool is_next = went_ns >= -kPacketLateMost_ns && went_ns <= kPacketPause_ns;
  const bool is_behind_pause = arrived_ns > kPacketPause_ns && std::abs(went_ns - arrived_ns) <= kPacketPause_ns;
  if (!is_next && !is_behind_pause) return false;
  const std::int64_t delay_ns = anchor_->arrival_ns + arrived_ns - anchor_->moment_ns - went_ns;
  const bool is_early = windows_ > 1 && arrived_ns >= 0 && delay_ns < offset_ns() - kEarlyMost_ns;
  return !is_early;
}

void PacketClock::hear_delay(std::int64_t delay_ns, std::int64_t arrival_ns) {
  if (std::abs(arrival_ns - window_began_ns_) >= kDelayWindow_ns) {
    least_before_ns_ = least_ns_;
    least_ns_ = delay_ns;
    window_began_ns_ = arrival_ns;
    ++windows_;
  }
  least_ns_ = std::min(least_ns_, delay_ns);
}

void PacketClock::begin_windows(std::int64_t delay_ns, std::int64_t arrival_ns) {
  least_ns_ = least_before_ns_ = delay_ns;
  window_began_ns_ = arrival_ns;
  windows_ = 0;
}

std::int64_t PacketClock::moment_ns(std::int64_t arrival_ns, std::optional<std::int64_t> clock_ns,
                                    std::int64_t modulus_ns) {
  if (!anchor_ || std::abs(arrival_ns - anchor_->arrival_ns) > kDamaged_ns) {
    anchor_ = {arrival_ns, arrival_ns, clock_ns};
    begin_windows(0, arrival_ns);
    return arrival_ns;
  }
  const std::int64_t arrived_ns = arrival_ns - anchor_->arrival_ns;
  std::int64_t moment_ns = anchor_->moment_ns + arrived_ns;
  const bool stands = !clock_ns || !anchor_->clock_ns || *clock_ns == *anchor_->clock_ns;
  const std::int64_t went_ns = stands ? 0 : this->went_ns(*clock_ns, arrived_ns, modulus_ns);
  if (!stands && is_believed(went_ns, arrived_ns)) {
    moment_ns = anchor_->moment_ns + went_ns;
    doubted_ = 0;
    anchor_ = {moment_ns, arrival_ns, clock_ns};
    if (std::abs(arrived_ns - went_ns) > kArrivalLeap_ns) begin_windows(arrival_ns - moment_ns, arrival_ns);
  } else if (stands ? std::abs(arrived_ns) > kPacketLateMost_ns : ++doubted_ == kDoubtedMost) {
    // It goes on from here as it arrived. One that came twice is told apart from a clock that stands by coming soon.
    doubted_ = 0;
    anchor_ = {moment_ns, arrival_ns, clock_ns};
  }
  hear_delay(arrival_ns - moment_ns, arrival_ns);
  return moment_ns;
}

std::int64_t PacketClock::offset_ns() const {
  return std::min(least_ns_, least_before_ns_);
}

}  // namespace pose_wall::tools
