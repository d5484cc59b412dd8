// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Recorded files without a header: KITTI's x y z intensity, an OS0's x y z, and times that are no points at all.
// Proves: the numbers tell the layouts apart, also where the size would fit another; times are refused.

#include <gtest/gtest.h>

#include <string>

#include "io/frames/bare_layout_guess.hpp"
#include "io/frames/load_frame.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

class BareRecordings : public RealFrames {
 protected:
  static tools::Bytes bytes_of(const char* file) { return tools::read_frame_bytes(data_folder() / file); }

  // The first points, so that the size fits every layout that is known.
  static tools::BareGuess guess_of(tools::Bytes bytes) {
    constexpr std::size_t kFitsAll = 480;
    bytes.resize(bytes.size() / kFitsAll * kFitsAll);
    return tools::guess_bare_layout(bytes);
  }
};

TEST_F(BareRecordings, AreReadByTheirNumbers) {
  const std::pair<const char*, const char*> cases[] = {{"negative/street_kitti.bin", "xyzi"},
                                                       {"deskew_newer/raw_00.bin", "xyz"},
                                                       {"deskew_newer/raw_01.bin", "xyz"},
                                                       {"deskew_newer/raw_02.bin", "xyz"},
                                                       {"deskew_newer/deskewed_00.bin", "xyz"}};
  for (const auto& [file, word] : cases) {
    const tools::BareGuess guess = guess_of(bytes_of(file));
    EXPECT_TRUE(guess.is_clear) << file;
    ASSERT_FALSE(guess.possible.empty()) << file;
    EXPECT_EQ(tools::bare_layout_word(guess.possible.front()), word) << file;
    EXPECT_GT(tools::load_frame(data_folder() / file).cloud.width, 10000U) << file;
  }
}

TEST_F(BareRecordings, TimesAreNoPoints) {
  for (const char* file : {"deskew_newer/times_00.bin", "deskew_newer/times_01.bin"}) {
    EXPECT_FALSE(guess_of(bytes_of(file)).is_clear) << file;
  }
}

}  // namespace
}  // namespace pose_wall::test
