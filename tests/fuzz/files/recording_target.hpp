// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Bytes as a recording of any kind: what it holds tells which. It gives frames that the engine takes, frames with an
// error, or an error for all of it.

#pragma once

#include <stdexcept>
#include <string>

#include "fuzz/files/memory_file.hpp"
#include "fuzz/files/reader_target.hpp"
#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::test {

// That are looked at. A recording of a few bytes may tell of any number of frames.
constexpr int kFramesMax = 64;

inline void take_frames(const std::string& path, const std::string& metadata) {
  tools::InputOptions options;
  options.fullest_topic = true;
  options.packets.metadata = metadata;
  try {
    tools::FrameSequence frames({path}, options);
    for (int i = 0; i < kFramesMax; ++i) {
      const auto next = frames.next();
      if (!next) break;
      require(next->frame.has_value() != !next->error.empty(), "a frame or an error");
      if (next->frame) take_frame(*next->frame);
    }
    frames.about();
  } catch (const std::invalid_argument& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  } catch (const tools::FrameError& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
}

}  // namespace pose_wall::test
