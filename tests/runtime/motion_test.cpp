// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: with motion a runtime publishes bit for bit what pose_wall_motion_process_both gives by hand, also from the
// black box; times and rings go along where a point has room for them; the key `motion`, a table that is missing and
// one that refuses leave the engine's frame as it would be without; silence and what is stale have no motion, and their
// image says so.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "pose_wall_box.h"
#include "support/engine_under_test.hpp"
#include "support/motion_under_test.hpp"
#include "support/record.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

using Change = RuntimeUnderTest::Change;

Change with_motion(const pose_wall_motion_functions* functions = pose_wall_motion_functions_get()) {
  return [functions](pose_wall_runtime_options* o) {
    o->motion = functions;
    o->point_bytes_max = 24;
  };
}

pose_wall_config config_with(const char* motion) {
  pose_wall_config config = small_config();
  EXPECT_EQ(pose_wall_config_set(&config, "motion", motion), POSE_WALL_OK);
  return config;
}

struct TimedPoint {
  float x, y, z;
  float time_s;
  std::uint16_t ring;
  std::uint16_t unused;
};

// A ribbed road, seen from a place that moves; some frames show nothing, some have inputs of the machine.
struct Frame {
  std::vector<TimedPoint> points;
  pose_wall_inputs inputs{};
  pose_wall_cloud cloud{};

  explicit Frame(std::uint32_t number, std::int64_t stamp_ns) {
    const Points seen = number % 4 == 3 ? Points() : ribbed_room_points(number + 1);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      points.push_back({seen[i][0], seen[i][1], seen[i][2],
                        static_cast<float>(i) / static_cast<float>(seen.size()) * 0.1F,
                        static_cast<std::uint16_t>(std::fabs(seen[i][2]) * 10.0F), 0xEEEE});
    }
    pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size()), sizeof(TimedPoint),
                          stamp_ns);
    cloud.time = {offsetof(TimedPoint, time_s), POSE_WALL_FIELD_FLOAT32};
    cloud.ring = {offsetof(TimedPoint, ring), POSE_WALL_FIELD_UINT16};
    inputs.struct_size = sizeof inputs;
    inputs.given = POSE_WALL_INPUT_SPEED;
    inputs.speed_m_s = 0.01 * number;
    inputs.speed_sigma_m_s = 0.1;
    if (number % 3 == 1) cloud.inputs = &inputs;
  }
};

std::vector<Frame> road(std::uint32_t count = 9) {
  std::vector<Frame> frames;
  for (std::uint32_t i = 0; i < count; ++i) frames.emplace_back(i, i * 100 * kMs);
  for (Frame& f : frames) {  // the vector may have moved them
    if (f.cloud.inputs != nullptr) f.cloud.inputs = &f.inputs;
    f.cloud.data = f.points.data();
  }
  return frames;
}

RuntimeUnderTest::Publications run(RuntimeUnderTest* runtime, const std::vector<Frame>& frames) {
  runtime->start();
  for (const Frame& frame : frames) {
    EXPECT_EQ(pose_wall_runtime_push(runtime->get(), &frame.cloud), POSE_WALL_OK);
    runtime->wait_idle();
  }
  runtime->stop();
  return runtime->published();
}

struct Both {
  pose_wall_result result{};
  pose_wall_motion_result motion{};
};

// By hand: motion and engine one behind the other.
std::vector<Both> by_hand(const std::vector<Frame>& frames, bool time = true, bool ring = true) {
  MotionUnderTest motion(small_config());
  EngineUnderTest engine(small_config());
  std::vector<Both> all;
  for (const Frame& frame : frames) {
    pose_wall_cloud cloud = frame.cloud;
    if (!time) cloud.time = {};
    if (!ring) cloud.ring = {};
    Both both;
    both.result.struct_size = sizeof both.result;
    both.motion.struct_size = sizeof both.motion;
    EXPECT_EQ(pose_wall_motion_process_both(motion.get(), engine.get(), &cloud, &both.motion, &both.result),
              POSE_WALL_OK);
    all.push_back(both);
  }
  return all;
}

