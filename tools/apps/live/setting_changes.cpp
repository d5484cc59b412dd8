// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/setting_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/config_file/key_table.hpp"

namespace pose_wall::tools::live {
namespace {

// What decides neither what is measured, nor who can reach the daemon, nor memory that was taken at the start.
constexpr std::array<const char*, 2> kTaken = {"log_level", "status_every_s"};

std::string shown(const std::string& value) {
  return value.empty() ? "''" : value;
}

}  // namespace

std::vector<SettingChange> setting_changes(const LoadedConfig& running, const LoadedConfig& fresh) {
  std::vector<SettingChange> changes;
  const auto compare = [&](const char* key, const std::string& before, const std::string& after) {
    const bool is_taken = std::find(kTaken.begin(), kTaken.end(), std::string(key)) != kTaken.end();
    if (before != after) changes.push_back({key, before, after, is_taken});
  };
  for (const pose_wall_key_info& key : config_keys()) {
    compare(key.name, config_written_text(*running.config.get(), key), config_written_text(*fresh.config.get(), key));
  }
  for (const OutsideKey& key : motion_keys()) {
    compare(key.name, motion_value_text(running.motion, key), motion_value_text(fresh.motion, key));
  }
  for (const OutsideKey& key : live_keys()) {
    compare(key.name, live_value_text(running.live, key), live_value_text(fresh.live, key));
  }
  for (const OutsideKey& key : planar_keys()) {
    compare(key.name, planar_value_text(running.planar, key), planar_value_text(fresh.planar, key));
  }
  return changes;
}

void take_changes(const std::vector<SettingChange>& changes, LoadedConfig* running) {
  for (const SettingChange& change : changes) {
    if (!change.is_taken) continue;
    // It was read from settings that were allowed.
    static_cast<void>(set_live_value(&running->live, *find_live_key(change.key), change.after));
  }
}

std::string change_text(const SettingChange& change) {
  return fmt::format("{}: {} instead of {}{}", change.key, shown(change.after), shown(change.before),
                     change.is_taken ? "" : ": waits for a restart");
}

}  // namespace pose_wall::tools::live
