// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a command counts until its age, and what is no number or absurd counts as none and is told. The extremes are
// those of one second, however fast commands come. A machine that moves is named where only standing was commanded, and
// one that brakes is not. Messages of ROS become commands; whatever bytes others send, nothing is thrown.

#include "apps/live/planar/command_board.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "apps/live/ros_messages/command_reader.hpp"
#include "io/bags/message_writer.hpp"
#include "live/frame_catcher.hpp"
#include "live/tf_message.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct CommandBoardTest : ::testing::Test {
  CommandBoard board{"test", 0.25};
  std::int64_t now_ns = 50 * kSecond_ns;
};

TEST_F(CommandBoardTest, ACommandCountsUntilItsAge) {
  EXPECT_FALSE(board.newest(now_ns));
  EXPECT_EQ(board.health(now_ns).summary, "waits for commands");
  ASSERT_TRUE(board.take({0.3, -0.1}, now_ns));
  ASSERT_TRUE(board.newest(now_ns + kSecond_ns / 4));
  EXPECT_EQ(board.newest(now_ns)->speed_m_s, 0.3);
  EXPECT_EQ(board.newest(now_ns)->turn_rad_s, -0.1);
  EXPECT_EQ(board.health(now_ns).grade, Grade::kGood);
  EXPECT_FALSE(board.newest(now_ns + kSecond_ns / 4 + 1));
  EXPECT_EQ(board.health(now_ns + kSecond_ns).summary, "no command comes any more");
  EXPECT_EQ(board.health(now_ns + kSecond_ns).grade, Grade::kWarning);
}

TEST_F(CommandBoardTest, WhatIsNoNumberOrAbsurdIsToldAndTakesTheOneBeforeAway) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::uint64_t refused = 0;
  for (const DriveMotion& absurd :
       {DriveMotion{kNone, 0.0}, {0.0, kNone}, {infinity, 0.0}, {0.0, -infinity}, {3.001, 0.0}, {0.0, -2.001}}) {
    ASSERT_TRUE(board.take({3.0, -2.0}, now_ns)) << "the most";
    EXPECT_FALSE(board.take(absurd, now_ns));
    EXPECT_FALSE(board.newest(now_ns)) << "something newer was commanded, and nobody knows what";
    EXPECT_EQ(fact(board.health(now_ns), "refused"), std::to_string(++refused));
    EXPECT_EQ(board.health(now_ns).summary, "the newest command was refused");
    EXPECT_EQ(board.last_second(now_ns)->most.speed_m_s, 3.0);
  }
  EXPECT_EQ(fact(board.health(now_ns), "last refusal"),
            "0 m/s, -2.001 rad/s; allowed: up to 3 m/s and 2 rad/s either way");
}

TEST_F(CommandBoardTest, TheExtremesAreThoseOfASecondHoweverFastCommandsCome) {
  EXPECT_FALSE(board.last_second(now_ns));
  ASSERT_TRUE(board.take({2.0, 1.0}, now_ns));
  for (int k = 1; k <= 10'000; ++k) ASSERT_TRUE(board.take({-0.1, k % 2 * 0.2}, now_ns + k * 90'000));
  const auto span = board.last_second(now_ns + 900'000'000);
  ASSERT_TRUE(span);
  EXPECT_EQ(span->least.speed_m_s, -0.1);
  EXPECT_EQ(span->most.speed_m_s, 2.0);
  EXPECT_EQ(span->least.turn_rad_s, 0.0);
  EXPECT_EQ(span->most.turn_rad_s, 1.0);
  EXPECT_EQ(board.last_second(now_ns + kSecond_ns)->most.speed_m_s, -0.1) << "the first is older than a second";
  EXPECT_FALSE(board.last_second(now_ns + 3 * kSecond_ns));
}

