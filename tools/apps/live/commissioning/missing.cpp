// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In place of this edge where the build did not find its library.

#include "apps/live/edges.hpp"

namespace pose_wall::tools::live {

std::unique_ptr<Commissioning> make_commissioning(const LoadedConfig&, const HealthBoard&, std::function<void()>) {
  throw EdgeMissing("this build has no page to commission from: install libwebsockets-dev, configure and build again");
}

}  // namespace pose_wall::tools::live
