// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the stop's image holds an answer's numbers, and no more speed than the answer allows. What is no permission
// becomes a stop. Damage to any one or two bits is found. The settings' CRC changes with each setting that decides, and
// with the config, and with nothing else. An old result keeps its heartbeat. Refused calls change nothing.
// Does not prove: what a controller does with it, tests/checks/plc_stop_test.py.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "planar/bytes_needed.hpp"
#include "pose_wall_planar_stop.h"
#include "support/aligned_block.hpp"

namespace pose_wall::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kStop = POSE_WALL_PLANAR_STOP_STOP, kSlow = POSE_WALL_PLANAR_STOP_SLOW,
                        kGo = POSE_WALL_PLANAR_STOP_GO;

pose_wall_config default_config() {
  pose_wall_config config;
  EXPECT_EQ(pose_wall_config_init(&config), POSE_WALL_OK);
  return config;
}

pose_wall_planar_stop_settings default_settings() {
  pose_wall_planar_stop_settings settings;
  EXPECT_EQ(pose_wall_planar_stop_settings_init(&settings), POSE_WALL_OK);
  return settings;
}

std::uint32_t crc_of(const pose_wall_config& config, const pose_wall_planar_stop_settings* settings) {
  std::uint32_t crc = 0;
  EXPECT_EQ(pose_wall_planar_stop_settings_crc(&config, settings, &crc), POSE_WALL_OK);
  return crc;
}

// A stop that has seen nothing yet.
class OpenedStop {
 public:
  OpenedStop() : block_(pose_wall::test::stop_bytes_needed(), Dirt::kRandom) {
    const pose_wall_config config = default_config();
    EXPECT_EQ(pose_wall_planar_stop_open(&config, nullptr, block_.data(), block_.size(), &stop_), POSE_WALL_OK);
  }
  pose_wall_planar_stop_result tick(std::int64_t now_ns) {
    pose_wall_planar_stop_result result{};
    result.struct_size = sizeof result;
    EXPECT_EQ(pose_wall_planar_stop_tick(stop_, now_ns, &result), POSE_WALL_OK);
    return result;
  }
  pose_wall_planar_stop* get() { return stop_; }

 private:
  AlignedBlock block_;
  pose_wall_planar_stop* stop_ = nullptr;
};

// An answer that permits driving, as of a frame of 123.4 ms before.
pose_wall_planar_stop_result permission(std::uint32_t state = kGo, double speed_m_s = 0.4567) {
  pose_wall_planar_stop_result result = OpenedStop().tick(1'000'123'456'789);
  result.state = state;
  result.allowed_speed_m_s = speed_m_s;
  result.reasons = POSE_WALL_PLANAR_STOP_R_THING | POSE_WALL_PLANAR_STOP_R_RESTART;
  result.heartbeat = 0xFFFFFFFFU;
  result.frames = 1;
  result.stamp_ns = result.now_ns - 123'400'000;
  return result;
}

pose_wall_planar_stop_image image_of(const pose_wall_planar_stop_result& result) {
  pose_wall_planar_stop_image image;
  std::memset(&image, 0x5A, sizeof image);
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_planar_stop_image_fill(&result, &image), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_planar_stop_image_check(&image), POSE_WALL_OK);
  return image;
}

TEST(StopImage, HoldsTheAnswer) {
  const pose_wall_planar_stop_result result = permission();
  const pose_wall_planar_stop_image image = image_of(result);
  EXPECT_EQ(image.struct_size, std::uint32_t{POSE_WALL_PLANAR_STOP_IMAGE_BYTES});
  EXPECT_EQ(image.version, std::uint32_t{POSE_WALL_PLANAR_STOP_IMAGE_VERSION});
  EXPECT_EQ(image.heartbeat, 0xFFFFFFFFU);
  EXPECT_EQ(image.settings_crc32, crc_of(default_config(), nullptr));
  EXPECT_EQ(image.library_version >> 16U, std::uint32_t{POSE_WALL_VERSION_MAJOR});
  const auto stamp = static_cast<std::uint64_t>(result.stamp_ns);
  EXPECT_EQ(image.stamp_low, static_cast<std::uint32_t>(stamp));
  EXPECT_EQ(image.stamp_high, static_cast<std::uint32_t>(stamp >> 32U));
  EXPECT_EQ(image.state, kGo);
  EXPECT_EQ(image.allowed_speed_mm_s, 456) << "rounded down";
  EXPECT_EQ(image.reasons, result.reasons);
  EXPECT_EQ(image.age_ms, 124U) << "rounded up";
  EXPECT_EQ(image.answered_ms, 1'000'123U);
  EXPECT_EQ(image_of(permission(kSlow)).state, kSlow);
}

