// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, by a pair of sockets in place of the bus: each publication sends all frames of both images, and those of one
// image count alike. The stop's frames go first, and with each answer; they say stop where nobody answers. A bus that
// takes nothing delays no longer than the patience, and loses what is counted. A port that fails is opened again.
// Settings that leave no room are refused. On vcan0 the same, where the kernel has it.
//
// Does not prove: what readers of DBC make of the frames, can_peer.py.

#if __has_include(<linux/can.h>)

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/live/can/can_sink.hpp"
#include "can_images.h"
#include "live/frame_catcher.hpp"
#include "live/said_stop.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

constexpr std::size_t kFramesOfBoth = POSE_WALL_CAN_IMAGE2_FRAMES + POSE_WALL_CAN_MOTION_IMAGE_FRAMES;

// CRC-32C of all words but the third, as image.def has it.
template <typename Image>
Image sealed(Image image) {
  std::uint32_t crc = 0xFFFFFFFFU;
  const auto* bytes = reinterpret_cast<const unsigned char*>(&image);
  for (std::size_t i = 0; i < sizeof image; ++i) {
    if (i >= 8 && i < 12) continue;
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0x82F63B78U : 0U);
  }
  image.crc32c = crc ^ 0xFFFFFFFFU;
  return image;
}

class SomeImages final : public Images {
 public:
  pose_wall_image image() const override { return {}; }
  pose_wall_image2 image2() const override {
    pose_wall_image2 image{};
    image.struct_size = sizeof image;
    image.version = POSE_WALL_IMAGE2_VERSION;
    image.publication = publication;
    image.roll.value_mdeg = -1234;
    return sealed(image);
  }
  std::optional<pose_wall_motion_image> motion_image() const override {
    if (!moves) return std::nullopt;
    pose_wall_motion_image image{};
    image.struct_size = sizeof image;
    image.version = POSE_WALL_MOTION_IMAGE_VERSION;
    image.publication = publication;
    image.travel_mm = 5678;
    return sealed(image);
  }
  std::uint32_t publication = 255;
  bool moves = true;
};

// A bus of which the test is the other end.
class PairBus {
 public:
  ~PairBus() { hang_up(); }
  CanPort open() {
    hang_up();
    int files[2] = {-1, -1};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, files), 0);
    end_ = files[1];
    ++opened;
    return CanPort(files[0]);
  }
  void hang_up() {
    if (end_ >= 0) close(end_);
    end_ = -1;
  }
  std::vector<can_frame> read_all() const {
    std::vector<can_frame> frames;
    for (can_frame frame{}; recv(end_, &frame, sizeof frame, MSG_DONTWAIT) == sizeof frame;) frames.push_back(frame);
    return frames;
  }
  int opened = 0;

 private:
  int end_ = -1;
};

struct CanSinkTest : testing::Test {
  LiveSettings settings;
  SomeImages images;
  PairBus bus;
  CanSink sink{"can7", can_bus_of(settings), images, nullptr, [this](const std::string&) { return bus.open(); }};
};

TEST_F(CanSinkTest, EachPublicationSendsAllFramesOfBothImages) {
  sink.start();
  for (const std::uint32_t counter : {255U, 256U}) {
    images.publication = counter;
    sink.take({});
    const std::vector<can_frame> frames = bus.read_all();
    ASSERT_EQ(frames.size(), kFramesOfBoth);
    std::set<canid_t> ids;
    for (const can_frame& frame : frames) {
      EXPECT_EQ(frame.can_dlc, 8);
      EXPECT_EQ(frame.data[1], counter & 0xFFU);
      EXPECT_EQ(frame.data[0], pose_wall_can_crc8(static_cast<std::uint8_t>(frame.can_id - 0x680), frame.data));
      ids.insert(frame.can_id);
    }
    EXPECT_EQ(ids.size(), kFramesOfBoth);
    EXPECT_EQ(*ids.begin(), 0x688U);
    // Roll, number 16: -1234 in 20 bits.
    EXPECT_EQ(frames[3].can_id, 0x690U);
    EXPECT_EQ((frames[3].data[2] | frames[3].data[3] << 8 | frames[3].data[4] << 16) & 0xFFFFF, 0x100000 - 1234);
  }
  EXPECT_EQ(fact(sink.health(), "frames"), std::to_string(2 * kFramesOfBoth));
  EXPECT_EQ(sink.health().grade, Grade::kGood);
}

