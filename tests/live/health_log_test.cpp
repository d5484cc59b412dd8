// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the log of a part that goes to and fro stays short, tells how often it changed and how it ended; what is new
// is told at once.

#include <gtest/gtest.h>

#include "apps/live/log.hpp"

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

TEST_F(HealthLogTest, WordsThatAreAlwaysOthersAreNoWayRoundIt) {
  for (int i = 0; i < 200; ++i) say("failed " + std::to_string(i), std::chrono::milliseconds(100));
  EXPECT_EQ(lines_.size(), 8U + 1U);
}

}  // namespace
}  // namespace pose_wall::tools::live