template <typename T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void expect_same(const RuntimeUnderTest::Publications& published, const std::vector<Both>& expected) {
  ASSERT_EQ(published.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(published[i].has_motion, 1U) << i;
    EXPECT_EQ(published[i].motion_status, POSE_WALL_OK) << i;
    EXPECT_TRUE(same_bits(published[i].result, expected[i].result)) << "engine, frame " << i;
    EXPECT_TRUE(same_bits(published[i].motion, expected[i].motion)) << "motion, frame " << i;
  }
}

bool has_no_pose(const pose_wall_motion_result& m) {
  return m.along_state == POSE_WALL_ALONG_LOST && std::isnan(m.position_m[0]) && std::isnan(m.along_m) &&
         std::isnan(m.step_s) && std::isinf(m.protection_level[POSE_WALL_MOTION_ALONG]) && m.run == 0;
}

TEST(RuntimeMotion, IsWhatBothGiveByHand) {
  const std::vector<Frame> frames = road();
  RuntimeUnderTest runtime(with_motion());
  const auto published = run(&runtime, frames);
  const std::vector<Both> expected = by_hand(frames);
  expect_same(published, expected);
  EngineUnderTest alone(small_config());
  std::uint32_t others = 0, poses = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    others += same_bits(alone.process(frames[i].cloud), expected[i].result) ? 0U : 1U;
    poses += expected[i].motion.along_state != POSE_WALL_ALONG_LOST ? 1U : 0U;
  }
  EXPECT_GT(others, 0U) << "else nothing was proved: the odometry makes no difference here";
  EXPECT_GT(poses, 3U);
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.motion.count, frames.size());
  EXPECT_EQ(s.work.count, frames.size());
  EXPECT_EQ(s.motion_refused, 0U);
}

TEST(RuntimeMotion, TimesAndRingsGoAlongWhereAPointHasRoom) {
  const std::vector<Frame> frames = road(4);
  const auto with_point_bytes = [&](std::uint32_t bytes) {
    RuntimeUnderTest runtime([&](pose_wall_runtime_options* o) {
      with_motion()(o);
      o->point_bytes_max = bytes;
    });
    return run(&runtime, frames);
  };
  for (const std::uint32_t bytes : {18U, 24U, 48U}) expect_same(with_point_bytes(bytes), by_hand(frames));
  for (const std::uint32_t bytes : {16U, 17U}) expect_same(with_point_bytes(bytes), by_hand(frames, true, false));
  expect_same(with_point_bytes(15), by_hand(frames, false, true));
  for (const std::uint32_t bytes : {12U, 13U}) expect_same(with_point_bytes(bytes), by_hand(frames, false, false));
  EXPECT_FALSE(same_bits(by_hand(frames)[2].motion, by_hand(frames, false, false)[2].motion)) << "else all are alike";
}

TEST(RuntimeMotion, NoReturnsAreLeftOutAndCounted) {
  std::vector<Frame> frames = road(2);
  for (Frame& frame : frames) frame.cloud.time = {};  // with times the first and the last are copied
  const auto whole = static_cast<std::uint32_t>(frames[1].points.size());
  const std::vector<Both> expected = by_hand(frames);
  frames[1].points.push_back({0.0F, 0.0F, 0.0F, 0.0F, 0, 0});
  frames[1].points.push_back({std::nanf(""), 0.0F, 0.0F, 0.0F, 0, 0});
  frames[1].cloud.data = frames[1].points.data();
  frames[1].cloud.width = whole + 2;
  frames[1].cloud.data_bytes = frames[1].points.size() * sizeof(TimedPoint);
  RuntimeUnderTest runtime(with_motion());
  const auto published = run(&runtime, frames);
  pose_wall_motion_result counted = expected[1].motion;
  counted.points_in += 2;
  EXPECT_TRUE(same_bits(published[1].motion, counted));
  EXPECT_EQ(published[1].result.points_in, whole + 2);
}

