// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/setting_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/config_file/all_settings.hpp"
#include "io/numbers/utc_text.hpp"

namespace pose_wall::tools::live {
namespace {

// What decides neither what is measured, nor who can reach the daemon, nor memory that was taken at the start.
constexpr std::array<const char*, 2> kTaken = {"log_level", "status_every_s"};
constexpr std::int64_t kNsPerS = 1'000'000'000;

}  // namespace

std::vector<SettingChange> setting_changes(const LoadedConfig& running, const LoadedConfig& fresh) {
  std::vector<SettingChange> changes;
  const std::vector<SettingText> before = all_settings(running), after = all_settings(fresh);
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k].value == after[k].value) continue;
    const bool is_taken = std::find(kTaken.begin(), kTaken.end(), std::string(before[k].key)) != kTaken.end();
    changes.push_back({before[k].key, before[k].written(), after[k].written(), is_taken});
  }
  return changes;
}

void take_changes(const std::vector<SettingChange>& changes, const LoadedConfig& fresh, LoadedConfig* running) {
  for (const SettingChange& change : changes) {
    if (!change.is_taken) continue;
    // It was read from settings that were allowed.
    const OutsideKey& key = *find_live_key(change.key);
    static_cast<void>(set_live_value(&running->live, key, live_value_text(fresh.live, key)));
  }
}

void SettingReadings::note_taken(std::size_t waiting, std::int64_t wall_ns) {
  const std::lock_guard<std::mutex> locked(lock_);
  ++readings_;
  waiting_ = waiting;
  time_ = utc_text(wall_ns / kNsPerS);
  refusal_.clear();
}

void SettingReadings::note_refused(const std::string& why, std::int64_t wall_ns) {
  const std::lock_guard<std::mutex> locked(lock_);
  ++readings_;
  time_ = utc_text(wall_ns / kNsPerS);
  refusal_ = why;
  // One sentence (health.hpp): the log has all lines.
  refusal_ = refusal_.substr(0, refusal_.find('\n'));
}

PartHealth SettingReadings::health() const {
  const std::lock_guard<std::mutex> locked(lock_);
  PartHealth health;
  health.part = "settings";
  health.grade = refusal_.empty() ? Grade::kGood : Grade::kWarning;
  health.summary = !refusal_.empty() ? fmt::format("read at {} and refused: {}", time_, refusal_)
                   : time_.empty()   ? "read at the start"
                   : waiting_ == 0   ? fmt::format("read at {}: nothing waits for a restart", time_)
                                     : fmt::format("read at {}: {} wait for a restart", time_, waiting_);
  health.add("readings", readings_);
  health.add("waiting", std::uint64_t{waiting_});
  health.add("refused", std::uint64_t{refusal_.empty() ? 0U : 1U});
  return health;
}

std::string change_text(const SettingChange& change) {
  return fmt::format("{}: {} instead of {}{}", change.key, change.after, change.before,
                     change.is_taken ? "" : ": waits for a restart");
}

}  // namespace pose_wall::tools::live
