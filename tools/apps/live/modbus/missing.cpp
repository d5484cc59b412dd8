// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In place of this edge where the build did not find its library.

#include "apps/live/edges.hpp"

namespace pose_wall::tools::live {

std::unique_ptr<Sink> make_modbus_sink(const LoadedConfig&, const Images&, const StopBoard*, CommandBoard*) {
  throw EdgeMissing("this build has no Modbus: install libmodbus-dev, configure and build again");
}

}  // namespace pose_wall::tools::live