TEST(RuntimeMotion, WithoutItTheEngineIsAlone) {
  const std::vector<Frame> frames = road(5);
  const auto needed = [](const pose_wall_motion_functions* functions, const char* key) {
    pose_wall_runtime_options o;
    pose_wall_runtime_options_init(&o);
    o.motion = functions;
    const pose_wall_config config = config_with(key);
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_runtime_memory_needed(&config, &o, &bytes), POSE_WALL_OK);
    return bytes;
  };
  const pose_wall_motion_functions* const functions = pose_wall_motion_functions_get();
  EXPECT_EQ(needed(functions, "off"), needed(nullptr, "on"));
  EXPECT_GE(needed(functions, "on"), needed(nullptr, "on") + pose_wall_motion_memory_needed());
  for (const char* key : {"off", "on"}) {
    const pose_wall_config config = config_with(key);
    RuntimeUnderTest runtime(with_motion(std::string(key) == "off" ? functions : nullptr), config);
    const auto published = run(&runtime, frames);
    ASSERT_EQ(published.size(), frames.size());
    EngineUnderTest engine(config);
    const pose_wall_motion_result nothing{};
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_TRUE(same_bits(published[i].result, engine.process(frames[i].cloud))) << key << i;
      EXPECT_EQ(published[i].has_motion, 0U);
      EXPECT_TRUE(same_bits(published[i].motion, nothing));
    }
    pose_wall_motion_image image{};
    image.struct_size = sizeof image;
    EXPECT_EQ(pose_wall_runtime_motion_image(runtime.get(), &image), POSE_WALL_RUNTIME_E_MOTION);
    EXPECT_EQ(image.version, 0U) << "unchanged";
    EXPECT_EQ(runtime.statistics().motion.count, 0U);
  }
}

// Some odometry of the caller's own: it drives along x.
pose_wall_odometry own_odometry(std::uint32_t frame) {
  pose_wall_odometry o{};
  o.run = 7;
  o.position_m[0] = 0.05 * frame;
  o.quaternion[3] = o.along[0] = o.across[1] = 1.0;
  for (double& level : o.level) level = 0.001;
  return o;
}

TEST(RuntimeMotion, TheCallersOwnOdometryCountsWithoutItAlone) {
  std::vector<Frame> frames = road(5);
  std::vector<Frame> plain = road(5);
  for (std::uint32_t i = 0; i < frames.size(); ++i) {
    frames[i].cloud.inputs = &frames[i].inputs;
    frames[i].inputs.given = POSE_WALL_INPUT_ODOMETRY;
    frames[i].inputs.odometry = own_odometry(i);
    plain[i].cloud.inputs = nullptr;
  }
  RuntimeUnderTest with(with_motion()), without;
  expect_same(run(&with, frames), by_hand(plain));
  const auto published = run(&without, frames);
  EngineUnderTest engine(small_config()), alone(small_config());
  std::uint32_t others = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const pose_wall_result expected = engine.process(frames[i].cloud);
    EXPECT_TRUE(same_bits(published[i].result, expected)) << i;
    others += same_bits(alone.process(plain[i].cloud), expected) ? 0U : 1U;
  }
  EXPECT_GT(others, 0U);
}

// Times count from a scan's first point, whether it holds a return or not.
TEST(RuntimeMotion, TimesOfPointsWithoutAReturnCount) {
  std::vector<Frame> whole = road(3), bare = road(3);
  EngineUnderTest engine(small_config()), misled(small_config());
  std::uint32_t others = 0;
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->point_bytes_max = 24; });
  for (std::uint32_t i = 0; i < whole.size(); ++i) {
    for (Frame* frame : {&whole[i], &bare[i]}) {
      frame->cloud.inputs = &frame->inputs;
      frame->inputs.given = POSE_WALL_INPUT_ODOMETRY;
      frame->inputs.odometry = own_odometry(i);
      frame->inputs.odometry.velocity_m_s[0] = 1.5;
    }
    Frame& frame = whole[i];
    for (const float time_s : {0.05F, -0.02F, 0.0F, 0.13F, 0.1F}) {
      frame.points.push_back({0.0F, 0.0F, time_s > 0.1F ? std::nanf("") : 0.0F, time_s, 0, 0});
    }
    frame.cloud.data = frame.points.data();
    frame.cloud.width = static_cast<std::uint32_t>(frame.points.size());
    frame.cloud.data_bytes = frame.points.size() * sizeof(TimedPoint);
  }
  const auto published = run(&runtime, whole);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const pose_wall_result expected = engine.process(whole[i].cloud);
    EXPECT_TRUE(same_bits(published[i].result, expected)) << i;
    others += misled.process(bare[i].cloud).floor.d_m != expected.floor.d_m ? 1U : 0U;
  }
  EXPECT_GT(others, 0U) << "else they make no difference";
}

