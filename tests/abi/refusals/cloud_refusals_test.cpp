// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a cloud whose description lies is refused by the status in the header, by every call that takes a cloud
// alike: check, engine, motion, both, and the runtime's push. No byte of engine, motion or results changes, so the
// next frame cannot either. Descriptions that are odd but true are in tests/faults/descriptions_test.cpp.

#include <cstddef>

#include "abi/refusals/refusal.hpp"
#include "pose_wall_motion.h"
#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/motion_under_test.hpp"
#include "support/room.hpp"
#if POSE_WALL_TEST_HAS_RUNTIME
#include "support/runtime_under_test.hpp"
#endif

namespace pose_wall::test {
namespace {

constexpr std::int32_t kField = POSE_WALL_E_CLOUD_FIELD, kStep = POSE_WALL_E_CLOUD_STEP,
                       kBytes = POSE_WALL_E_CLOUD_SIZE;
constexpr std::uint32_t kMost = 0xFFFFFFFF;

struct Lie {
  const char* fault;
  std::int32_t status;
  void (*tell)(pose_wall_cloud* cloud, pose_wall_inputs* inputs);
};

using C = pose_wall_cloud;
using I = pose_wall_inputs;

const Lie kLies[] = {
    {"struct_size 0", kSize, [](C* c, I*) { c->struct_size = 0; }},
    {"struct_size 4", kSize, [](C* c, I*) { c->struct_size = 4; }},
    {"struct_size of garbage", kSize, [](C* c, I*) { c->struct_size = 0x5A5A5A5A; }},
    {"struct_size most", kSize, [](C* c, I*) { c->struct_size = kMost; }},
    {"one byte short of a cloud without ring", kSize, [](C* c, I*) { c->struct_size = offsetof(C, ring) - 1; }},
    {"of ABI 1", POSE_WALL_E_ABI, [](C* c, I*) { c->struct_size = offsetof(C, inputs); }},
    {"struct_size 8 more", kNewer, [](C* c, I*) { c->struct_size += 8; }},

    {"data NULL", kNull, [](C* c, I*) { c->data = nullptr; }},
    {"data_bytes 0", kBytes, [](C* c, I*) { c->data_bytes = 0; }},
    {"data_bytes one less", kBytes, [](C* c, I*) { --c->data_bytes; }},
    {"width one more", kBytes, [](C* c, I*) { ++c->width; }},
    {"width 2^26 + 1", kBytes, [](C* c, I*) { c->width = (1U << 26) + 1; }},
    {"width most", kBytes, [](C* c, I*) { c->width = kMost; }},
    {"height 2", kBytes, [](C* c, I*) { c->height = 2; }},
    {"height most", kBytes, [](C* c, I*) { c->height = kMost; }},
    {"width and height most", kBytes, [](C* c, I*) { c->width = c->height = kMost; }},

    {"point_step 0", kStep, [](C* c, I*) { c->point_step = 0; }},
    {"point_step 4", kStep, [](C* c, I*) { c->point_step = 4; }},
    {"point_step 11", kStep, [](C* c, I*) { c->point_step = 11; }},
    {"point_step 13", kBytes, [](C* c, I*) { c->point_step = 13; }},
    {"point_step most", kBytes, [](C* c, I*) { c->point_step = kMost; }},
    {"row_step 1", kStep, [](C* c, I*) { c->row_step = 1; }},
    {"row_step one less", kStep, [](C* c, I*) { c->row_step = static_cast<std::uint32_t>(c->data_bytes - 1); }},
    {"row_step most, two rows", kBytes, [](C* c, I*) { c->row_step = kMost, c->height = 2, c->width /= 2; }},
    {"row_step less than a point", kStep, [](C* c, I*) { c->height = c->width, c->width = 1, c->row_step = 4; }},

    {"x past the point", kStep, [](C* c, I*) { c->x.offset = 9; }},
    {"x wraps to 0", kStep, [](C* c, I*) { c->x.offset = kMost - 3; }},
    {"x offset most", kStep, [](C* c, I*) { c->x.offset = kMost; }},
    {"y wraps to 4", kStep, [](C* c, I*) { c->y.offset = kMost - 3; }},
    {"z one more", kStep, [](C* c, I*) { c->z.offset = 9; }},
    {"z offset most", kStep, [](C* c, I*) { c->z.offset = kMost; }},
    {"z a double past the point", kStep, [](C* c, I*) { c->z.type = POSE_WALL_FIELD_FLOAT64; }},
    {"big_endian 2", kField, [](C* c, I*) { c->big_endian = 2; }},
    {"big_endian most", kField, [](C* c, I*) { c->big_endian = kMost; }},

    {"intensity past the point", kStep,
     [](C* c, I*) {
       c->intensity = pose_wall_field{12, POSE_WALL_FIELD_UINT8};
     }},
    {"intensity offset most", kStep,
     [](C* c, I*) {
       c->intensity = pose_wall_field{kMost, POSE_WALL_FIELD_UINT8};
     }},
    {"intensity of no type", kField,
     [](C* c, I*) {
       c->intensity = pose_wall_field{0, 9};
     }},
    {"intensity type most", kField,
     [](C* c, I*) {
       c->intensity = pose_wall_field{0, kMost};
     }},
    {"time of no type", kField,
     [](C* c, I*) {
       c->time = pose_wall_field{kMost, kMost};
     }},
    {"time past the point", kStep,
     [](C* c, I*) {
       c->time = pose_wall_field{c->point_step - 3, POSE_WALL_FIELD_UINT32};
     }},
    {"ring of no type", kField,
     [](C* c, I*) {
       c->ring = pose_wall_field{kMost, kMost};
     }},
    {"ring a byte past the point", kStep,
     [](C* c, I*) {
       c->ring = pose_wall_field{9, POSE_WALL_FIELD_UINT32};
     }},
    {"ring behind the point", kStep,
     [](C* c, I*) {
       c->ring = pose_wall_field{12, POSE_WALL_FIELD_UINT32};
     }},
    {"ring wraps", kStep,
     [](C* c, I*) {
       c->ring = pose_wall_field{kMost - 1, POSE_WALL_FIELD_UINT32};
     }},

    {"inputs of no size", kSize, [](C* c, I* i) { c->inputs = i, i->struct_size = 0; }},
    {"inputs of 4 bytes", kSize, [](C* c, I* i) { c->inputs = i, i->struct_size = 4; }},
    {"inputs 8 bytes longer", kNewer, [](C* c, I* i) { c->inputs = i, i->struct_size += 8; }},
    {"inputs with the first unknown bit", POSE_WALL_E_INPUT, [](C* c, I* i) { c->inputs = i, i->given = 16; }},
    {"inputs with the last unknown bit", POSE_WALL_E_INPUT, [](C* c, I* i) { c->inputs = i, i->given = 1U << 31U; }},
};

// All that takes clouds, with a frame behind it.
class CloudTakers {
 public:
  CloudTakers() {
    const pose_wall_cloud first = cloud_of(points_, 0);
    engine_.process(first);
    motion_.process(first);
    std::memset(&results_, 0x5A, sizeof results_);
    results_.engine.struct_size = sizeof results_.engine;
    results_.motion.struct_size = sizeof results_.motion;
#if POSE_WALL_TEST_HAS_RUNTIME
    runtime_.start();
#endif
  }

