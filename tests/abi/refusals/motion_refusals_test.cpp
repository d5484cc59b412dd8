// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every call of pose_wall_motion.h refuses what the header says it refuses, by the status that stands there,
// and then changes no byte of the motion's block, of an engine's or of a result. Settings out of their ranges are in
// abi/motion_test.cpp, clouds in cloud_refusals_test.cpp.

#include <cstddef>

#include "abi/refusals/refusal.hpp"
#include "pose_wall_motion.h"
#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/motion_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

class MotionWorld {
 public:
  // What calls write. Compared byte by byte, so it is filled once as a whole.
  struct Written {
    pose_wall_motion_settings settings;
    pose_wall_motion_fault fault;
    pose_wall_motion* opened;
    pose_wall_motion_result result;
    pose_wall_result engine_result;
    pose_wall_inputs inputs;
    pose_wall_motion_image image;
    float map[30];
    std::uint32_t total;
  };

  MotionWorld() {
    const pose_wall_cloud first = cloud_of(points_, 0);
    measured_ = motion_.process(first);
    engine_.process(first);
    append(motion_.block().data(), motion_.block().size(), &motion_as_it_was_);
    append(engine_.block().data(), engine_.block().size(), &engine_as_it_was_);
    restore();
  }

  void restore() {
    std::memcpy(motion_.block().data(), motion_as_it_was_.data(), motion_as_it_was_.size());
    std::memcpy(engine_.block().data(), engine_as_it_was_.data(), engine_as_it_was_.size());
    std::memset(&written_, 0x5A, sizeof written_);
    (void)pose_wall_motion_settings_init(&written_.settings);
    written_.result.struct_size = sizeof written_.result;
    written_.engine_result.struct_size = sizeof written_.engine_result;
    written_.inputs.struct_size = sizeof written_.inputs;
    written_.image.struct_size = sizeof written_.image;
    (void)pose_wall_motion_image_fill(&measured_, nullptr, &written_.image);
    to_image = measured_;
    given_config = small_config();
    described = cloud_of(points_, 100000000);
    source = {sizeof source, 1, 1, 1, 1, 1};
    settings = &written_.settings, config = &given_config, opened = &written_.opened;
    motion = motion_.get(), engine = engine_.get(), cloud = &described;
    result = &written_.result, result_to_image = &to_image, engine_result = &written_.engine_result;
    inputs = &written_.inputs, image = &written_.image, map = written_.map, total = &written_.total;
    free_block = free_block_.data();
    free_bytes = pose_wall_motion_memory_needed();
  }
  void copy(WorldBytes* to) {
    to->clear();
    append(&written_, sizeof written_, to);
    append(motion_.block().data(), motion_.block().size(), to);
    append(engine_.block().data(), engine_.block().size(), to);
    append(free_block_.data(), free_block_.size(), to);
  }
  // The handle is not the motion but another block, of these bytes or of its own.
  void hand_over(Dirt dirt) {
    AlignedBlock& block = dirt == Dirt::kRandom ? random_ : free_block_;
    if (dirt != Dirt::kRandom) std::memset(block.data(), dirt == Dirt::kOnes ? 0xFF : 0x00, motion_as_it_was_.size());
    motion = static_cast<pose_wall_motion*>(block.data());
  }
  void hand_over_a_copy() {
    std::memcpy(free_block_.data(), motion_.block().data(), motion_as_it_was_.size());
    motion = static_cast<pose_wall_motion*>(free_block_.data());
  }
  void hand_over_no_engine() { engine = static_cast<pose_wall_engine*>(random_.data()); }
  void misalign() { free_block = static_cast<char*>(free_block_.data()) + 8; }

  // Arguments. Those that are written to point into written_.
  pose_wall_config given_config{}, *config = nullptr;
  pose_wall_motion_settings* settings = nullptr;
  void* free_block = nullptr;
  std::uint64_t free_bytes = 0;
  pose_wall_motion *motion = nullptr, **opened = nullptr;
  pose_wall_engine* engine = nullptr;
  pose_wall_cloud described{}, *cloud = nullptr;
  pose_wall_motion_result to_image{}, *result = nullptr, *result_to_image = nullptr;
  pose_wall_result* engine_result = nullptr;
  pose_wall_inputs* inputs = nullptr;
  pose_wall_image_source source{};
  pose_wall_motion_image* image = nullptr;
  float* map = nullptr;
  std::uint32_t* total = nullptr;

 private:
  const Points points_ = room_points(1);
  MotionUnderTest motion_{small_config()};
  EngineUnderTest engine_{small_config()};
  AlignedBlock free_block_{pose_wall_motion_memory_needed() + POSE_WALL_BLOCK_ALIGNMENT, Dirt::kZeros};
  AlignedBlock random_{pose_wall_motion_memory_needed(), Dirt::kRandom};
  WorldBytes motion_as_it_was_, engine_as_it_was_;
  pose_wall_motion_result measured_{};
  Written written_{};
};