TEST(RuntimeMotion, EachStartBeginsANewMap) {
  const std::vector<Frame> frames = road(3);
  RuntimeUnderTest runtime(with_motion());
  run(&runtime, frames);
  run(&runtime, frames);
  const auto published = runtime.published();
  ASSERT_EQ(published.size(), 6U);
  for (const std::size_t first : {0U, 3U}) {
    EXPECT_NE(published[first].motion.reasons & POSE_WALL_MOTION_R_FIRST, 0U);
    EXPECT_EQ(published[first].motion.frame_index, 0U);
  }
  EXPECT_NE(published[0].motion.run, published[3].motion.run);
}

// ------------------------------------------------------------------------------------------ what refuses

// Of the table that the tests hand over: where motion was placed, and what it is to say.
struct Saboteur {
  static inline void* block = nullptr;
  static inline int opened = 0;
  static inline int refuse = 0;  // so many frames more

  static std::int32_t open(const pose_wall_config* config, const pose_wall_motion_settings* settings, void* at,
                           std::uint64_t bytes, pose_wall_motion** motion) {
    block = at;
    ++opened;
    return pose_wall_motion_open(config, settings, at, bytes, motion);
  }
  static std::int32_t process(pose_wall_motion* motion, const pose_wall_cloud* cloud, pose_wall_motion_result* result) {
    if (refuse == 0) return pose_wall_motion_process(motion, cloud, result);
    --refuse;
    return POSE_WALL_E_CLOUD_FIELD;
  }
  static const pose_wall_motion_functions* table() {
    static pose_wall_motion_functions functions;
    functions = *pose_wall_motion_functions_get();
    functions.open = open;
    functions.process = process;
    block = nullptr;
    opened = refuse = 0;
    return &functions;
  }
};

void expect_frame_without_motion(const pose_wall_publication& p, std::int32_t status) {
  EXPECT_EQ(p.cause, std::uint32_t{POSE_WALL_RUNTIME_FRAME});
  EXPECT_EQ(p.has_motion, 0U);
  EXPECT_EQ(p.motion_status, status);
  EXPECT_TRUE(has_no_pose(p.motion));
}

TEST(RuntimeMotion, WhatItRefusesIsWorkedWithoutIt) {
  std::vector<Frame> frames = road(3);
  for (Frame& frame : frames) frame.cloud.inputs = nullptr;
  RuntimeUnderTest runtime(with_motion(Saboteur::table()));
  Saboteur::refuse = 3;
  const auto published = run(&runtime, frames);
  EngineUnderTest engine(small_config());
  ASSERT_EQ(published.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    expect_frame_without_motion(published[i], POSE_WALL_E_CLOUD_FIELD);
    EXPECT_TRUE(same_bits(published[i].result, engine.process(frames[i].cloud))) << i;
  }
  EXPECT_EQ(runtime.statistics().motion_refused, 3U);
  EXPECT_EQ(dropped(runtime.statistics()), 0U);
}

TEST(RuntimeMotion, ADamagedBlockIsOpenedAnewAndCostsNoFrame) {
  const std::vector<Frame> frames = road(3);
  RuntimeUnderTest runtime(with_motion(Saboteur::table()));
  runtime.start();
  const auto push = [&](const Frame& frame) {
    EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &frame.cloud), POSE_WALL_OK);
    runtime.wait_idle();
  };
  push(frames[0]);
  ASSERT_NE(Saboteur::block, nullptr);
  std::memset(Saboteur::block, 0xA5, 64);
  push(frames[1]);
  push(frames[2]);
  const auto published = runtime.published();
  ASSERT_EQ(published.size(), 3U);
  expect_frame_without_motion(published[1], POSE_WALL_E_ENGINE);
  EXPECT_NE(published[1].result.points_in, 0U);
  EXPECT_EQ(published[2].has_motion, 1U);
  EXPECT_NE(published[2].motion.reasons & POSE_WALL_MOTION_R_FIRST, 0U);
  EXPECT_NE(published[2].motion.run, published[0].motion.run);
  EXPECT_EQ(Saboteur::opened, 2);
  // Between two starts as well.
  runtime.stop();
  std::memset(Saboteur::block, 0xA5, 64);
  runtime.start();
  push(frames[0]);
  EXPECT_EQ(runtime.published().back().has_motion, 1U);
}

