// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the graph message has the very bytes that nodes of Humble and Iron sent. Names, hashes and USER_DATA are
// those of ROS. Its environment variables are read as ROS reads them, and what is none is refused by name. The settings
// for Cyclone follow. A mismatch names each policy with what either side has.

#ifdef POSE_WALL_LIVE_HAS_ROS2

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "apps/live/ros2/environment.hpp"
#include "apps/live/ros2/graph_message.hpp"
#include "apps/live/ros2/qos_match.hpp"
#include "apps/live/ros2/ros2_node.hpp"
#include "apps/live/ros2/ros2_source.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "live/ros2_golden.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::live {
namespace {

std::string from_hex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

Gid gid_from(const std::string& prefix_hex, unsigned entity) {
  const std::string bytes = from_hex(prefix_hex);
  Gid gid{};
  for (std::size_t i = 0; i < bytes.size(); ++i) gid[i] = static_cast<std::uint8_t>(bytes[i]);
  gid[14] = static_cast<std::uint8_t>(entity >> 8U);
  gid[15] = static_cast<std::uint8_t>(entity & 0xFFU);
  return gid;
}

std::vector<Gid> gids_from(const std::string& prefix_hex, const std::vector<unsigned>& entities) {
  std::vector<Gid> gids;
  for (const unsigned entity : entities) gids.push_back(gid_from(prefix_hex, entity));
  return gids;
}

TEST(Ros2Wire, TheGraphMessageOfHumbleHasItsBytes) {
  const std::string prefix = "0110de17b1eaf995400c9ac80000";
  const std::vector<GraphNode> nodes = {
      {"/TEST", "ComponentManager", gids_from(prefix, {0x0704, 0x0904, 0x0b04, 0x0d04}),
       gids_from(prefix, {0x0603, 0x0803, 0x0a03, 0x0c03})},
      {"/", "listener", gids_from(prefix, {0x1004, 0x1204, 0x1404, 0x1604, 0x1804, 0x1a04, 0x1c04, 0x1d04}),
       gids_from(prefix, {0x0e03, 0x0f03, 0x1103, 0x1303, 0x1503, 0x1703, 0x1903, 0x1b03})},
      {"/", "talker", gids_from(prefix, {0x2004, 0x2204, 0x2404, 0x2604, 0x2804, 0x2a04, 0x2c04}),
       gids_from(prefix, {0x1e03, 0x1f03, 0x2103, 0x2303, 0x2503, 0x2703, 0x2903, 0x2b03, 0x2d03})}};
  EXPECT_EQ(graph_message(RosDistro::kHumble, gid_from(prefix, 0x01c1), nodes),
            from_hex(pose_wall::test::kHumbleGraphHex));
}

TEST(Ros2Wire, TheGraphMessageOfIronHasItsBytes) {
  const std::string prefix = "010f20a26b2fbd80000000000000";
  const std::vector<GraphNode> nodes = {
      {"/TEST", "ComponentManager", gids_from(prefix, {0x0404, 0x0504, 0x0704, 0x0904, 0x0b04}),
       gids_from(prefix, {0x0303, 0x0603, 0x0803, 0x0a03, 0x0c03})},
      {"/", "listener", gids_from(prefix, {0x0e04, 0x1004, 0x1204, 0x1404, 0x1604, 0x1804, 0x1b04, 0x1c04, 0x1e04}),
       gids_from(prefix, {0x0d03, 0x0f03, 0x1103, 0x1303, 0x1503, 0x1703, 0x1903, 0x1a03, 0x1d03})},
      {"/", "talker", gids_from(prefix, {0x2004, 0x2204, 0x2404, 0x2604, 0x2804, 0x2a04, 0x2d04, 0x2e04}),
       gids_from(prefix, {0x1f03, 0x2103, 0x2303, 0x2503, 0x2703, 0x2903, 0x2b03, 0x2c03, 0x2f03, 0x3003})}};
  EXPECT_EQ(graph_message(RosDistro::kIronOrLater, gid_from(prefix, 0x01c1), nodes),
            from_hex(pose_wall::test::kIronGraphHex));
}

TEST(Ros2Wire, NamesAndWordsAreThoseOfRos) {
  EXPECT_EQ(kPointCloud2Type.dds_name(), "sensor_msgs::msg::dds_::PointCloud2_");
  EXPECT_EQ(kParticipantEntitiesType.dds_name(), "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_");
  EXPECT_EQ(dds_topic("/lidar/points"), "rt/lidar/points");
  EXPECT_EQ(dds_topic("points"), "rt/points");
  for (const char* bad : {"", "/", "/a//b", "/a/", "/a b", "/1a", "/a/2", "/a-b", "/\xC3\xA4", "~/a"}) {
    EXPECT_THROW(dds_topic(bad), std::runtime_error) << bad;
  }
  EXPECT_EQ(participant_user_data(), "enclave=/;");
  EXPECT_EQ(endpoint_user_data(RosDistro::kHumble, kPointCloud2Type.hash), "");
  EXPECT_EQ(endpoint_user_data(RosDistro::kIronOrLater, kPointCloud2Type.hash),
            "typehash=RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5;");
  EXPECT_EQ(endpoint_user_data(RosDistro::kIronOrLater, ""), "");
  // As others published them, beside those that the generator checks.
  EXPECT_EQ(std::string(kTfMessageType.hash),
            "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  EXPECT_EQ(std::string(kParticipantEntitiesType.hash),
            "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e");
}

RosEnvironment read(const std::map<std::string, std::string>& variables, RosDistro distro = RosDistro::kHumble) {
  return read_ros_environment(distro, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::make_optional(found->second);
  });
}

