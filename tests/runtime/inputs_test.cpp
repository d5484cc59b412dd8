// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what the machine knows of itself goes with its frame through the queue into the engine and the black box,
// bit for bit, and into no other frame. After a dropped frame nothing is believed of its motion. The caller may change
// it when push has come back. What is malformed is refused like a malformed cloud. What was saved is taken up by the
// next start, and by it alone.

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "base/math/crc32.hpp"
#include "pose_wall_box.h"
#include "runtime/box_layout.hpp"
#include "support/engine_under_test.hpp"
#include "support/record.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

// Another one for every frame; of some none.
bool inputs_of(std::uint32_t frame, pose_wall_inputs* inputs) {
  *inputs = pose_wall_inputs{};
  inputs->struct_size = sizeof *inputs;
  inputs->given = frame % 4;
  inputs->speed_m_s = 0.05 * frame;
  inputs->speed_sigma_m_s = 0.01;
  const double box[6] = {-3.0 - frame, 0.5, -0.5, 0.5, -1.0, 1.0 + frame};
  if (frame % 3 != 1) std::memcpy(inputs->body_box[frame % POSE_WALL_INPUT_BOXES], box, sizeof box);
  return frame % 5 != 4;
}

// Every third frame shows nothing: it is held by what the inputs say of it.
Points points_of(std::uint32_t frame) {
  return frame % 3 == 2 ? Points() : room_points(frame);
}

constexpr std::uint32_t kFrames = 12;

RuntimeUnderTest::Publications run(RuntimeUnderTest* runtime) {
  runtime->start();
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const Points points = points_of(frame);
    pose_wall_cloud cloud = cloud_of(points, frame * 100 * kMs);
    pose_wall_inputs inputs;
    if (inputs_of(frame, &inputs)) cloud.inputs = &inputs;
    runtime->gate.shut();  // what is pushed waits, and the caller's inputs are gone when it is worked
    EXPECT_EQ(pose_wall_runtime_push(runtime->get(), &cloud), POSE_WALL_OK);
    std::memset(&inputs, 0xEE, sizeof inputs);
    runtime->gate.open();
    runtime->wait_idle();
  }
  runtime->stop();
  return runtime->published();
}

TEST(RuntimeInputs, GoWithTheirFrame) {
  RuntimeUnderTest runtime;
  const auto published = run(&runtime);
  ASSERT_EQ(published.size(), kFrames);
  EngineUnderTest engine(small_config()), without(small_config());
  std::uint32_t others = 0;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const Points points = points_of(frame);
    pose_wall_cloud cloud = cloud_of(points, frame * 100 * kMs);
    pose_wall_result plain = without.process(cloud), expected{};
    pose_wall_inputs inputs;
    if (inputs_of(frame, &inputs)) cloud.inputs = &inputs;
    expected = engine.process(cloud);
    EXPECT_EQ(std::memcmp(&published[frame].result, &expected, sizeof expected), 0) << frame;
    others += std::memcmp(&plain, &expected, sizeof plain) != 0 ? 1U : 0U;
  }
  EXPECT_GT(others, 0U) << "else nothing was proved: inputs make no difference here";
}

TEST(RuntimeInputs, AreInTheBlackBoxAndComputeToTheSameBits) {
  Record bytes;
  RuntimeUnderTest runtime([&](pose_wall_runtime_options* o) {
    o->sink = write_record;
    o->sink_user = &bytes;
    o->box_bytes = 64 << 20;
  });
  const auto published = run(&runtime);
  pose_wall_box_info info;
  ASSERT_EQ(pose_wall_box_open(bytes.data(), bytes.size(), &info), POSE_WALL_OK);
  EngineUnderTest engine(info.config);
  std::uint64_t offset = POSE_WALL_BOX_HEADER_BYTES;
  pose_wall_box_record r;
  std::uint32_t frame = 0;
  for (; pose_wall_box_next(bytes.data(), bytes.size(), &offset, &r) == POSE_WALL_OK; ++frame) {
    ASSERT_EQ(r.damaged, std::uint32_t{POSE_WALL_BOX_WHOLE});
    pose_wall_inputs inputs;
    const bool given = inputs_of(frame, &inputs);
    ASSERT_EQ(r.inputs != nullptr, given) << frame;
    if (given) {
      EXPECT_EQ(std::memcmp(r.inputs, &inputs, sizeof inputs), 0) << frame;
    }
    pose_wall_result again{};
    again.struct_size = sizeof again;
    ASSERT_EQ(pose_wall_box_compute(&r, engine.get(), &again), POSE_WALL_OK) << frame;
    EXPECT_EQ(std::memcmp(&again, &published[frame].result, sizeof again), 0) << frame;
  }
  EXPECT_EQ(frame, kFrames);
}

