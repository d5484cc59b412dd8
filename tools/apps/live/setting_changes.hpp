// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Settings that are read again while the daemon runs: what is other, and what of it can be taken without a restart.

#pragma once

#include <string>
#include <vector>

#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

struct SettingChange {
  std::string key, before, after;
  bool is_taken = false;  // false: it waits for a restart
};

// All keys that differ, in the tables' order.
std::vector<SettingChange> setting_changes(const LoadedConfig& running, const LoadedConfig& fresh);

// Puts those that can be taken into the running settings.
void take_changes(const std::vector<SettingChange>& changes, const LoadedConfig& fresh, LoadedConfig* running);

// "log_level: warning instead of info", "udp_port: 2368 instead of 0: waits for a restart".
std::string change_text(const SettingChange& change);

}  // namespace pose_wall::tools::live
