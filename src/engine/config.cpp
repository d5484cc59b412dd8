// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/config.hpp"

#include <cmath>
#include <cstring>

#include "base/estimation/protection.hpp"
#include "base/math/crc32.hpp"
#include "base/math/elementary.hpp"
#include "part/export.hpp"
#include "part/number_text.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kNumbersOfBox = 6;  // x, y and z, from and to

// A row of the table, with where pose_wall_config stores it.
struct Row {
  pose_wall_key_info info;
  std::uint32_t slot;  // first index into number[], or into text[]
  double default_value;
};

// How many slots of number[] and text[] each kind of row takes, counted while the table is laid out.
enum NumberSlot : std::uint32_t {
#define POSE_WALL_TEXT(name, group, text, help)
#define POSE_WALL_CHOICE(name, group, index, text, choices, help) kNumber_##name,
#define POSE_WALL_NUMBER(name, group, unit, value, text, minimum, maximum, help) kNumber_##name,
#define POSE_WALL_COUNT(name, group, unit, value, text, minimum, maximum, help) kNumber_##name,
#define POSE_WALL_BOX(name, group, unit, limit, help) \
  kNumber_##name, kNumberLast_##name = kNumber_##name + kNumbersOfBox - 1,
#include "engine/config_keys.def"
#undef POSE_WALL_TEXT
#undef POSE_WALL_CHOICE
#undef POSE_WALL_NUMBER
#undef POSE_WALL_COUNT
#undef POSE_WALL_BOX
  kNumbersUsed
};
enum TextSlot : std::uint32_t {
#define POSE_WALL_TEXT(name, group, text, help) kText_##name,
#define POSE_WALL_CHOICE(name, group, index, text, choices, help)
#define POSE_WALL_NUMBER(name, group, unit, value, text, minimum, maximum, help)
#define POSE_WALL_COUNT(name, group, unit, value, text, minimum, maximum, help)
#define POSE_WALL_BOX(name, group, unit, limit, help)
#include "engine/config_keys.def"
#undef POSE_WALL_TEXT
#undef POSE_WALL_CHOICE
#undef POSE_WALL_NUMBER
#undef POSE_WALL_COUNT
#undef POSE_WALL_BOX
  kTextsUsed
};
static_assert(kNumbersUsed <= POSE_WALL_CONFIG_NUMBERS, "raise POSE_WALL_CONFIG_NUMBERS");
static_assert(kTextsUsed <= POSE_WALL_CONFIG_TEXTS, "raise POSE_WALL_CONFIG_TEXTS");

