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
// As of a recording (sender_facts.cpp): who told nothing by then tells nothing.
constexpr std::size_t kLooksMost = 16;

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

void SensorWatch::hear(const Datagram& datagram, const std::function<std::string()>& metadata) {
  const std::lock_guard<std::mutex> locked(lock_);
  if (!words_ && looks_ < kLooksMost) {
    ++looks_;
    words_ = packet_words_for(datagram.payload, metadata());
  }
  if (!words_) return;
  words_->hear(datagram);
  if (const std::optional<ClockReading> clock = words_->clock()) ahead_.hear(*clock, wall_ns());
}

std::optional<std::int64_t> SensorWatch::started_ns() const {
  const std::lock_guard<std::mutex> locked(lock_);
  const std::optional<std::int64_t> ahead_ns = ahead_.ahead_ns();
  if (!ahead_ns) return std::nullopt;
  return ahead_.is_of_a_date() ? 0 : -*ahead_ns;
}

void SensorWatch::begin_anew() {
  const std::lock_guard<std::mutex> locked(lock_);
  if (words_) missing_before_ += words_->state().missing.value_or(0);
  words_.reset();
  looks_ = 0;
  ahead_.begin_anew();
  was_synchronised_ = false;  // a sensor that starts takes its time until it has found a server
}

void SensorWatch::tell(bool is_silent, PartHealth* health) const {
  const std::lock_guard<std::mutex> locked(lock_);
  const SensorState state = words_ ? words_->state() : SensorState{};
  was_synchronised_ = was_synchronised_ || state.is_synchronised.value_or(false);
  const bool has_lost_clock = was_synchronised_ && state.is_synchronised == false;
  const std::string alert = !state.alert.value_or("").empty() ? *state.alert
                            : has_lost_clock ? "the sensor's clock is no longer synchronised: is its time server gone?"
                                             : "";
  if (!alert.empty()) {
    health->summary += "; " + alert;
    if (health->grade == Grade::kGood) health->grade = Grade::kWarning;
  }
  missing_told_ = std::max(missing_told_, missing_before_ + state.missing.value_or(0));
  if (missing_told_ > 0 || state.missing) health->add("packets lost on the way", missing_told_);
  if (is_silent) return;
  if (state.alert) health->add("sensor alerts", std::uint64_t{state.alert->empty() ? 0U : 1U});
  if (state.is_synchronised) health->add("sensor synchronised", *state.is_synchronised ? "yes" : "no");
  if (const std::optional<std::int64_t> ahead_ns = ahead_.ahead_ns()) {
    if (ahead_.is_of_a_date()) {
      health->add("sensor clock ahead ms", fmt::format("{:.1f}", 1e-6 * static_cast<double>(*ahead_ns)));
    } else {
      health->add("sensor clock", "since_start");
    }
  }
}

}  // namespace pose_wall::tools::live
