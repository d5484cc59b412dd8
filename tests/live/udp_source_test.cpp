// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets that arrive by UDP become the frames that a capture of them gives, bit for bit. Into no frame gets
// what comes from others, what is no packet, and what the sensor sent before it fell silent. What no waiting mends is
// refused with words that help. The simulated sensor's packets give back the ranges that they were made from.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <thread>

#include "apps/live/edges.hpp"
#include "apps/live/sensor_sim/metadata_server.hpp"
#include "apps/live/sensor_sim/packet_encoder.hpp"
#include "apps/live/sensor_sim/robosense_encoder.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "io/packets/ouster.hpp"
#include "io/packets/udp_capture.hpp"
#include "io/packets/velodyne.hpp"
#include "lab/sim/scenes.hpp"
#include "live/frame_catcher.hpp"
#include "live/loopback.hpp"
#include "support/real_frames.hpp"
#include "support/said_by.hpp"
#include "tools/ouster_packets.hpp"
#include "tools/test_files.hpp"

namespace pose_wall::tools::live {
namespace {

using namespace pose_wall::test;

// Ten turns a second, as sensors leave the factory.
constexpr std::int64_t kTurn_ns = 100'000'000;

LoadedConfig live_config(std::uint16_t port, std::vector<std::string> more = {}) {
  more.push_back("udp_port=" + std::to_string(port));
  return load_config("", more);
}

std::string refusal_of(const LoadedConfig& loaded) {
  FrameCatcher catcher;
  return test::said_by<std::runtime_error>([&] { make_udp_source(loaded)->start(catcher); });
}

// A closed room in every direction, another range at every place.
RangeImage image_of(std::uint32_t rings, std::uint32_t columns, std::uint32_t turn = 0) {
  RangeImage image;
  image.rings = rings;
  image.columns = columns;
  for (std::uint32_t i = 0; i < rings * columns; ++i) {
    image.range_m.push_back(2.0 + 0.002 * ((i + 7 * turn) % 1500));
    image.intensity.push_back(static_cast<float>(i % 200));
  }
  return image;
}

std::vector<std::string> vlp16_turns(std::uint32_t turns, std::uint32_t first = 0) {
  std::vector<std::string> packets;
  VelodyneEncoder encoder(VelodyneModel::kVlp16);
  for (std::uint32_t turn = first; turn < first + turns; ++turn) {
    for (std::string& packet : encoder.packets(image_of(16, 1800, turn), turn * kTurn_ns, kTurn_ns)) {
      packets.push_back(std::move(packet));
    }
  }
  return packets;
}

// Of the one source of a test, so that what is sent never outruns what is taken: a small receive buffer would lose it.
class Pace {
 public:
  explicit Pace(const Source& source) : source_(source) {}

  void send(const LoopbackSender& sender, std::string_view packet) {
    ASSERT_TRUE(sender.send(packet));
    if (++sent_ % kAhead == 0) {
      ASSERT_TRUE(becomes_true([this] { return taken() + kAhead >= sent_; }));
    }
  }
  void send(const LoopbackSender& sender, const std::vector<std::string>& packets) {
    for (const std::string& packet : packets) send(sender, std::string_view(packet));
  }

 private:
  // At most twice so many wait: 48 kB of a VLP-16's packets, 0.5 MB of an OS1-64's.
  static constexpr std::uint64_t kAhead = 20;

  std::uint64_t taken() const {
    const PartHealth health = source_.health();
    return std::stoull(fact(health, "packets")) + std::stoull(fact(health, "packets of others"));
  }

