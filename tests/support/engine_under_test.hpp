// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// An engine on a block of its own, through the C ABI alone.

#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>

#include "pose_wall.h"
#include "support/aligned_block.hpp"

namespace pose_wall::test {

using KeyValue = std::pair<const char*, const char*>;

inline void set(pose_wall_config* config, const char* key, const char* value) {
  const std::int32_t status = pose_wall_config_set(config, key, value);
  if (status != POSE_WALL_OK) {
    throw std::runtime_error(std::string(key) + ": " + value + ": " + pose_wall_status_text(status));
  }
}

inline void set(pose_wall_config* config, const char* key, double value) {
  const std::int32_t status = pose_wall_config_set_number(config, key, value);
  if (status != POSE_WALL_OK) throw std::runtime_error(std::string(key) + ": " + pose_wall_status_text(status));
}

inline pose_wall_config config_with(std::initializer_list<KeyValue> values = {}) {
  pose_wall_config config;
  pose_wall_config_init(&config);
  for (const auto& [key, value] : values) set(&config, key, value);
  return config;
}

// For sensors of few rings; see config/vlp16.yaml, of which this is what matters to the engine.
inline pose_wall_config sparse_config() {
  return config_with({{"outlier_radius", "0.40"},
                      {"outlier_min_neighbors", "2"},
                      {"ground_inlier_min", "150"},
                      {"wall_inlier_min", "250"}});
}

class EngineUnderTest {
 public:
  explicit EngineUnderTest(const pose_wall_config& config, Dirt dirt = Dirt::kRandom) : block_(needed(config), dirt) {
    const std::int32_t status = pose_wall_open(&config, block_.data(), block_.size(), &engine_);
    if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
  }

  pose_wall_result process(const pose_wall_cloud& cloud) {
    pose_wall_result result{};
    result.struct_size = sizeof result;
    const std::int32_t status = pose_wall_process(engine_, &cloud, &result);
    if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
    return result;
  }

  pose_wall_engine* get() { return engine_; }
  AlignedBlock& block() { return block_; }

 private:
  static std::uint64_t needed(const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    const std::int32_t status = pose_wall_memory_needed(&config, &bytes);
    if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
    return bytes;
  }

  AlignedBlock block_;
  pose_wall_engine* engine_ = nullptr;
};

}  // namespace pose_wall::test
