// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The last value for who subscribes late. A broker keeps it, so it must never look current when it is not: it tells its
// age and until when it holds, it is told anew each second, and what has no fresh result has no values.

#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "apps/live/images.hpp"

namespace pose_wall::tools::live {

// Three of the messages that come each second: one may be late, and one more lost.
constexpr auto kLastValueHolds = std::chrono::seconds(3);

struct LastValue {
  std::string json;
  std::string gist;  // what is told at once when it changes: state, and what may steer
};

// now_ns by the clock of published_ns; wall_ns by the one that people set.
LastValue last_value(const Newest& newest, std::int64_t now_ns, std::int64_t wall_ns);

// What stands there once the daemon has stopped, or is gone.
std::string no_last_value();

// A line of JSON with the time up to which it holds: "valid_until_ns".
std::string with_end(std::string json, std::int64_t wall_ns);

}  // namespace pose_wall::tools::live
