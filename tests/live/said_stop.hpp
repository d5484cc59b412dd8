// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// An obstacle stop beside the daemon's, for what hands its answers on.

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <mutex>

#include "apps/live/planar/planar_news.hpp"
#include "study/planar/part_block.hpp"

namespace pose_wall::test {

// A stop that says what it is told to.
class SaidStop final : public tools::live::StopBoard {
 public:
  tools::live::StopNews stop_now() const override {
    const std::lock_guard<std::mutex> locked(lock_);
    return news_;
  }
  void say(const tools::live::StopNews& news) {
    const std::lock_guard<std::mutex> locked(lock_);
    news_ = news;
  }

 private:
  mutable std::mutex lock_;
  tools::live::StopNews news_;
};

// The answer of a stop that was opened, made to say something else.
inline tools::live::StopNews opened_news() {
  pose_wall_config config;
  EXPECT_EQ(pose_wall_config_init(&config), POSE_WALL_OK);
  std::uint64_t bytes = 0;
  EXPECT_EQ(pose_wall_planar_stop_memory_needed(&bytes), POSE_WALL_OK);
  const tools::PartBlock block(bytes);
  pose_wall_planar_stop* stop = nullptr;
  EXPECT_EQ(pose_wall_planar_stop_open(&config, nullptr, block.data(), block.bytes(), &stop), POSE_WALL_OK);
  tools::live::StopNews news;
  news.result.struct_size = sizeof news.result;
  EXPECT_EQ(pose_wall_planar_stop_tick(stop, 1'234'999'999, &news.result), POSE_WALL_OK);
  return news;
}

}  // namespace pose_wall::test
