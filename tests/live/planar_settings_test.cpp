// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the keys of the planar part are refused with key, value and range. Every value in their ranges is one that
// the library takes, and what has no key keeps the library's default. The stop's times follow from the machine's
// latency and the sensor's period. Rules over several keys name them.

#include "io/config_file/planar_settings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/config_file/load_config.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

std::string planar_fault_of(const std::vector<std::string>& settings) {
  return test::said_by<ConfigError>([&] { load_config("", settings); });
}

TEST(PlanarSettings, AreOffAndRefusedWithWhatIsAllowed) {
  EXPECT_FALSE(load_config("", {}).planar.is_on());
  EXPECT_EQ(planar_fault_of({"planar=on"}), "--set: planar: 'on' is refused; allowed: one of off, map, localise");
  EXPECT_EQ(planar_fault_of({"planar_stale=1.01"}),
            "--set: planar_stale: '1.01' is refused; allowed: a number from 0.02 to 1 s");
  for (const char* wrong : {"planar_height=nan", "planar_x_min=0", "planar_cell=", "planar_tf=yes", "planar_motion=0",
                            "planar_turn_max_deg=1e9", "planar_map_every_s=0"}) {
    EXPECT_NE(planar_fault_of({wrong}).find("is refused; allowed: "), std::string::npos) << wrong;
  }
  EXPECT_NE(planar_fault_of({"planar_stail=1"}).find("did you mean 'planar_stale'?"), std::string::npos);
}

TEST(PlanarSettings, RulesOverSeveralKeysNameThem) {
  EXPECT_EQ(planar_fault_of({"planar=localise"}), "planar: localise needs planar_map, the file of a saved map");
  EXPECT_EQ(
      planar_fault_of({"planar_x_max=5", "planar_y_max=2"}),
      "planar_x_max 5 m and planar_y_max 2 m: this corner of the machine is 5.39 m from base; allowed: up to 5 m");
  EXPECT_EQ(
      planar_fault_of({"planar_x_min=-4.5", "planar_y_min=-2.5"}),
      "planar_x_min -4.5 m and planar_y_min -2.5 m: this corner of the machine is 5.15 m from base; allowed: up to "
      "5 m");
  EXPECT_EQ(planar_fault_of({"planar_tf=base", "planar_map_frame="}),
            "planar_tf: base needs names in planar_map_frame and planar_odom_frame");
  EXPECT_EQ(planar_fault_of({"planar_tf=off", "planar_map_frame="}), "");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_map=map.yaml"}),
            "planar_map: with planar: map the name must end in .pwt");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_map=trail.pwt"}), "");
}

TEST(PlanarSettings, CommandsComeFromOnePlaceThatThereIs) {
  EXPECT_EQ(
      planar_fault_of({"planar=map", "planar_motion=commanded"}),
      "planar_motion: commanded needs planar_command_modbus, planar_command_ros or planar_command_can: where commands "
      "come from");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_motion=both", "planar_command_modbus=10.0.0.2"}),
            "planar_command_modbus needs modbus, the address of the server");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_motion=both", "planar_command_ros=cmd_vel"}),
            "planar_command_ros needs a node: ros1: 1, ros2: 1, or source: ros1 or ros2");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_command_modbus=10.0.0.2", "planar_command_ros=cmd_vel", "ros1=1",
                             "modbus=10.0.0.1:502"}),
            "planar_command_modbus, planar_command_ros and planar_command_can: commands come from one place alone");
  EXPECT_EQ(
      planar_fault_of({"planar_command_modbus=10.0.0"}),
      "--set: planar_command_modbus: '10.0.0' is refused; allowed: an IPv4 address, as 192.168.1.201, or nothing");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_motion=both", "planar_command_can=2048"}),
            "planar_command_can needs can, the interface");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_command_can=2048", "can=can0"}),
            "planar_command_can: 2048 is more than 11 bits hold; allowed with can_frames: 11bit: up to 2047");
  EXPECT_EQ(
      planar_fault_of({"planar=map", "planar_motion=both", "planar_command_can=2048", "can=can0", "can_frames=j1939"}),
      "");
  for (const char* node : {"ros1=1", "ros2=1", "source=ros1", "source=ros2"}) {
    EXPECT_EQ(planar_fault_of({"planar=map", "planar_motion=both", "planar_command_ros=cmd_vel", node}), "") << node;
  }
  EXPECT_EQ(planar_fault_of({"planar_motion=both"}), "") << "no stop that runs";
}

