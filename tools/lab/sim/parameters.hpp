// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The setup's numbers by name: the one table of keys with unit, range and help; defaults are those of setup.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

struct Parameter {
  const char* group;
  const char* name;
  const char* unit;   // "m", "deg", ...; "1" for shares, counts and factors, "" for words
  const char* words;  // "none|left|right|both": the number is the word's index; "" for plain numbers
  double minimum;
  double maximum;
  const char* help;
  double& (*field)(Setup&);
};

// In the order of setup.hpp.
const std::vector<Parameter>& parameters();

// nullptr if there is none of this name.
const Parameter* find_parameter(std::string_view name);

// Throws std::invalid_argument that says what is allowed, and what may have been meant.
void set_parameter(Setup& setup, std::string_view name, std::string_view value);
// The same for "KEY=VALUE".
void set_parameter(Setup& setup, std::string_view assignment);

// A number of the table as it would be written on the command line.
std::string parameter_text(const Parameter& parameter, double value);

}  // namespace pose_wall::tools::sim