TEST(StopImage, WhatIsNoPermissionIsAStop) {
  for (const auto& [state, speed_m_s] : {std::pair(kStop, 0.5),
                                         {3U, 0.5},
                                         {0xFFFFFFFFU, 0.5},
                                         {kGo, 0.0},
                                         {kGo, 0.0009},
                                         {kSlow, -1.0},
                                         {kGo, kNaN},
                                         {kGo, std::numeric_limits<double>::infinity()},
                                         {kSlow, -std::numeric_limits<double>::infinity()}}) {
    const pose_wall_planar_stop_image image = image_of(permission(state, speed_m_s));
    EXPECT_EQ(image.state, kStop) << state << " " << speed_m_s;
    EXPECT_EQ(image.allowed_speed_mm_s, 0) << state << " " << speed_m_s;
  }
  EXPECT_EQ(image_of(permission(kGo, 1e12)).allowed_speed_mm_s, INT32_MAX);
}

TEST(StopImage, AgesAndClocksAtTheirEnds) {
  pose_wall_planar_stop_result result = permission();
  result.frames = 0;
  EXPECT_EQ(image_of(result).age_ms, 0xFFFFFFFFU) << "no frame yet";
  result.frames = 1;
  for (const auto& [stamp_ns, now_ns, age_ms] : {std::tuple(std::int64_t{5}, std::int64_t{5}, 0U),
                                                 {5'000'000, 1, 0U},
                                                 {1, 2, 1U},
                                                 {INT64_MIN, INT64_MAX, 0xFFFFFFFFU},
                                                 {INT64_MAX, INT64_MIN, 0U},
                                                 {0, 4'294'967'294'000'000, 4294967294U},
                                                 {0, 4'294'967'295'000'000, 0xFFFFFFFFU}}) {
    result.stamp_ns = stamp_ns, result.now_ns = now_ns;
    EXPECT_EQ(image_of(result).age_ms, age_ms) << stamp_ns << " " << now_ns;
  }
  result.now_ns = -1;
  EXPECT_EQ(image_of(result).answered_ms, 0xFFFFFFFFU);
  result.now_ns = 999'999;
  EXPECT_EQ(image_of(result).answered_ms, 0U);
  result.now_ns = 4'294'967'296'000'000;
  EXPECT_EQ(image_of(result).answered_ms, 0U);
}

TEST(StopImage, EachCallIsOneBeatAndAnOldResultKeepsItsOwn) {
  OpenedStop stop;
  const pose_wall_planar_stop_result first = stop.tick(0), second = stop.tick(20'000'000);
  EXPECT_EQ(image_of(second).heartbeat, image_of(first).heartbeat + 1);
  EXPECT_EQ(image_of(first).heartbeat, first.heartbeat);
  EXPECT_EQ(image_of(first).age_ms, 0xFFFFFFFFU);
  EXPECT_EQ(pose_wall_planar_stop_reset(stop.get()), POSE_WALL_OK);
  EXPECT_EQ(stop.tick(40'000'000).heartbeat, second.heartbeat + 1) << "a reset is no restart";
}

TEST(StopImage, OneOrTwoFlippedBitsAreFound) {
  const pose_wall_planar_stop_image good = image_of(permission());
  constexpr std::size_t kBits = 8 * sizeof(good);
  const auto flip = [](std::size_t bit, pose_wall_planar_stop_image* image) {
    reinterpret_cast<unsigned char*>(image)[bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
  };
  std::size_t missed = 0;
  for (std::size_t first = 0; first < kBits; ++first) {
    for (std::size_t second = first; second < kBits; ++second) {
      pose_wall_planar_stop_image image = good;
      flip(first, &image);
      if (second != first) flip(second, &image);
      missed += pose_wall_planar_stop_image_check(&image) == POSE_WALL_OK ? 1U : 0U;
    }
  }
  EXPECT_EQ(missed, 0U);
}

TEST(StopImage, TheSettingsCrcIsThatOfAllThatDecides) {
  const pose_wall_config config = default_config();
  const pose_wall_planar_stop_settings settings = default_settings();
  const std::uint32_t crc = crc_of(config, &settings);
  EXPECT_EQ(crc, crc_of(config, nullptr));
  // Every number of the settings, as it lies there; corners beyond those in use decide nothing.
  const std::size_t used = 8 + 16 * std::size_t{settings.corners};
  const std::size_t numbers = 8 + 16 * std::size_t{POSE_WALL_PLANAR_STOP_CORNERS_MAX};
  for (std::size_t at = 8; at < sizeof settings; at += sizeof(double)) {
    pose_wall_planar_stop_settings other = settings;
    double number;
    std::memcpy(&number, reinterpret_cast<const char*>(&settings) + at, sizeof number);
    number += 0.001;
    std::memcpy(reinterpret_cast<char*>(&other) + at, &number, sizeof number);
    EXPECT_EQ(crc_of(config, &other) == crc, at >= used && at < numbers) << at;
  }
  pose_wall_planar_stop_settings fewer = settings;
  --fewer.corners;
  EXPECT_NE(crc_of(config, &fewer), crc);
  pose_wall_planar_stop_settings zero = settings, minus = settings;
  zero.restart_s = 0.0, minus.restart_s = -0.0;
  EXPECT_EQ(crc_of(config, &zero), crc_of(config, &minus));
  pose_wall_config moved = config;
  ASSERT_EQ(pose_wall_config_set_number(&moved, "extrinsic_x", 0.01), POSE_WALL_OK);
  EXPECT_NE(crc_of(moved, &settings), crc);
}

TEST(StopImage, RefusedCallsChangeNothing) {
  const pose_wall_planar_stop_result good = permission();
  pose_wall_planar_stop_image image;
  std::memset(&image, 0x5A, sizeof image);
  image.struct_size = sizeof image;
  const pose_wall_planar_stop_image before = image;
  EXPECT_EQ(pose_wall_planar_stop_image_fill(nullptr, &image), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_stop_image_fill(&good, nullptr), POSE_WALL_E_NULL);
  pose_wall_planar_stop_result bad = good;
  bad.struct_size = 1;
  EXPECT_EQ(pose_wall_planar_stop_image_fill(&bad, &image), POSE_WALL_E_STRUCT_SIZE);
  bad = good;
  bad.mark = 0;
  EXPECT_EQ(pose_wall_planar_stop_image_fill(&bad, &image), POSE_WALL_E_RESULT) << "made by no stop";
  EXPECT_EQ(std::memcmp(&image, &before, sizeof image), 0);
  image.struct_size = 4;
  EXPECT_EQ(pose_wall_planar_stop_image_fill(&good, &image), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_planar_stop_image_check(nullptr), POSE_WALL_E_NULL);
  pose_wall_planar_stop_image other = image_of(good);
  other.version = 3;
  EXPECT_EQ(pose_wall_planar_stop_image_check(&other), POSE_WALL_E_IMAGE_VERSION);

  const pose_wall_config config = default_config();
  pose_wall_planar_stop_settings settings = default_settings();
  std::uint32_t crc = 7;
  EXPECT_EQ(pose_wall_planar_stop_settings_crc(nullptr, &settings, &crc), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_stop_settings_crc(&config, &settings, nullptr), POSE_WALL_E_NULL);
  settings.struct_size = 0;
  EXPECT_EQ(pose_wall_planar_stop_settings_crc(&config, &settings, &crc), POSE_WALL_E_STRUCT_SIZE);
  pose_wall_config empty{};
  EXPECT_EQ(pose_wall_planar_stop_settings_crc(&empty, nullptr, &crc), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(crc, 7U);
}

}  // namespace
}  // namespace pose_wall::test