TEST(RuntimeMotion, OptionsThatAreNone) {
  const auto fault_of = [](const Change& change) {
    pose_wall_runtime_options o;
    pose_wall_runtime_options_init(&o);
    change(&o);
    const char* option = "";
    const std::int32_t status = pose_wall_runtime_options_check(&o, &option);
    EXPECT_EQ(status, *option == '\0' ? std::int32_t{POSE_WALL_OK} : POSE_WALL_RUNTIME_E_OPTION);
    return std::string(option);
  };
  pose_wall_motion_functions other = *pose_wall_motion_functions_get();
  const auto hand_over = [&](pose_wall_runtime_options* o) { o->motion = &other; };
  EXPECT_EQ(fault_of(hand_over), "");
  other.abi_version += 1;
  EXPECT_EQ(fault_of(hand_over), "motion");
  other.abi_version -= 1;
  other.struct_size -= 8;
  EXPECT_EQ(fault_of(hand_over), "motion");
  pose_wall_motion_settings settings = motion_settings();
  const auto set = [&](pose_wall_runtime_options* o) {
    with_motion()(o);
    o->motion_settings = &settings;
  };
  EXPECT_EQ(fault_of(set), "");
  settings.speed_max_m_s = -1.0;
  EXPECT_EQ(fault_of(set), "motion_settings");
}

TEST(RuntimeMotion, SettingsAreCopiedByOpen) {
  const std::vector<Frame> frames = road(4);
  pose_wall_motion_settings settings = motion_settings();
  settings.speed_max_m_s = 0.5;
  MotionUnderTest motion(small_config(), Dirt::kRandom, settings);
  RuntimeUnderTest runtime([&](pose_wall_runtime_options* o) {
    with_motion()(o);
    o->motion_settings = &settings;
  });
  settings.speed_max_m_s = 20.0;
  const auto published = run(&runtime, frames);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_TRUE(same_bits(published[i].motion, motion.process(frames[i].cloud))) << i;
  }
}

// ------------------------------------------------------------------------------------------ silence and images

pose_wall_motion_image image_of(const RuntimeUnderTest& runtime, std::int32_t expected) {
  pose_wall_motion_image image{};
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_runtime_motion_image(runtime.get(), &image), expected);
  EXPECT_EQ(pose_wall_motion_image_check(&image), POSE_WALL_OK);
  return image;
}

void expect_no_value(const pose_wall_motion_image& image) {
  EXPECT_EQ(image.run, 0U);
  EXPECT_EQ(image.travel_mm, POSE_WALL_IMAGE_NO_VALUE);
  EXPECT_EQ(image.yaw_mdeg, POSE_WALL_IMAGE_NO_VALUE);
  EXPECT_EQ(image.speed_mm_s, POSE_WALL_IMAGE_NO_VALUE);
  EXPECT_EQ(image.travel_protection_mm, POSE_WALL_IMAGE_NO_BOUND);
  EXPECT_EQ(image.yaw_protection_mdeg, POSE_WALL_IMAGE_NO_BOUND);
}

TEST(RuntimeMotion, SilenceHasNoneAndItsImageSaysSo) {
  const std::vector<Frame> frames = road(3);
  RuntimeUnderTest runtime(with_motion());
  expect_no_value(image_of(runtime, POSE_WALL_RUNTIME_E_STATE));
  runtime.start();
  pose_wall_motion_image image = image_of(runtime, POSE_WALL_RUNTIME_E_NOTHING);
  expect_no_value(image);
  EXPECT_EQ(image.sequence, 0U);
  for (const Frame& frame : frames) {
    EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &frame.cloud), POSE_WALL_OK);
    runtime.wait_idle();
  }
  image = image_of(runtime, POSE_WALL_OK);
  EXPECT_NE(image.run, 0U);
  EXPECT_EQ(image.sequence, 3U);
  EXPECT_EQ(image.publication, 3U);
  EXPECT_EQ(image.told_by, 1U);
  EXPECT_EQ(image.travel_mm, std::lround(runtime.latest().motion.along_m * 1000.0));
  std::uint32_t crc = 0;
  const pose_wall_config config = small_config();
  pose_wall_config_crc(&config, &crc);
  EXPECT_EQ(image.config_crc32, crc);

  runtime.pass(300 * kMs);
  const pose_wall_publication p = runtime.latest();
  EXPECT_EQ(p.cause, std::uint32_t{POSE_WALL_RUNTIME_SILENCE});
  EXPECT_EQ(p.has_motion, 0U);
  EXPECT_EQ(p.motion_status, POSE_WALL_OK);
  EXPECT_TRUE(has_no_pose(p.motion));
  EXPECT_EQ(p.motion.frame_index, 2U);
  image = image_of(runtime, POSE_WALL_OK);
  expect_no_value(image);
  EXPECT_EQ(image.told_by, 2U);
  EXPECT_EQ(image.sequence, 3U) << "of the last frame";
  EXPECT_EQ(image.publication, 4U);
}

