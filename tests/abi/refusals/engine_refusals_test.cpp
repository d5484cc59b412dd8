// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every call of pose_wall.h refuses what the header says it refuses, by the status that stands there, and then
// changes nothing: no byte of the engine's block, of the config, of the result or of what else it would have written.
// Values of keys are in tests/faults/settings_test.cpp, clouds in cloud_refusals_test.cpp.

#include "abi/refusals/engine_world.hpp"

// What a program that was compiled against ABI 1 calls by these names.
extern "C" std::int32_t config_init_of_abi_1(pose_wall_config* config) __asm__("pose_wall_config_init");
extern "C" std::int32_t cloud_xyz32_of_abi_1(pose_wall_cloud* cloud, const void* data, std::uint32_t count,
                                             std::uint32_t point_step,
                                             std::int64_t stamp_ns) __asm__("pose_wall_cloud_xyz32");

namespace pose_wall::test {
namespace {

constexpr std::uint32_t kResultBytesOfAbi1 = 864;

using W = EngineWorld;

const Call<W> kEngineCalls[] = {
    {"pose_wall_config_init", [](W* w) { return config_init_of_abi_1(w->config); }, false, POSE_WALL_E_ABI},
    {"pose_wall_config_init_2", [](W* w) { return pose_wall_config_init(w->config); }},
    {"pose_wall_config_set", [](W* w) { return pose_wall_config_set(w->config, w->key, w->value); }},
    {"pose_wall_config_set_number", [](W* w) { return pose_wall_config_set_number(w->config, w->key, 25.0); }},
    {"pose_wall_config_get_number", [](W* w) { return pose_wall_config_get_number(w->config, w->key, w->number); }},
    {"pose_wall_config_get_box", [](W* w) { return pose_wall_config_get_box(w->config, w->box_key, w->box); }},
    {"pose_wall_config_get_text",
     [](W* w) { return pose_wall_config_get_text(w->config, w->text_key, w->text, w->text_bytes); }},
    {"pose_wall_config_key", [](W* w) { return pose_wall_config_key(w->index, w->key_info); }},
    {"pose_wall_config_check", [](W* w) { return pose_wall_config_check(w->config, &w->written().fault); }},
    {"pose_wall_config_crc", [](W* w) { return pose_wall_config_crc(w->config, w->crc); }},
    {"pose_wall_cloud_xyz32", [](W* w) { return cloud_xyz32_of_abi_1(w->cloud_to_fill, w->data, 1, 12, 0); }, false,
     POSE_WALL_E_ABI},
    {"pose_wall_cloud_xyz32_2", [](W* w) { return pose_wall_cloud_xyz32_2(w->cloud_to_fill, w->data, 1, 12, 0); }},
    {"pose_wall_cloud_xyz32_3", [](W* w) { return pose_wall_cloud_xyz32(w->cloud_to_fill, w->data, 1, 12, 0); }},
    {"pose_wall_cloud_check", [](W* w) { return pose_wall_cloud_check(w->cloud); }},
    {"pose_wall_memory_needed", [](W* w) { return pose_wall_memory_needed(w->config, w->needed); }},
    {"pose_wall_open", [](W* w) { return pose_wall_open(w->config, w->free_block, w->free_bytes, w->opened); }},
    {"pose_wall_reset", [](W* w) { return pose_wall_reset(w->engine); }, true},
    {"pose_wall_set_clock", [](W* w) { return pose_wall_set_clock(w->engine, nullptr, nullptr); }, true},
    {"pose_wall_process", [](W* w) { return pose_wall_process(w->engine, w->cloud, w->result); }, true},
    {"pose_wall_age", [](W* w) { return pose_wall_age(w->engine, 1, w->result); }, true},
    {"pose_wall_save", [](W* w) { return pose_wall_save(w->engine, &w->moment, w->memento, w->memento_bytes); }, true},
    {"pose_wall_load", [](W* w) { return pose_wall_load(w->engine, &w->moment, w->memento, w->memento_bytes); }, true},
    {"pose_wall_last_points", [](W* w) { return pose_wall_last_points(w->engine, w->points); }, true},
    {"pose_wall_self_test", [](W* w) { return pose_wall_self_test(w->free_block, w->free_bytes, w->report); }},
    {"pose_wall_image_fill", [](W* w) { return pose_wall_image_fill(w->result_to_image, w->image); }},
    {"pose_wall_image_check", [](W* w) { return pose_wall_image_check(w->image); }},
    {"pose_wall_image2_fill", [](W* w) { return pose_wall_image2_fill(w->result_to_image, &w->source, w->image2); }},
    {"pose_wall_image2_check", [](W* w) { return pose_wall_image2_check(w->image2); }},
};

// What all calls that take a config refuse alike.
const Refusal<W> kNoConfigs[] = {
    {"", "config NULL", kNull, [](W* w) { w->config = nullptr; }},
    {"", "config of another layout", kSize, [](W* w) { w->config->layout += 1; }},
    {"", "config of garbage", kSize, [](W* w) { std::memset(w->config, 0x41, sizeof *w->config); }},
    {"", "config of zeros", kSize, [](W* w) { std::memset(w->config, 0, sizeof *w->config); }},
};

// And those that take an engine.
const Refusal<W> kEngineHandles[] = {
    {"", "engine NULL", kNull, [](W* w) { w->engine = nullptr; }},
    {"", "a block of zeros", POSE_WALL_E_ENGINE, [](W* w) { w->hand_over(Dirt::kZeros); }},
    {"", "a block of ones", POSE_WALL_E_ENGINE, [](W* w) { w->hand_over(Dirt::kOnes); }},
    {"", "a block of garbage", POSE_WALL_E_ENGINE, [](W* w) { w->hand_over(Dirt::kRandom); }},
    {"", "an engine that was copied elsewhere", POSE_WALL_E_ENGINE, [](W* w) { w->hand_over_a_copy(); }},
    {"", "an engine with a bit turned", POSE_WALL_E_ENGINE, [](W* w) { w->turn_a_bit(); }},
};

template <std::uint32_t by>
void misalign(W* w) {
  w->misalign(by);
}
template <std::uint32_t size>
void result_of_size(W* w) {
  w->result->struct_size = size;
}
void contradict(W* w) {
  set(w->config, "s_front", "-3");
}
void unknown_key(W* w) {
  w->key = w->box_key = w->text_key = "no_such_key";
}
void change_head(W* w) {
  w->to_image.publication += 1;
}
void blank(W* w) {
  w->to_image = pose_wall_result{};
  w->to_image.struct_size = sizeof w->to_image;
}
void no_boot(W* w) {
  std::memset(w->moment.boot_id, 0, sizeof w->moment.boot_id);
}
template <int word>
void change_memento(W* w) {
  w->written().memento[word < 0 ? pose_wall_memento_bytes() - 1 : static_cast<std::uint64_t>(word)] ^= 1U;
}
constexpr std::uint32_t kNow = sizeof(pose_wall_result);

const Refusal<W> kEngineTable[] = {
    {"pose_wall_config_init", "of ABI 1", POSE_WALL_E_ABI, [](W*) {}},
    {"pose_wall_config_init_2", "NULL", kNull, [](W* w) { w->config = nullptr; }},
    {"pose_wall_config_set", "key NULL", kNull, [](W* w) { w->key = nullptr; }},
    {"pose_wall_config_set", "value NULL", kNull, [](W* w) { w->value = nullptr; }},
    {"pose_wall_config_set", "no such key", POSE_WALL_E_KEY_UNKNOWN, unknown_key},
    {"pose_wall_config_set_number", "key NULL", kNull, [](W* w) { w->key = nullptr; }},
    {"pose_wall_config_set_number", "no such key", POSE_WALL_E_KEY_UNKNOWN, unknown_key},
    {"pose_wall_config_set_number", "a choice", POSE_WALL_E_VALUE_TYPE, [](W* w) { w->key = "forward_axis"; }},
    {"pose_wall_config_set_number", "a box", POSE_WALL_E_VALUE_TYPE, [](W* w) { w->key = "body_box_1"; }},
    {"pose_wall_config_get_number", "key NULL", kNull, [](W* w) { w->key = nullptr; }},
    {"pose_wall_config_get_number", "value NULL", kNull, [](W* w) { w->number = nullptr; }},
    {"pose_wall_config_get_number", "no such key", POSE_WALL_E_KEY_UNKNOWN, unknown_key},
    {"pose_wall_config_get_number", "a choice", POSE_WALL_E_VALUE_TYPE, [](W* w) { w->key = "forward_axis"; }},
    {"pose_wall_config_get_number", "a box", POSE_WALL_E_VALUE_TYPE, [](W* w) { w->key = "body_box_1"; }},
    {"pose_wall_config_get_number", "a text", POSE_WALL_E_VALUE_TYPE, [](W* w) { w->key = "lidar_frame"; }},
    {"pose_wall_config_get_box", "key NULL", kNull, [](W* w) { w->box_key = nullptr; }},
    {"pose_wall_config_get_box", "value NULL", kNull, [](W* w) { w->box = nullptr; }},
    {"pose_wall_config_get_box", "no such key", POSE_WALL_E_KEY_UNKNOWN, unknown_key},
    {"pose_wall_config_get_box", "a number", POSE_WALL_E_VALUE_TYPE, [](W* w) { w->box_key = "range_max"; }},
    {"pose_wall_config_get_text", "key NULL", kNull, [](W* w) { w->text_key = nullptr; }},
    {"pose_wall_config_get_text", "buffer NULL", kNull, [](W* w) { w->text = nullptr; }},
    {"pose_wall_config_get_text", "no such key", POSE_WALL_E_KEY_UNKNOWN, unknown_key},
    {"pose_wall_config_get_text", "a number", POSE_WALL_E_VALUE_TYPE, [](W* w) { w->text_key = "range_max"; }},
    {"pose_wall_config_get_text", "no room for the closing zero", POSE_WALL_E_BUFFER_SMALL,
     [](W* w) { set(w->config, "lidar_frame", "four"), w->text_bytes = 4; }},
    {"pose_wall_config_key", "info NULL", kNull, [](W* w) { w->key_info = nullptr; }},
    {"pose_wall_config_key", "one too many", POSE_WALL_E_INDEX, [](W* w) { w->index = pose_wall_config_key_count(); }},
    {"pose_wall_config_crc", "crc NULL", kNull, [](W* w) { w->crc = nullptr; }},

    {"pose_wall_cloud_xyz32", "of ABI 1", POSE_WALL_E_ABI, [](W*) {}},
    {"pose_wall_cloud_xyz32_2", "cloud NULL", kNull, [](W* w) { w->cloud_to_fill = nullptr; }},
    {"pose_wall_cloud_xyz32_2", "no data", kNull, [](W* w) { w->data = nullptr; }},
    {"pose_wall_cloud_xyz32_3", "cloud NULL", kNull, [](W* w) { w->cloud_to_fill = nullptr; }},
    {"pose_wall_cloud_xyz32_3", "no data", kNull, [](W* w) { w->data = nullptr; }},
    {"pose_wall_cloud_check", "NULL", kNull, [](W* w) { w->cloud = nullptr; }},

    {"pose_wall_memory_needed", "bytes NULL", kNull, [](W* w) { w->needed = nullptr; }},
    {"pose_wall_memory_needed", "a contradiction", POSE_WALL_E_CONFIG_RULE, contradict},
    {"pose_wall_open", "block NULL", kNull, [](W* w) { w->free_block = nullptr; }},
    {"pose_wall_open", "engine NULL", kNull, [](W* w) { w->opened = nullptr; }},
    {"pose_wall_open", "a contradiction", POSE_WALL_E_CONFIG_RULE, contradict},
    {"pose_wall_open", "a byte too few", POSE_WALL_E_BLOCK_SMALL, [](W* w) { w->free_bytes = w->engine_bytes() - 1; }},
    {"pose_wall_open", "no bytes", POSE_WALL_E_BLOCK_SMALL, [](W* w) { w->free_bytes = 0; }},
    {"pose_wall_open", "off by 1", POSE_WALL_E_BLOCK_ALIGN, misalign<1>},
    {"pose_wall_open", "off by 8", POSE_WALL_E_BLOCK_ALIGN, misalign<8>},
    {"pose_wall_open", "off by 32", POSE_WALL_E_BLOCK_ALIGN, misalign<32>},
    {"pose_wall_open", "off by 63", POSE_WALL_E_BLOCK_ALIGN, misalign<63>},
    {"pose_wall_self_test", "block NULL", kNull, [](W* w) { w->free_block = nullptr; }},
    {"pose_wall_self_test", "report NULL", kNull, [](W* w) { w->report = nullptr; }},
    {"pose_wall_self_test", "a byte too few", POSE_WALL_E_BLOCK_SMALL,
     [](W* w) { w->free_bytes = pose_wall_self_test_bytes() - 1; }},
    {"pose_wall_self_test", "no bytes", POSE_WALL_E_BLOCK_SMALL, [](W* w) { w->free_bytes = 0; }},
    {"pose_wall_self_test", "off by 1", POSE_WALL_E_BLOCK_ALIGN, misalign<1>},
    {"pose_wall_self_test", "off by 63", POSE_WALL_E_BLOCK_ALIGN, misalign<63>},
    {"pose_wall_self_test", "a report of no size", kSize, [](W* w) { w->report->struct_size = 0; }},
    {"pose_wall_self_test", "a report of 4 bytes", kSize, [](W* w) { w->report->struct_size = 4; }},
    {"pose_wall_self_test", "a report of garbage", kSize, [](W* w) { w->report->struct_size = 0xFFFFFFFF; }},

    {"pose_wall_process", "cloud NULL", kNull, [](W* w) { w->cloud = nullptr; }},
    {"pose_wall_process", "result NULL", kNull, [](W* w) { w->result = nullptr; }},
    {"pose_wall_process", "a result of no size", kSize, result_of_size<0>},
    {"pose_wall_process", "a result of 4 bytes", kSize, result_of_size<4>},
    {"pose_wall_process", "a result of garbage", kSize, result_of_size<0x5A5A5A5A>},
    {"pose_wall_process", "a result one byte short", kSize, result_of_size<kNow - 1>},
    {"pose_wall_process", "a result of ABI 1", POSE_WALL_E_ABI, result_of_size<kResultBytesOfAbi1>},
    {"pose_wall_process", "a result one byte longer", kNewer, result_of_size<kNow + 1>},
    {"pose_wall_process", "a result 8 bytes longer", kNewer, result_of_size<kNow + 8>},
    {"pose_wall_process", "a result 400 bytes longer", kNewer, result_of_size<kNow + 400>},
    {"pose_wall_age", "result NULL", kNull, [](W* w) { w->result = nullptr; }},
    {"pose_wall_age", "a result of no size", kSize, result_of_size<0>},
    {"pose_wall_age", "a result of ABI 1", POSE_WALL_E_ABI, result_of_size<kResultBytesOfAbi1>},
    {"pose_wall_age", "a result 8 bytes longer", kNewer, result_of_size<kNow + 8>},
    {"pose_wall_last_points", "points NULL", kNull, [](W* w) { w->points = nullptr; }},

    {"pose_wall_save", "memento NULL", kNull, [](W* w) { w->memento = nullptr; }},
    {"pose_wall_save", "a byte too few", POSE_WALL_E_BUFFER_SMALL, [](W* w) { w->memento_bytes -= 1; }},
    {"pose_wall_save", "an unknown bit", POSE_WALL_E_INPUT, [](W* w) { w->moment.known = 8; }},
    {"pose_wall_save", "a boot that nobody filled in", POSE_WALL_E_INPUT, no_boot},
    {"pose_wall_save", "a moment of 1 byte", kSize, [](W* w) { w->moment.struct_size = 1; }},
    {"pose_wall_load", "memento NULL", kNull, [](W* w) { w->memento = nullptr; }},
    {"pose_wall_load", "an unknown bit", POSE_WALL_E_INPUT, [](W* w) { w->moment.known = 8; }},
    {"pose_wall_load", "a boot that nobody filled in", POSE_WALL_E_INPUT, no_boot},
    {"pose_wall_load", "a moment of 1 byte", kSize, [](W* w) { w->moment.struct_size = 1; }},
    {"pose_wall_load", "a byte too few", POSE_WALL_E_MEMENTO, [](W* w) { w->memento_bytes -= 1; }},
    {"pose_wall_load", "no bytes", POSE_WALL_E_MEMENTO, [](W* w) { w->memento_bytes = 0; }},
    {"pose_wall_load", "zeros", POSE_WALL_E_MEMENTO, [](W* w) { std::memset(w->memento, 0, w->memento_bytes); }},
    {"pose_wall_load", "ones", POSE_WALL_E_MEMENTO, [](W* w) { std::memset(w->memento, 0xFF, w->memento_bytes); }},
    {"pose_wall_load", "of another version", POSE_WALL_E_MEMENTO, change_memento<0>},
    {"pose_wall_load", "with another sum", POSE_WALL_E_MEMENTO, change_memento<8>},
    {"pose_wall_load", "with its first byte changed", POSE_WALL_E_MEMENTO, change_memento<16>},
    {"pose_wall_load", "with its last byte changed", POSE_WALL_E_MEMENTO, change_memento<-1>},
    {"pose_wall_load", "moved by a word", POSE_WALL_E_MEMENTO,
     [](W* w) {
       unsigned char* const m = w->written().memento;
       std::rotate(m + 16, m + 24, m + w->memento_bytes);
     }},
    {"pose_wall_load", "backwards", POSE_WALL_E_MEMENTO,
     [](W* w) { std::reverse(w->written().memento, w->written().memento + w->memento_bytes); }},

    {"pose_wall_image_fill", "result NULL", kNull, [](W* w) { w->result_to_image = nullptr; }},
    {"pose_wall_image_fill", "image NULL", kNull, [](W* w) { w->image = nullptr; }},
    {"pose_wall_image_fill", "an image of no size", kSize, [](W* w) { w->image->struct_size = 0; }},
    {"pose_wall_image_fill", "a result of 8 bytes", kSize, [](W* w) { w->to_image.struct_size = 8; }},
    {"pose_wall_image_fill", "a result that nobody filled", POSE_WALL_E_RESULT, blank},
    {"pose_wall_image_fill", "another publication", POSE_WALL_E_RESULT, change_head},
    {"pose_wall_image_fill", "another config", POSE_WALL_E_RESULT, [](W* w) { w->to_image.config_crc32 ^= 1U; }},
    {"pose_wall_image_fill", "another stamp", POSE_WALL_E_RESULT, [](W* w) { w->to_image.stamp_ns += 1; }},
    {"pose_wall_image_fill", "another frame", POSE_WALL_E_RESULT, [](W* w) { w->to_image.frame_index += 1; }},
    {"pose_wall_image_check", "NULL", kNull, [](W* w) { w->image = nullptr; }},
    {"pose_wall_image_check", "never filled", POSE_WALL_E_IMAGE_VERSION,
     [](W* w) { std::memset(w->image, 0, sizeof *w->image); }},
    {"pose_wall_image_check", "a bit turned", POSE_WALL_E_IMAGE_CRC, [](W* w) { w->image->sequence ^= 1U; }},
    {"pose_wall_image2_fill", "result NULL", kNull, [](W* w) { w->result_to_image = nullptr; }},
    {"pose_wall_image2_fill", "image NULL", kNull, [](W* w) { w->image2 = nullptr; }},
    {"pose_wall_image2_fill", "an image of no size", kSize, [](W* w) { w->image2->struct_size = 0; }},
    {"pose_wall_image2_fill", "a result of 8 bytes", kSize, [](W* w) { w->to_image.struct_size = 8; }},
    {"pose_wall_image2_fill", "a source of no size", kSize, [](W* w) { w->source.struct_size = 0; }},
    {"pose_wall_image2_fill", "a newer source", kNewer, [](W* w) { w->source.struct_size += 8; }},
    {"pose_wall_image2_fill", "another publication", POSE_WALL_E_RESULT, change_head},
    {"pose_wall_image2_fill", "a result that nobody filled", POSE_WALL_E_RESULT, blank},
    {"pose_wall_image2_check", "NULL", kNull, [](W* w) { w->image2 = nullptr; }},
    {"pose_wall_image2_check", "never filled", POSE_WALL_E_IMAGE_VERSION,
     [](W* w) { std::memset(w->image2, 0, sizeof *w->image2); }},
    {"pose_wall_image2_check", "a bit turned", POSE_WALL_E_IMAGE_CRC, [](W* w) { w->image2->sequence ^= 1U; }},
};

TEST(EngineRefusals, EveryCallThatCanFailIsTold) {
  expect_every_call_of("include/pose_wall.h", kEngineCalls);
}

TEST(EngineRefusals, WrongCallsChangeNothing) {
  EngineWorld world;
  expect_table(&world, kEngineCalls, kEngineTable);
}

TEST(EngineRefusals, WhatIsNoEngineOrADamagedOne) {
  EngineWorld world;
  expect_handles(&world, kEngineCalls, kEngineHandles);
}

TEST(EngineRefusals, WhatIsNoConfig) {
  EngineWorld world;
  for (const char* name : {"pose_wall_config_set", "pose_wall_config_set_number", "pose_wall_config_get_number",
                           "pose_wall_config_get_box", "pose_wall_config_get_text", "pose_wall_config_check",
                           "pose_wall_config_crc", "pose_wall_memory_needed", "pose_wall_open"}) {
    for (const Refusal<W>& fault : kNoConfigs) expect_refused(&world, call_of(kEngineCalls, name), fault);
  }
}

// The clock is the one place where the caller's code runs inside a call. What it asks there is refused, and the frame
// goes on; the memory of the engine in use may not be opened over.
TEST(EngineRefusals, EveryCallIntoABusyEngine) {
  struct Inside {
    EngineWorld world;
    int asked = 0;

    static std::int64_t ask(void* user) {
      Inside& inside = *static_cast<Inside*>(user);
      W& w = inside.world;
      if (inside.asked++ > 0) return 0;
      const WorldBytes before = w.written_bytes();
      for (const Call<W>& call : kEngineCalls) {
        if (call.takes_handle) {
          EXPECT_EQ(call.make(&w), POSE_WALL_E_BUSY) << call.name;
        }
      }
      EXPECT_EQ(pose_wall_open(w.config, w.engine, w.engine_bytes(), w.opened), POSE_WALL_E_BUSY);
      EXPECT_TRUE(w.written_bytes() == before);
      return 0;
    }
  } inside;
  W& w = inside.world;
  const pose_wall_result expected = w.result_of_next_frame();
  w.restore();
  ASSERT_EQ(pose_wall_set_clock(w.engine, Inside::ask, &inside), POSE_WALL_OK);
  const pose_wall_result found = w.result_of_next_frame();
  EXPECT_GT(inside.asked, 0);
  EXPECT_EQ(std::memcmp(&found, &expected, sizeof found), 0) << "the frame was disturbed";
}

}  // namespace
}  // namespace pose_wall::test