using M = MotionWorld;

const Call<M> kMotionCalls[] = {
    {"pose_wall_motion_settings_init", [](M* m) { return pose_wall_motion_settings_init(m->settings); }},
    {"pose_wall_motion_settings_check", [](M* m) { return pose_wall_motion_settings_check(m->settings, nullptr); }},
    {"pose_wall_motion_open",
     [](M* m) { return pose_wall_motion_open(m->config, m->settings, m->free_block, m->free_bytes, m->opened); }},
    {"pose_wall_motion_reset", [](M* m) { return pose_wall_motion_reset(m->motion); }, true},
    {"pose_wall_motion_process", [](M* m) { return pose_wall_motion_process(m->motion, m->cloud, m->result); }, true},
    {"pose_wall_motion_give", [](M* m) { return pose_wall_motion_give(m->motion, m->inputs); }, true},
    {"pose_wall_motion_process_both",
     [](M* m) { return pose_wall_motion_process_both(m->motion, m->engine, m->cloud, m->result, m->engine_result); },
     true},
    {"pose_wall_motion_blank", [](M* m) { return pose_wall_motion_blank(m->motion, m->result); }, true},
    {"pose_wall_motion_image_fill",
     [](M* m) { return pose_wall_motion_image_fill(m->result_to_image, &m->source, m->image); }},
    {"pose_wall_motion_image_check", [](M* m) { return pose_wall_motion_image_check(m->image); }},
    {"pose_wall_motion_map", [](M* m) { return pose_wall_motion_map(m->motion, 0, m->map, 10, m->total); }, true},
};

const Refusal<M> kMotionHandles[] = {
    {"", "motion NULL", POSE_WALL_E_NULL, [](M* m) { m->motion = nullptr; }},
    {"", "a block of zeros", POSE_WALL_E_ENGINE, [](M* m) { m->hand_over(Dirt::kZeros); }},
    {"", "a block of ones", POSE_WALL_E_ENGINE, [](M* m) { m->hand_over(Dirt::kOnes); }},
    {"", "a block of garbage", POSE_WALL_E_ENGINE, [](M* m) { m->hand_over(Dirt::kRandom); }},
    {"", "a motion that was copied elsewhere", POSE_WALL_E_ENGINE, [](M* m) { m->hand_over_a_copy(); }},
};

constexpr std::uint32_t kWhole = sizeof(pose_wall_motion_result);

template <std::uint32_t size>
void settings_of_size(M* m) {
  m->settings->struct_size = size;
}
template <std::uint32_t size>
void result_of_size(M* m) {
  m->result->struct_size = size;
}
void forget_layout(M* m) {
  m->config->layout = 0;
}

