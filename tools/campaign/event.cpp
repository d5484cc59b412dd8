// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/event.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::campaign {
namespace {

class Events {
 public:
  explicit Events(double rate_hz) : rate_hz_(rate_hz) {}

  void add(bool happens, double from_s, double to_s) {
    if (!happens) return;
    const Event next{frame_at(from_s), frame_at(to_s)};
    event_ = event_ ? Event{std::min(event_->first, next.first), std::max(event_->after, next.after)} : next;
  }
  void add_interval(double from_s, double to_s) { add(from_s < to_s, from_s, to_s); }

  std::optional<Event> whole() const { return event_; }

 private:
  // As the simulator compares: the first frame whose time is not before it.
  std::uint32_t frame_at(double time_s) const { return static_cast<std::uint32_t>(std::ceil(time_s * rate_hz_)); }

  double rate_hz_;
  std::optional<Event> event_;
};

}  // namespace

std::optional<Event> event_of(const sim::Setup& setup) {
  const sim::Sequence& q = setup.sequence;
  const sim::Faults& faults = setup.faults;
  const sim::Machine& machine = setup.machine;
  Events events(q.rate_hz);
  if (faults.lost_side != sim::kSideNone) events.add_interval(faults.lost_from_s, faults.lost_to_s);
  events.add_interval(q.freeze_from_s, q.freeze_to_s);
  events.add_interval(q.partial_from_s, q.partial_to_s);
  events.add_interval(q.stamp_still_from_s, q.stamp_still_to_s);
  events.add(q.stamp_jump_s != 0.0, q.stamp_jump_at_s, q.stamp_jump_at_s);
  events.add(machine.turn_step_deg != 0.0, machine.turn_step_at_s, machine.turn_step_at_s);
  return events.whole();
}

}  // namespace pose_wall::tools::campaign
