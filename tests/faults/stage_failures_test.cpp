// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: whichever inner step fails, the output is held or degraded as in the table, nothing that is told is wrong,
// and after one such frame the engine is back as promised; where the step fails for good, what is not measured any more
// is held and then invalid. A step that fails says so as its header allows, or comes back with NaN.

#include <functional>

#include "fault_room.hpp"
#include "stage_wraps.hpp"

namespace pose_wall::test {
namespace {

struct StageCase {
  const char* name;
  Fault fault;
  const char* once;      // states of the frame with the fault
  const char* for_good;  // and of the last of many
  bool keeps_contract = true;
  FramesOf frames_of = room_frame;
};

void PrintTo(const StageCase& c, std::ostream* out) {
  *out << c.name;
}

const StageCase kStageCases[] = {
    {"voxels_do_not_fit", Fault::kVoxelsDoNotFit, "H", "I"},
    {"voxels_none", Fault::kVoxelsNone, "H", "I"},
    {"outliers_are_all", Fault::kOutliersAll, "H", "I"},
    {"floor_not_found", Fault::kFloorNotFound, "H", "I"},
    {"floor_is_nan", Fault::kFloorNan, "HHHVVVV", "IIIVVVV"},
    {"floor_without_hypotheses", Fault::kFloorNoHypotheses, "H", "I"},
    {"floor_fit_fails", Fault::kFloorFitFails, "H", "I"},
    {"floor_waves_unsolved", Fault::kFloorWavesUnsolved, ".", "."},
    {"halves_are_nan", Fault::kHalvesNan, "HHHVVVV", "IIIVVVV"},
    {"level_is_nan", Fault::kLevelNan, "H", "I"},
    {"band_is_empty", Fault::kBandEmpty, "VVHHHHH", "VVIIIII"},
    {"walls_not_found", Fault::kWallsNotFound, "VVHHHHH", "VVIIIII"},
    {"left_wall_not_found", Fault::kLeftNotFound, "VVLHHVV", "VVLIIVV"},
    {"right_wall_not_found", Fault::kRightNotFound, "VVLVVHH", "VVLVVII"},
    {"walls_are_nan", Fault::kWallsNan, "VVHHHHH", "VVIIIII", false},
    {"no_walls_proposed", Fault::kNothingProposed, "VVHHHHH", "VVIIIII"},
    {"no_wall_is_chosen", Fault::kChooseNone, "VVHHHHH", "VVIIIII"},
    {"strips_not_found", Fault::kStripsNotFound, "VVLLLLL", "VVLLLLL", true, ribbed_room_frame},
    {"strips_found_but_not_judged", Fault::kStripsUnjudgedFound, "VVHHHHH", "VVIIIII"},
    {"strips_not_judged", Fault::kStripsNotJudged, "VVLLLLL", "VVLLLLL", true, ribbed_room_frame},
    {"layers_not_found", Fault::kLayersNotFound, "VVLLLLL", "VVLLLLL", true, ribbed_room_frame},
    {"layers_are_nan", Fault::kLayersNan, "VV.....", "VV....."},
    {"layers_of_strips_are_nan", Fault::kLayersNan, "VVLLLLL", "VVLLLLL", true, ribbed_room_frame},
    {"all_is_grooved", Fault::kGroovedAll, "VVDDDDD", "VVDDDDD"},
    {"surface_unsolved", Fault::kSurfaceUnsolved, "VVHHHHH", "VVIIIII"},
    {"patches_unsolved", Fault::kPatchesUnsolved, "h", "I"},
    {"irls_of_clouds_unsolved", Fault::kIrlsCloudUnsolved, "x", "."},
    {"irls_of_points_unsolved", Fault::kIrlsPointsUnsolved, ".", "."},
    {"wall_measurement_refused", Fault::kMeasureRefused, "VVHHHHH", "VVIIIII"},
    {"directions_not_learnt", Fault::kDirectionsNotLearnt, ".", "."},
    {"sight_is_silent", Fault::kSightSilent, "VVHHHHH", "VVIIIII"},
    {"sight_is_nan", Fault::kSightNan, "VVHHHHH", "VVIIIII"},
    {"sight_is_dim", Fault::kSightDim, "VVDDDDD", "VVDDDDD"},
    {"edges_see_an_island", Fault::kEdgesIsland, "VVHHHHH", "VVIIIII"},
    {"edges_see_over_it", Fault::kEdgesLow, "VVHHHHH", "VVIIIII"},
    {"edges_see_no_top", Fault::kEdgesTopUnseen, "VVDDDDD", "VVDDDDD"},
    {"sampling_points_interrupted", Fault::kSampleInterrupted, "VVVDDDD", "VVVDDDD"},
    {"sampling_points_unbounded", Fault::kSampleNan, "VVVHHHH", "VVVIIII"},
    {"short_steps_are_nan", Fault::kShortStepNan, "VVVHHHH", "VVVIIII"},
    {"distances_are_nan", Fault::kDistanceNan, "VV.HHHH", "VV.IIII"},
    {"direction_not_shared", Fault::kDirectionNotShared, "VVLLLLL", "VVLLLLL"},
    {"both_sides_blocked", Fault::kSidesBlocked, "VVHHHHH", "VVIIIII"},
    {"quantities_not_measured", Fault::kNothingMeasured, "H", "I"},
    {"time_is_nan", Fault::kTimeNan, "V", "V"},
    {"time_is_unknown", Fault::kTimeUnknown, "V", "V"},
    {"smoothing_writes_nothing", Fault::kSmoothingSilent, "I", "I", false},
    {"report_writes_nothing", Fault::kReportSilent, "V", "V", false},
};

class StageFailures : public ::testing::TestWithParam<StageCase> {
 protected:
  void TearDown() override { fail_from_now_on(Fault::kNone); }

