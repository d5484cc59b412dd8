// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// For the files that hold the table's rows, in which a key is named once: as the member.
#pragma once

#include "lab/sim/parameters.hpp"

namespace pose_wall::tools::sim {

template <auto Group, auto Member>
double& parameter_field(Setup& setup) {
  return setup.*Group.*Member;
}

std::vector<Parameter> road_parameters();
std::vector<Parameter> machine_parameters();
std::vector<Parameter> sensor_parameters();

inline constexpr const char* kSideWords = "none|left|right|both";
inline constexpr const char* kSwitchWords = "no|yes";

}  // namespace pose_wall::tools::sim

#define POSE_WALL_SIM_NUMBER(group, type, member, unit, minimum, maximum, help) \
  { #group, #member, unit, "", minimum, maximum, help, &parameter_field < &Setup::group, &type::member> }
#define POSE_WALL_SIM_WORDS(group, type, member, words, last, help) \
  { #group, #member, "", words, 0.0, last, help, &parameter_field < &Setup::group, &type::member> }
