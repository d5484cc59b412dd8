// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/times_watch.hpp"

#include <fmt/format.h>

#include "apps/live/log.hpp"
#include "study/info/usable_times.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::uint64_t kLookEvery = 10;  // frames: a look at 65,000 times takes as long as reading them, 0.2 ms
constexpr std::uint64_t kLooksAlike = 2;  // a single scan may be broken

}  // namespace

void TimesWatch::note(const Frame& frame, const pose_wall_publication& publication) {
  const bool is_due = frames_ < kLooksAlike || frames_ % kLookEvery == 0;
  ++frames_;
  const bool carries = has_times(frame);
  without_ = carries ? 0 : without_ + 1;
  bent_ = carries ? 0 : bent_ + (publication.has_motion != 0 && bends_scan(publication.motion) ? 1 : 0);
  if (is_due) {
    const TimeFault seen = unusable_times(frame);
    alike_ = seen == seen_ ? alike_ + 1 : 1;
    seen_ = seen;
  }
  if (alike_ < kLooksAlike) return;
  if (seen_ == TimeFault::kNone && bent_ >= kBentScansLeast) {
    decide(TimeFault::kMissing, without_, bent_, carries);
  } else {
    decide(seen_, alike_, alike_, carries);
  }
}

void TimesWatch::decide(TimeFault fault, std::uint64_t scans, std::uint64_t faulty, bool carries) {
  has_times_ = carries;
  is_known_ = true;
  if (fault_.exchange(fault) == fault) return;
  ScanTimeFacts facts;
  facts.fault = fault;
  facts.scans = scans;
  facts.faulty = faulty;
  if (fault == TimeFault::kNone) {
    log_line(Grade::kGood, "runtime", carries ? "times of points: good again" : "times of points: clouds carry none");
  } else {
    log_line(Grade::kWarning, "runtime", fmt::format("times of points: {}", times_doubt(facts)));
  }
}

void TimesWatch::tell(PartHealth* health) const {
  const TimeFault fault = fault_;
  if (fault != TimeFault::kNone) {
    health->add("times of points", time_fault_name(fault));
    if (health->grade == Grade::kGood) health->grade = Grade::kWarning;
    if (health->grade == Grade::kWarning) health->summary += "; times of points are of no use";
    return;
  }
  health->add("times of points", !is_known_ ? "-" : has_times_ ? "good" : "none");
}

}  // namespace pose_wall::tools::live