TEST_F(CanSinkTest, WithoutMotionTheOtherImageGoesAlone) {
  images.moves = false;
  sink.start();
  sink.take({});
  EXPECT_EQ(bus.read_all().size(), std::size_t{POSE_WALL_CAN_IMAGE2_FRAMES});
}

// The lowest identifiers, which win on the bus.
TEST_F(CanSinkTest, TheStopGoesFirstAndWithEachAnswer) {
  constexpr std::size_t kOfStop = POSE_WALL_CAN_STOP_IMAGE_FRAMES;
  SaidStop stop;
  StopNews news = opened_news();
  news.result.state = POSE_WALL_PLANAR_STOP_SLOW;
  news.result.allowed_speed_m_s = 0.4567;
  news.result.heartbeat = 0x12345678;
  stop.say(news);
  CanSink with_stop("can7", can_bus_of(settings), images, &stop, [this](const std::string&) { return bus.open(); });
  EXPECT_TRUE(with_stop.wants_planar());
  EXPECT_FALSE(sink.wants_planar());
  with_stop.start();
  with_stop.take_stop(news);
  std::vector<can_frame> frames = bus.read_all();
  ASSERT_EQ(frames.size(), kOfStop);
  for (std::size_t k = 0; k < kOfStop; ++k) {
    EXPECT_EQ(frames[k].can_id, 0x680U + k);
    EXPECT_EQ(frames[k].data[1], 0x78U);
  }
  // State in 2 bits, then 456 mm/s in 20.
  EXPECT_EQ((frames[0].data[2] | frames[0].data[3] << 8 | frames[0].data[4] << 16) & 0x3FFFFF,
            POSE_WALL_PLANAR_STOP_SLOW | 456 << 2);
  // What is asked for later is newer than the news.
  news.result.state = POSE_WALL_PLANAR_STOP_STOP;
  news.result.allowed_speed_m_s = 0.0;
  ++news.result.heartbeat;
  stop.say(news);
  with_stop.take({});
  frames = bus.read_all();
  ASSERT_EQ(frames.size(), kOfStop + kFramesOfBoth);
  EXPECT_EQ(frames[0].can_id, 0x680U);
  EXPECT_EQ(frames[0].data[1], 0x79U);
  EXPECT_EQ((frames[0].data[2] | frames[0].data[3] << 8 | frames[0].data[4] << 16) & 0x3FFFFF, 0);
  EXPECT_EQ(frames[kOfStop].can_id, 0x688U);
}

TEST_F(CanSinkTest, AStopThatNeverAnsweredHasNoFrames) {
  const SaidStop silent;
  CanSink with_stop("can7", can_bus_of(settings), images, &silent, [this](const std::string&) { return bus.open(); });
  with_stop.start();
  with_stop.take_stop({});
  EXPECT_TRUE(bus.read_all().empty());
  with_stop.take({});
  EXPECT_EQ(bus.read_all().size(), kFramesOfBoth);
}

TEST_F(CanSinkTest, J1939HasPriorityGroupAndAddress) {
  settings.can_frames = "j1939";
  settings.can_address = 200;
  CanSink wide("can7", can_bus_of(settings), images, nullptr, [this](const std::string&) { return bus.open(); });
  wide.start();
  wide.take({});
  const std::vector<can_frame> frames = bus.read_all();
  ASSERT_EQ(frames.size(), kFramesOfBoth);
  EXPECT_EQ(frames[3].can_id, CAN_EFF_FLAG | 3U << 26U | 0xFF10U << 8U | 200U);  // Roll
  EXPECT_EQ(frames[4].can_id, CAN_EFF_FLAG | 6U << 26U | 0xFF11U << 8U | 200U);  // RollWhy
}

