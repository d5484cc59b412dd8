// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the log of a part that goes to and fro stays short, tells how often it changed and how it ended; what is new
// is told at once.

#include <gtest/gtest.h>

#include "apps/live/health_words.hpp"
#include "apps/live/log.hpp"
#include "apps/live/result_json.hpp"

namespace pose_wall::tools::live {
namespace {

class HealthLogTest : public testing::Test {
 protected:
  void say(const std::string& summary, std::chrono::milliseconds later) {
    now_ += later;
    log_.note({{"runtime", Grade::kWarning, summary, {}}}, now_);
  }

  std::vector<std::string> lines_;
  HealthLog log_{[this](Grade, const std::string&, const std::string& fact) { lines_.push_back(fact); }};
  HealthLog::Clock::time_point now_{std::chrono::hours(1)};
};

TEST_F(HealthLogTest, WhatStaysIsToldOnce) {
  for (int i = 0; i < 3000; ++i) say("measures", std::chrono::milliseconds(50));
  EXPECT_EQ(lines_, std::vector<std::string>{"measures"});
}

TEST_F(HealthLogTest, AFloodIsSummedUpOnceAWindowAndItsEndIsTold) {
  // 100 s to and fro, ten times a second, then rest.
  for (int i = 0; i < 1000; ++i) {
    say(i % 2 == 0 ? "no frame comes" : "measures", std::chrono::milliseconds(100));
  }
  for (int i = 0; i < 1000; ++i) say("measures", std::chrono::milliseconds(100));
  ASSERT_EQ(lines_.size(), 6U + 1U + 4U + 1U);
  EXPECT_EQ(lines_[6], "no frame comes; it goes to and fro: from here on one line sums up 30 s");
  // 300 changes fit into 30 s; six of the first were told.
  EXPECT_EQ(lines_[7], "measures; changed 294 more times in 30 s");
  EXPECT_EQ(lines_[8], "measures; changed 300 more times in 30 s");
  EXPECT_EQ(lines_.back(), "measures; it rests");
}

TEST_F(HealthLogTest, WhatIsNewIsToldAtOnceInAFloodToo) {
  for (int i = 0; i < 100; ++i) {
    say(i % 2 == 0 ? "no frame comes" : "measures", std::chrono::milliseconds(100));
  }
  say("the worker hangs", std::chrono::milliseconds(100));
  EXPECT_EQ(lines_.back(), "the worker hangs");
}

TEST(HealthWords, TellAPartInChineseAndKeepItsNames) {
  PartHealth health{"sink modbus 127.0.0.1:502", Grade::kGood, "serves", {}};
  health.add("clients", std::uint64_t{2});
  health.add("of", std::uint64_t{70});
  health.add("yaw", std::string("valid"));
  health.add("why", std::string("The floor is not seen, for 3 s. Drive slower."));
  health.chinese_facts["why"] = "未见底板";
  EXPECT_EQ(in_language(Language::kEnglish, health).facts, health.facts);
  const PartHealth told = in_language(Language::kChinese, health);
  EXPECT_EQ(told.part, "输出 modbus 127.0.0.1:502");
  EXPECT_EQ(told.summary, "正在服务");
  EXPECT_EQ(told.facts, (std::vector<std::pair<std::string, std::string>>{
                            {"客户端", "2"}, {"总数", "70"}, {"航向", "有效"}, {"原因与解除", "未见底板"}}));
  EXPECT_EQ(part_words(Language::kChinese, "planar stop"), "障碍停车");
  EXPECT_EQ(part_words(Language::kChinese, "source ros1 /points"), "输入 ros1 /points");
  EXPECT_EQ(part_words(Language::kChinese, "pose_walld"), "pose_walld");
  EXPECT_EQ(grade_words(Language::kChinese, Grade::kBad), "故障");
}

// What scripts read is English, whatever the page is told beside it.
TEST(HealthWords, ScriptsGetEnglishAndThePageBoth) {
  const std::vector<PartHealth> parts = {{"runtime", Grade::kGood, "measures", {}}};
  EXPECT_EQ(health_json(parts).find("zh"), std::string::npos);
  const std::string both = health_in_both_json(parts);
  EXPECT_NE(both.find(R"("summary":"measures")"), std::string::npos) << both;
  EXPECT_NE(both.find("正在测量"), std::string::npos) << both;
}

TEST_F(HealthLogTest, WordsThatAreAlwaysOthersAreNoWayRoundIt) {
  for (int i = 0; i < 200; ++i) say("failed " + std::to_string(i), std::chrono::milliseconds(100));
  EXPECT_EQ(lines_.size(), 8U + 1U);
}

}  // namespace
}  // namespace pose_wall::tools::live
