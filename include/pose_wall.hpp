// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The C ABI of pose_wall.h for C++17 callers. It owns the engine's block of memory and initialises structs; it makes no
// decisions. Every call returns the status of the C call beneath it. Nothing here throws except std::bad_alloc from
// Engine::open. The manual of all numbers is pose_wall.h.
//
//     pose_wall::api::Config config;
//     if (config.set("forward_axis", "+X") != POSE_WALL_OK) ...
//     pose_wall::api::Engine engine;
//     if (engine.open(config) != POSE_WALL_OK) ...
//     pose_wall_result result = pose_wall::api::make_result();
//     engine.process(cloud, result);

#ifndef POSE_WALL_HPP
#define POSE_WALL_HPP

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::api {

class Config {
 public:
  Config() noexcept { pose_wall_config_init(&config_); }

  int32_t set(const char* key, const char* value) noexcept { return pose_wall_config_set(&config_, key, value); }
  int32_t set(const char* key, double value) noexcept { return pose_wall_config_set_number(&config_, key, value); }
  int32_t check(pose_wall_rule_fault* fault = nullptr) const noexcept {
    return pose_wall_config_check(&config_, fault);
  }

  // NaN for a key that is not one number.
  double number(const char* key) const noexcept {
    double value = std::numeric_limits<double>::quiet_NaN();
    pose_wall_config_get_number(&config_, key, &value);
    return value;
  }

  const pose_wall_config* get() const noexcept { return &config_; }
  pose_wall_config* get() noexcept { return &config_; }

 private:
  pose_wall_config config_;
};

inline pose_wall_result make_result() noexcept {
  pose_wall_result result{};
  result.struct_size = sizeof result;
  return result;
}

inline pose_wall_image make_image() noexcept {
  pose_wall_image image{};
  image.struct_size = sizeof image;
  return image;
}

inline pose_wall_image2 make_image2() noexcept {
  pose_wall_image2 image{};
  image.struct_size = sizeof image;
  return image;
}

// Owns the block that the engine lives in. Moving keeps the block where it is; a moved-from engine is not open.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  Engine(Engine&& other) noexcept : block_(std::move(other.block_)), engine_(std::exchange(other.engine_, nullptr)) {}
  Engine& operator=(Engine&& other) noexcept {
    block_ = std::move(other.block_);
    engine_ = std::exchange(other.engine_, nullptr);
    return *this;
  }
  ~Engine() = default;

  // The only call that allocates. An engine that was open is closed first.
  int32_t open(const Config& config) {
    engine_ = nullptr;
    uint64_t bytes = 0;
    const int32_t status = pose_wall_memory_needed(config.get(), &bytes);
    if (status != POSE_WALL_OK) return status;
    block_.resize(static_cast<std::size_t>((bytes + sizeof(Line) - 1) / sizeof(Line)));
    return pose_wall_open(config.get(), block_.data(), block_.size() * sizeof(Line), &engine_);
  }

  int32_t process(const pose_wall_cloud& cloud, pose_wall_result& result) noexcept {
    return pose_wall_process(engine_, &cloud, &result);
  }
  int32_t age(int64_t stamp_ns, pose_wall_result& result) noexcept { return pose_wall_age(engine_, stamp_ns, &result); }
  // The image of a result, whichever engine gave it.
  static int32_t fill_image(const pose_wall_result& result, pose_wall_image& image) noexcept {
    return pose_wall_image_fill(&result, &image);
  }
  static int32_t fill_image(const pose_wall_result& result, pose_wall_image2& image,
                            const pose_wall_image_source* source = nullptr) noexcept {
    return pose_wall_image2_fill(&result, source, &image);
  }
  int32_t reset() noexcept { return pose_wall_reset(engine_); }
  int32_t set_clock(pose_wall_clock clock, void* user = nullptr) noexcept {
    return pose_wall_set_clock(engine_, clock, user);
  }
  int32_t last_points(pose_wall_points& points) const noexcept { return pose_wall_last_points(engine_, &points); }

  bool is_open() const noexcept { return engine_ != nullptr; }
  std::size_t block_bytes() const noexcept { return block_.size() * sizeof(Line); }
  pose_wall_engine* get() noexcept { return engine_; }

 private:
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  std::vector<Line> block_;
  pose_wall_engine* engine_ = nullptr;
};

}  // namespace pose_wall::api

#endif  // POSE_WALL_HPP