TEST_F(CanSinkTest, ABusThatTakesNothingDelaysNobody) {
  sink.start();
  const auto begin = std::chrono::steady_clock::now();
  std::uint64_t publications = 0;
  while (sink.health().grade == Grade::kGood && publications < 1000) {
    sink.take({});
    ++publications;
  }
  EXPECT_EQ(sink.health().grade, Grade::kBad);
  EXPECT_NE(sink.health().summary.find("do not leave"), std::string::npos);
  const std::uint64_t sent = std::stoull(fact(sink.health(), "frames"));
  const std::uint64_t lost = std::stoull(fact(sink.health(), "lost"));
  EXPECT_GT(lost, 0U);
  EXPECT_EQ(sent + lost, publications * kFramesOfBoth);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  EXPECT_EQ(bus.read_all().size(), sent);
  sink.take({});
  EXPECT_EQ(sink.health().grade, Grade::kGood);
  EXPECT_EQ(bus.opened, 1);
}

TEST_F(CanSinkTest, APortThatFailsIsOpenedAgain) {
  sink.start();
  bus.hang_up();
  sink.take({});
  EXPECT_EQ(sink.health().grade, Grade::kBad);
  EXPECT_EQ(fact(sink.health(), "lost"), std::to_string(kFramesOfBoth));
  sink.take({});
  EXPECT_EQ(bus.opened, 2);
  EXPECT_EQ(sink.health().grade, Grade::kGood);
  EXPECT_EQ(bus.read_all().size(), kFramesOfBoth);
}

TEST_F(CanSinkTest, AnInterfaceThatIsNoneIsNamed) {
  const std::string said =
      test::said_by<std::runtime_error>([&] { CanSink("nocan9", can_bus_of(settings), images, nullptr).start(); });
  EXPECT_NE(said.find("nocan9"), std::string::npos) << said;
}

TEST(CanBus, SettingsThatLeaveNoRoomAreRefused) {
  LiveSettings settings;
  EXPECT_EQ(can_bus_of(settings).first, 0x680U);
  settings.can_first = 1984;
  EXPECT_EQ(can_bus_of(settings).first, 1984U);
  settings.can_first = 1985;
  EXPECT_THROW(can_bus_of(settings), std::runtime_error);
  settings.can_frames = "j1939";
  EXPECT_THROW(can_bus_of(settings), std::runtime_error);
  for (const double first : {65280.0, 65472.0}) {
    settings.can_first = first;
    EXPECT_EQ(can_bus_of(settings).first, first);
  }
  settings.can_first = 0;
  EXPECT_EQ(can_bus_of(settings).first, 0xFF00U);
}

TEST(CanFrames, RefuseWhatTheyCannotSend) {
  const SomeImages images;
  pose_wall_image2 image = images.image2();
  pose_wall_can_frame frames[POSE_WALL_CAN_IMAGE2_FRAMES];
  const pose_wall_can_bus sound{0, 0x680, 0}, narrow{0, 0x7C1, 0}, nobody{1, 0xFF00, 254};
  EXPECT_EQ(pose_wall_can_of_image2(&image, &sound, frames), std::uint32_t{POSE_WALL_CAN_IMAGE2_FRAMES});
  EXPECT_EQ(pose_wall_can_of_image2(&image, &narrow, frames), 0U);
  EXPECT_EQ(pose_wall_can_of_image2(&image, &nobody, frames), 0U);
  EXPECT_EQ(pose_wall_can_of_image2(nullptr, &sound, frames), 0U);
  ++image.roll.value_mdeg;
  EXPECT_EQ(pose_wall_can_of_image2(&image, &sound, frames), 0U);
}

// ip link add dev vcan0 type vcan && ip link set vcan0 up
TEST(CanOnVcan, SendsWhatAnotherSocketReads) {
  const int reader = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex("vcan0"));
  if (reader < 0 || address.can_ifindex == 0) GTEST_SKIP() << "no vcan0 here: the sink was tested by a pair of sockets";
  ASSERT_EQ(bind(reader, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  SomeImages images;
  CanSink sink("vcan0", can_bus_of({}), images, nullptr);
  sink.start();
  sink.take({});
  std::size_t count = 0;
  for (can_frame frame{}; recv(reader, &frame, sizeof frame, 0) == sizeof frame;) ++count;
  close(reader);
  EXPECT_EQ(count, kFramesOfBoth);
}

}  // namespace
}  // namespace pose_wall::tools::live

#endif
