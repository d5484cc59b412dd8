// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Settings that are read again while the daemon runs: what is other, and what of it can be taken without a restart.

#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "apps/live/health.hpp"
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

// What became of the settings' last reading, for monitors: who asked for it by a signal got no answer.
class SettingReadings {
 public:
  void note_taken(std::size_t waiting, std::int64_t wall_ns);
  void note_refused(const std::string& why, std::int64_t wall_ns);
  // The part "settings". From any thread.
  PartHealth health() const;

 private:
  mutable std::mutex lock_;
  std::uint64_t readings_ = 1;  // that of the start
  std::size_t waiting_ = 0;
  std::string time_, refusal_;  // of the last one; empty: of the start, none
};

// "log_level: warning instead of info", "udp_port: 2368 instead of 0: waits for a restart".
std::string change_text(const SettingChange& change);

}  // namespace pose_wall::tools::live
