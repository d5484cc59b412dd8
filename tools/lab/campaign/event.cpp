// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/event.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::campaign {
namespace {

constexpr double kRecovery_s = 2.0;   // after an event
constexpr double kUnsteady_s = 3.0;   // of frames that come twice, or not, or when they like
constexpr double kAfterRise_s = 1.0;  // in dust as thick as it gets

class Events {
 public:
  explicit Events(double rate_hz) : rate_hz_(rate_hz) {}

  void add(bool happens, double from_s, double to_s) {
    if (!happens) return;
    const std::uint32_t first = frame_at(from_s), after = frame_at(to_s);
    first_ = any_ ? std::min(first_, first) : first;
    after_ = any_ ? std::max(after_, after) : after;
    any_ = true;
  }
  void add_interval(double from_s, double to_s) { add(from_s < to_s, from_s, to_s); }
  // It may begin in the midst of a scan.
  void add_within_scans(double from_s, double to_s, double scan_s) {
    const double scans_from_s = (std::floor((from_s - scan_s) * rate_hz_) + 1.0) / rate_hz_;
    add(from_s < to_s, std::min(from_s, std::max(scans_from_s, 0.0)), to_s);
  }

  std::optional<Event> whole() const { return any_ ? std::optional<Event>(Event{first_, after_}) : std::nullopt; }

 private:
  // As the simulator compares: the first frame whose time is not before it.
  std::uint32_t frame_at(double time_s) const { return static_cast<std::uint32_t>(std::ceil(time_s * rate_hz_)); }

  double rate_hz_;
  bool any_ = false;
  std::uint32_t first_ = 0, after_ = 0;
};

}  // namespace

std::optional<Event> event_of(const sim::Setup& setup) {
  const sim::Sequence& q = setup.sequence;
  const sim::Faults& faults = setup.faults;
  const sim::Machine& machine = setup.machine;
  Events events(q.rate_hz);
  if (faults.lost_side != static_cast<double>(sim::kSideNone))
    events.add_within_scans(faults.lost_from_s, faults.lost_to_s, q.scan_s);
  events.add_interval(q.freeze_from_s, q.freeze_to_s);
  events.add_within_scans(q.partial_from_s, q.partial_to_s, q.scan_s);
  events.add_interval(q.stamp_still_from_s, q.stamp_still_to_s);
  events.add(q.stamp_jump_s != 0.0, q.stamp_jump_at_s, q.stamp_jump_at_s);
  events.add(machine.turn_step_deg != 0.0, machine.turn_step_at_s, machine.turn_step_at_s);
  return events.whole();
}

std::uint32_t frames_to_watch(const sim::Setup& setup) {
  const sim::Sequence& q = setup.sequence;
  double watched_s = 0.0;
  const auto watch = [&watched_s](bool happens, double time_s) {
    if (happens) watched_s = std::max(watched_s, time_s);
  };
  watch(q.duplicate_every >= 1.0 || q.drop_every >= 1.0 || q.stamp_jitter_s > 0.0, kUnsteady_s);
  watch(setup.faults.dust > 0.0 && setup.faults.dust_rise_s > 0.0, setup.faults.dust_rise_s + kAfterRise_s);
  watch(setup.machine.boom_sweep_deg > 0.0, 0.5 * setup.machine.boom_period_s);
  const auto frames = static_cast<std::uint32_t>(std::ceil(watched_s * q.rate_hz));
  const std::optional<Event> event = event_of(setup);
  if (!event) return frames;
  return std::max(frames, event->after + static_cast<std::uint32_t>(std::ceil(kRecovery_s * q.rate_hz)));
}

}  // namespace pose_wall::tools::campaign
