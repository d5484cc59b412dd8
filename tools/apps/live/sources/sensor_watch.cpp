// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sources/sensor_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/live/clocks.hpp"

namespace pose_wall::tools::live {
namespace {

// Long enough for a packet that nothing held up, short enough to follow a clock that is being set.
constexpr std::int64_t kWhile_ns = 5'000'000'000;
// 2001-09-09: no clock that was set stands before, none that counts since its start gets there.
constexpr std::int64_t kFirstDate_ns = 1'000'000'000'000'000'000;

}  // namespace

void ClockAhead::hear(const ClockReading& clock, std::int64_t wall_ns) {
  is_of_a_date_ = clock.modulus_ns > 0 || clock.clock_ns >= kFirstDate_ns;
  std::int64_t ahead_ns = clock.clock_ns - wall_ns;
  if (clock.modulus_ns > 0) {
    ahead_ns %= clock.modulus_ns;
    if (ahead_ns < -clock.modulus_ns / 2) ahead_ns += clock.modulus_ns;
    if (ahead_ns >= clock.modulus_ns / 2) ahead_ns -= clock.modulus_ns;
  }
  if (wall_ns - while_began_ns_ >= kWhile_ns || wall_ns < while_began_ns_) {
    while_began_ns_ = wall_ns;
    ahead_before_ns_ = ahead_ns_;
    ahead_ns_ = kNone;
  }
  ahead_ns_ = std::max(ahead_ns_, ahead_ns);
}

std::optional<std::int64_t> ClockAhead::ahead_ns() const {
  const std::int64_t ahead_ns = std::max(ahead_ns_, ahead_before_ns_);
  return ahead_ns == kNone ? std::nullopt : std::optional<std::int64_t>(ahead_ns);
}

void SensorWatch::hear(const Datagram& datagram, const std::string& metadata) {
  if (!words_) words_ = packet_words_for(datagram.payload, metadata);
  if (!words_) return;
  words_->hear(datagram);
  const SensorState state = words_->state();
  const std::lock_guard<std::mutex> locked(lock_);
  state_ = state;
  if (state.clock) ahead_.hear(*state.clock, wall_ns());
  was_synchronised_ = was_synchronised_ || state.is_synchronised.value_or(false);
}

std::optional<std::int64_t> SensorWatch::started_ns() const {
  const std::lock_guard<std::mutex> locked(lock_);
  const std::optional<std::int64_t> ahead_ns = ahead_.ahead_ns();
  if (!ahead_ns) return std::nullopt;
  return ahead_.is_of_a_date() ? 0 : -*ahead_ns;
}

void SensorWatch::begin_anew() {
  words_.reset();
  const std::lock_guard<std::mutex> locked(lock_);
  missing_before_ += state_.missing.value_or(0);
  state_ = {};
  ahead_.begin_anew();
}

void SensorWatch::tell(PartHealth* health) const {
  const std::lock_guard<std::mutex> locked(lock_);
  const bool has_lost_clock = was_synchronised_ && state_.is_synchronised == false;
  const std::string alert = !state_.alert.value_or("").empty() ? *state_.alert
                            : has_lost_clock ? "the sensor's clock is no longer synchronised: is its time server gone?"
                                             : "";
  if (!alert.empty()) {
    health->summary += "; " + alert;
    if (health->grade == Grade::kGood) health->grade = Grade::kWarning;
  }
  if (state_.alert) health->add("sensor alerts", std::uint64_t{state_.alert->empty() ? 0U : 1U});
  if (state_.is_synchronised) health->add("sensor synchronised", *state_.is_synchronised ? "yes" : "no");
  if (const std::optional<std::int64_t> ahead_ns = ahead_.ahead_ns()) {
    if (ahead_.is_of_a_date()) {
      health->add("sensor clock ahead ms", fmt::format("{:.1f}", 1e-6 * static_cast<double>(*ahead_ns)));
    } else {
      health->add("sensor clock", "since_start");
    }
  }
  if (missing_before_ > 0 || state_.missing) {
    health->add("packets lost on the way", missing_before_ + state_.missing.value_or(0));
  }
}

}  // namespace pose_wall::tools::live