  void expect_refused(const std::string& fault, std::int32_t status, const std::function<void(C*, I*)>& tell) {
    SCOPED_TRACE(fault);
    pose_wall_inputs inputs{};
    inputs.struct_size = sizeof inputs;
    pose_wall_cloud cloud = cloud_of(points_, 100000000);
    tell(&cloud, &inputs);
    copy(&before_);
    EXPECT_EQ(pose_wall_cloud_check(&cloud), status);
    EXPECT_EQ(pose_wall_process(engine_.get(), &cloud, &results_.engine), status);
    EXPECT_EQ(pose_wall_motion_process(motion_.get(), &cloud, &results_.motion), status);
    EXPECT_EQ(pose_wall_motion_process_both(motion_.get(), engine_.get(), &cloud, &results_.motion, &results_.engine),
              status);
    copy(&after_);
    EXPECT_TRUE(after_ == before_) << "a refused cloud changed something";
    ++refused_;
#if POSE_WALL_TEST_HAS_RUNTIME
    EXPECT_EQ(pose_wall_runtime_push(runtime_.get(), &cloud), status);
    const pose_wall_runtime_statistics s = runtime_.statistics();
    EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_DESCRIPTION], refused_);
    EXPECT_EQ(s.pushed, refused_);
    EXPECT_TRUE(accounts_balance(s));
#endif
  }

 private:
  void copy(WorldBytes* to) {
    to->clear();
    append(&results_, sizeof results_, to);
    append(engine_.block().data(), engine_.block().size(), to);
    append(motion_.block().data(), motion_.block().size(), to);
  }

  const Points points_ = room_points(1);
  EngineUnderTest engine_{small_config()};
  MotionUnderTest motion_{small_config()};
  struct {
    pose_wall_result engine;
    pose_wall_motion_result motion;
  } results_;
  WorldBytes before_, after_;
  std::uint64_t refused_ = 0;
#if POSE_WALL_TEST_HAS_RUNTIME
  RuntimeUnderTest runtime_;
#endif
};

TEST(CloudRefusals, ALieIsRefusedByAllAlike) {
  CloudTakers all;
  for (const Lie& lie : kLies) all.expect_refused(lie.fault, lie.status, lie.tell);
}

TEST(CloudRefusals, OnlyFloatsAreCoordinates) {
  CloudTakers all;
  for (const auto axis : {&pose_wall_cloud::x, &pose_wall_cloud::y, &pose_wall_cloud::z}) {
    for (const std::uint32_t type : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 9U, 255U, kMost}) {
      all.expect_refused("type " + std::to_string(type), kField, [&](C* c, I*) { (c->*axis).type = type; });
    }
  }
}

}  // namespace
}  // namespace pose_wall::test