TEST(RuntimeMotion, WhatIsStaleIsNotTold) {
  const std::vector<Frame> frames = road(1);
  RuntimeUnderTest runtime(with_motion());
  runtime.start();
  runtime.gate.shut();
  EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &frames[0].cloud), POSE_WALL_OK);
  runtime.gate.wait_until_somebody_is_inside();
  EXPECT_NE(image_of(runtime, POSE_WALL_OK).run, 0U);
  runtime.clock.advance(400 * kMs);
  expect_no_value(image_of(runtime, POSE_WALL_RUNTIME_E_STALE));
  pose_wall_publication p{};
  p.struct_size = sizeof p;
  EXPECT_EQ(pose_wall_runtime_latest(runtime.get(), &p), POSE_WALL_RUNTIME_E_STALE);
  EXPECT_EQ(p.has_motion, 0U);
  EXPECT_TRUE(has_no_pose(p.motion));
  runtime.gate.open();
}

// ------------------------------------------------------------------------------------------ black box

TEST(RuntimeMotion, TheBlackBoxHoldsItAndComputesToTheSameBits) {
  Record bytes;
  const std::vector<Frame> frames = road();
  RuntimeUnderTest runtime([&](pose_wall_runtime_options* o) {
    with_motion()(o);
    o->sink = write_record;
    o->sink_user = &bytes;
    o->box_bytes = 64 << 20;
  });
  runtime.start();
  for (const Frame& frame : frames) {
    EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &frame.cloud), POSE_WALL_OK);
    runtime.wait_idle();
  }
  runtime.pass(300 * kMs);
  runtime.stop();
  const auto published = runtime.published();
  pose_wall_box_info info;
  ASSERT_EQ(pose_wall_box_open(bytes.data(), bytes.size(), &info), POSE_WALL_OK);
  std::uint32_t format = 0;
  char version[24] = {};
  ASSERT_EQ(pose_wall_box_written_by(bytes.data(), bytes.size(), &format, version), POSE_WALL_OK);
  EXPECT_EQ(format, std::uint32_t{POSE_WALL_BOX_VERSION});
  EXPECT_STREQ(version, pose_wall_version());
  EngineUnderTest engine(info.config);
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record r;
  std::size_t event = 0;
  for (; pose_wall_box_next(bytes.data(), bytes.size(), &offset, &r) == POSE_WALL_OK; ++event) {
    ASSERT_LT(event, published.size());
    const pose_wall_publication& p = published[event];
    pose_wall_result again{};
    again.struct_size = sizeof again;
    ASSERT_EQ(pose_wall_box_compute(&r, engine.get(), &again), POSE_WALL_OK) << event;
    EXPECT_TRUE(same_bits(again, p.result)) << event;
    ASSERT_EQ(r.motion != nullptr, p.cause == POSE_WALL_RUNTIME_FRAME) << event;
    if (r.motion == nullptr) continue;
    EXPECT_EQ(std::memcmp(r.motion, &p.motion, sizeof p.motion), 0) << event;
    EXPECT_EQ(r.time.type, std::uint32_t{POSE_WALL_FIELD_FLOAT32});
    EXPECT_EQ(r.ring.type, std::uint32_t{POSE_WALL_FIELD_UINT16});
    pose_wall_inputs inputs;
    ASSERT_NE(r.inputs, nullptr);
    std::memcpy(&inputs, r.inputs, sizeof inputs);
    ASSERT_NE(inputs.given & POSE_WALL_INPUT_ODOMETRY, 0U) << event;
    EXPECT_EQ(std::isfinite(inputs.odometry.level[POSE_WALL_MOTION_YAW]), p.motion.along_state != POSE_WALL_ALONG_LOST)
        << event;
  }
  EXPECT_EQ(event, frames.size() + 1);
}

}  // namespace
}  // namespace pose_wall::test
