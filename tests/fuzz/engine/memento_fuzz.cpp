// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: what is given to pose_wall_load. Arbitrary bytes, and mementos whose words were changed and whose
// checksum is right again. What is refused changes nothing; what is taken is saved alike; and whatever an engine was
// made to believe, the next frames stay without undefined behaviour and in known states. More is not promised: a
// memento is trusted like the config.

#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/road_from_input.hpp"
#include "support/moments.hpp"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

// Above pose_wall_memento_bytes(); checked where it is used.
constexpr std::uint64_t kRoom = 16384;

std::uint64_t checksum(const unsigned char* bytes, std::uint64_t count) {
  std::uint64_t sum = 0xCBF29CE484222325U;
  for (std::uint64_t i = 0; i < count; ++i) sum = (sum ^ bytes[i]) * 0x100000001B3U;
  return sum;
}

void mend_checksum(unsigned char* memento) {
  std::uint64_t sum = checksum(memento + 16, pose_wall_memento_bytes() - 16);
  for (int i = 0; i < 8; ++i, sum >>= 8U) memento[8 + i] = static_cast<unsigned char>(sum);
}

// Some of the numbers that arithmetic goes wrong with, or the input's own.
std::uint64_t strange_word(Input* input) {
  static const std::uint64_t kWords[] = {0,
                                         1,
                                         2,
                                         ~std::uint64_t{0},
                                         0x7FF0000000000000U,  // infinite
                                         0x7FF8000000000000U,  // NaN
                                         0x7FEFFFFFFFFFFFFFU,  // the largest double
                                         0x0000000000000001U,  // the smallest
                                         0x8000000000000000U,  // -0, and the least int64
                                         0x3FF0000000000000U,  // 1
                                         0xBFF0000000000000U,  // -1
                                         0x43E0000000000000U,  // 2^63
                                         0x00000000FFFFFFFFU};
  constexpr std::uint32_t kCount = sizeof kWords / sizeof kWords[0];
  const std::uint32_t which = input->below(kCount + 4);
  return which < kCount ? kWords[which] : input->take<std::uint64_t>();
}

void change_words(Input* input, unsigned char* memento) {
  const auto words = static_cast<std::uint32_t>(pose_wall_memento_bytes() / 8 - 2);
  for (int i = 0; i < 24 && input->left() >= 2; ++i) {
    const std::uint32_t at = input->byte() % words;
    const std::uint64_t word = strange_word(input);
    std::memcpy(memento + 16 + 8 * at, &word, sizeof word);
  }
}

void process(pose_wall_engine* engine, std::uint32_t points, std::int64_t stamp_ns) {
  pose_wall_cloud cloud;
  require_ok(pose_wall_cloud_xyz32(&cloud, road_points(), points, 12, stamp_ns), "xyz32");
  pose_wall_result result = empty_result();
  require_ok(pose_wall_process(engine, &cloud, &result), "process");
  for (const pose_wall_value& v : result.quantity) require(v.state <= POSE_WALL_VALID, "a known state");
  require_ok(pose_wall_age(engine, stamp_ns + 150000000, &result), "age");
  for (const pose_wall_value& v : result.quantity) require(v.state <= POSE_WALL_HELD, "silence measures nothing");
  pose_wall_image image;
  image.struct_size = sizeof image;
  require_ok(pose_wall_image_fill(&result, &image), "image");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static KeptBlock block;
  static const pose_wall_config config = small_config_for_fuzzing();
  static const std::uint32_t points = scan_road(plain_road(), 0);
  static unsigned char memento[kRoom], before[kRoom], after[kRoom];
  const std::uint64_t bytes = pose_wall_memento_bytes();
  require(bytes <= kRoom, "room for a memento");
  Input input(data, size);
  pose_wall_engine* const engine = open_engine(config, &block, 0xA5);
  const std::uint8_t how = input.byte();
  if ((how & 1U) != 0) process(engine, points, 0);
  require_ok(pose_wall_save(engine, nullptr, before, bytes), "save");
  std::memcpy(memento, before, bytes);
  if ((how & 2U) != 0) {
    const std::size_t held = input.left() < bytes ? input.left() : static_cast<std::size_t>(bytes);
    if (held > 0) std::memcpy(memento, input.rest(), held);
  } else {
    change_words(&input, memento);
  }
  if ((how & 4U) == 0) mend_checksum(memento);
  const std::int32_t status = pose_wall_load(engine, &kSameClock, memento, bytes);
  require_ok(pose_wall_save(engine, nullptr, after, bytes), "save");
  require(status == POSE_WALL_OK || status == POSE_WALL_E_MEMENTO, "taken or refused");
  require(std::memcmp(after, status == POSE_WALL_OK ? memento : before, bytes) == 0,
          "what is taken is there, what is refused changes nothing");
  process(engine, points, 100000000);
  process(engine, points, 200000000);
  return 0;
}