  const Source& source_;
  std::uint64_t sent_ = 0;
};

double range_at(const Frame& frame, std::uint32_t point) {
  return std::hypot(test::number_at(frame, frame.cloud.x, point), test::number_at(frame, frame.cloud.y, point),
                    test::number_at(frame, frame.cloud.z, point));
}

TEST(SimulatedSensor, PacketsOfAVlp16GiveTheRangesBack) {
  VelodyneAssembler assembler;
  for (const std::string& packet : vlp16_turns(2)) {
    const Bytes bytes = test::bytes_of(packet);
    ASSERT_TRUE(assembler.add({0, {}, {bytes.data(), bytes.size()}}));
  }
  const std::optional<Scan> scan = assembler.take();
  ASSERT_TRUE(scan);
  const Frame frame = frame_of(*scan);
  ASSERT_EQ(scan->points.size(), 16U * 1800U);
  const RangeImage image = image_of(16, 1800);
  for (std::uint32_t i = 0; i < scan->points.size(); i += 97) {
    // The beam starts up to 11 mm above the centre.
    EXPECT_NEAR(range_at(frame, i), image.range_m[i], 0.012) << i;
  }
}

// Turns of an OS1-64 of 1,024 columns, until they are contradicted.
struct Contradicted {
  explicit Contradicted(OusterMetadata metadata, const sim::Setup& setup) : assembler(std::move(metadata)) {
    OusterEncoder encoder(setup.sensor);
    for (int turn = 0; turn < 3; ++turn) {
      for (const std::string& packet : encoder.packets(image_of(64, 1024), turn * kTurn_ns, kTurn_ns)) {
        const Bytes bytes = test::bytes_of(packet);
        try {
          assembler.add({0, {}, {bytes.data(), bytes.size()}});
        } catch (const FrameError& fault) {
          why = fault.what();
          ++times;
        }
      }
    }
    assembler.finish();
  }

