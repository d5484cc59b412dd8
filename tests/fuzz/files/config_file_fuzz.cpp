// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a pose_wall.yaml. A config that is given has passed the rules; else all is told in one
// ConfigError.

#include <string>

#include "fuzz/files/memory_file.hpp"
#include "fuzz/fuzz_target.hpp"
#include "io/config_file/load_config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pose_wall::test::require;
  const pose_wall::test::MemoryFile file(data, size);
  try {
    const pose_wall::tools::LoadedConfig loaded = pose_wall::tools::load_config(file.path(), {});
    require(loaded.config.check() == POSE_WALL_OK, "a config that is given has passed");
    for (const auto& [key, origin] : loaded.origins) require(!key.empty() && !origin.empty(), "a key has an origin");
  } catch (const pose_wall::tools::ConfigError& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
