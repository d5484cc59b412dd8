// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves for every reason bit that there is a scene which raises it, on the quantity it belongs to, and a scene like it
// which does not. Does not prove that a bit is raised whenever it should be; the campaign looks at what is claimed
// without one.

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "lab/sim/parameters.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

// Beside the seven quantities: the frame itself.
constexpr std::uint32_t kFrame = POSE_WALL_QUANTITIES;

struct Staged {
  const char* scene;
  std::vector<const char*> sizes = {};  // KEY=VALUE over the scene
  std::vector<KeyValue> settings = {};  // over the engine's defaults
  const char* sensor = "os1-64";
  std::uint32_t frames = 3;
};

struct Row {
  std::uint32_t reason;
  std::uint32_t quantity;
  Staged raises;
  Staged does_not;
};

// clang-format off
const std::vector<Row> kRows = {
    // the frame
    {POSE_WALL_R_NO_POINTS, kFrame, {"millimetres"}, {"clean"}},
    {POSE_WALL_R_LEAF_GROWN, kFrame, {"clean", {}, {{"points_max", "5000"}}}, {"clean"}},
    {POSE_WALL_R_STAMP_STILL, POSE_WALL_YAW, {"stamp_still", {}, {}, "os1-64", 14}, {"jitter", {}, {}, "os1-64", 14}},
    {POSE_WALL_R_STAMP_BACK, POSE_WALL_YAW, {"stamp_jump", {}, {}, "os1-64", 12}, {"stamp_leap", {}, {}, "os1-64", 12}},
    {POSE_WALL_R_STAMP_LEAP, POSE_WALL_YAW, {"stamp_leap", {}, {}, "os1-64", 12},
     {"dropped", {"drop_length=8"}, {}, "os1-64", 12}},
    {POSE_WALL_R_FROZEN, POSE_WALL_YAW, {"frozen", {}, {}, "os1-64", 16}, {"clean", {"speed_mps=0"}, {}, "os1-64", 16}},
    // the floor
    {POSE_WALL_R_FLOOR_NOT_FOUND, POSE_WALL_ROLL, {"no_floor"}, {"puddles"}},
    {POSE_WALL_R_FLOOR_FEW_INLIERS, POSE_WALL_ROLL, {"clean", {}, {{"ground_inlier_min", "100000"}}, "os0-128"},
     {"clean", {}, {}, "os0-128"}},
    {POSE_WALL_R_FLOOR_THIN, POSE_WALL_ROLL,
     {"face", {"face_distance_m=3", "blocked_from_deg=5", "blocked_to_deg=355"}, {}, "os0-128"},
     {"face", {"face_distance_m=3"}, {}, "os0-128"}},
    {POSE_WALL_R_FLOOR_AMBIGUOUS, POSE_WALL_ROLL, {"humps"}, {"rough"}},
    // the walls
    {POSE_WALL_R_WALL_NOT_FOUND, POSE_WALL_D_RF, {"one_wall"}, {"clean"}},
    {POSE_WALL_R_WALL_FEW_INLIERS, POSE_WALL_D_LF, {"clean", {}, {{"wall_inlier_min", "100000"}}}, {"dropout"}},
    {POSE_WALL_R_WALL_SHORT, POSE_WALL_YAW, {"cavern"}, {"one_wall"}},
    {POSE_WALL_R_WALL_LEANS, POSE_WALL_D_LF, {"trapezoid", {"lean_left_deg=25"}}, {"trapezoid", {"lean_left_deg=10"}}},
    {POSE_WALL_R_WALL_SEEN_THROUGH, POSE_WALL_D_LF, {"props_before_void"}, {"pipes"}},
    {POSE_WALL_R_WALL_AMBIGUOUS, POSE_WALL_D_LF, {"curtain"}, {"rough"}},
    {POSE_WALL_R_WALLS_NOT_PARALLEL, POSE_WALL_YAW, {"splayed_wide"}, {"splayed"}},
    {POSE_WALL_R_YAW_OUT_OF_RANGE, POSE_WALL_YAW, {"turned", {"turned_left_deg=47", "face_distance_m=0"}},
     {"turned", {"turned_left_deg=40", "face_distance_m=0"}}},
    {POSE_WALL_R_CROSS_ROAD, POSE_WALL_YAW,
     {"clean", {"turned_left_deg=90", "face_distance_m=5", "rear_distance_m=5"}},
     {"clean", {"face_distance_m=5", "rear_distance_m=5"}}},
    {POSE_WALL_R_CURVED, POSE_WALL_D_LF, {"curved", {"curve_radius_m=12"}}, {"clean"}},
    {POSE_WALL_R_EXTRAPOLATED, POSE_WALL_D_LF, {"crosscut", {}, {}, "vlp16"},
     {"crosscut", {"crosscut_at_m=-6"}, {}, "vlp16"}},
    // the outcome
    {POSE_WALL_R_LEVEL_MISSING, POSE_WALL_YAW, {"no_floor"}, {"puddles"}},
    {POSE_WALL_R_ALERT_LIMIT, POSE_WALL_YAW, {"curtain"}, {"clean"}},
    {POSE_WALL_R_INNOVATION, POSE_WALL_YAW, {"turn_step", {}, {}, "os1-64", 12},
     {"clean", {"turn_rate_dps=1"}, {}, "os1-64", 12}},
    {POSE_WALL_R_RATE_LIMITED, POSE_WALL_YAW,
     {"clean", {"turn_rate_dps=40"}, {{"temporal_smoothing_tau", "0"}}, "os1-64", 5},
     {"clean", {"turn_rate_dps=20"}, {{"temporal_smoothing_tau", "0"}}, "os1-64", 5}},
    {POSE_WALL_R_HOLD_EXPIRED, POSE_WALL_D_LF, {"wall_lost", {"lost_from_s=0.3"}, {}, "os1-64", 14},
     {"wall_lost", {"lost_from_s=0.3", "lost_to_s=0.5"}, {}, "os1-64", 14}},
    {POSE_WALL_R_WALL_TOO_NEAR, POSE_WALL_D_LF, {"below_range_min"}, {"near_wall"}},
    {POSE_WALL_R_NEVER_MEASURED, POSE_WALL_D_RF, {"one_wall"}, {"dark_wall", {"wet_side=left"}}},
};
// clang-format on