  OusterAssembler assembler;
  std::string why;
  int times = 0;
};

TEST(SimulatedSensor, MetadataOfAnotherModeIsRefusedBeforeAScanAndFromThenOn) {
  const sim::Setup setup = sim::make_setup("clean", "os1-64", false, 1);
  OusterMetadata metadata = parse_ouster_metadata(OusterEncoder(setup.sensor).metadata());
  for (const std::uint32_t columns : {512U, 2048U, 4096U}) {
    metadata.columns_per_frame = columns;
    Contradicted seen(metadata, setup);
    EXPECT_EQ(seen.why, fmt::format("the sensor turns in 1024 columns, but the metadata's columns_per_frame is {}: it "
                                    "is of another lidar_mode; read it from the sensor again",
                                    columns));
    EXPECT_EQ(seen.times, 2 * 64) << "all packets of the turns after the first";
    EXPECT_FALSE(seen.assembler.take()) << "nothing is handed on whose directions are wrong";
  }
}

TEST(SimulatedSensor, MetadataOfOtherPixelsThanThePacketsHaveIsHintedAt) {
  const sim::Setup setup = sim::make_setup("clean", "os1-64", false, 1);
  OusterMetadata metadata = parse_ouster_metadata(OusterEncoder(setup.sensor).metadata());
  metadata.rings = 128;
  Contradicted seen(metadata, setup);
  EXPECT_NE(seen.assembler.hint().find("have 64 pixels a column, but the metadata's pixels_per_column is 128"),
            std::string::npos)
      << seen.assembler.hint();
  EXPECT_EQ(seen.times, 0) << "they may be of another sensor";
  EXPECT_FALSE(seen.assembler.take());
}

TEST(SimulatedSensor, PacketsOfAnOusterGiveTheRangesBack) {
  const sim::Setup setup = sim::make_setup("clean", "os1-64", false, 1);
  OusterEncoder encoder(setup.sensor);
  OusterAssembler assembler(parse_ouster_metadata(encoder.metadata()));
  const RangeImage image = image_of(64, 1024);
  for (const std::string& packet : encoder.packets(image, 0, kTurn_ns)) {
    const Bytes bytes = test::bytes_of(packet);
    ASSERT_TRUE(assembler.add({0, {}, {bytes.data(), bytes.size()}}));
  }
  assembler.finish();
  const std::optional<Scan> scan = assembler.take();
  ASSERT_TRUE(scan);
  const Frame frame = frame_of(*scan);
  for (std::uint32_t from_top = 0; from_top < 64; from_top += 9) {
    for (std::uint32_t column = 0; column < 1024; column += 101) {
      EXPECT_NEAR(range_at(frame, from_top * 1024 + column), image.range_m[image.at(63 - from_top, column)], 0.001);
    }
  }
}

TEST(UdpSource, TurnsBecomeFramesAndTheStampsOfTheEngineAreOfAClockThatNobodySets) {
  const std::uint16_t port = free_udp_port();
  const auto source = make_udp_source(live_config(port));
  FrameCatcher catcher;
  source->start(catcher);
  const LoopbackSender sender(port);
  Pace(*source).send(sender, vlp16_turns(4));
  ASSERT_TRUE(catcher.wait_for_frames(3));
  ASSERT_TRUE(becomes_true([&] { return fact(source->health(), "packets") == "300"; }));
  source->stop();
  EXPECT_EQ(catcher.frames().size(), 3U) << "the fourth has no end yet";
  timespec up{};
  clock_gettime(CLOCK_MONOTONIC, &up);
  for (const LiveFrame& frame : catcher.frames()) {
    EXPECT_EQ(frame.frame.cloud.width * frame.frame.cloud.height, 16U * 1800U);
    EXPECT_NEAR(static_cast<double>(frame.frame.cloud.stamp_ns) * 1e-9, static_cast<double>(up.tv_sec), 60.0);
    EXPECT_NEAR(static_cast<double>(frame.stamp_ns) * 1e-9, static_cast<double>(std::time(nullptr)), 60.0);
  }
  EXPECT_EQ(fact(source->health(), "packets"), "300");
  EXPECT_EQ(fact(source->health(), "packets of no use"), "0");
}

TEST(UdpSource, PacketsOfOthersAndWhatIsNoPacketAreCountedAndDropped) {
  const std::uint16_t port = free_udp_port();
  const auto source = make_udp_source(live_config(port, {"udp_sender=127.0.0.1"}));
  FrameCatcher catcher;
  source->start(catcher);
  const LoopbackSender sender(port), other(port, "127.0.0.2");
  const std::vector<std::string> ours = vlp16_turns(3), theirs = vlp16_turns(3, 50);
  Pace pace(*source);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    pace.send(other, std::string_view(theirs[i]));
    pace.send(sender, std::string_view(ours[i]));
    pace.send(sender, "no packet");
    pace.send(sender, "");
  }
  ASSERT_TRUE(catcher.wait_for_frames(2));
  ASSERT_TRUE(becomes_true([&] { return fact(source->health(), "packets of no use") == "450"; }));
  source->stop();
  EXPECT_EQ(fact(source->health(), "packets of others"), "225");
  EXPECT_EQ(fact(source->health(), "packets of no use"), "450");
  VelodyneAssembler alone;
  for (const std::string& packet : ours) {
    const Bytes bytes = test::bytes_of(packet);
    alone.add({0, {}, {bytes.data(), bytes.size()}});
  }
  const Frame expected = frame_of(*alone.take());
  for (std::uint32_t i = 0; i < 16U * 1800U; ++i) {
    ASSERT_EQ(range_at(catcher.frames()[0].frame, i), range_at(expected, i)) << i;
  }
}

// A source that anybody may send to, and two who do.
struct TwoSenders {
  TwoSenders() { source->start(catcher); }

  const std::uint16_t port = free_udp_port();
  FrameCatcher catcher;
  const std::unique_ptr<Source> source = make_udp_source(live_config(port));
  const LoopbackSender sender{port}, other{port, "127.0.0.2"};
  Pace pace{*source};
};

// Four turns of each, packet by packet.
void send_at_once(Pace& pace, const LoopbackSender& sender, const LoopbackSender& other) {
  const std::vector<std::string> ours = vlp16_turns(4), theirs = vlp16_turns(4, 50);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    pace.send(sender, std::string_view(ours[i]));
    pace.send(other, std::string_view(theirs[i]));
  }
}

