// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Every setting, whoever reads it: engine, motion library, daemon, planar part.

#pragma once

#include <string>
#include <vector>

#include "io/config_file/load_config.hpp"

namespace pose_wall::tools {

struct SettingText {
  enum class Reader { kEngine, kMotion, kLive, kPlanar };

  const char* key;
  Reader reader;
  std::string value;    // may be empty
  bool is_text;         // a name or a path, in which any sign may stand
  const char* nothing;  // how people, and settings files, write an empty one

  std::string written() const { return value.empty() ? nothing : value; }
};

// All keys of all tables, in the tables' order.
std::vector<SettingText> all_settings(const LoadedConfig& loaded);

}  // namespace pose_wall::tools