std::string name_of(std::uint32_t reason) {
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if (reason == 1U << bit) return pose_wall_reason_name(bit);
  }
  return "not_one_bit";
}

void PrintTo(const Row& row, std::ostream* os) {
  *os << name_of(row.reason);
}

// Frames in which the quantity carries the reason.
std::uint32_t raised(const Staged& staged, std::uint32_t reason, std::uint32_t quantity) {
  sim::SceneSetup setup = sim::make_setup(staged.scene, staged.sensor, false, 1);
  for (const char* assignment : staged.sizes) sim::set_parameter(setup, assignment);
  pose_wall_config config = config_with();
  for (const auto& [key, value] : staged.settings) set(&config, key, value);
  std::uint32_t count = 0;
  for (const JudgedFrame& f : run_frames(setup, 1, staged.frames, config)) {
    const std::uint32_t reasons = quantity == kFrame ? f.result.frame_reasons : f.result.quantity[quantity].reasons;
    count += (reasons & reason) != 0 ? 1U : 0U;
  }
  return count;
}

class Reason : public ::testing::TestWithParam<Row> {};

TEST_P(Reason, IsRaisedWhereItMustBeAndNotElsewhere) {
  const Row& row = GetParam();
  EXPECT_GT(raised(row.raises, row.reason, row.quantity), 0U) << "never raised in " << row.raises.scene;
  EXPECT_EQ(raised(row.does_not, row.reason, row.quantity), 0U) << "raised in " << row.does_not.scene;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Reason, ::testing::ValuesIn(kRows),
                         [](const auto& test) { return name_of(test.param.reason); });

TEST(Reasons, EveryBitHasARow) {
  // No scene raises these: abi/age_test, property/work_test and abi/abi2_test do.
  std::uint32_t covered = POSE_WALL_R_NO_FRAME | POSE_WALL_R_WORK_LIMIT | POSE_WALL_R_PRIOR;
  for (const Row& row : kRows) covered |= row.reason;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    EXPECT_NE(covered & (1U << bit), 0U) << pose_wall_reason_name(bit);
  }
}

}  // namespace
}  // namespace pose_wall::test