TEST(UdpSource, ASecondSensorOnThePortIsNamedAndNotMixedIn) {
  TwoSenders two;
  send_at_once(two.pace, two.sender, two.other);
  ASSERT_TRUE(two.catcher.wait_for_frames(3));
  EXPECT_TRUE(becomes_true([&] { return two.source->health().summary.find("127.0.0.2") != std::string::npos; }))
      << two.source->health().summary;
  EXPECT_NE(fact(two.source->health(), "sources").find(" packets)"), std::string::npos);
  // Counts would make each look a line of the log.
  EXPECT_EQ(two.source->health().summary.find(" packets)"), std::string::npos) << two.source->health().summary;
  two.source->stop();
  for (std::uint32_t turn = 0; turn < 3; ++turn) {
    const RangeImage seen = image_of(16, 1800, turn);
    EXPECT_NEAR(range_at(two.catcher.frames()[turn].frame, 0), seen.range_m[0], 0.012) << turn;
  }
}

void send_one(const LoopbackSender& sender) {
  ASSERT_TRUE(sender.send(vlp16_turns(1)[0]));
}

// It is mounted elsewhere: its walls would be measured from where the first one stands.
TEST(UdpSource, ASecondSensorDoesNotTakeThePlaceOfOneThatFellSilent) {
  TwoSenders two;
  send_at_once(two.pace, two.sender, two.other);
  ASSERT_TRUE(two.catcher.wait_for_frames(3));
  ASSERT_TRUE(becomes_true([&] { return two.source->health().summary == "the sensor is silent"; }));
  const std::string frames = fact(two.source->health(), "frames");
  two.pace.send(two.other, vlp16_turns(4, 60));
  EXPECT_EQ(fact(two.source->health(), "frames"), frames);
  EXPECT_TRUE(becomes_true([&] {
    send_one(two.other);
    return two.source->health().summary ==
           "the sensor is silent; waits for 127.0.0.1; 127.0.0.2 is sending, and is not read: udp_sender chooses";
  })) << two.source->health().summary;
  two.pace.send(two.sender, vlp16_turns(4, 4));
  EXPECT_TRUE(becomes_true([&] { return fact(two.source->health(), "frames") != frames; }))
      << two.source->health().summary;
  two.source->stop();
}

// Anybody can send a packet now and then, also before the sensor does.
TEST(UdpSource, AStrangersPacketNowAndThenKeepsNoSensorOut) {
  TwoSenders two;
  send_one(two.other);
  EXPECT_TRUE(becomes_true([&] { return two.source->health().summary == "packets come, no turn yet"; }));
  const std::vector<std::string> turns = vlp16_turns(40);  // 4 s
  const std::size_t second = turns.size() / 4;
  for (std::size_t i = 0; i < turns.size() && fact(two.source->health(), "frames") == "0"; ++i) {
    if (i % second == 0) send_one(two.other);
    two.pace.send(two.sender, std::string_view(turns[i]));
    std::this_thread::sleep_for(std::chrono::microseconds(1330));  // as the sensor does
  }
  two.source->stop();
  ASSERT_FALSE(two.catcher.frames().empty()) << two.source->health().summary;
}

TEST(UdpSource, WhoSendsInPlaceOfTheOneThatIsWaitedForIsNamed) {
  const std::uint16_t port = free_udp_port();
  const auto source = make_udp_source(live_config(port, {"udp_sender=127.0.0.1"}));
  FrameCatcher catcher;
  source->start(catcher);
  const LoopbackSender other(port, "127.0.0.2");
  EXPECT_TRUE(becomes_true([&] {
    send_one(other);
    return source->health().summary == "packets come from 127.0.0.2, but none from udp_sender 127.0.0.1";
  })) << source->health().summary;
  // What it says does not change with each packet: each change is a line of the log.
  EXPECT_TRUE(
      becomes_true([&] { return source->health().summary == "packets came, but none from udp_sender 127.0.0.1"; }));
  source->stop();
}

