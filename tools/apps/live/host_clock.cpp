// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/host_clock.hpp"

#include <fmt/format.h>
#include <sys/timex.h>

namespace pose_wall::tools::live {
namespace {

constexpr double kMillisecondsPerMicrosecond = 1e-3;  // timex counts in microseconds (adjtimex(2))

}  // namespace

std::optional<HostClockState> read_host_clock() {
  timex told{};  // modes 0: it only reads
  const int state = adjtimex(&told);
  if (state < 0) return std::nullopt;
  const bool is_synchronised = state != TIME_ERROR && (told.status & STA_UNSYNC) == 0;
  return HostClockState{is_synchronised, kMillisecondsPerMicrosecond * static_cast<double>(told.maxerror)};
}

PartHealth HostClock::health() const {
  PartHealth health;
  health.part = "host clock";
  const std::optional<HostClockState> now = read_();
  health.add("synchronised", !now ? "-" : now->is_synchronised ? "yes" : "no");
  if (!now) {
    health.summary = "the kernel does not tell whether it is set by NTP or PTP";
  } else if (now->is_synchronised) {
    was_synchronised_ = true;
    health.summary = "is set by NTP or PTP";
    health.add("error at most ms", fmt::format("{:.1f}", now->error_most_ms));
  } else if (was_synchronised_) {
    health.grade = Grade::kWarning;
    health.summary = "was set by NTP or PTP, and is no more: is the time server gone?";
  } else {
    health.summary = "is not set by NTP or PTP: times of logs and recordings are this machine's own";
  }
  return health;
}

}  // namespace pose_wall::tools::live
