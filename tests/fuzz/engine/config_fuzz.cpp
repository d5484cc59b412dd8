// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: the config. Arbitrary texts and numbers for its keys, unknown keys, and bytes written past the
// functions, as a black box of others may hold them. What is refused leaves the config as it was; what passes the check
// asks for a bounded block, and where that is small, opens and takes a frame.

#include <cmath>

#include <initializer_list>

#include "fuzz/fuzz_target.hpp"
#include "fuzz/road_from_input.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

// No config that passes its check may ask for more than kBlockMax. Those up to kBlockToOpen also take a frame: larger
// blocks cost the fuzzer its rounds.
constexpr std::uint64_t kBlockMax = 256ULL << 20U, kBlockToOpen = 2ULL << 20U;

// The next word of the input, as a text of at most that many bytes; ends at a zero or line end.
template <std::size_t bytes>
void take_text(Input* input, char (&text)[bytes]) {
  std::memset(text, 0, bytes);
  for (std::size_t i = 0; i + 1 < bytes && !input->empty(); ++i) {
    const char c = static_cast<char>(input->byte());
    if (c == '\0' || c == '\n') return;
    text[i] = c;
  }
}

void set_text(Input* input, pose_wall_config* config) {
  pose_wall_key_info key;
  const std::uint32_t rows = pose_wall_config_key_count();
  char name[48], value[256];
  const std::uint32_t row = input->byte() % (rows + 1);
  const bool known = pose_wall_config_key(row, &key) == POSE_WALL_OK;
  require(known == (row < rows), "a row is there iff it is counted");
  if (!known) take_text(input, name);
  take_text(input, value);
  const pose_wall_config before = *config;
  const std::int32_t status = pose_wall_config_set(config, known ? key.name : name, value);
  if (status != POSE_WALL_OK) require(std::memcmp(&before, config, sizeof before) == 0, "refused, and changed");
  double number = 0.0;
  if (known && status == POSE_WALL_OK && key.type <= POSE_WALL_KEY_INTEGER) {
    require_ok(pose_wall_config_get_number(config, key.name, &number), "get");
    require(number >= key.minimum && number <= key.maximum, "within its range");
  }
  char text[POSE_WALL_TEXT_MAX];
  if (known && status == POSE_WALL_OK && key.type >= POSE_WALL_KEY_CHOICE && key.type <= POSE_WALL_KEY_TEXT) {
    require_ok(pose_wall_config_get_text(config, key.name, text, sizeof text), "get text");
    require(std::strcmp(text, value) == 0, "the text that was set");
  }
}

void set_number(Input* input, pose_wall_config* config) {
  pose_wall_key_info key;
  require_ok(pose_wall_config_key(input->byte() % pose_wall_config_key_count(), &key), "key");
  const auto value = input->take<double>();
  const pose_wall_config before = *config;
  if (pose_wall_config_set_number(config, key.name, value) == POSE_WALL_OK) {
    require(value >= key.minimum && value <= key.maximum, "within its range");
  } else {
    require(std::memcmp(&before, config, sizeof before) == 0, "refused, and changed");
  }
}

void write_past(Input* input, pose_wall_config* config) {
  const std::size_t at = input->take<std::uint16_t>() % (sizeof *config / 8) * 8;
  const auto word = input->take<std::uint64_t>();
  std::memcpy(reinterpret_cast<unsigned char*>(config) + at, &word, sizeof word);
}

void take_a_frame(const pose_wall_config& config) {
  static KeptBlock block;
  static const std::uint32_t points = scan_road(plain_road(), 0) / 4;
  pose_wall_engine* const engine = open_engine(config, &block, 0xA5);
  pose_wall_cloud cloud;
  require_ok(pose_wall_cloud_xyz32(&cloud, road_points(), points, 12, 0), "xyz32");
  pose_wall_result result = empty_result();
  require_ok(pose_wall_process(engine, &cloud, &result), "process");
}

void read_texts(const pose_wall_config& config) {
  char text[POSE_WALL_TEXT_MAX];
  for (const char* key : {"pointcloud_topic", "lidar_frame", "base_frame", "forward_axis"}) {
    pose_wall_config_get_text(&config, key, text, sizeof text);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pose_wall_config config;
  require_ok(pose_wall_config_init(&config), "init");
  require_ok(pose_wall_config_set(&config, "points_max", "5000"), "points_max");
  Input input(data, size);
  for (int i = 0; i < 16 && !input.empty(); ++i) {
    const std::uint32_t how = input.below(8);
    if (how < 4) {
      set_text(&input, &config);
    } else if (how < 6) {
      set_number(&input, &config);
    } else {
      write_past(&input, &config);
    }
  }
  read_texts(config);
  pose_wall_rule_fault fault{};
  std::uint64_t bytes = 0;
  const std::int32_t checked = pose_wall_config_check(&config, &fault);
  require(pose_wall_memory_needed(&config, &bytes) == checked, "one check for all");
  std::uint32_t crc = 0;
  const std::int32_t summed = pose_wall_config_crc(&config, &crc);
  require(summed == POSE_WALL_OK || checked != POSE_WALL_OK, "what passes has a CRC");
  if (checked == POSE_WALL_E_CONFIG_RULE) require(fault.key != nullptr && fault.rule != nullptr, "a fault is named");
  if (checked != POSE_WALL_OK) return 0;
  require(bytes > 0 && bytes <= kBlockMax, "a bounded block");
  if (bytes <= kBlockToOpen) take_a_frame(config);
  return 0;
}