// Inputs speak of the time since the frame before. The engine, which never saw a dropped one, would take them for all
// the time since the last one that it did see: a machine that moved meanwhile would seem to stand.
TEST(RuntimeInputs, DoNotSpeakOfTheTimeOfADroppedFrame) {
  RuntimeUnderTest runtime;
  EngineUnderTest engine(small_config()), deceived(small_config());
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof inputs;
  inputs.given = POSE_WALL_INPUT_STANDING;
  runtime.start();
  const auto push = [&](const Points& points, std::int64_t stamp_ns) {
    pose_wall_cloud cloud = cloud_of(points, stamp_ns);
    cloud.inputs = &inputs;
    const std::int32_t status = pose_wall_runtime_push(runtime.get(), &cloud);
    runtime.wait_idle();
    return status;
  };
  const Points seen = room_points(0), none;
  ASSERT_EQ(push(seen, 0), POSE_WALL_OK);
  pose_wall_cloud refused = cloud_of(seen, 100 * kMs);
  refused.point_step = 1;
  ASSERT_NE(pose_wall_runtime_push(runtime.get(), &refused), POSE_WALL_OK);
  ASSERT_EQ(push(none, 200 * kMs), POSE_WALL_OK);
  runtime.stop();
  const auto published = runtime.published();
  ASSERT_EQ(published.size(), 2U);
  engine.process(cloud_of(seen, 0));
  deceived.process(cloud_of(seen, 0));
  pose_wall_cloud last = cloud_of(none, 200 * kMs);
  const pose_wall_result expected = engine.process(last);
  last.inputs = &inputs;
  const pose_wall_result too_sure = deceived.process(last);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& value = published[1].result.quantity[q];
    EXPECT_EQ(value.protection_level, expected.quantity[q].protection_level) << q;
    EXPECT_GT(value.protection_level, too_sure.quantity[q].protection_level) << q;
  }
}

// A box of the format before, or of a build whose inputs have another size.
TEST(RuntimeInputs, ABoxOfAnotherFormatIsRefused) {
  Record bytes;
  RuntimeUnderTest runtime([&](pose_wall_runtime_options* o) {
    o->sink = write_record;
    o->sink_user = &bytes;
    o->box_bytes = 1 << 20;
    o->box_clouds = 0;
  });
  run(&runtime);
  for (const std::uint32_t at : {runtime::kAtVersion, runtime::kAtInputsBytes}) {
    Record other = bytes;
    runtime::put<std::uint32_t>(1, other.data() + at);
    runtime::put(crc32(other.data(), runtime::kAtHeaderCrc), other.data() + runtime::kAtHeaderCrc);
    pose_wall_box_info info;
    EXPECT_EQ(pose_wall_box_open(other.data(), other.size(), &info), POSE_WALL_BOX_E_VERSION);
  }
}

pose_wall_moment moment_of(std::int64_t stamp_ns, unsigned char boot) {
  pose_wall_moment m{};
  m.struct_size = sizeof m;
  m.known = POSE_WALL_MOMENT_BOOT;
  m.boot_id[3] = boot;
  m.stamp_ns = stamp_ns;
  return m;
}

