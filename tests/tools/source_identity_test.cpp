// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: sources are told apart by whatever an input tells of them; the first that is whole is read for good, and the
// others are counted and named as --source takes them; a name that means nobody or several is no choice.

#include "io/frames/source_identity.hpp"

#include <gtest/gtest.h>

namespace pose_wall::tools {
namespace {

SourceIdentity of_frame(const std::string& frame_id) {
  SourceIdentity who;
  who.frame_id = frame_id;
  return who;
}

SourceIdentity of_lidar(std::uint8_t lidar_id) {
  SourceIdentity who = of_frame("livox_frame");
  who.lidar_id = lidar_id;
  return who;
}

SourceIdentity at(const std::string& address, std::uint16_t port) {
  SourceIdentity who;
  who.address = address;
  who.port = port;
  return who;
}

TEST(SourceIdentity, EachThingThatIsToldTellsApart) {
  SourceIdentity other_mac = at("192.168.1.201", 2368), other_serial = other_mac, behind_router = other_mac;
  behind_router.from_port = 40001;
  other_mac.mac = "02:00:00:00:00:01";
  other_serial.serial = "1220";
  const SourceIdentity all[] = {{},
                                of_frame(""),
                                of_frame("left"),
                                of_lidar(0),
                                of_lidar(1),
                                other_mac,
                                behind_router,
                                other_serial,
                                at("192.168.1.201", 2368),
                                at("192.168.1.201", 2369),
                                at("192.168.1.202", 2368)};
  for (const SourceIdentity& a : all) {
    for (const SourceIdentity& b : all) EXPECT_EQ(a == b, &a == &b) << a.text() << " and " << b.text();
  }
}

TEST(SourceIdentity, IsCalledByItsWholeTextOrByAPart) {
  SourceIdentity who = at("192.168.1.201", 2368);
  who.serial = "1220";
  EXPECT_EQ(who.text(), "192.168.1.201:2368, serial 1220");
  for (const char* name :
       {"192.168.1.201:2368, serial 1220", "192.168.1.201:2368", "192.168.1.201", "serial 1220", "1220"}) {
    EXPECT_TRUE(who.is_named(name)) << name;
  }
  for (const char* name : {"", "2368", "192.168.1.20", "serial", "122"}) EXPECT_FALSE(who.is_named(name)) << name;
  EXPECT_TRUE(of_lidar(1).is_named("lidar_id 1"));
  EXPECT_TRUE(of_lidar(1).is_named("1"));
  EXPECT_TRUE(of_frame("").is_named("frame_id ''"));
  EXPECT_FALSE(SourceIdentity{}.text().empty());
}

TEST(SourceIdentity, ASlashOfOldIsNoOtherFrame) {
  EXPECT_EQ(frame_id_of("/lidar"), "lidar");
  EXPECT_EQ(frame_id_of("lidar"), "lidar");
  EXPECT_EQ(frame_id_of(""), "");
}

TEST(SourceGate, TheFirstIsReadForGoodAndTheOthersAreNamed) {
  SourceGate gate;
  EXPECT_TRUE(gate.note("on /points", "message").empty());
  EXPECT_TRUE(gate.admits(of_frame("left")));
  EXPECT_TRUE(gate.note("on /points", "message").empty()) << "one is no reason for a word";
  EXPECT_FALSE(gate.admits(of_frame("right")));
  EXPECT_FALSE(gate.admits(of_frame("right")));
  EXPECT_TRUE(gate.admits(of_frame("left")));
  EXPECT_EQ(gate.refused(), 2U);
  EXPECT_EQ(gate.note("on /points", "message"),
            "2 sources on /points: frame_id left is read; frame_id right (2 messages) is not; --source chooses");
}

TEST(SourceGate, HearingDecidesNothing) {
  SourceGate gate;
  gate.hear(at("10.0.0.1", 2368));
  gate.hear(at("10.0.0.2", 2368));
  EXPECT_FALSE(gate.chosen());
  EXPECT_TRUE(gate.decide(at("10.0.0.2", 2368))) << "the first whole turn is the second one's";
  EXPECT_FALSE(gate.decide(at("10.0.0.1", 2368)));
  EXPECT_FALSE(gate.may_be(at("10.0.0.1", 2368)));
  EXPECT_EQ(gate.note("", "packet"),
            "2 sources: 10.0.0.2:2368 is read; 10.0.0.1:2368 (1 packet) is not; --source chooses");
}

// Of what both have in common nothing is said: it would choose none of them.
TEST(SourceGate, NamesOnlyWhatTellsApart) {
  SourceGate gate("lidar_id 1");
  EXPECT_FALSE(gate.admits(of_lidar(0)));
  EXPECT_TRUE(gate.admits(of_lidar(1)));
  EXPECT_TRUE(gate.fault("on /livox", "message").empty());
  EXPECT_EQ(gate.note("on /livox", "message"),
            "2 sources on /livox: lidar_id 1 is read; lidar_id 0 (1 message) is not; --source chooses");
}

TEST(SourceGate, ANameOfNobodyOrOfSeveralIsNoChoice) {
  SourceGate nobody("rear");
  EXPECT_FALSE(nobody.admits(of_frame("left")));
  EXPECT_EQ(nobody.fault("on /points", "message"),
            "--source rear: nobody on /points is called this; there: frame_id left (1 message)");
  SourceGate several("livox_frame");
  several.hear(of_lidar(0));
  several.hear(of_lidar(1));
  EXPECT_EQ(several.fault("", "message"),
            "--source livox_frame: several are meant: lidar_id 0 (1 message), lidar_id 1 (1 message)");
}

TEST(SourceGate, EverNewNamesFillNoMemory) {
  SourceGate gate;
  for (int i = 0; i < 1000; ++i) gate.admits(of_frame(std::to_string(i)));
  EXPECT_EQ(gate.heard().size(), kSourcesNamed);
  EXPECT_EQ(gate.refused(), 999U);
  EXPECT_NE(gate.note("", "message").find("further ones (984 messages)"), std::string::npos)
      << gate.note("", "message");
}

}  // namespace
}  // namespace pose_wall::tools
