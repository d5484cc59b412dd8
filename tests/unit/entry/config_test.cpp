// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the table of keys is consistent in itself; every key takes its own default and its limits and refuses what
// lies beyond; refusals leave the config as it was; the rules over several keys hold.

#include "engine/config.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "support/engine_under_test.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

std::vector<pose_wall_key_info> keys() {
  std::vector<pose_wall_key_info> all(pose_wall_config_key_count());
  for (std::uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(pose_wall_config_key(i, &all[i]), POSE_WALL_OK);
  return all;
}

bool is_number(const pose_wall_key_info& key) {
  return key.type == POSE_WALL_KEY_NUMBER || key.type == POSE_WALL_KEY_INTEGER;
}

// Status of a call that must change nothing.
template <typename Call>
std::int32_t refused(pose_wall_config* config, const Call& call) {
  pose_wall_config before;
  std::memcpy(&before, config, sizeof before);
  const std::int32_t status = call();
  EXPECT_EQ(std::memcmp(&before, config, sizeof before), 0) << "a refused call changed the config";
  return status;
}

std::int32_t refused_set(const char* key, const std::string& value) {
  pose_wall_config config = test::config_with();
  return refused(&config, [&] { return pose_wall_config_set(&config, key, value.c_str()); });
}

TEST(Config, TheTableIsConsistent) {
  std::set<std::string> names;
  for (const pose_wall_key_info& key : keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name << " twice";
    EXPECT_GT(std::strlen(key.help), 5U) << key.name;
    EXPECT_GT(std::strlen(key.group), 0U) << key.name;
    EXPECT_NE(key.unit, nullptr);
    EXPECT_NE(key.choices, nullptr);
    if (is_number(key)) {
      EXPECT_LT(key.minimum, key.maximum) << key.name;
      EXPECT_GT(std::strlen(key.unit), 0U) << key.name;
    }
  }
  pose_wall_key_info info;
  EXPECT_EQ(pose_wall_config_key(pose_wall_config_key_count(), &info), POSE_WALL_E_INDEX);
}

TEST(Config, HoldsAllTheKeysThatWereAskedForWithTheirDefaults) {
  const pose_wall_config config = test::config_with();
  const std::vector<std::pair<const char*, double>> asked = {{"s_front", 2.0},
                                                             {"s_back", -2.0},
                                                             {"range_min", 0.30},
                                                             {"range_max", 30.0},
                                                             {"voxel_leaf", 0.05},
                                                             {"outlier_radius", 0.20},
                                                             {"ground_roi_radius", 3.0},
                                                             {"ground_z_percentile", 25},
                                                             {"ground_ransac_thresh", 0.03},
                                                             {"ground_inlier_min", 800},
                                                             {"wall_z_min", 0.25},
                                                             {"wall_z_max", 2.50},
                                                             {"wall_ransac_thresh", 0.05},
                                                             {"wall_inlier_min", 900},
                                                             {"wall_parallel_cos", 0.90}};
  for (const auto& [key, expected] : asked) {
    double value = -1;
    ASSERT_EQ(pose_wall_config_get_number(&config, key, &value), POSE_WALL_OK) << key;
    EXPECT_EQ(value, expected) << key;
  }
  for (const char* key : {"pointcloud_topic", "lidar_frame", "base_frame", "forward_axis", "z_axis"}) {
    char text[POSE_WALL_TEXT_MAX];
    EXPECT_EQ(pose_wall_config_get_text(&config, key, text, sizeof text), POSE_WALL_OK) << key;
  }
  double unused = 0.0;
  for (const char* key : {"outlier_min_neighbors", "temporal_smoothing_tau"}) {
    EXPECT_EQ(pose_wall_config_get_number(&config, key, &unused), POSE_WALL_OK) << key;
  }
}

TEST(Config, EveryDefaultTextSetsTheDefaultValue) {
  const pose_wall_config defaults = test::config_with();
  for (const pose_wall_key_info& key : keys()) {
    pose_wall_config config = defaults;
    // Away from the default first, where the key has another value.
    if (is_number(key)) {
      ASSERT_EQ(pose_wall_config_set_number(&config, key.name, key.maximum), POSE_WALL_OK) << key.name;
    }
    ASSERT_EQ(pose_wall_config_set(&config, key.name, key.default_text), POSE_WALL_OK) << key.name;
    EXPECT_EQ(std::memcmp(&config, &defaults, sizeof config), 0) << key.name;
  }
  EXPECT_EQ(pose_wall_config_check(&defaults, nullptr), POSE_WALL_OK);
}

TEST(Config, ChoicesTakeTheirWordsOnly) {
  for (const pose_wall_key_info& key : keys()) {
    if (key.type != POSE_WALL_KEY_CHOICE) continue;
    std::string words = key.choices;
    for (std::size_t at = 0; at != std::string::npos;) {
      const std::size_t bar = words.find('|', at);
      const std::string word = words.substr(at, bar - at);
      pose_wall_config config = test::config_with();
      ASSERT_EQ(pose_wall_config_set(&config, key.name, word.c_str()), POSE_WALL_OK) << key.name;
      char text[POSE_WALL_TEXT_MAX];
      ASSERT_EQ(pose_wall_config_get_text(&config, key.name, text, sizeof text), POSE_WALL_OK);
      EXPECT_EQ(word, text);
      at = bar == std::string::npos ? bar : bar + 1;
    }
    for (const char* wrong : {"", "+", "X", "+x", "+X ", "+X|-X", "-Z", "0"}) {
      EXPECT_EQ(refused_set(key.name, wrong), POSE_WALL_E_VALUE_TYPE) << key.name << ": " << wrong;
    }
  }
}

TEST(Config, BoxesTakeSixNumbersInOrder) {
  const double expected[6] = {-2.3, 2.3, -0.6, 0.6, -1.5, 0.4};
  for (const char* text : {"-2.3 2.3 -0.6 0.6 -1.5 0.4", "[-2.3, 2.3, -0.6, 0.6, -1.5, 0.4]",
                           " -2.3,2.3,-.6,.6,-1.5,.4 ", " [ -2.3 , 2.3\t-0.6,0.6  -1.5 , 0.4 ] "}) {
    pose_wall_config config = test::config_with();
    ASSERT_EQ(pose_wall_config_set(&config, "body_box_2", text), POSE_WALL_OK) << text;
    double box[6];
    ASSERT_EQ(pose_wall_config_get_box(&config, "body_box_2", box), POSE_WALL_OK);
    EXPECT_EQ(std::memcmp(box, expected, sizeof box), 0) << text;
    for (const char* nothing : {"", " ", "[]", " [ ] "}) {
      pose_wall_config without = config;
      ASSERT_EQ(pose_wall_config_set(&without, "body_box_2", nothing), POSE_WALL_OK)
          << "takes the box away: " << nothing;
      ASSERT_EQ(pose_wall_config_get_box(&without, "body_box_2", box), POSE_WALL_OK);
      for (const double number : box) EXPECT_EQ(number, 0.0);
    }
  }
  for (const char* wrong : {"1", "1 2 3 4 5", "1 2 3 4 5 6 7", "a b c d e f", "1 2 3 4 5 x", "1;2;3;4;5;6", "none"}) {
    EXPECT_EQ(refused_set("body_box_1", wrong), POSE_WALL_E_VALUE_TYPE) << wrong;
  }
  for (const char* wrong : {"0,,1,0,1,0,1", "0,1,,0,1,0,1", "0 , , 1 0 1 0 1", ",0,1,0,1,0,1", "0,1,0,1,0,1,", ",",
                            "[,]", "[0 1 0 1 0 1", "0 1 0 1 0 1]", "[0 1 0 1 0 1]]", "[[0 1 0 1 0 1]]",
                            "[0 1 0][1 0 1]", "[0 1 0 1 0 1] 2", "[", "]", "][", "-2-1 0 1 0 1", "0 1 0 1 0+1"}) {
    EXPECT_EQ(refused_set("body_box_1", wrong), POSE_WALL_E_VALUE_TYPE) << wrong;
  }
  for (const char* wrong : {"2 1 0 1 0 1", "0 0 0 1 0 1", "0 1 0 1 0 1e9", "-99 1 0 1 0 1"}) {
    EXPECT_EQ(refused_set("body_box_1", wrong), POSE_WALL_E_VALUE_RANGE) << wrong;
  }
}

TEST(Config, TextsUpToTheirLength) {
  pose_wall_config config = test::config_with();
  const std::string longest(POSE_WALL_TEXT_MAX - 1, 'a');
  ASSERT_EQ(pose_wall_config_set(&config, "lidar_frame", longest.c_str()), POSE_WALL_OK);
  char buffer[POSE_WALL_TEXT_MAX];
  ASSERT_EQ(pose_wall_config_get_text(&config, "lidar_frame", buffer, sizeof buffer), POSE_WALL_OK);
  EXPECT_EQ(longest, buffer);
  EXPECT_EQ(pose_wall_config_get_text(&config, "lidar_frame", buffer, sizeof buffer - 1), POSE_WALL_E_BUFFER_SMALL);
  EXPECT_EQ(pose_wall_config_get_text(&config, "lidar_frame", buffer, 0), POSE_WALL_E_BUFFER_SMALL);
  EXPECT_EQ(refused_set("lidar_frame", longest + "a"), POSE_WALL_E_TEXT_LONG);
  EXPECT_EQ(refused_set("lidar_frame", std::string(100000, 'a')), POSE_WALL_E_TEXT_LONG);
}

TEST(Config, NamesThatAreNearlyAKeysAreUnknown) {
  for (const char* key : {"", "range_minimum", "RANGE_MIN", "range_min ", "range"}) {
    EXPECT_EQ(refused_set(key, "1"), POSE_WALL_E_KEY_UNKNOWN) << key;
  }
}

// What the factor of the levels follows from. Its old key holds another number, so it is unknown and not ignored.
TEST(Config, TheRiskSetsTheFactorOfTheLevels) {
  EXPECT_NEAR(read_settings(test::config_with()).protection_sigmas, 4.8916, 1e-3) << "1e-6";
  EXPECT_NEAR(test::settings_with({{"integrity_risk", "1e-2"}}).protection_sigmas, 2.5758, 1e-3);
  EXPECT_NEAR(test::settings_with({{"integrity_risk", "0.000000001"}}).protection_sigmas, 6.1094, 1e-3);
  for (const char* risk : {"0", "1", "-1e-6", "0.0101", "9.9e-10", "5.0"}) {
    EXPECT_EQ(refused_set("integrity_risk", risk), POSE_WALL_E_VALUE_RANGE) << risk;
  }
  EXPECT_EQ(refused_set("integrity_risk", "nan"), POSE_WALL_E_VALUE_TYPE);
  pose_wall_config config = test::config_with();
  EXPECT_EQ(refused(&config, [&] { return pose_wall_config_set_number(&config, "integrity_risk", std::nan("")); }),
            POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(refused_set("protection_factor", "5.0"), POSE_WALL_E_KEY_UNKNOWN);
}

struct BrokenRule {
  const char *key, *value, *other_key, *other_value;
};

TEST(Config, RulesOverTwoKeysNameBoth) {
  for (const BrokenRule& rule : {BrokenRule{"s_front", "-3", "s_back", "-2"},
                                 {"s_front", "1", "s_back", "1"},
                                 {"range_min", "5", "range_max", "4"},
                                 {"range_min", "5", "range_max", "5"},
                                 {"voxel_leaf", "0.25", "outlier_radius", "0.2"},
                                 {"ground_roi_radius", "20", "ground_roi_radius_max", "10"},
                                 {"ground_height_min", "4", "ground_height_max", "3"},
                                 {"wall_z_min", "2", "wall_z_max", "1"},
                                 {"wall_z_min", "1", "wall_z_max", "1.2"}}) {
    const pose_wall_config config = test::config_with({{rule.key, rule.value}, {rule.other_key, rule.other_value}});
    pose_wall_rule_fault fault{};
    EXPECT_EQ(pose_wall_config_check(&config, &fault), POSE_WALL_E_CONFIG_RULE) << rule.key;
    EXPECT_EQ(pose_wall_config_check(&config, nullptr), POSE_WALL_E_CONFIG_RULE) << rule.key;
    const std::set<std::string> named = {fault.key, fault.other_key};
    EXPECT_EQ(named, (std::set<std::string>{rule.key, rule.other_key}));
    EXPECT_NE(std::string(fault.rule).find(rule.key), std::string::npos);
  }
}

TEST(Config, TextsAndChoicesWrittenPastTheFunctionsAreCaught) {
  const pose_wall_config good = test::config_with();
  char text[2 * POSE_WALL_TEXT_MAX];
  for (const int member : {0, 1, 2}) {
    pose_wall_config config = good;
    std::memset(config.text[member], 'A', POSE_WALL_TEXT_MAX);
    pose_wall_rule_fault fault{};
    EXPECT_EQ(pose_wall_config_check(&config, &fault), POSE_WALL_E_CONFIG_RULE);
    EXPECT_STREQ(fault.rule, "text without an end");
    EXPECT_EQ(pose_wall_config_get_text(&config, fault.key, text, POSE_WALL_TEXT_MAX), POSE_WALL_E_BUFFER_SMALL);
    EXPECT_EQ(pose_wall_config_get_text(&config, fault.key, text, sizeof text), POSE_WALL_OK);
    EXPECT_EQ(std::string(text), std::string(POSE_WALL_TEXT_MAX, 'A')) << "and nothing of what lies behind";
  }
  for (const double no_choice : {std::nan(""), -1.0, 4.0, 1e300}) {
    pose_wall_config config = good;
    config.number[0] = no_choice;
    EXPECT_EQ(pose_wall_config_check(&config, nullptr), POSE_WALL_E_CONFIG_RULE);
    EXPECT_EQ(pose_wall_config_get_text(&config, "forward_axis", text, sizeof text), POSE_WALL_E_VALUE_TYPE)
        << no_choice;
  }
}

TEST(Config, SettingsAndAlertLimitsAreThoseSet) {
  const Settings s = read_settings(test::config_with({{"forward_axis", "-Y"},
                                                      {"wall_iterations", "123"},
                                                      {"body_box_3", "1 2 3 4 5 6"},
                                                      {"alert_limit_angle_deg", "2"},
                                                      {"alert_limit_distance", "0.3"}}));
  EXPECT_EQ(s.forward_axis, 3);
  EXPECT_EQ(s.wall_iterations, 123U);
  EXPECT_TRUE(s.body_box_3.contains(1.5, 3.5, 5.5));
  EXPECT_FALSE(s.body_box_3.contains(2.5, 3.5, 5.5));
  EXPECT_FALSE(s.body_box_1.holds_something());
  EXPECT_NEAR(alert_limit(POSE_WALL_YAW, s), 2.0 * M_PI / 180.0, 1e-15);
  EXPECT_EQ(alert_limit(POSE_WALL_D_LF, s), 0.3);
}

}  // namespace
}  // namespace pose_wall
