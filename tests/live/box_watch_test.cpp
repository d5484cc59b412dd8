// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a black box that cannot be written, or has gaps, is a warning that says why, and it ends when records are
// written again.

#include "apps/live/box_watch.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>

#include "apps/live/clocks.hpp"
#include "apps/live/health_words.hpp"
#include "apps/live/live_runtime.hpp"
#include "live/frame_catcher.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::becomes_true;
using pose_wall::test::fact;

constexpr std::int64_t kBoxSecond_ns = 1'000'000'000;  // the clock of the daemon counts in ns

// A file that takes what it is given, or fails by the system's number of a fault.
struct Disk {
  std::shared_ptr<BlackBox::State> state = std::make_shared<BlackBox::State>();
  std::atomic<int> fault{0};

  static std::int32_t write(void* user, std::uint64_t, const void*, std::uint64_t) {
    Disk& disk = *static_cast<Disk*>(user);
    const int fault = disk.fault;
    disk.state->fault = fault;
    return fault == 0 ? 0 : -1;
  }
  BlackBox box() {
    BlackBox box;
    box.write = write;
    box.user = this;
    box.bytes = 1 << 20;  // enough for records without clouds
    box.state = state;
    return box;
  }
};

PartHealth told(BoxWatch* watch, const BlackBox& box, std::uint64_t lost, std::int64_t now_ns) {
  PartHealth health{"runtime", Grade::kGood, "measures", {}};
  pose_wall_runtime_statistics now{};
  now.box_lost = lost;
  watch->tell(box, now, now_ns, &health);
  return health;
}

TEST(BoxWatch, TellsTheSystemsFaultUntilItIsOver) {
  Disk disk;
  BoxWatch watch;
  EXPECT_EQ(told(&watch, disk.box(), 0, 0).summary, "measures");
  disk.state->fault = ENOSPC;
  const PartHealth full = told(&watch, disk.box(), 0, 0);
  EXPECT_EQ(full.grade, Grade::kWarning);
  EXPECT_EQ(full.summary, "measures; the black box is not written: No space left on device");
  EXPECT_EQ(in_language(Language::kChinese, full).summary, "正在测量；黑匣子没有写入：磁盘已满");
  disk.state->fault = 0;
  EXPECT_EQ(told(&watch, disk.box(), 0, 0).grade, Grade::kGood);
}

TEST(BoxWatch, GapsAreAWarningUntilTheDiskKeepsUp) {
  Disk disk;
  BoxWatch watch;
  EXPECT_EQ(told(&watch, disk.box(), 0, kBoxSecond_ns).grade, Grade::kGood);
  EXPECT_EQ(told(&watch, disk.box(), 3, 2 * kBoxSecond_ns).summary,
            "measures; the black box has gaps: its disk is slow");
  EXPECT_EQ(told(&watch, disk.box(), 3, 11 * kBoxSecond_ns).grade, Grade::kWarning);
  EXPECT_EQ(told(&watch, disk.box(), 3, 13 * kBoxSecond_ns).grade, Grade::kGood);
}

TEST(BoxWatch, AFaultOfTheRuntimeStaysTheWorseOne) {
  BoxWatch watch;
  PartHealth health{"runtime", Grade::kBad, "no frame comes", {}};
  watch.tell(BlackBox{}, {}, kBoxSecond_ns, &health);
  EXPECT_EQ(health.grade, Grade::kBad);
  EXPECT_EQ(health.summary, "no frame comes; the black box is not written: its file cannot be made");
}

TEST(BoxWatch, TheRuntimesHealthHasIt) {
  Disk disk;
  disk.fault = EIO;
  LiveRuntime runtime(
      load_config("", {"black_box=boxes"}), [&disk] { return disk.box(); },
      [](const std::shared_ptr<const LiveResult>&) {}, [] { return false; });
  runtime.start();
  const auto is_warned = [&] {
    return runtime.health().summary.find("the black box is not written: ") != std::string::npos;
  };
  EXPECT_TRUE(becomes_true(is_warned)) << "silence is written, too";
  EXPECT_TRUE(becomes_true([&] { return std::stoul(fact(runtime.health(), "black box failed")) > 0; }));
  disk.fault = 0;
  EXPECT_TRUE(becomes_true([&] { return !is_warned(); })) << "the header is tried again and again";
  EXPECT_NE(fact(runtime.health(), "black box written"), "0");
  runtime.stop();
}

}  // namespace
}  // namespace pose_wall::tools::live
