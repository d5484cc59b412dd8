// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// All that the calls of pose_wall.h read and write, as it is before a call is spoilt: see refusal.hpp.

#pragma once

#include "abi/refusals/refusal.hpp"
#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {

class EngineWorld {
 public:
  // What calls write. Compared byte by byte, so it is filled once as a whole.
  struct Written {
    pose_wall_config config;
    pose_wall_key_info key_info;
    pose_wall_rule_fault fault;
    double number, box[6];
    char text[64];
    std::uint64_t needed;
    std::uint32_t crc;
    pose_wall_cloud cloud;
    pose_wall_engine* opened;
    pose_wall_result result;
    pose_wall_points points;
    unsigned char memento[16384];
    pose_wall_self_test_report report;
    pose_wall_image image;
    pose_wall_image2 image2;
  };

  EngineWorld() {
    EXPECT_LE(pose_wall_memento_bytes(), sizeof written_.memento);
    EXPECT_EQ(pose_wall_open(&settings_, block_.data(), block_.size(), &engine_), POSE_WALL_OK);
    const pose_wall_cloud first = cloud_of(points_, 0);
    measured_.struct_size = sizeof measured_;
    EXPECT_EQ(pose_wall_process(engine_, &first, &measured_), POSE_WALL_OK);
    EXPECT_EQ(pose_wall_save(engine_, nullptr, memento_, pose_wall_memento_bytes()), POSE_WALL_OK);
    append(block_.data(), block_.size(), &block_as_it_was_);
    restore();
  }

  // An engine with one frame behind it, and every argument as it should be.
  void restore() {
    std::memcpy(block_.data(), block_as_it_was_.data(), block_as_it_was_.size());
    std::memset(free_block_.data(), 0x5A, static_cast<std::size_t>(free_block_.size()));
    std::memset(&written_, 0x5A, sizeof written_);
    written_.config = settings_;
    std::memcpy(written_.memento, memento_, sizeof memento_);
    written_.result.struct_size = sizeof written_.result;
    written_.report.struct_size = sizeof written_.report;
    (void)pose_wall_image_fill(&measured_, written_image1());
    (void)pose_wall_image2_fill(&measured_, nullptr, written_image2());
    described = cloud_of(points_, 0);
    inputs = pose_wall_inputs{};
    inputs.struct_size = sizeof inputs;
    moment = {sizeof moment, POSE_WALL_MOMENT_BOOT, {1}, 0, 0};
    source = {sizeof source, 1, 1, 1, 1, 1};
    to_image = measured_;
    point_at_all();
  }
  void copy(WorldBytes* to) {
    to->clear();
    append(&written_, sizeof written_, to);
    append(block_.data(), block_.size(), to);
    append(free_block_.data(), free_block_.size(), to);
    append(not_open_.data(), not_open_.size(), to);
  }

  // The handle is not the engine but another block, of these bytes.
  void hand_over(Dirt dirt) {
    std::memset(not_open_.data(), dirt == Dirt::kOnes ? 0xFF : 0x00, static_cast<std::size_t>(not_open_.size()));
    if (dirt == Dirt::kRandom) std::memcpy(not_open_.data(), random_.data(), static_cast<std::size_t>(random_.size()));
    engine = static_cast<pose_wall_engine*>(not_open_.data());
  }
  void hand_over_a_copy() {
    std::memcpy(not_open_.data(), block_.data(), static_cast<std::size_t>(block_.size()));
    engine = static_cast<pose_wall_engine*>(not_open_.data());
  }
  // In the settings or the memory, both of which carry the sum.
  void turn_a_bit() { static_cast<unsigned char*>(block_.data())[512] ^= 4U; }
  void misalign(std::uint32_t by) { free_block = static_cast<unsigned char*>(free_block_.data()) + by; }
  Written& written() { return written_; }
  WorldBytes written_bytes() {
    WorldBytes all;
    append(&written_, sizeof written_, &all);
    return all;
  }
  std::uint64_t engine_bytes() const { return block_.size(); }
  pose_wall_result result_of_next_frame() {
    pose_wall_result next{};
    next.struct_size = sizeof next;
    const pose_wall_cloud second = cloud_of(points_, 100000000);
    EXPECT_EQ(pose_wall_process(engine_, &second, &next), POSE_WALL_OK);
    return next;
  }

  // Arguments. Those that are written to point into written_.
  pose_wall_config* config = nullptr;
  const char *key = nullptr, *value = nullptr, *box_key = nullptr, *text_key = nullptr;
  std::uint32_t index = 0;
  std::uint64_t text_bytes = 0, memento_bytes = 0, free_bytes = 0;
  pose_wall_key_info* key_info = nullptr;
  double *number = nullptr, *box = nullptr;
  char* text = nullptr;
  std::uint64_t* needed = nullptr;
  std::uint32_t* crc = nullptr;
  pose_wall_cloud *cloud_to_fill = nullptr, *cloud = nullptr, described{};
  const void* data = nullptr;
  pose_wall_inputs inputs{};
  pose_wall_engine *engine = nullptr, **opened = nullptr;
  void* free_block = nullptr;
  pose_wall_result *result = nullptr, *result_to_image = nullptr, to_image{};
  pose_wall_points* points = nullptr;
  void* memento = nullptr;
  pose_wall_moment moment{};
  pose_wall_self_test_report* report = nullptr;
  pose_wall_image* image = nullptr;
  pose_wall_image2* image2 = nullptr;
  pose_wall_image_source source{};

 private:
  static std::uint64_t bytes_of(const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
    return bytes;
  }
  pose_wall_image* written_image1() {
    written_.image.struct_size = sizeof written_.image;
    return &written_.image;
  }
  pose_wall_image2* written_image2() {
    written_.image2.struct_size = sizeof written_.image2;
    return &written_.image2;
  }
  void point_at_all() {
    config = &written_.config;
    key = "range_max", value = "25", box_key = "body_box_1", text_key = "lidar_frame";
    index = 0;
    text_bytes = sizeof written_.text, memento_bytes = pose_wall_memento_bytes();
    free_bytes = free_block_.size() - POSE_WALL_BLOCK_ALIGNMENT;
    key_info = &written_.key_info;
    number = &written_.number, box = written_.box, text = written_.text;
    needed = &written_.needed, crc = &written_.crc;
    cloud_to_fill = &written_.cloud, cloud = &described, data = points_.data();
    engine = engine_, opened = &written_.opened;
    free_block = free_block_.data();
    result = &written_.result, result_to_image = &to_image, points = &written_.points;
    memento = written_.memento, report = &written_.report;
    image = &written_.image, image2 = &written_.image2;
  }

  const Points points_ = room_points(1);
  const pose_wall_config settings_ = small_config();
  AlignedBlock block_{bytes_of(settings_), Dirt::kRandom}, random_{bytes_of(settings_), Dirt::kRandom};
  AlignedBlock not_open_{bytes_of(settings_), Dirt::kZeros};
  AlignedBlock free_block_{std::max(bytes_of(settings_), pose_wall_self_test_bytes()) + POSE_WALL_BLOCK_ALIGNMENT,
                           Dirt::kZeros};
  WorldBytes block_as_it_was_;
  pose_wall_engine* engine_ = nullptr;
  pose_wall_result measured_ = {};
  unsigned char memento_[16384] = {};
  Written written_{};
};

}  // namespace pose_wall::test