// Angles and returns of a RoboSense come by a port of its own.
TEST(UdpSource, WhatARoboSenseSaysOfItselfIsHeardAtItsOtherPort) {
  const std::uint16_t port = free_udp_port(), device_port = free_udp_port();
  const auto source =
      make_udp_source(live_config(port, {"sensor=robosense_rs16", "udp_device_port=" + std::to_string(device_port)}));
  FrameCatcher catcher;
  source->start(catcher);
  RoboSenseEncoder encoder(robosense_rs16());
  const LoopbackSender sender(port), device_sender(device_port);
  Pace pace(*source);
  for (std::uint32_t turn = 0; turn < 4; ++turn) {
    pace.send(sender, encoder.packets(image_of(16, 1800, turn), turn * kTurn_ns, kTurn_ns));
    if (turn == 0) {
      EXPECT_EQ(fact(source->health(), "frames"), "0");
    }
    ASSERT_TRUE(device_sender.send(encoder.device_packet(kTurn_ns)));
  }
  EXPECT_TRUE(catcher.wait_for_frames(2)) << source->health().summary;
  source->stop();
  EXPECT_EQ(catcher.frames()[0].frame.cloud.height, 16U);
}

TEST(UdpSource, HalfATurnBeforeASilenceIsNotJoinedToHalfOfOneAfterIt) {
  const std::uint16_t port = free_udp_port();
  const auto source = make_udp_source(live_config(port));
  FrameCatcher catcher;
  source->start(catcher);
  const LoopbackSender sender(port);
  std::vector<std::string> before = vlp16_turns(2), after = vlp16_turns(3, 20);
  before.resize(75 + 37);
  after.erase(after.begin(), after.begin() + 37);
  Pace pace(*source);
  pace.send(sender, before);
  ASSERT_TRUE(catcher.wait_for_frames(1));
  ASSERT_TRUE(becomes_true([&] { return source->health().summary == "the sensor is silent"; }));
  pace.send(sender, after);
  ASSERT_TRUE(catcher.wait_for_frames(2));
  source->stop();
  for (const LiveFrame& frame : catcher.frames()) {
    EXPECT_EQ(frame.frame.cloud.width * frame.frame.cloud.height, 16U * 1800U) << "a whole turn or none";
  }
  const RangeImage second = image_of(16, 1800, 21);
  EXPECT_NEAR(range_at(catcher.frames()[1].frame, 0), second.range_m[0], 0.012);
  EXPECT_EQ(fact(source->health(), "silences"), "1");
}

#ifdef POSE_WALL_LIVE_HAS_HTTP
// An OS1-64, and where it tells its metadata and sends to.
struct Ouster {
  sim::Setup setup = sim::make_setup("clean", "os1-64", false, 1);
  OusterEncoder encoder{setup.sensor};
  std::string web = fmt::format("127.0.0.1:{}", pose_wall::test::free_tcp_port());
  std::uint16_t port = free_udp_port();
};

TEST(UdpSource, AnOusterThatStartsLaterIsAskedForItsMetadata) {
  Ouster ouster;
  auto& [setup, encoder, web, port] = ouster;
  const auto source = make_udp_source(live_config(port, {"sensor_metadata=http://" + web + "/"}));
  FrameCatcher catcher;
  source->start(catcher);
  ASSERT_TRUE(becomes_true([&] { return source->health().summary.find("metadata") != std::string::npos; }))
      << source->health().summary;
  for (const std::string& word : {"host 127.0.0.1, port " + web.substr(web.find(':') + 1),
                                  std::string("path /api/v1/sensor/metadata: no connection; is the sensor on"),
                                  "curl http://" + web + "/api/v1/sensor/metadata"}) {
    EXPECT_NE(source->health().summary.find(word), std::string::npos) << source->health().summary;
  }
  const MetadataServer server(web, encoder.metadata());
  ASSERT_TRUE(becomes_true([&] { return source->health().summary.find("metadata") == std::string::npos; }));
  const LoopbackSender sender(port);
  Pace pace(*source);
  for (int turn = 0; turn < 3; ++turn) {
    pace.send(sender, encoder.packets(image_of(64, 1024), turn * kTurn_ns, kTurn_ns));
  }
  ASSERT_TRUE(catcher.wait_for_frames(2));
  source->stop();
  EXPECT_EQ(catcher.frames()[0].frame.cloud.width * catcher.frames()[0].frame.cloud.height, 64U * 1024U);
  EXPECT_EQ(catcher.frames()[1].stamp_ns - catcher.frames()[0].stamp_ns, kTurn_ns) << "the sensor's own clock";
}
#endif