const Refusal<M> kMotionTable[] = {
    {"pose_wall_motion_settings_init", "NULL", kNull, [](M* m) { m->settings = nullptr; }},
    {"pose_wall_motion_settings_check", "NULL", kNull, [](M* m) { m->settings = nullptr; }},
    {"pose_wall_motion_settings_check", "no size", kSize, settings_of_size<0>},
    {"pose_wall_motion_settings_check", "4 bytes", kSize, settings_of_size<4>},
    {"pose_wall_motion_settings_check", "8 bytes short", kSize,
     settings_of_size<sizeof(pose_wall_motion_settings) - 8>},
    {"pose_wall_motion_settings_check", "a size of garbage", kSize, settings_of_size<0x5A5A5A5A>},
    {"pose_wall_motion_settings_check", "8 bytes longer", kNewer,
     settings_of_size<sizeof(pose_wall_motion_settings) + 8>},
    {"pose_wall_motion_open", "config NULL", kNull, [](M* m) { m->config = nullptr; }},
    {"pose_wall_motion_open", "block NULL", kNull, [](M* m) { m->free_block = nullptr; }},
    {"pose_wall_motion_open", "motion NULL", kNull, [](M* m) { m->opened = nullptr; }},
    {"pose_wall_motion_open", "config of another layout", kSize, forget_layout},
    {"pose_wall_motion_open", "a contradiction", POSE_WALL_E_CONFIG_RULE,
     [](M* m) { set(m->config, "s_front", "-3"); }},
    {"pose_wall_motion_open", "settings of another size", kSize, settings_of_size<3>},
    {"pose_wall_motion_open", "no speed", POSE_WALL_E_VALUE_RANGE, [](M* m) { m->settings->speed_max_m_s = 0.0; }},
    {"pose_wall_motion_open", "a byte too few", POSE_WALL_E_BLOCK_SMALL, [](M* m) { m->free_bytes -= 1; }},
    {"pose_wall_motion_open", "no bytes", POSE_WALL_E_BLOCK_SMALL, [](M* m) { m->free_bytes = 0; }},
    {"pose_wall_motion_open", "off by 8", POSE_WALL_E_BLOCK_ALIGN, [](M* m) { m->misalign(); }},
    {"pose_wall_motion_process", "cloud NULL", kNull, [](M* m) { m->cloud = nullptr; }},
    {"pose_wall_motion_process", "result NULL", kNull, [](M* m) { m->result = nullptr; }},
    {"pose_wall_motion_process", "no size", kSize, result_of_size<0>},
    {"pose_wall_motion_process", "8 bytes", kSize, result_of_size<8>},
    {"pose_wall_motion_process", "short of run", kSize, result_of_size<offsetof(pose_wall_motion_result, run) - 8>},
    {"pose_wall_motion_process", "a size of garbage", kSize, result_of_size<0x5A5A5A5A>},
    {"pose_wall_motion_process", "8 bytes longer", kNewer, result_of_size<kWhole + 8>},
    {"pose_wall_motion_process", "400 bytes longer", kNewer, result_of_size<kWhole + 400>},
    {"pose_wall_motion_process_both", "engine NULL", kNull, [](M* m) { m->engine = nullptr; }},
    {"pose_wall_motion_process_both", "cloud NULL", kNull, [](M* m) { m->cloud = nullptr; }},
    {"pose_wall_motion_process_both", "motion's result NULL", kNull, [](M* m) { m->result = nullptr; }},
    {"pose_wall_motion_process_both", "result NULL", kNull, [](M* m) { m->engine_result = nullptr; }},
    {"pose_wall_motion_process_both", "motion's result of no size", kSize, result_of_size<0>},
    {"pose_wall_motion_process_both", "result of no size", kSize, [](M* m) { m->engine_result->struct_size = 0; }},
    {"pose_wall_motion_give", "inputs NULL", kNull, [](M* m) { m->inputs = nullptr; }},
    {"pose_wall_motion_give", "inputs of no size", kSize, [](M* m) { m->inputs->struct_size = 0; }},
    {"pose_wall_motion_blank", "result NULL", kNull, [](M* m) { m->result = nullptr; }},
    {"pose_wall_motion_blank", "4 bytes", kSize, result_of_size<4>},
    {"pose_wall_motion_image_fill", "result NULL", kNull, [](M* m) { m->result_to_image = nullptr; }},
    {"pose_wall_motion_image_fill", "image NULL", kNull, [](M* m) { m->image = nullptr; }},
    {"pose_wall_motion_image_fill", "4 bytes short", kSize, [](M* m) { m->image->struct_size -= 4; }},
    {"pose_wall_motion_image_fill", "a source of 4 bytes", kSize, [](M* m) { m->source.struct_size = 4; }},
    {"pose_wall_motion_image_fill", "a result of 8 bytes", kSize, [](M* m) { m->to_image.struct_size = 8; }},
    {"pose_wall_motion_image_fill", "another mark", POSE_WALL_E_RESULT, [](M* m) { m->to_image.mark ^= 1U; }},
    {"pose_wall_motion_image_fill", "a result that nobody filled", POSE_WALL_E_RESULT,
     [](M* m) { m->to_image = blank_motion_result(); }},
    {"pose_wall_motion_image_check", "NULL", kNull, [](M* m) { m->image = nullptr; }},
    {"pose_wall_motion_image_check", "another version", POSE_WALL_E_IMAGE_VERSION,
     [](M* m) { m->image->version += 1; }},
    {"pose_wall_motion_image_check", "a bit turned", POSE_WALL_E_IMAGE_CRC, [](M* m) { m->image->sequence ^= 1U; }},
    {"pose_wall_motion_map", "points NULL", kNull, [](M* m) { m->map = nullptr; }},
    {"pose_wall_motion_map", "total NULL", kNull, [](M* m) { m->total = nullptr; }},
};

TEST(MotionRefusals, EveryCallThatCanFailIsTold) {
  expect_every_call_of("include/pose_wall_motion.h", kMotionCalls);
}

TEST(MotionRefusals, WrongCallsChangeNothing) {
  MotionWorld world;
  expect_table(&world, kMotionCalls, kMotionTable);
}

TEST(MotionRefusals, WhatIsNoMotion) {
  MotionWorld world;
  expect_handles(&world, kMotionCalls, kMotionHandles);
}

// As the header says: the motion has taken the frame then. No result is written for the engine.
TEST(MotionRefusals, BothWithWhatIsNoEngineWriteNoResultOfOne) {
  MotionWorld world;
  world.hand_over_no_engine();
  const pose_wall_result before = *world.engine_result;
  EXPECT_EQ(call_of(kMotionCalls, "pose_wall_motion_process_both").make(&world), POSE_WALL_E_ENGINE);
  EXPECT_EQ(std::memcmp(world.engine_result, &before, sizeof before), 0);
}

}  // namespace
}  // namespace pose_wall::test
