// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: who has the settings read again by a signal sees in the health what became of it: how many wait for a
// restart, or why they were refused.

#include "apps/live/setting_changes.hpp"

#include <gtest/gtest.h>

#include "apps/live/health_words.hpp"
#include "live/frame_catcher.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::fact;

constexpr std::int64_t kReadAt_ns = 1'796'087'585'000'000'000;  // any

TEST(SettingReadings, TellWhatWaitsAndWhyTheyWereRefused) {
  SettingReadings readings;
  EXPECT_EQ(readings.health().summary, "read at the start");
  readings.note_taken(2, kReadAt_ns);
  PartHealth health = readings.health();
  EXPECT_EQ(health.part, "settings");
  EXPECT_EQ(health.grade, Grade::kGood);
  EXPECT_EQ(health.summary, "read at 2026-12-01T01:13:05Z: 2 wait for a restart");
  EXPECT_EQ(in_language(Language::kChinese, health).summary, "已于 2026-12-01T01:13:05Z 读取：2 项待重启后生效");
  EXPECT_EQ(fact(health, "waiting"), "2");
  readings.note_refused("a.yaml: forward_axis: up is no axis\nsecond line", kReadAt_ns);
  health = readings.health();
  EXPECT_EQ(health.grade, Grade::kWarning);
  EXPECT_EQ(health.summary, "read at 2026-12-01T01:13:05Z and refused: a.yaml: forward_axis: up is no axis");
  EXPECT_EQ(fact(health, "refused"), "1");
  EXPECT_EQ(fact(health, "waiting"), "2") << "those that were read before still wait";
  readings.note_taken(0, kReadAt_ns);
  EXPECT_EQ(readings.health().summary, "read at 2026-12-01T01:13:05Z: nothing waits for a restart");
  EXPECT_EQ(fact(readings.health(), "readings"), "4");
}

}  // namespace
}  // namespace pose_wall::tools::live