TEST(UdpSource, ASensorThatComesBackUnderAnotherAddressIsHeard) {
  const std::uint16_t port = free_udp_port();
  const auto source = make_udp_source(live_config(port));
  FrameCatcher catcher;
  source->start(catcher);
  Pace pace(*source);
  pace.send(LoopbackSender(port), vlp16_turns(3));
  ASSERT_TRUE(catcher.wait_for_frames(2));
  ASSERT_TRUE(becomes_true([&] { return source->health().summary == "the sensor is silent"; }));
  pace.send(LoopbackSender(port, "127.0.0.2"), vlp16_turns(3, 20));
  EXPECT_TRUE(catcher.wait_for_frames(4)) << source->health().summary;
  source->stop();
  EXPECT_EQ(fact(source->health(), "packets of others"), "0");
}

#ifdef POSE_WALL_LIVE_HAS_HTTP
TEST(UdpSource, AnOusterThatIsSetUpAnewIsAskedAnew) {
  Ouster ouster;
  auto& [setup, encoder, web, port] = ouster;
  std::string other_mode = encoder.metadata();
  const std::string columns = "\"columns_per_frame\": 1024";
  ASSERT_NE(other_mode.find(columns), std::string::npos) << other_mode;
  other_mode.replace(other_mode.find(columns), columns.size(), "\"columns_per_frame\": 2048");
  auto server = std::make_unique<MetadataServer>(web, other_mode);
  const auto source = make_udp_source(live_config(port, {"sensor_metadata=http://" + web}));
  FrameCatcher catcher;
  source->start(catcher);
  const LoopbackSender sender(port);
  Pace pace(*source);
  int turn = 0;
  const auto send_turn = [&] { pace.send(sender, encoder.packets(image_of(64, 1024), turn++ * kTurn_ns, kTurn_ns)); };
  ASSERT_TRUE(becomes_true([&] {
    send_turn();
    return source->health().summary.find("another lidar_mode") != std::string::npos;
  })) << source->health().summary;
  EXPECT_EQ(catcher.frames().size(), 0U);
  server.reset();
  server = std::make_unique<MetadataServer>(web, encoder.metadata());
  ASSERT_TRUE(becomes_true([&] {
    send_turn();
    return !catcher.frames().empty();
  })) << source->health().summary;
  source->stop();
  EXPECT_EQ(catcher.frames()[0].frame.cloud.width * catcher.frames()[0].frame.cloud.height, 64U * 1024U);
}
#endif

// The cable, or the file, is of the other of two machines.
TEST(UdpSource, AnOusterOfAnotherSerialNumberThanItsMetadataIsToldAndNotMeasured) {
  const test::TempFolder folder;
  const std::uint16_t port = free_udp_port();
  test::OusterDescription told;
  told.more = test::ouster_serial_told(test::kOusterSerial);
  const std::string file = folder.write("o.json", test::ouster_json(told));
  const auto source = make_udp_source(live_config(port, {"sensor_metadata=" + file}));
  FrameCatcher catcher;
  source->start(catcher);
  const LoopbackSender sender(port);
  Pace pace(*source);
  test::OusterPacket packet;
  const auto send_turns = [&](std::uint64_t serial) {
    packet.serial = serial;
    for (const test::OusterPacket& one : test::turns_of(packet, 3)) pace.send(sender, test::payload_of(one));
    packet.frame += 3;
  };
  ASSERT_TRUE(becomes_true([&] {
    send_turns(test::kOtherOusterSerial);
    const std::string summary = source->health().summary;
    return summary.find("122201000222") != std::string::npos && summary.find("122201000111") != std::string::npos;
  })) << source->health().summary;
  EXPECT_EQ(source->health().grade, Grade::kBad);
  EXPECT_EQ(catcher.frames().size(), 0U);
  ASSERT_TRUE(becomes_true([&] {
    send_turns(test::kOusterSerial);
    return source->health().summary == "receives";
  })) << source->health().summary;
  source->stop();
  EXPECT_GE(catcher.frames().size(), 2U);
}

