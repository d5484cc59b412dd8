// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether the clock of this machine is set by NTP or PTP, as the kernel knows it: chrony, ntpd, systemd-timesyncd and
// others tell it how far off they believe it is.

#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "apps/live/health.hpp"

namespace pose_wall::tools::live {

struct HostClockState {
  bool is_synchronised = false;
  double error_most_ms = 0.0;  // as far as the clock may be off; it grows as long as nobody sets the clock
};

// Of the kernel; nothing where it does not say.
std::optional<HostClockState> read_host_clock();

class HostClock {
 public:
  explicit HostClock(std::function<std::optional<HostClockState>()> read = read_host_clock) : read_(std::move(read)) {}

  // From any thread. A clock that was never set is usual on a machine alone in a mine, and no fault; one that was
  // synchronised and is no more is a warning.
  PartHealth health() const;

 private:
  std::function<std::optional<HostClockState>()> read_;
  mutable std::atomic<bool> was_synchronised_{false};
};

}  // namespace pose_wall::tools::live
