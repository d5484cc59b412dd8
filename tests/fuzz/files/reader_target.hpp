// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz targets of readers: each is one line. A reader gives frames whose description the engine takes, or throws its
// own error with a message; any other exception is a finding.

#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "fuzz/config_from_input.hpp"
#include "fuzz/fuzz_target.hpp"
#include "io/frames/frame.hpp"

namespace pose_wall::test {

// Larger frames cost the fuzzer its rounds. The number is the largest points_max of config_from_input.hpp.
constexpr std::uint64_t kPointsToProcess = 20000;

// The engine reads what the reader promises, with all of a frame's fields.
inline void take_frame(const tools::Frame& frame) {
  static KeptBlock block;
  static const pose_wall_config config = [] {
    pose_wall_config c = small_config_for_fuzzing();
    set_key(&c, "intensity_weight", 0.5);
    return c;
  }();
  require_ok(pose_wall_cloud_check(&frame.cloud), "what a reader gives");
  if (std::uint64_t{frame.cloud.width} * frame.cloud.height > kPointsToProcess) return;
  pose_wall_result result = empty_result();
  require_ok(pose_wall_process(open_engine(config, &block, 0xA5), &frame.cloud, &result), "process");
}

template <typename Reader>
int feed_reader(Reader read, const std::uint8_t* data, std::size_t size) {
  tools::Bytes bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  try {
    const tools::Frame frame = read(std::move(bytes));
    const auto* const begin = static_cast<const std::byte*>(frame.cloud.data);
    const std::byte* const end = frame.bytes.data() + frame.bytes.size();
    require(frame.cloud.data_bytes <= static_cast<std::size_t>(end - begin), "a frame describes what it holds");
    take_frame(frame);
  } catch (const tools::FrameError& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}

}  // namespace pose_wall::test

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): the one function of a target
#define POSE_WALL_FUZZ_READER(read)                                                                     \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {                   \
    return pose_wall::test::feed_reader([](auto bytes) { return read(std::move(bytes)); }, data, size); \
  }