// In the callback of its last frame a runtime saves what another one starts with.
std::vector<unsigned char> saved_after_a_frame(const pose_wall_moment& now) {
  std::vector<unsigned char> memento(pose_wall_memento_bytes());
  RuntimeUnderTest runtime;
  std::int32_t status = 1;
  runtime.in_callback = [&] { status = pose_wall_runtime_save(runtime.get(), &now, memento.data(), memento.size()); };
  runtime.start();
  EXPECT_EQ(pose_wall_runtime_save(runtime.get(), &now, memento.data(), memento.size()), POSE_WALL_RUNTIME_E_STATE);
  runtime.push(room_points(1), 1000 * kMs);
  runtime.wait_idle();
  EXPECT_EQ(status, POSE_WALL_OK);
  runtime.stop();
  std::vector<unsigned char> stopped(memento.size());
  EXPECT_EQ(pose_wall_runtime_save(runtime.get(), &now, stopped.data(), stopped.size()), POSE_WALL_OK);
  EXPECT_EQ(stopped, memento) << "and while it is stopped";
  return memento;
}

TEST(RuntimeMemento, TheNextStartHoldsWhatCanBeDated) {
  const auto memento = saved_after_a_frame(moment_of(1000 * kMs, 1));
  const auto state_at_the_first_silence = [&](RuntimeUnderTest* runtime) {
    runtime->start();
    runtime->pass(300 * kMs);
    const pose_wall_publication p = runtime->latest();
    runtime->stop();
    return p;
  };
  for (const bool same_boot : {true, false}) {
    RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->thinning_max = 4; });
    const pose_wall_moment now = moment_of(1050 * kMs, same_boot ? 1 : 2);
    ASSERT_EQ(pose_wall_runtime_load(runtime.get(), &now, memento.data(), memento.size()), POSE_WALL_OK);
    runtime.clock.advance(50 * kMs);  // between the load and the start
    pose_wall_publication p = state_at_the_first_silence(&runtime);
    const pose_wall_value& left = p.result.quantity[POSE_WALL_D_LF];
    EXPECT_EQ(p.cause, std::uint32_t{POSE_WALL_RUNTIME_SILENCE});
    EXPECT_EQ(left.state, std::uint32_t{same_boot ? POSE_WALL_HELD : POSE_WALL_INVALID});
    if (same_boot) {
      EXPECT_NEAR(left.age_s, 0.4, 1e-9);
    }
    EXPECT_EQ(p.held_thinning, same_boot ? 4U : 1U) << "nobody knows of which";
    p = state_at_the_first_silence(&runtime);
    EXPECT_NE(p.result.quantity[POSE_WALL_YAW].reasons & POSE_WALL_R_NEVER_MEASURED, 0U) << "one start alone";
  }
}

TEST(RuntimeMemento, IsLoadedWhileStoppedAlone) {
  auto memento = saved_after_a_frame(moment_of(1000 * kMs, 1));
  RuntimeUnderTest runtime;
  pose_wall_runtime* const r = runtime.get();
  const pose_wall_moment now = moment_of(1050 * kMs, 1);
  const auto bytes = static_cast<std::uint64_t>(memento.size());
  memento[bytes / 2] ^= 1;
  EXPECT_EQ(pose_wall_runtime_load(r, &now, memento.data(), bytes), POSE_WALL_E_MEMENTO);
  runtime.start();
  EXPECT_EQ(pose_wall_runtime_load(r, &now, memento.data(), bytes), POSE_WALL_RUNTIME_E_STATE);
  std::int32_t called_back = 0;
  runtime.in_callback = [&] { called_back = pose_wall_runtime_load(r, &now, memento.data(), bytes); };
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  EXPECT_EQ(called_back, POSE_WALL_RUNTIME_E_THREAD);
  runtime.pass(300 * kMs);
  EXPECT_NEAR(runtime.latest().result.quantity[POSE_WALL_YAW].age_s, 0.3, 1e-9) << "nothing was loaded";
}

}  // namespace
}  // namespace pose_wall::test
