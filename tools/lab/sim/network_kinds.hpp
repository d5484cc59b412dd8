// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Networks by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lab/sim/network_plan.hpp"

namespace pose_wall::tools::sim {

struct NetworkKind {
  const char* name;
  const char* help;
  NetworkPlan plan;
};

// The first is the default: 130 m of rough rock.
const std::vector<NetworkKind>& network_kinds();
// nullptr if there is none of this name.
const NetworkKind* find_network_kind(std::string_view name);

}  // namespace pose_wall::tools::sim