constexpr Row kRows[] = {
#define POSE_WALL_TEXT(name, group, text, help) \
  {{#name, "", "", text, group, help, 0.0, 0.0, POSE_WALL_KEY_TEXT, 0}, kText_##name, 0.0},
#define POSE_WALL_CHOICE(name, group, index, text, choices, help) \
  {{#name, "", choices, text, group, help, 0.0, 0.0, POSE_WALL_KEY_CHOICE, 0}, kNumber_##name, index},
#define POSE_WALL_NUMBER(name, group, unit, value, text, minimum, maximum, help) \
  {{#name, unit, "", text, group, help, minimum, maximum, POSE_WALL_KEY_NUMBER, 0}, kNumber_##name, value},
#define POSE_WALL_COUNT(name, group, unit, value, text, minimum, maximum, help) \
  {{#name, unit, "", text, group, help, minimum, maximum, POSE_WALL_KEY_INTEGER, 0}, kNumber_##name, value},
#define POSE_WALL_BOX(name, group, unit, limit, help) \
  {{#name, unit, "", "", group, help, -(limit), limit, POSE_WALL_KEY_BOX, 0}, kNumber_##name, 0.0},
#include "engine/config_keys.def"
#undef POSE_WALL_TEXT
#undef POSE_WALL_CHOICE
#undef POSE_WALL_NUMBER
#undef POSE_WALL_COUNT
#undef POSE_WALL_BOX
};
constexpr std::uint32_t kRowCount = sizeof(kRows) / sizeof(kRows[0]);  // as many as the table has

// Separates a config of this table from one of another build.
constexpr std::uint32_t kLayout = 0x50570000U + kRowCount * 256U + kNumbersUsed;

bool is_initialised(const pose_wall_config& config) {
  return config.struct_size == sizeof(pose_wall_config) && config.layout == kLayout;
}

std::int32_t find_row(const pose_wall_config& config, const char* key, const Row** found) {
  if (!is_initialised(config)) return POSE_WALL_E_STRUCT_SIZE;
  for (const Row& row : kRows) {
    if (std::strcmp(row.info.name, key) != 0) continue;
    *found = &row;
    return POSE_WALL_OK;
  }
  return POSE_WALL_E_KEY_UNKNOWN;
}

// Length of the choice that starts at `choice`.
std::size_t choice_length(const char* choice) {
  const char* bar = std::strchr(choice, '|');
  return bar != nullptr ? static_cast<std::size_t>(bar - choice) : std::strlen(choice);
}

// The index-th of "a|b|c", nullptr behind the last.
const char* choice_at(const char* choices, std::uint32_t index) {
  for (; index > 0; --index) {
    const char* bar = std::strchr(choices, '|');
    if (bar == nullptr) return nullptr;
    choices = bar + 1;
  }
  return choices;
}

// The choice that a config holds, nullptr where it holds none.
const char* choice_held(const Row& row, const pose_wall_config& config) {
  const double index = config.number[row.slot];
  if (!(index >= 0.0 && index < POSE_WALL_CONFIG_NUMBERS)) return nullptr;
  return choice_at(row.info.choices, static_cast<std::uint32_t>(index));
}

// POSE_WALL_TEXT_MAX for one without its closing zero.
std::size_t text_length(const char (&text)[POSE_WALL_TEXT_MAX]) {
  std::size_t length = 0;
  while (length < POSE_WALL_TEXT_MAX && text[length] != '\0') ++length;
  return length;
}

bool in_range(const Row& row, double value) {
  return value >= row.info.minimum && value <= row.info.maximum;
}

std::int32_t set_number(pose_wall_config* config, const Row& row, double value) {
  if (!in_range(row, value)) return POSE_WALL_E_VALUE_RANGE;
  if (row.info.type == POSE_WALL_KEY_INTEGER &&
      value != static_cast<double>(static_cast<std::int64_t>(value))) {  // in range, so the cast is defined
    return POSE_WALL_E_VALUE_TYPE;
  }
  config->number[row.slot] = value;
  return POSE_WALL_OK;
}

std::int32_t set_choice(pose_wall_config* config, const Row& row, const char* value) {
  const std::size_t length = std::strlen(value);
  for (std::uint32_t index = 0;; ++index) {
    const char* choice = choice_at(row.info.choices, index);
    if (choice == nullptr) return POSE_WALL_E_VALUE_TYPE;
    if (choice_length(choice) == length && std::memcmp(choice, value, length) == 0) {
      config->number[row.slot] = index;
      return POSE_WALL_OK;
    }
  }
}

// Six numbers with spaces, one comma or both between them, in brackets or not; or nothing. Returns how many there were,
// more than six where it is anything else.
std::uint32_t read_box(const char* at, double (*numbers)[kNumbersOfBox]) {
  constexpr std::uint32_t kNoBox = kNumbersOfBox + 1;  // a number of numbers that no box has
  skip_spaces(&at);
  const bool bracket = *at == '[';
  if (bracket) ++at;
  std::uint32_t count = 0;
  for (skip_spaces(&at); count < kNumbersOfBox && read_number(&at, &(*numbers)[count]); ++count) {
    const char* const behind = at;
    skip_spaces(&at);
    if (count + 1 == kNumbersOfBox) continue;
    if (*at == ',') ++at;
    if (at == behind) return kNoBox;
    skip_spaces(&at);
  }
  if (bracket && *at++ != ']') return kNoBox;
  skip_spaces(&at);
  return *at == '\0' ? count : kNoBox;
}

std::int32_t set_box(pose_wall_config* config, const Row& row, const char* value) {
  double numbers[kNumbersOfBox] = {};
  const std::uint32_t count = read_box(value, &numbers);
  if (count != 0 && count != kNumbersOfBox) return POSE_WALL_E_VALUE_TYPE;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!in_range(row, numbers[i]) || (i % 2 == 1 && !(numbers[i - 1] < numbers[i]))) return POSE_WALL_E_VALUE_RANGE;
  }
  std::memcpy(&config->number[row.slot], numbers, sizeof(numbers));
  return POSE_WALL_OK;
}

std::int32_t set_text(pose_wall_config* config, const Row& row, const char* value) {
  const std::size_t length = std::strlen(value);
  if (length >= POSE_WALL_TEXT_MAX) return POSE_WALL_E_TEXT_LONG;
  std::memset(config->text[row.slot], 0, POSE_WALL_TEXT_MAX);
  std::memcpy(config->text[row.slot], value, length);
  return POSE_WALL_OK;
}

void set_default(pose_wall_config* config, const Row& row) {
  if (row.info.type == POSE_WALL_KEY_TEXT) {
    set_text(config, row, row.info.default_text);
  } else if (row.info.type != POSE_WALL_KEY_BOX) {
    config->number[row.slot] = row.default_value;
  }
}

bool is_one_number(const Row& row) {
  return row.info.type == POSE_WALL_KEY_NUMBER || row.info.type == POSE_WALL_KEY_INTEGER;
}

Box box_at(const pose_wall_config& config, std::uint32_t slot) {
  const double* n = &config.number[slot];
  return {n[0], n[1], n[2], n[3], n[4], n[5]};
}

// Every number and text again, for configs whose members were written past the functions.
bool all_in_range(const pose_wall_config& config, pose_wall_rule_fault* fault) {
  for (const Row& row : kRows) {
    const std::uint32_t count = row.info.type == POSE_WALL_KEY_BOX ? kNumbersOfBox : (is_one_number(row) ? 1U : 0U);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!in_range(row, config.number[row.slot + i])) {
        *fault = {row.info.name, "", "value outside the key's range"};
        return false;
      }
    }
    if (row.info.type == POSE_WALL_KEY_CHOICE && choice_held(row, config) == nullptr) {
      *fault = {row.info.name, "", "not one of the key's choices"};
      return false;
    }
    if (row.info.type == POSE_WALL_KEY_TEXT && text_length(config.text[row.slot]) == POSE_WALL_TEXT_MAX) {
      *fault = {row.info.name, "", "text without an end"};
      return false;
    }
  }
  return true;
}

void add_text(const char* text, Crc32* sum) {
  for (; *text != '\0'; ++text) sum->add_byte(static_cast<std::uint8_t>(*text));
  sum->add_byte(0);
}

}  // namespace

Settings read_settings(const pose_wall_config& config) {
  Settings s{};
#define POSE_WALL_TEXT(name, group, text, help)
#define POSE_WALL_CHOICE(name, group, index, text, choices, help) \
  s.name = static_cast<std::int32_t>(config.number[kNumber_##name]);
#define POSE_WALL_NUMBER(name, group, unit, value, text, minimum, maximum, help) s.name = config.number[kNumber_##name];
#define POSE_WALL_COUNT(name, group, unit, value, text, minimum, maximum, help) \
  s.name = static_cast<std::uint32_t>(config.number[kNumber_##name]);
#define POSE_WALL_BOX(name, group, unit, limit, help) s.name = box_at(config, kNumber_##name);
#include "engine/config_keys.def"
#undef POSE_WALL_TEXT
#undef POSE_WALL_CHOICE
#undef POSE_WALL_NUMBER
#undef POSE_WALL_COUNT
#undef POSE_WALL_BOX
  s.protection_sigmas = sigmas_at_risk(s.integrity_risk);
  return s;
}

double reach_of(const Settings& s) {
  constexpr double kRounding_m = 0.01;  // more than floats of a ray of range_max round by
  return s.range_max + kRounding_m +
         std::sqrt(s.extrinsic_x * s.extrinsic_x + s.extrinsic_y * s.extrinsic_y + s.extrinsic_z * s.extrinsic_z);
}

std::uint64_t work_most(const Settings& settings, std::uint64_t returns, std::uint64_t voxels) {
  // Measured on furnished roads, a mine's gallery and bent scans (bench/README.md, "The budget"): the dearest took
  // two thirds of it. One part for the fits of any cloud, one for a return while it is read, and one for a voxel,
  // since hypotheses are weighed over voxels. Lost returns make a cloud smaller, and hardly change its voxels.
  constexpr std::uint64_t kWhatever = 5'000'000, kPerReturn = 20, kPerVoxel = 270;
  return settings.work_max > 0 ? settings.work_max : kWhatever + kPerReturn * returns + kPerVoxel * voxels;
}

double alert_limit(std::uint32_t quantity, const Settings& settings) {
  return quantity <= POSE_WALL_YAW ? radians(settings.alert_limit_angle_deg) : settings.alert_limit_distance;
}

extern "C" {

POSE_WALL_EXPORT int32_t pose_wall_config_check(const pose_wall_config* config, pose_wall_rule_fault* fault) {
  if (config == nullptr) return POSE_WALL_E_NULL;
  pose_wall_rule_fault unused;
  pose_wall_rule_fault* out = fault != nullptr ? fault : &unused;
  if (!is_initialised(*config)) return POSE_WALL_E_STRUCT_SIZE;
  if (!all_in_range(*config, out)) return POSE_WALL_E_CONFIG_RULE;
  const Settings s = read_settings(*config);
  struct Rule {
    bool holds;
    pose_wall_rule_fault fault;
  };
  const Rule rules[] = {
      {s.s_front > s.s_back, {"s_front", "s_back", "s_front must be greater than s_back"}},
      {s.range_min < s.range_max, {"range_min", "range_max", "range_min must be smaller than range_max"}},
      {s.voxel_leaf <= s.outlier_radius,
       {"voxel_leaf", "outlier_radius", "outlier_radius must be at least voxel_leaf, or every voxel is an outlier"}},
      {s.ground_roi_radius <= s.ground_roi_radius_max,
       {"ground_roi_radius", "ground_roi_radius_max", "ground_roi_radius must not exceed ground_roi_radius_max"}},
      {s.floor_region_max - s.floor_region_min >= 1.0,
       {"floor_region_min", "floor_region_max", "the floor's region must be at least 1 m long"}},
      {s.ground_height_min < s.ground_height_max,
       {"ground_height_min", "ground_height_max", "ground_height_min must be smaller than ground_height_max"}},
      {s.wall_z_min < s.wall_z_max, {"wall_z_min", "wall_z_max", "wall_z_min must be smaller than wall_z_max"}},
      {s.wall_z_max - s.wall_z_min >= 0.3,
       {"wall_z_min", "wall_z_max", "the wall band from wall_z_min to wall_z_max must be at least 0.3 m high"}},
  };
  for (const Rule& rule : rules) {
    if (!rule.holds) {
      *out = rule.fault;
      return POSE_WALL_E_CONFIG_RULE;
    }
  }
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_config_crc(const pose_wall_config* config, uint32_t* crc) {
  if (config == nullptr || crc == nullptr) return POSE_WALL_E_NULL;
  if (!is_initialised(*config)) return POSE_WALL_E_STRUCT_SIZE;
  Crc32 sum;
  sum.add_word(config->layout);
  // The names and units of the numbers: a build that names, orders or measures them otherwise has other settings.
  for (const Row& row : kRows) {
    add_text(row.info.name, &sum);
    add_text(row.info.unit, &sum);
  }
  for (const double number : config->number) {
    const double one_zero = number + 0.0;  // -0 and 0 are the same setting
    std::uint64_t bits;
    std::memcpy(&bits, &one_zero, sizeof(bits));
    sum.add_word(static_cast<std::uint32_t>(bits & 0xFFFFFFFFU));
    sum.add_word(static_cast<std::uint32_t>(bits >> 32U));
  }
  for (const auto& text : config->text) {
    for (const char c : text) sum.add_byte(static_cast<std::uint8_t>(c));
  }
  *crc = sum.value();
  return POSE_WALL_OK;
}

#undef pose_wall_config_init
POSE_WALL_EXPORT int32_t pose_wall_config_init(pose_wall_config* /*config*/) {
  return POSE_WALL_E_ABI;
}

POSE_WALL_EXPORT int32_t pose_wall_config_init_2(pose_wall_config* config) {
  if (config == nullptr) return POSE_WALL_E_NULL;
  std::memset(config, 0, sizeof(*config));
  config->struct_size = sizeof(*config);
  config->layout = kLayout;
  for (const Row& row : kRows) set_default(config, row);
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_config_set(pose_wall_config* config, const char* key, const char* value) {
  if (config == nullptr || key == nullptr || value == nullptr) return POSE_WALL_E_NULL;
  const Row* row = nullptr;
  const std::int32_t status = find_row(*config, key, &row);
  if (status != POSE_WALL_OK) return status;
  switch (row->info.type) {
    case POSE_WALL_KEY_TEXT:
      return set_text(config, *row, value);
    case POSE_WALL_KEY_CHOICE:
      return set_choice(config, *row, value);
    case POSE_WALL_KEY_BOX:
      return set_box(config, *row, value);
    default: {
      double number = 0.0;
      return whole_number_text(value, &number) ? set_number(config, *row, number) : POSE_WALL_E_VALUE_TYPE;
    }
  }
}

POSE_WALL_EXPORT int32_t pose_wall_config_set_number(pose_wall_config* config, const char* key, double value) {
  if (config == nullptr || key == nullptr) return POSE_WALL_E_NULL;
  const Row* row = nullptr;
  const std::int32_t status = find_row(*config, key, &row);
  if (status != POSE_WALL_OK) return status;
  return is_one_number(*row) ? set_number(config, *row, value) : POSE_WALL_E_VALUE_TYPE;
}

POSE_WALL_EXPORT int32_t pose_wall_config_get_number(const pose_wall_config* config, const char* key, double* value) {
  if (config == nullptr || key == nullptr || value == nullptr) return POSE_WALL_E_NULL;
  const Row* row = nullptr;
  const std::int32_t status = find_row(*config, key, &row);
  if (status != POSE_WALL_OK) return status;
  if (!is_one_number(*row)) return POSE_WALL_E_VALUE_TYPE;
  *value = config->number[row->slot];
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_config_get_box(const pose_wall_config* config, const char* key, double value[6]) {
  if (config == nullptr || key == nullptr || value == nullptr) return POSE_WALL_E_NULL;
  const Row* row = nullptr;
  const std::int32_t status = find_row(*config, key, &row);
  if (status != POSE_WALL_OK) return status;
  if (row->info.type != POSE_WALL_KEY_BOX) return POSE_WALL_E_VALUE_TYPE;
  std::memcpy(value, &config->number[row->slot], kNumbersOfBox * sizeof(double));
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT int32_t pose_wall_config_get_text(const pose_wall_config* config, const char* key, char* buffer,
                                                   uint64_t bytes) {
  if (config == nullptr || key == nullptr || buffer == nullptr) return POSE_WALL_E_NULL;
  const Row* row = nullptr;
  const std::int32_t status = find_row(*config, key, &row);
  if (status != POSE_WALL_OK) return status;
  const char* text = nullptr;
  std::size_t length = 0;
  if (row->info.type == POSE_WALL_KEY_TEXT) {
    text = config->text[row->slot];
    length = text_length(config->text[row->slot]);
  } else if (row->info.type == POSE_WALL_KEY_CHOICE) {
    text = choice_held(*row, *config);
    if (text != nullptr) length = choice_length(text);
  }
  if (text == nullptr) return POSE_WALL_E_VALUE_TYPE;
  if (length + 1 > bytes) return POSE_WALL_E_BUFFER_SMALL;
  std::memcpy(buffer, text, length);
  buffer[length] = '\0';
  return POSE_WALL_OK;
}

POSE_WALL_EXPORT uint32_t pose_wall_config_key_count(void) {
  return kRowCount;
}

POSE_WALL_EXPORT int32_t pose_wall_config_key(uint32_t index, pose_wall_key_info* info) {
  if (info == nullptr) return POSE_WALL_E_NULL;
  if (index >= kRowCount) return POSE_WALL_E_INDEX;
  *info = kRows[index].info;
  return POSE_WALL_OK;
}

}  // extern "C"

}  // namespace pose_wall
