// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The row of a gate whose limit is a number, whatever the settings are. To be used in namespace pose_wall.

#pragma once

#include "base/gates/gate.hpp"

#define POSE_WALL_CONSTANT_GATE(id, sense_, limit_)                         \
  template <>                                                               \
  struct GateRow<id> {                                                      \
    static constexpr GateSense sense = GateSense::sense_;                   \
    static constexpr bool by_caller = false; /* each limit is in its row */ \
    static constexpr auto limit() { return limit_; }                        \
  };
