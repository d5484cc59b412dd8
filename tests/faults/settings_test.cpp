// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: of every key, what is below or above its range, no number, no word of it or too long is refused, by its text
// and by its number, and changes nothing; both ends of its range are taken and, by themselves, open an engine that
// keeps the contract; keys that contradict each other open none.

#include <cstdlib>
#include <limits>
#include <vector>

#include "fault_room.hpp"

namespace pose_wall::test {
namespace {

pose_wall_key_info key_of(std::uint32_t index) {
  pose_wall_key_info key;
  EXPECT_EQ(pose_wall_config_key(index, &key), POSE_WALL_OK);
  return key;
}

bool is_number(const pose_wall_key_info& key) {
  return key.type == POSE_WALL_KEY_NUMBER || key.type == POSE_WALL_KEY_INTEGER;
}

// The shortest that is this number, as a person writes it: the engine reads 15 digits exactly.
std::string text_of(double number) {
  char text[64];
  for (int digits = 1; digits <= 17 && (digits == 1 || std::strtod(text, nullptr) != number); ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, number);
  }
  return text;
}

void expect_refused(const char* key, const std::string& value, std::int32_t status) {
  pose_wall_config config = config_with(), before = config;
  EXPECT_EQ(pose_wall_config_set(&config, key, value.c_str()), status) << key << ": " << value;
  EXPECT_EQ(std::memcmp(&config, &before, sizeof config), 0) << key << ": " << value;
}

void expect_number_refused(const char* key, double value) {
  pose_wall_config config = config_with(), before = config;
  const std::int32_t status = pose_wall_config_set_number(&config, key, value);
  EXPECT_TRUE(status == POSE_WALL_E_VALUE_RANGE || status == POSE_WALL_E_VALUE_TYPE) << key << ": " << value;
  EXPECT_EQ(std::memcmp(&config, &before, sizeof config), 0) << key << ": " << value;
}

// Whether the config opens, and how it measures the room then. What another key contradicts is refused as a whole.
void expect_contract_with(const char* key, const std::string& value) {
  pose_wall_config config = small_config();
  ASSERT_EQ(pose_wall_config_set(&config, key, value.c_str()), POSE_WALL_OK) << key << ": " << value;
  if (pose_wall_config_check(&config, nullptr) != POSE_WALL_OK) return;
  FaultRoom room(config);
  for (std::uint32_t i = 0; i < 2; ++i) room.process(cloud_of(room_frame(i), i * kPeriod_ns));
}

std::vector<std::uint32_t> keys_of_numbers() {
  std::vector<std::uint32_t> keys;
  for (std::uint32_t i = 0; i < pose_wall_config_key_count(); ++i) {
    if (is_number(key_of(i))) keys.push_back(i);
  }
  return keys;
}

class Keys : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(Keys, RefuseWhatIsNoneOfTheirValues) {
  const pose_wall_key_info key = key_of(GetParam());
  if (key.type == POSE_WALL_KEY_TEXT) {
    expect_refused(key.name, std::string(POSE_WALL_TEXT_MAX, 'a'), POSE_WALL_E_TEXT_LONG);
    return;
  }
  if (key.type != POSE_WALL_KEY_BOX) expect_refused(key.name, "", POSE_WALL_E_VALUE_TYPE);
  for (const char* rubbish : {"x", "1 2", "0x1", "1e", "--1", "1,5", "true", "0.1m", "+X-X", "\xff\xfe", "[1"}) {
    expect_refused(key.name, rubbish, POSE_WALL_E_VALUE_TYPE);
  }
  for (const double no_number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()}) {
    if (is_number(key)) expect_number_refused(key.name, no_number);
  }
  for (const char* no_number : {"nan", "NaN", "inf", "-inf", "infinity"}) {
    expect_refused(key.name, no_number, POSE_WALL_E_VALUE_TYPE);
  }
  for (const char* beyond_all : {"1e999", "-1e999"}) {
    expect_refused(key.name, beyond_all, is_number(key) ? POSE_WALL_E_VALUE_RANGE : POSE_WALL_E_VALUE_TYPE);
  }
  if (key.type == POSE_WALL_KEY_INTEGER) {
    expect_refused(key.name, text_of(key.minimum + 0.5), POSE_WALL_E_VALUE_TYPE);
    expect_number_refused(key.name, key.minimum + 0.5);
  }
  if (key.type == POSE_WALL_KEY_BOX) expect_refused(key.name, "1 0 0 1 0 1", POSE_WALL_E_VALUE_RANGE);
}

// What a program wrote past the functions is found before anything is opened.
TEST(Members, HoldNumbersOrAreFound) {
  pose_wall_config config = config_with();
  int read = 0;
  for (double& member : config.number) {
    const double before = member;
    int refused = 0;
    for (const double none : {std::numeric_limits<double>::quiet_NaN(), 1e30, -1e30}) {
      member = none;
      pose_wall_rule_fault fault{};
      const std::int32_t status = pose_wall_config_check(&config, &fault);
      EXPECT_TRUE(status == POSE_WALL_OK || (status == POSE_WALL_E_CONFIG_RULE && fault.key != nullptr));
      refused += status == POSE_WALL_E_CONFIG_RULE ? 1 : 0;
    }
    EXPECT_TRUE(refused == 0 || refused == 3) << "a number that is no number is found, another is not";
    read += refused > 0 ? 1 : 0;
    member = before;
  }
  EXPECT_GE(read, static_cast<int>(keys_of_numbers().size())) << "the others are room for keys to come";
}

class NumberKeys : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(NumberKeys, KeepToTheirRange) {
  const pose_wall_key_info key = key_of(GetParam());
  const double step = key.type == POSE_WALL_KEY_INTEGER ? 1.0 : 1e-9 * (1.0 + std::fabs(key.maximum));
  for (const double end : {key.minimum, key.maximum}) {
    pose_wall_config config = config_with();
    double got = std::nan("");
    EXPECT_EQ(pose_wall_config_set_number(&config, key.name, end), POSE_WALL_OK) << key.name << ": " << end;
    EXPECT_EQ(pose_wall_config_get_number(&config, key.name, &got), POSE_WALL_OK) << key.name;
    EXPECT_EQ(got, end) << key.name;
  }
  for (const double outside : {key.minimum - step, key.maximum + step, -1e300, 1e300}) {
    expect_refused(key.name, text_of(outside), POSE_WALL_E_VALUE_RANGE);
    expect_number_refused(key.name, outside);
  }
  const bool is_room = std::strcmp(key.name, "points_max") == 0;  // the most is a matter of memory, not of measuring
  expect_contract_with(key.name, text_of(key.minimum));
  if (!is_room) expect_contract_with(key.name, text_of(key.maximum));
}

INSTANTIATE_TEST_SUITE_P(Faults, Keys, ::testing::Range(0U, pose_wall_config_key_count()),
                         [](const auto& test) { return std::string(key_of(test.param).name); });

INSTANTIATE_TEST_SUITE_P(Faults, NumberKeys, ::testing::ValuesIn(keys_of_numbers()),
                         [](const auto& test) { return std::string(key_of(test.param).name); });

}  // namespace
}  // namespace pose_wall::test