#ifdef POSE_WALL_LIVE_HAS_HTTP
// Another sensor is put in place of the first: its metadata is asked for once the first is silent. Firmware 3.2 tells
// a head of another kind.
TEST(UdpSource, AnOusterThatReplacesAnotherIsReadByItsOwnMetadata) {
  const std::string web = fmt::format("127.0.0.1:{}", pose_wall::test::free_tcp_port());
  const std::uint16_t port = free_udp_port();
  test::OusterDescription first, second;
  first.more = test::ouster_serial_told(test::kOusterSerial);
  second.more = test::ouster_serial_told(test::kOtherOusterSerial);
  second.more_of_format = ", \"header_type\": \"FUSA\", \"column_window\": [8, 15]";
  auto server = std::make_unique<MetadataServer>(web, test::ouster_json(first));
  const auto source = make_udp_source(live_config(port, {"sensor_metadata=http://" + web}));
  FrameCatcher catcher;
  source->start(catcher);
  const LoopbackSender sender(port);
  Pace pace(*source);
  test::OusterPacket packet;
  packet.serial = test::kOusterSerial;
  const auto send_turns = [&] {
    for (const test::OusterPacket& one : test::turns_of(packet, 3)) {
      if (!packet.is_fusa || one.first_column >= 8) pace.send(sender, test::payload_of(one));
    }
    packet.frame += 3;
  };
  const auto frames = [&] { return std::stoull(fact(source->health(), "frames")); };
  ASSERT_TRUE(becomes_true([&] {
    send_turns();
    return frames() > 0;
  })) << source->health().summary;
  server.reset();
  server = std::make_unique<MetadataServer>(web, test::ouster_json(second));
  ASSERT_TRUE(becomes_true([&] { return source->health().summary == "the sensor is silent"; }));
  const auto of_first = frames();
  packet.serial = test::kOtherOusterSerial;
  packet.is_fusa = true;
  packet.frame = 1'000'000;
  const std::int64_t of_second_ns = 1'000'000LL * test::kOusterColumnsOfTurn * test::kOusterColumn_ns;
  ASSERT_TRUE(becomes_true([&] {
    send_turns();
    return frames() > of_first + 5;
  })) << source->health().summary;
  source->stop();
  EXPECT_GE(catcher.frames().back().stamp_ns, of_second_ns);
}
#endif

TEST(UdpSource, WhatNoWaitingMendsIsRefusedWithWordsThatHelp) {
  EXPECT_NE(refusal_of(live_config(0, {"sensor_metadata=/nowhere.json"})).find("/nowhere.json"), std::string::npos);
  const std::uint16_t port = free_udp_port();
  FrameCatcher catcher;
  const auto first = make_udp_source(live_config(port));
  first->start(catcher);
  EXPECT_NE(refusal_of(live_config(port)).find(fmt::format("udp_address 127.0.0.1, udp_port {}: cannot listen", port)),
            std::string::npos);
}

// 192.0.2.0/24 is for documentation (RFC 5737): no machine has it. That it receives once it is there: daemon_peer.py.
TEST(UdpSource, AnAddressThatNoInterfaceHasYetIsWaitedFor) {
  const auto source = make_udp_source(live_config(free_udp_port(), {"udp_address=192.0.2.1"}));
  FrameCatcher catcher;
  source->start(catcher);
  const PartHealth health = source->health();
  EXPECT_EQ(health.grade, Grade::kBad);
  EXPECT_NE(health.summary.find("no interface of this machine has udp_address 192.0.2.1"), std::string::npos)
      << health.summary;
  source->stop();
}

