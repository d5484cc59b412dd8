// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: keys of pose_walld stand in the same file as the engine's. Their errors are alike: place, value, what is
// allowed, and the nearest name. The written form of each default reads back.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "io/config_file/load_config.hpp"
#include "io/packets/sensors.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

std::string fault_of(const std::string& setting) {
  return test::said_by<ConfigError>([&] { load_config("", {setting}); });
}

TEST(LiveSettings, AreRefusedWithWhatIsAllowed) {
  EXPECT_EQ(fault_of("source=usb"),
            "--set: source: 'usb' is refused; allowed: one of udp, ros1, ros2; did you mean 'udp'?");
  EXPECT_EQ(fault_of("udp_port=65536"), "--set: udp_port: '65536' is refused; allowed: a whole number from 0 to 65535");
  for (const char* wrong : {"udp_port=1.5", "udp_port=", "udp_port=x", "udp_port=nan", "ros1=yes", "ros1=2",
                            "black_box_mb=0.5", "status_every_s=1e9", "http=8080", "http=:80", "http=a:0", "modbus=a:b",
                            "mqtt=::1:1883", "modbus=a:65536", "http=[]:80"}) {
    EXPECT_NE(fault_of(wrong).find("is refused; allowed: "), std::string::npos) << wrong;
  }
  EXPECT_EQ(fault_of("sensor=vlp61"),
            fmt::format("--set: sensor: 'vlp61' is refused; allowed: one of {}; did you mean 'vlp16'?",
                        fmt::join(sensor_names(), ", ")));
  EXPECT_EQ(fault_of("udp_address=sensor"),
            "--set: udp_address: 'sensor' is refused; allowed: an IPv4 address, as 192.168.1.100");
  for (const char* wrong : {"udp_address=", "udp_address=::1", "udp_address=127.1", "udp_address=1.2.3.256",
                            "udp_address=1.2.3.4 ", "udp_sender=x", "udp_sender=192.168.1.201:2368"}) {
    EXPECT_NE(fault_of(wrong).find("is refused; allowed: an IPv4 address"), std::string::npos) << wrong;
  }
  EXPECT_NE(fault_of(std::string("udp_address=1.2.3.4\0x", 21)), "") << "a zero byte ends no address";
  EXPECT_EQ(fault_of("udp_sender="), "");
  EXPECT_NE(fault_of("modbsu=127.0.0.1:502").find("did you mean 'modbus'?"), std::string::npos);
  EXPECT_NE(fault_of("extrinsic_from=tf").find("source (default) must be ros1 or ros2"), std::string::npos);
}

TEST(LiveSettings, ALoginWithoutItsPartsIsRefused) {
  EXPECT_EQ(fault_of("mqtt_password_file=/x"), "mqtt_password_file needs mqtt_user");
  EXPECT_EQ(fault_of("mqtt_ca_file=/x"), "mqtt_ca_file and mqtt_cert_file need mqtt_tls: 1");
  EXPECT_EQ(fault_of("mqtt_cert_file=/x"), "mqtt_ca_file and mqtt_cert_file need mqtt_tls: 1");
  EXPECT_EQ(fault_of("mqtt_key_file=/x"), "mqtt_key_file needs mqtt_cert_file");
  EXPECT_NE(fault_of("log_level=debug").find("allowed: one of info, warning, error"), std::string::npos);
}

TEST(LiveSettings, EverySensorThatIsKnownCanBeChosen) {
  for (const std::string& name : sensor_names()) {
    EXPECT_EQ(load_config("", {"sensor=" + name}).live.sensor, name);
  }
}

TEST(LiveSettings, AreTakenWithTheirOrigin) {
  const LoadedConfig loaded = load_config("", {"http=[::1]:8080", "udp_port=7502", "ros1=1", "source=ros1",
                                               "extrinsic_from=tf", "black_box=/var/lib/pose_wall/box"});
  EXPECT_EQ(loaded.live.http, "[::1]:8080");
  EXPECT_EQ(loaded.live.udp_port, 7502);
  EXPECT_TRUE(loaded.live.ros1);
  EXPECT_EQ(loaded.live.black_box, "/var/lib/pose_wall/box");
  EXPECT_EQ(loaded.origin("http"), "--set");
  EXPECT_EQ(loaded.origin("modbus"), "default");
}

TEST(LiveSettings, EveryDefaultReadsBack) {
  const LiveSettings defaults;
  EXPECT_GT(live_keys().size(), 15U);
  for (const OutsideKey& key : live_keys()) {
    LiveSettings changed;
    const std::string written = live_value_text(defaults, key);
    EXPECT_TRUE(set_live_value(&changed, key, written)) << key.name;
    EXPECT_EQ(live_value_text(changed, key), written) << key.name;
  }
}

TEST(HostPort, IsReadOrRefused) {
  const std::optional<HostPort> six = parse_host_port("[fe80::1]:502");
  ASSERT_TRUE(six);
  EXPECT_EQ(six->host, "fe80::1");
  EXPECT_EQ(six->port, 502);
  EXPECT_EQ(parse_host_port("localhost:1")->host, "localhost");
  for (const char* wrong : {"", "a", "a:", ":1", "a:-1", "a:1x", "fe80::1:502", "[:1"}) {
    EXPECT_FALSE(parse_host_port(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace pose_wall::tools