// What pose_wall_planar_stop.h asks of delay_s and slack_s, for slow brakes and for a sensor of five frames a second.
TEST(PlanarSettings, TheStopsTimesFollowFromLatencyAndPeriod) {
  const auto stop_of = [](const std::vector<std::string>& settings) {
    return stop_settings_of(load_config("", settings).planar);
  };
  EXPECT_NEAR(stop_of({"planar_latency=0.6"}).slack_s, 0.75, 1e-12);
  const std::vector<std::string> slow = {"planar_period=0.2", "planar_stale=0.35", "planar_scan_time=0.2"};
  EXPECT_NEAR(stop_of(slow).slack_s, 0.45, 1e-12);
  EXPECT_NEAR(stop_of(slow).delay_s, 0.6, 1e-12);
  EXPECT_EQ(planar_fault_of({"planar_latency=1.5"}),
            "--set: planar_latency: '1.5' is refused; allowed: a number from 0 to 1.4 s");
  EXPECT_EQ(
      planar_fault_of({"planar=map", "planar_period=0.25"}),
      "planar_stale: 0.25 s is too short for planar_period 0.25 s: each frame would be stale before the next one; "
      "allowed: from 0.3 s");
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_stale=0.15"}), "") << "the least";
  EXPECT_EQ(planar_fault_of({"planar_stale=0.1"}), "") << "no stop that runs";
  EXPECT_EQ(planar_fault_of({"planar=map", "planar_scan_time=0.2"}),
            "planar_scan_time: 0.2 s is longer than planar_period, 0.1 s: a frame lasts no longer than its period");
}

TEST(PlanarSettings, EveryValueInRangeIsOneThatTheLibraryTakes) {
  for (const OutsideKey& key : planar_keys()) {
    if (key.type != OutsideKey::Type::kNumber) continue;
    const bool is_corner = std::string(key.name).find("_x_") != std::string::npos ||
                           std::string(key.name).find("_y_") != std::string::npos;
    for (const double value : {key.minimum, key.maximum}) {
      PlanarSettings settings;
      ASSERT_TRUE(set_planar_value(&settings, key, std::to_string(value))) << key.name;
      if (is_corner && std::abs(value) > 4.9) continue;  // with the other side it is further than 5 m
      const std::string rule = broken_planar_rule(settings);
      EXPECT_TRUE(rule.empty() || rule.rfind("planar_stale: ", 0) == 0 || rule.rfind("planar_scan_time: ", 0) == 0)
          << key.name << " " << value << ": " << rule;
      const pose_wall_planar_stop_settings stop = stop_settings_of(settings);
      pose_wall_planar_fault fault{};
      EXPECT_EQ(pose_wall_planar_stop_settings_check(&stop, &fault), POSE_WALL_OK) << key.name << ": " << fault.rule;
    }
  }
}

TEST(PlanarSettings, DefaultsReadBackAndAreTheLibrarysWhereTheyHaveNoKey) {
  const PlanarSettings defaults;
  for (const OutsideKey& key : planar_keys()) {
    PlanarSettings changed;
    const std::string written = planar_value_text(defaults, key);
    EXPECT_TRUE(set_planar_value(&changed, key, written)) << key.name;
    EXPECT_EQ(planar_value_text(changed, key), written) << key.name;
  }
  pose_wall_planar_stop_settings library{};
  ASSERT_EQ(pose_wall_planar_stop_settings_init(&library), POSE_WALL_OK);
  const pose_wall_planar_stop_settings ours = stop_settings_of(defaults);
  for (const auto member : {&pose_wall_planar_stop_settings::tall_m, &pose_wall_planar_stop_settings::stale_s,
                            &pose_wall_planar_stop_settings::delay_s, &pose_wall_planar_stop_settings::restart_s,
                            &pose_wall_planar_stop_settings::approach_m_s,
                            &pose_wall_planar_stop_settings::deceleration_m_s2, &pose_wall_planar_stop_settings::top_m,
                            &pose_wall_planar_stop_settings::scan_s, &pose_wall_planar_stop_settings::slack_s}) {
    EXPECT_NEAR(ours.*member, library.*member, 1e-12);
  }
  EXPECT_NEAR(ours.turn_max_rad_s, library.turn_max_rad_s, 0.002);
  for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(ours.corner_m[k][0], library.corner_m[k][0]);
}

}  // namespace
}  // namespace pose_wall::tools