TEST(UdpSource, AnAddressOfThisMachineIsNotMissed) {
  for (const char* here : {"127.0.0.1", "127.9.9.9", "0.0.0.0"}) {
    const auto source = make_udp_source(live_config(free_udp_port(), {std::string("udp_address=") + here}));
    FrameCatcher catcher;
    source->start(catcher);
    EXPECT_EQ(source->health().summary, "waits for the sensor: no packet yet") << here;
    source->stop();
  }
}

TEST(UdpSource, StopsTwiceAndBeforeItBegan) {
  const auto source = make_udp_source(live_config(free_udp_port()));
  source->stop();
  source->stop();
  EXPECT_EQ(fact(source->health(), "frames"), "0");
}

// Every capture there is: as UDP the same points as from the file, bit for bit.
class LiveCaptures : public pose_wall::test::RealFrames {};

TEST_F(LiveCaptures, GiveTheSameBitsByUdpAsFromTheFile) {
  std::size_t looked_at = 0;
  for (const auto& entry : std::filesystem::directory_iterator(pose_wall::test::data_folder() / "packets")) {
    if (entry.path().extension() != ".pcap") continue;
    SCOPED_TRACE(entry.path().filename().string());
    FrameSequence sequence({entry.path().string()});
    std::vector<Frame> expected;
    while (std::optional<SourcedFrame> frame = sequence.next()) {
      if (frame->frame) expected.push_back(std::move(*frame->frame));
    }
    std::filesystem::path metadata = entry.path();
    metadata.replace_extension(".json");
    std::vector<std::string> settings;
    if (std::filesystem::exists(metadata)) settings.push_back("sensor_metadata=" + metadata.string());

    const std::uint16_t port = free_udp_port();
    const auto source = make_udp_source(live_config(port, settings));
    FrameCatcher catcher;
    source->start(catcher);
    const LoopbackSender sender(port);
    const std::unique_ptr<DatagramSource> capture = open_udp_capture(entry.path().string());
    std::int64_t last_ns = 0;
    std::size_t sent = 0;
    while (std::optional<Datagram> datagram = capture->next()) {
      const std::int64_t pause_ns = last_ns == 0 ? 0 : datagram->captured_ns - last_ns;
      last_ns = datagram->captured_ns;
      std::this_thread::sleep_for(std::chrono::nanoseconds(std::clamp<std::int64_t>(pause_ns, 0, 100'000'000)));
      ASSERT_TRUE(sender.send(text_of(datagram->payload)));
      ++sent;
    }
    ASSERT_TRUE(becomes_true([&] { return fact(source->health(), "packets") == std::to_string(sent); }));
    source->stop();
    ++looked_at;
    std::size_t same = 0;
    for (const LiveFrame& frame : catcher.frames()) {
      for (const Frame& from_file : expected) {
        if (frame.frame.cloud.width != from_file.cloud.width || frame.frame.cloud.height != from_file.cloud.height) {
          continue;
        }
        bool is_same = true;
        const std::uint32_t points = from_file.cloud.width * from_file.cloud.height;
        for (std::uint32_t i = 0; i < points && is_same; ++i) {
          const auto at = std::size_t{i} * from_file.cloud.point_step;
          // x, y, z and intensity; the times go by the packets' arrival.
          is_same = std::memcmp(frame.frame.bytes.data() + at, from_file.bytes.data() + at, 16) == 0;
        }
        if (is_same) ++same;
      }
    }
    std::cout << entry.path().filename().string() << ": " << expected.size() << " frames of the file, "
              << catcher.frames().size() << " live, " << same << " the same bits\n";
    EXPECT_EQ(same, catcher.frames().size()) << "what the file's reader refuses is refused live";
    EXPECT_GE(catcher.frames().size() + 1, expected.size()) << "but for a turn whose end the capture does not hold";
  }
  EXPECT_GT(looked_at, 0U);
}

}  // namespace
}  // namespace pose_wall::tools::live
