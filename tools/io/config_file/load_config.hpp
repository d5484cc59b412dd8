// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Settings of the engine, of the motion library and of pose_walld from a pose_wall.yaml and from --set KEY=VALUE, each
// with where it came from.

#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/config_file/live_settings.hpp"
#include "io/config_file/motion_settings.hpp"
#include "io/config_file/planar_settings.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools {

struct LoadedConfig {
  api::Config config;
  std::string file;                         // that was read, or files with commas between them; empty: none
  std::string asked_files;                  // as load_config was asked, so that it can be asked again
  std::vector<std::string> asked_settings;  // likewise
  std::string notes;      // what a person should know of their choice and order, a line each; empty: nothing
  LiveSettings live;      // of pose_walld; the engine does not read them
  PlanarSettings planar;  // likewise
  pose_wall_motion_settings motion = default_motion_settings();
  std::map<std::string, std::string> origins;  // keys that were set: "pose_wall.yaml:12" or "--set"

  // Where a key's value comes from; "default" for a key that was not set.
  std::string origin(const std::string& key) const;
};

// One line per fault, each naming file and line (or --set), key, value and what is allowed.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Defaults, then each file or config of that name in turn (find_configs; "": none), then what was commissioned, then
// each KEY=VALUE in turn; then the rules over several keys. All faults are collected before anything is thrown. Throws
// ConfigError.
LoadedConfig load_config(const std::string& files, const std::vector<std::string>& settings);

// Where the page saves the settings of a machine, in the folder of the key `commissioned`.
std::string commissioned_file(const std::string& folder);

// The notes, on stderr.
void tell_notes(const LoadedConfig& loaded, bool quiet);

}  // namespace pose_wall::tools
