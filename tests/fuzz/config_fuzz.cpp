// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// libFuzzer target: arbitrary values for every key of the config. The first byte chooses the key. What is accepted must
// leave a config that is checked, and one that passes the check must open.

#include <cstdint>
#include <cstring>
#include <string>

#include "pose_wall.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  pose_wall_key_info key;
  if (pose_wall_config_key(data[0] % pose_wall_config_key_count(), &key) != POSE_WALL_OK) __builtin_trap();
  const std::string value(reinterpret_cast<const char*>(data) + 1, size - 1);
  pose_wall_config config, before;
  pose_wall_config_init(&config);
  std::memcpy(&before, &config, sizeof config);
  const std::int32_t status = pose_wall_config_set(&config, key.name, value.c_str());
  if (status != POSE_WALL_OK && std::memcmp(&before, &config, sizeof config) != 0) __builtin_trap();
  std::uint64_t bytes = 0;
  const std::int32_t checked = pose_wall_config_check(&config, nullptr);
  if (pose_wall_memory_needed(&config, &bytes) != checked) __builtin_trap();
  if (checked == POSE_WALL_OK && bytes == 0) __builtin_trap();
  return 0;
}