TEST(Ros2Environment, IsReadAsRosReadsIt) {
  EXPECT_EQ(read({}).domain_id, 0U);
  EXPECT_EQ(read({}).range, DiscoveryRange::kSubnet);
  EXPECT_EQ(read({{"ROS_DOMAIN_ID", ""}}).domain_id, 0U);
  EXPECT_EQ(read({{"ROS_DOMAIN_ID", "232"}}).domain_id, 232U);
  EXPECT_EQ(read({{"ROS_LOCALHOST_ONLY", "1"}}).range, DiscoveryRange::kLocalhost);
  EXPECT_EQ(read({{"ROS_LOCALHOST_ONLY", "0"}}).range, DiscoveryRange::kSubnet);
  EXPECT_EQ(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}).range, DiscoveryRange::kOff);
  // The one that keeps it to this machine wins, whichever it is.
  EXPECT_EQ(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}, {"ROS_LOCALHOST_ONLY", "1"}}).range,
            DiscoveryRange::kLocalhost);
  EXPECT_EQ(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}, {"ROS_LOCALHOST_ONLY", "1"}}).range, DiscoveryRange::kOff);
  EXPECT_EQ(read({{"ROS_STATIC_PEERS", ";192.0.2.7;box.local;"}}).static_peers,
            (std::vector<std::string>{"192.0.2.7", "box.local"}));
}

TEST(Ros2Environment, RefusesByName) {
  const std::pair<const char*, const char*> bad[] = {
      {"ROS_DOMAIN_ID", "233"},      {"ROS_DOMAIN_ID", "-1"},
      {"ROS_DOMAIN_ID", "1x"},       {"ROS_DOMAIN_ID", "99999999999999999999"},
      {"ROS_LOCALHOST_ONLY", "yes"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "subnet"},
      {"ROS_STATIC_PEERS", "a\"/>"}, {"ROS_STATIC_PEERS", "<Peers>"}};
  for (const auto& [name, value] : bad) {
    const std::pair<std::string, std::string> variable = {name, value};
    const std::string said = test::said_by<std::runtime_error>([&] { read({variable}); });
    EXPECT_NE(said.find(name), std::string::npos) << name << " " << value << ": " << said;
    EXPECT_NE(said.find("allowed"), std::string::npos) << name << " " << value << ": " << said;
  }
}

const std::vector<NetworkInterface>& interfaces() {
  static const std::vector<NetworkInterface> all = {
      {"lo", "127.0.0.1", true, false}, {"ppp0", "192.0.2.9", false, false}, {"eth1", "192.0.2.2", false, true}};
  return all;
}

