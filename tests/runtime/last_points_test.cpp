// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: in its callback a runtime gives the labelled points that an engine gives of the same frame, bit for bit; of a
// silence the last frame's; and elsewhere it refuses and leaves what it was given as it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "support/engine_under_test.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

struct LabelledPoints {
  explicit LabelledPoints(const pose_wall_points& p)
      : x_base_m(p.x_base_m, p.x_base_m + p.count),
        y_base_m(p.y_base_m, p.y_base_m + p.count),
        z_base_m(p.z_base_m, p.z_base_m + p.count),
        label(p.label, p.label + p.count) {}
  bool operator==(const LabelledPoints& other) const {
    return x_base_m == other.x_base_m && y_base_m == other.y_base_m && z_base_m == other.z_base_m &&
           label == other.label;
  }
  bool has(pose_wall_label wanted) const { return std::count(label.begin(), label.end(), wanted) > 0; }

  std::vector<float> x_base_m, y_base_m, z_base_m;
  std::vector<std::uint8_t> label;
};

// What each callback got.
class LookingRuntime : public RuntimeUnderTest {
 public:
  LookingRuntime() {
    in_callback = [this] {
      pose_wall_points points{};
      status.push_back(pose_wall_runtime_last_points(get(), &points));
      seen.emplace_back(points);
    };
    start();
  }

  std::vector<std::int32_t> status;
  std::vector<LabelledPoints> seen;
};

TEST(RuntimeLastPoints, AreThoseOfAnEngineThatGetsTheSameFrames) {
  LookingRuntime runtime;
  EngineUnderTest engine(small_config());
  for (std::uint32_t frame = 1; frame <= 3; ++frame) {
    const Points room = room_points(frame);
    const std::int64_t stamp_ns = frame * 100 * kMs;
    ASSERT_EQ(runtime.push(room, stamp_ns), POSE_WALL_OK);
    runtime.wait_idle();
    ASSERT_EQ(runtime.seen.size(), frame);
    ASSERT_EQ(runtime.status.back(), POSE_WALL_OK);

    (void)engine.process(cloud_of(room, stamp_ns));
    pose_wall_points points{};
    ASSERT_EQ(pose_wall_last_points(engine.get(), &points), POSE_WALL_OK);
    EXPECT_TRUE(runtime.seen.back() == LabelledPoints(points));
    EXPECT_TRUE(runtime.seen.back().has(POSE_WALL_LABEL_FLOOR));
    EXPECT_TRUE(runtime.seen.back().has(POSE_WALL_LABEL_LEFT));
    EXPECT_TRUE(runtime.seen.back().has(POSE_WALL_LABEL_RIGHT));
  }
}

TEST(RuntimeLastPoints, OfASilenceAreTheLastFrames) {
  LookingRuntime runtime;
  ASSERT_EQ(runtime.push(room_points(1), 100 * kMs), POSE_WALL_OK);
  runtime.wait_idle();
  runtime.pass(2000 * kMs);
  ASSERT_EQ(runtime.published().back().cause, static_cast<std::uint32_t>(POSE_WALL_RUNTIME_SILENCE));
  ASSERT_GE(runtime.seen.size(), 2U);
  EXPECT_EQ(runtime.status.back(), POSE_WALL_OK);
  EXPECT_TRUE(runtime.seen.back() == runtime.seen.front());
}

TEST(RuntimeLastPoints, AreRefusedOutsideTheCallback) {
  LookingRuntime runtime;
  pose_wall_points points{};
  points.count = 77;
  EXPECT_EQ(pose_wall_runtime_last_points(runtime.get(), &points), POSE_WALL_RUNTIME_E_STATE);

  // The callback is called meanwhile, but another thread asks.
  runtime.gate.shut();
  ASSERT_EQ(runtime.push(room_points(1), 100 * kMs), POSE_WALL_OK);
  runtime.gate.wait_until_somebody_is_inside();
  EXPECT_EQ(pose_wall_runtime_last_points(runtime.get(), &points), POSE_WALL_RUNTIME_E_STATE);
  runtime.gate.open();
  runtime.stop();
  EXPECT_EQ(pose_wall_runtime_last_points(runtime.get(), &points), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(points.count, 77U);
}

}  // namespace
}  // namespace pose_wall::test
