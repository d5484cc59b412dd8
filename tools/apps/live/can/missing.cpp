// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In place of this edge where the build did not find the kernel's headers.

#include "apps/live/edges.hpp"

namespace pose_wall::tools::live {

namespace {

constexpr const char* kMissing = "this build has no CAN: install linux-libc-dev, configure and build again";

}  // namespace

std::unique_ptr<Sink> make_can_sink(const LoadedConfig&, const Images&, const StopBoard*) {
  throw EdgeMissing(kMissing);
}

std::unique_ptr<Sink> make_can_commands(const LoadedConfig&, CommandBoard&) {
  throw EdgeMissing(kMissing);
}

}  // namespace pose_wall::tools::live