TEST(Ros2Environment, ChoosesTheInterface) {
  EXPECT_EQ(choose_interface(read({}), interfaces())->name, "eth1");
  EXPECT_EQ(choose_interface(read({}), {interfaces()[0]})->name, "lo");
  EXPECT_THROW(choose_interface(read({}), {}), std::runtime_error);
  EXPECT_EQ(choose_interface(read({{"ROS_LOCALHOST_ONLY", "1"}}), interfaces())->name, "lo");
  // From Iron on nodes of one machine are on the network's interface, and the two ways do not find each other.
  EXPECT_EQ(choose_interface(read({{"ROS_LOCALHOST_ONLY", "1"}}, RosDistro::kIronOrLater), interfaces())->name, "eth1");
  EXPECT_FALSE(choose_interface(read({{"CYCLONEDDS_URI", "<CycloneDDS/>"}}), interfaces()));
  EXPECT_FALSE(choose_interface(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT"}}), interfaces()));
}

std::string settings(const std::map<std::string, std::string>& variables, RosDistro distro = RosDistro::kHumble) {
  const RosEnvironment environment = read(variables, distro);
  return cyclone_settings(environment, choose_interface(environment, interfaces()), {4'194'304, 9'000'000});
}

TEST(Ros2Environment, SettingsForCycloneFollow) {
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const std::string subnet = settings({{"ROS_STATIC_PEERS", "192.0.2.7"}});
  EXPECT_TRUE(has(subnet, "<NetworkInterface name=\"eth1\"/>")) << subnet;
  EXPECT_TRUE(has(subnet, "<Peer address=\"192.0.2.7\"/>")) << subnet;
  EXPECT_FALSE(has(subnet, "AllowMulticast")) << subnet;
  EXPECT_FALSE(has(subnet, "localhost")) << subnet;
  // A minimum beyond what the kernel grants would end the participant.
  EXPECT_TRUE(has(subnet, "<SocketReceiveBufferSize max=\"4194304 B\"/>")) << subnet;
  EXPECT_FALSE(has(subnet, "min=")) << subnet;
  EXPECT_TRUE(has(subnet, "<MaxSampleSize>9000000 B</MaxSampleSize>")) << subnet;

  const std::string humble = settings({{"ROS_LOCALHOST_ONLY", "1"}});
  EXPECT_TRUE(has(humble, "<NetworkInterface name=\"lo\"")) << humble;
  const std::string iron = settings({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}}, RosDistro::kIronOrLater);
  EXPECT_TRUE(has(iron, "<AllowMulticast>false</AllowMulticast>")) << iron;
  EXPECT_TRUE(has(iron, "<Peer address=\"localhost\"/>")) << iron;
  const std::string off = settings({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}, {"ROS_STATIC_PEERS", "192.0.2.7"}});
  EXPECT_TRUE(has(off, "<Tag>ros_discovery_off_")) << off;
  EXPECT_FALSE(has(off, "192.0.2.7")) << off;
  const std::string own = settings({{"CYCLONEDDS_URI", "file:///etc/cyclone.xml"}});
  EXPECT_EQ(own.substr(own.find("</CycloneDDS>")), "</CycloneDDS>,file:///etc/cyclone.xml") << own;
}

TEST(Ros2Qos, AMismatchNamesWhatEitherSideHas) {
  EndpointQos offered, requested;
  EXPECT_EQ(qos_mismatch(offered, requested), "");
  offered.reliability = 1;
  EXPECT_EQ(qos_mismatch(offered, requested), "") << "more than was asked for";
  requested.reliability = 1;
  requested.durability = 1;
  EXPECT_EQ(qos_mismatch(offered, requested),
            "durability: the writer offers volatile, the reader asks for transient local");
  offered.reliability = 0;
  requested.deadline_ns = 100'000'000;
  offered.ownership = 1;
  const std::string text = qos_mismatch(offered, requested);
  for (const char* part : {"reliability: the writer offers best effort, the reader asks for reliable", "durability",
                           "deadline: the writer offers none, the reader asks for 100 ms",
                           "ownership: the writer offers exclusive, the reader asks for shared"}) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  EndpointQos of_a, of_b;
  of_a.partitions = {"machine"};
  EXPECT_NE(qos_mismatch(of_a, of_b).find("partition"), std::string::npos);
  of_b.partitions = {"", "machine"};
  EXPECT_EQ(qos_mismatch(of_a, of_b), "");
}

TEST(Ros2Qos, ASmallBufferIsToldWithTheRemedy) {
  EXPECT_EQ(receive_buffer_warning(4'194'304, 524'429), "");
  EXPECT_EQ(receive_buffer_warning(4'194'304, 4'194'445), "") << "the head of a cloud is taken out meanwhile";
  EXPECT_EQ(receive_buffer_warning(0, 4'194'445), "") << "not known";
  const std::string text = receive_buffer_warning(212'992, 4'194'445);
  for (const char* part : {"4.2 MB", "0.2 MB", "sysctl -w net.core.rmem_max=4194445"}) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace pose_wall::tools::live

#endif
