// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as the file that `pose_wall replay-box` is given, its checksums made right as in box_fuzz.cpp.

#include <stdexcept>
#include <vector>

#include "fuzz/files/memory_file.hpp"
#include "fuzz/fuzz_target.hpp"
#include "fuzz/mended_box.hpp"
#include "io/box/box_replay.hpp"

namespace {

// A config may ask for any block it likes; filling large ones would be all that the fuzzer does.
bool is_quick(const std::vector<unsigned char>& box) {
  pose_wall_box_info info;
  std::uint64_t bytes = 0;
  if (pose_wall_box_open(box.data(), box.size(), &info) != POSE_WALL_OK) return true;
  return pose_wall_memory_needed(&info.config, &bytes) != POSE_WALL_OK || bytes < (4U << 20U);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pose_wall::test::require;
  if (size < 1) return 0;
  std::vector<unsigned char> box(data + 1, data + size);
  pose_wall::test::mend_box(box.data(), box.size(), data[0]);
  if (!is_quick(box)) return 0;
  const pose_wall::test::MemoryFile file(box.data(), box.size());
  try {
    const pose_wall::tools::BoxReplay replay = pose_wall::tools::replay_box(file.path(), nullptr);
    require(replay.equal + replay.different + replay.digests_only + replay.refused == replay.records,
            "every record is one of these");
    const std::uint64_t of_a_kind = replay.frames + replay.silences;
    require(of_a_kind <= replay.records && replay.records - of_a_kind <= replay.refused, "an unknown kind is refused");
    require(replay.left_over <= replay.records, "what is left over is part of them");
    require(replay.missing <= replay.last_sequence, "no more are missing than there were");
    require(replay.first.has_value() == (replay.different > 0), "the first difference is named");
  } catch (const std::runtime_error& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