TEST_F(CommandBoardTest, AMachineThatMovesWithoutACommandIsNamedAndOneThatBrakesIsNot) {
  const DriveMotion level{0.05, 0.02}, moving{0.3, 0.0};
  board.note_measured(moving, level, now_ns);
  EXPECT_EQ(board.health(now_ns).summary, "the machine moves without a command") << "none ever came";
  now_ns += 2 * kSecond_ns;
  EXPECT_NE(board.health(now_ns).summary, "the machine moves without a command") << "that is long ago";
  ASSERT_TRUE(board.take({0.5, 0.0}, now_ns));
  for (int k = 1; k <= 9; ++k) {
    ASSERT_TRUE(board.take({}, now_ns + k * kSecond_ns / 10));
    board.note_measured(moving, level, now_ns + k * kSecond_ns / 10);
    EXPECT_EQ(board.health(now_ns + k * kSecond_ns / 10).summary, "commands come") << "it brakes";
  }
  now_ns += 2 * kSecond_ns;
  ASSERT_TRUE(board.take({}, now_ns));
  board.note_measured({0.04, 0.01}, level, now_ns);
  EXPECT_EQ(board.health(now_ns).summary, "commands come") << "noise is no motion";
  board.note_measured({0.0, -0.03}, level, now_ns);
  EXPECT_EQ(board.health(now_ns).summary, "the machine moves without a command");
  EXPECT_EQ(board.health(now_ns).grade, Grade::kWarning);
}

TEST_F(CommandBoardTest, TheLargestDifferenceOfASecondIsTold) {
  ASSERT_TRUE(board.take({0.5, 0.1}, now_ns));
  board.note_measured({0.9, 0.1}, {}, now_ns);
  board.note_measured({0.4, 0.3}, {}, now_ns + 1);
  board.note_measured({kNone, 0.3}, {}, now_ns + 1);
  EXPECT_EQ(fact(board.health(now_ns), "command less measured m/s"), "-0.400");
  EXPECT_EQ(fact(board.health(now_ns), "command less measured rad/s"), "-0.200");
  EXPECT_EQ(fact(board.health(now_ns + 2 * kSecond_ns), "command less measured m/s"), "0.000");
}

// Six numbers, and a header before them where `frame` is given.
std::string twist(MessageEncoding encoding, const std::vector<double>& members, const char* frame = nullptr) {
  MessageWriter message(encoding);
  if (frame != nullptr) {
    if (encoding == MessageEncoding::kRos1) message.number(std::uint32_t{0});
    message.number(std::uint32_t{7});
    message.number(std::uint32_t{0});
    message.text(frame);
  }
  for (const double member : members) message.number(member);
  return message.take();
}

TEST(CommandReader, TwistsOfBothKindsAndBothRosAreCommands) {
  for (const MessageEncoding encoding : {MessageEncoding::kRos1, MessageEncoding::kCdr}) {
    for (const char* frame : {static_cast<const char*>(nullptr), "base_link", "b"}) {
      CommandBoard board("ros cmd_vel", 10.0);
      CommandReader reader(board, encoding);
      const std::string message = twist(encoding, {0.4, 0, 0, 0, 0, -0.2}, frame);
      const RosType& type = frame != nullptr ? kTwistStampedType : kTwistType;
      reader.take(type.name, view_of(message));
      const PartHealth health = board.health(0);
      EXPECT_EQ(fact(health, "commands"), "1") << fact(health, "last refusal");
      EXPECT_EQ(fact(health, "command m/s"), "0.400");
      EXPECT_EQ(fact(health, "command rad/s"), "-0.200");
    }
  }
}

TEST(CommandReader, OtherTypesMotionsAndCutMessagesAreRefused) {
  CommandBoard board("ros cmd_vel", 10.0);
  CommandReader reader(board, MessageEncoding::kRos1);
  const std::string whole = twist(MessageEncoding::kRos1, {0.4, 0, 0, 0, 0, 0});
  reader.take("geometry_msgs/Vector3", view_of(whole));
  std::uint64_t refused = 1;
  for (std::size_t size = 0; size < whole.size(); ++size, ++refused) {
    reader.take(kTwistType.name, view_of(whole.substr(0, size)));
  }
  reader.take(kTwistType.name, view_of(whole + "x"));
  ++refused;
  for (const std::size_t member : {1U, 2U, 3U, 4U}) {
    for (const double wrong : {0.1, kNone}) {
      std::vector<double> members(6, 0.0);
      members[member] = wrong;
      reader.take(kTwistType.name, view_of(twist(MessageEncoding::kRos1, members)));
      ++refused;
    }
  }
  reader.take(kTwistType.name, view_of(twist(MessageEncoding::kRos1, {kNone, 0, 0, 0, 0, 0})));
  EXPECT_EQ(fact(board.health(0), "refused"), std::to_string(refused + 1));
  EXPECT_EQ(fact(board.health(0), "commands"), "0");
  reader.take(kTwistType.name, view_of(whole));
  EXPECT_EQ(fact(board.health(0), "commands"), "1") << "the next sound one is taken";
}

}  // namespace
}  // namespace pose_wall::tools::live
