// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In place of this edge where the build did not find its library.

#include "apps/live/edges.hpp"

namespace pose_wall::tools::live {

std::unique_ptr<Sink> make_foxglove_sink(const LoadedConfig&, const HealthBoard&) {
  throw EdgeMissing("this build has no edge for Foxglove: install libwebsockets-dev, configure and build again");
}

}  // namespace pose_wall::tools::live
