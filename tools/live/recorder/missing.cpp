// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "live/edges.hpp"

namespace pose_wall::tools::live {

std::unique_ptr<Sink> make_recorder(const LoadedConfig&, const HealthBoard&) {
  throw EdgeMissing("this build has no recorder");
}

BlackBox open_black_box(const LoadedConfig& loaded) {
  if (!loaded.live.black_box.empty()) throw EdgeMissing("this build has no black box");
  return {};
}

}  // namespace pose_wall::tools::live
