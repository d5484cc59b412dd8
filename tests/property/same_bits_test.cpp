// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: nothing but the set of points, the stamps and the config decides the result, to the last bit: not what the
// block held before, not the order of points, not another engine, not how a driver lays the points out.
// Does not prove: equal bits from another compiler or on another machine; tests/digest does.

#include <gtest/gtest.h>

#include <cstring>

#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

sim::SceneSetup rough_road() {
  sim::SceneSetup setup = sim::make_setup("nominal", "os1-64", false, 1);
  setup.machine.turned_left_deg = 4.0;
  setup.machine.roll_deg = 3.0;
  setup.machine.pitch_deg = -2.0;
  setup.machine.speed_mps = 0.2;
  return setup;
}

// The frames of one sequence, rendered once for all cases.
const std::vector<sim::Frame>& frames() {
  static const std::vector<sim::Frame> all = [] {
    const sim::Simulator simulator(rough_road(), 11);
    std::vector<sim::Frame> rendered;
    for (std::uint32_t i = 0; i < 4; ++i) rendered.push_back(simulator.render(i));
    return rendered;
  }();
  return all;
}

pose_wall_config config() {
  return config_for(rough_road());
}

void expect_same_bits(const pose_wall_result& a, const pose_wall_result& b) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_EQ(std::memcmp(&a.quantity[q], &b.quantity[q], sizeof a.quantity[q]), 0)
        << pose_wall_quantity_name(q) << ": " << a.quantity[q].raw << " and " << b.quantity[q].raw;
  }
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);  // no clock is set, so the timings are zero
}

std::vector<pose_wall_result> run(EngineUnderTest* engine) {
  std::vector<pose_wall_result> results;
  for (const sim::Frame& frame : frames()) results.push_back(engine->process(cloud_of(frame)));
  return results;
}

void expect_same_bits(const std::vector<pose_wall_result>& a, const std::vector<pose_wall_result>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_same_bits(a[i], b[i]);
}

TEST(SameBits, TheSequenceMeasuresSomething) {
  EngineUnderTest engine(config());
  for (const pose_wall_result& r : run(&engine)) {
    for (const pose_wall_value& v : r.quantity) EXPECT_GE(v.state, POSE_WALL_DEGRADED);
  }
}

TEST(SameBits, WhateverTheBlockHeld) {
  EngineUnderTest zeros(config(), Dirt::kZeros), ones(config(), Dirt::kOnes), noise(config(), Dirt::kRandom);
  const std::vector<pose_wall_result> expected = run(&zeros);
  expect_same_bits(run(&ones), expected);
  expect_same_bits(run(&noise), expected);
}

TEST(SameBits, WhateverTheOrderOfPoints) {
  EngineUnderTest engine(config());
  const std::vector<pose_wall_result> expected = run(&engine);
  for (const std::uint32_t seed : {1U, 2U}) {
    EngineUnderTest shuffled(config());
    for (std::size_t i = 0; i < frames().size(); ++i) {
      Points points = points_of(frames()[i]);
      shuffle(&points, seed);
      expect_same_bits(shuffled.process(cloud_of(points, frames()[i].stamp_ns)), expected[i]);
    }
  }
}

TEST(SameBits, AfterResetAsAfterOpen) {
  EngineUnderTest engine(config());
  const std::vector<pose_wall_result> expected = run(&engine);
  ASSERT_EQ(pose_wall_reset(engine.get()), POSE_WALL_OK);
  expect_same_bits(run(&engine), expected);
}

TEST(SameBits, EnginesDoNotKnowOfEachOther) {
  EngineUnderTest alone(config());
  const std::vector<pose_wall_result> expected = run(&alone);
  EngineUnderTest first(config()), second(config_with({{"forward_axis", "-Y"}, {"points_max", "7000"}}));
  for (std::size_t i = 0; i < frames().size(); ++i) {
    second.process(cloud_of(frames()[frames().size() - 1 - i]));
    expect_same_bits(first.process(cloud_of(frames()[i])), expected[i]);
  }
}

// A float is a double exactly, so no layout may change a bit.
class SameBitsInAnyLayout : public ::testing::TestWithParam<CloudLayout> {};

TEST_P(SameBitsInAnyLayout, AsInTheNativeOne) {
  EngineUnderTest native(config()), other(config());
  for (const sim::Frame& frame : frames()) {
    Points points = points_of(frame);
    points.resize(points.size() / GetParam().rows * GetParam().rows);
    const EncodedCloud encoded = encode(points, GetParam(), frame.stamp_ns);
    expect_same_bits(other.process(encoded.cloud), native.process(cloud_of(points, frame.stamp_ns)));
  }
}

CloudLayout layout(bool float64, bool big_endian, std::uint32_t offset, std::uint32_t gap, std::uint32_t point_extra,
                   std::uint32_t rows, std::uint32_t row_extra) {
  return {float64, big_endian, offset, gap, point_extra, rows, row_extra};
}

INSTANTIATE_TEST_SUITE_P(Layouts, SameBitsInAnyLayout,
                         ::testing::Values(layout(false, false, 0, 0, 0, 64, 0),    // organised
                                           layout(false, false, 0, 0, 20, 16, 13),  // padded points and rows
                                           layout(false, false, 5, 7, 3, 1, 0),     // unaligned
                                           layout(true, false, 0, 0, 0, 1, 0),      // doubles
                                           layout(true, false, 18, 0, 6, 8, 0),     // doubles at offset 18
                                           layout(false, true, 0, 0, 4, 1, 0),      // big-endian
                                           layout(true, true, 3, 11, 1, 32, 5)));

// Intensity at weight 0 is not read, whatever it holds.
TEST(SameBits, IntensityIsNotReadByDefault) {
  EngineUnderTest without(config()), with(config());
  const sim::Frame& frame = frames()[0];
  pose_wall_cloud cloud = cloud_of(frame);
  const pose_wall_result expected = without.process(cloud);
  cloud.intensity = {12, POSE_WALL_FIELD_FLOAT32};
  expect_same_bits(with.process(cloud), expected);
}

TEST(SameBits, AClockChangesOnlyTheTimings) {
  EngineUnderTest with(config()), without(config());
  std::int64_t now = 0;
  const auto clock = [](void* user) { return *static_cast<std::int64_t*>(user) += 1000; };
  ASSERT_EQ(pose_wall_set_clock(with.get(), clock, &now), POSE_WALL_OK);
  for (const sim::Frame& frame : frames()) {
    pose_wall_result timed = with.process(cloud_of(frame));
    for (std::int64_t& ns : timed.stage_ns) {
      EXPECT_GT(ns, 0);
      ns = 0;
    }
    expect_same_bits(timed, without.process(cloud_of(frame)));
  }
}

}  // namespace
}  // namespace pose_wall::test