  // A frame while the fault is on. Where the fault is that results are not written, no more is asked than that.
  pose_wall_result faulty(FaultRoom* room, EngineUnderTest* engine, std::int64_t stamp_ns) {
    // Never one again: good frames have even numbers.
    const pose_wall_cloud cloud = cloud_of(GetParam().frames_of(2 * faulty_++ + 1), stamp_ns);
    const pose_wall_result r = GetParam().keeps_contract ? room->process(cloud) : engine->process(cloud);
    EXPECT_EQ(misleading(r, kRoomTruth), "") << states_of(r) << " at " << stamp_ns;
    return r;
  }

 private:
  std::uint32_t faulty_ = 0;
};

TEST_P(StageFailures, OnceIsHeldOrDegradedAndOver) {
  FaultRoom room(small_config(), GetParam().frames_of);
  EngineUnderTest engine(small_config());
  ASSERT_EQ(states_of(room.good(0)), "VVVVVVV");
  engine.process(cloud_of(GetParam().frames_of(0), 0));
  fail_from_now_on(GetParam().fault);
  const pose_wall_result r = faulty(&room, &engine, kPeriod_ns);
  EXPECT_GT(failures(), 0) << "the step was not reached";
  fail_from_now_on(Fault::kNone);
  EXPECT_TRUE(matches(states_of(r), GetParam().once)) << states_of(r) << ", not " << GetParam().once;
  EXPECT_LE(room.frames_until_valid(kPeriod_ns), kBackWithin);
  const pose_wall_result next = engine.process(cloud_of(GetParam().frames_of(2), 2 * kPeriod_ns));
  EXPECT_EQ(misleading(next, kRoomTruth), "");
}

TEST_P(StageFailures, ForGoodIsHeldThenInvalid) {
  constexpr std::int64_t kHalfSecond_ns = 500000000;
  FaultRoom room(small_config(), GetParam().frames_of);
  EngineUnderTest engine(small_config());
  room.good(0);
  engine.process(cloud_of(GetParam().frames_of(0), 0));
  fail_from_now_on(GetParam().fault);
  std::string states;
  for (int frame = 1; frame <= 6; ++frame) states = states_of(faulty(&room, &engine, frame * kHalfSecond_ns));
  EXPECT_TRUE(matches(states, GetParam().for_good)) << states << ", not " << GetParam().for_good;
  fail_from_now_on(Fault::kNone);
  if (!GetParam().keeps_contract) return;
  EXPECT_LE(room.frames_until_valid(6 * kHalfSecond_ns), kBackWithin);
}

INSTANTIATE_TEST_SUITE_P(Faults, StageFailures, ::testing::ValuesIn(kStageCases),
                         [](const auto& test) { return name_of(test.param.name); });

}  // namespace
}  // namespace pose_wall::test
