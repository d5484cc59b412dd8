// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, by a pair of sockets in place of the bus: what a controller writes into a frame is the command. Frames that
// were damaged, are of another length or say something absurd are refused. A counter that stands commands nothing. An
// interface that went away is opened again.

#if __has_include(<linux/can.h>)

#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "apps/live/can/can_commands.hpp"
#include "apps/live/clocks.hpp"
#include "live/frame_catcher.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;
using Data = std::array<std::uint8_t, 8>;

Data frame_of(std::uint32_t counter, int speed_mm_s, int turn_mrad_s) {
  const pose_wall_can_command command{counter, speed_mm_s, turn_mrad_s};
  Data data{};
  EXPECT_EQ(pose_wall_can_write_command(&command, data.data()), 1U);
  return data;
}

// Of a bus of which the test is the other end.
class CanCommandsTest : public ::testing::Test {
 protected:
  void TearDown() override {
    reader.stop();
    hang_up();
  }
  CanPort open() {
    const std::lock_guard<std::mutex> locked(lock);
    int files[2] = {-1, -1};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, files), 0);
    end = files[1];
    ++opened;
    return CanPort(files[0]);
  }
  void hang_up() {
    const std::lock_guard<std::mutex> locked(lock);
    if (end >= 0) close(end);
    end = -1;
  }
  void send(const Data& data, std::size_t bytes = 8) {
    can_frame frame{};
    frame.can_id = 0x123;
    frame.can_dlc = static_cast<std::uint8_t>(bytes);
    std::memcpy(frame.data, data.data(), data.size());
    const std::lock_guard<std::mutex> locked(lock);
    EXPECT_EQ(::send(end, &frame, sizeof frame, MSG_NOSIGNAL), static_cast<ssize_t>(sizeof frame));
  }
  bool counts(const char* name, int count) {
    return becomes_true([&] { return fact(board.health(monotonic_ns()), name) == std::to_string(count); });
  }

  std::mutex lock;
  int end = -1, opened = 0;
  CommandBoard board{"can", 10.0};
  CanCommands reader{"can7", board, [this](const std::string&) { return open(); }};
};

TEST_F(CanCommandsTest, AFrameIsACommandWhenItsCounterChanges) {
  reader.start();
  send(frame_of(255, 400, -200));
  ASSERT_TRUE(counts("commands", 1));
  EXPECT_NEAR(board.newest(monotonic_ns())->speed_m_s, 0.4, 1e-12);
  EXPECT_NEAR(board.newest(monotonic_ns())->turn_rad_s, -0.2, 1e-12);
  for (int k = 0; k < 3; ++k) send(frame_of(255, 400, -200));
  send(frame_of(0, -1500, 2000));
  ASSERT_TRUE(counts("commands", 2));
  EXPECT_NEAR(board.newest(monotonic_ns())->speed_m_s, -1.5, 1e-12);
  EXPECT_EQ(fact(board.health(monotonic_ns()), "refused"), "0");
}

TEST_F(CanCommandsTest, WhatIsNoSoundFrameIsRefused) {
  reader.start();
  int refused = 0;
  const Data good = frame_of(1, 400, 0);
  for (std::size_t bit = 0; bit < 64; ++bit) {
    Data damaged = good;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ 1U << bit % 8);
    send(damaged);
    ASSERT_TRUE(counts("refused", ++refused)) << bit;
  }
  Data more = good;
  more[7] = 1;
  more[0] = pose_wall_can_crc8(POSE_WALL_CAN_COMMAND_NUMBER, more.data());
  send(more);
  send(good, 7);
  send(frame_of(2, 3001, 0));
  ASSERT_TRUE(counts("refused", refused + 3));
  EXPECT_FALSE(board.newest(monotonic_ns()));
  send(good);
  EXPECT_TRUE(counts("commands", 1));
}

TEST_F(CanCommandsTest, AnInterfaceThatWentAwayIsOpenedAgain) {
  reader.start();
  send(frame_of(1, 400, 0));
  ASSERT_TRUE(counts("commands", 1));
  hang_up();
  ASSERT_TRUE(becomes_true([&] {
    const std::lock_guard<std::mutex> locked(lock);
    return opened == 2;
  }));
  send(frame_of(2, 400, 0));
  EXPECT_TRUE(counts("commands", 2));
  EXPECT_TRUE(becomes_true([&] { return reader.health().grade == Grade::kGood; }));
}

TEST(CanCommand, NumbersThatDoNotFitAreNotWritten) {
  Data data{};
  for (const pose_wall_can_command& wrong : {pose_wall_can_command{256, 0, 0}, {0, 32768, 0}, {0, 0, -32769}}) {
    EXPECT_EQ(pose_wall_can_write_command(&wrong, data.data()), 0U);
  }
  EXPECT_EQ(data, Data{});
  for (const int edge : {-32768, -1, 0, 32767}) {
    pose_wall_can_command read{};
    ASSERT_EQ(pose_wall_can_read_command(frame_of(7, edge, -1 - edge).data(), &read), 1U);
    EXPECT_EQ(read.counter, 7U);
    EXPECT_EQ(read.speed_mm_s, edge);
    EXPECT_EQ(read.turn_mrad_s, -1 - edge);
  }
  EXPECT_EQ(pose_wall_can_write_command(nullptr, data.data()), 0U);
  EXPECT_EQ(pose_wall_can_read_command(nullptr, nullptr), 0U);
}

}  // namespace
}  // namespace pose_wall::tools::live

#endif
