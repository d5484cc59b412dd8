// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: whichever inner step fails, the output is measured by other steps, held or degraded as in the table. Nothing
// that is told is wrong, and after one such frame the engine is back as promised. Where the step fails for good, what
// is not measured any more is held and then invalid. A step that fails says so as its header allows, or comes back with
// NaN. Where the region's plane takes the place of an endless one that fails, a row without regions shows the failure.

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
  const char* region = "on";  // off: the endless planes alone
};

pose_wall_config config_of(const StageCase& c) {
  pose_wall_config config = small_config();
  set(&config, "region", c.region);
  return config;
}

void PrintTo(const StageCase& c, std::ostream* out) {
  *out << c.name;
}

const StageCase kStageCases[] = {
    {"voxels_do_not_fit", Fault::kVoxelsDoNotFit, "H", "I"},
    {"voxels_none", Fault::kVoxelsNone, "H", "I"},
    {"outliers_are_all", Fault::kOutliersAll, "H", "I"},
    {"floor_not_found", Fault::kFloorNotFound, "H", "I"},
    {"floor_is_nan", Fault::kFloorNan, "V", "V"},
    {"floor_is_nan_without_regions", Fault::kFloorNan, "HHHVVVV", "IIIVVVV", true, room_frame, "off"},
    {"floor_plane_is_nan", Fault::kFloorPlaneNan, "H", "I", false},
    {"floor_without_hypotheses", Fault::kFloorNoHypotheses, "H", "I"},
    {"floor_fit_fails", Fault::kFloorFitFails, "H", "I"},
    {"floor_waves_unsolved", Fault::kFloorWavesUnsolved, ".", "."},
    {"halves_are_nan", Fault::kHalvesNan, "V", "V"},
    {"halves_are_nan_without_regions", Fault::kHalvesNan, "HHHVVVV", "IIIVVVV", true, room_frame, "off"},
    {"level_is_nan", Fault::kLevelNan, "H", "I"},
    {"band_is_empty", Fault::kBandEmpty, "VVHHHHH", "VVIIIII"},
    {"walls_not_found", Fault::kWallsNotFound, "VVHHHHH", "VVIIIII"},
    {"left_wall_not_found", Fault::kLeftNotFound, "VVLHHVV", "VVLIIVV"},
    {"right_wall_not_found", Fault::kRightNotFound, "VVLVVHH", "VVLVVII"},
    {"walls_are_nan", Fault::kWallsNan, "VVVHHHH", "VVVIIII"},
    {"walls_are_nan_without_regions", Fault::kWallsNan, "VVHHHHH", "VVIIIII", false, room_frame, "off"},
    {"wall_planes_are_nan", Fault::kWallPlanesNan, "V", "V", false},
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
    {"sampling_points_interrupted", Fault::kSampleInterrupted, "V", "V"},
    {"sampling_points_interrupted_without_regions", Fault::kSampleInterrupted, "VVVDDDD", "VVVDDDD", true, room_frame,
     "off"},
    {"sampling_points_unbounded", Fault::kSampleNan, "V", "V"},
    {"sampling_points_unbounded_without_regions", Fault::kSampleNan, "VVVHHHH", "VVVIIII", true, room_frame, "off"},
    {"short_steps_are_nan", Fault::kShortStepNan, "V", "V"},
    {"short_steps_are_nan_without_regions", Fault::kShortStepNan, "VVVHHHH", "VVVIIII", true, room_frame, "off"},
    {"floor_region_is_silent", Fault::kFloorRegionSilent, "V", "V"},
    {"wall_regions_are_silent", Fault::kWallRegionsSilent, "V", "V"},
    {"regions_not_found", Fault::kRegionsNotFound, "V", "V"},
    {"regions_are_nan", Fault::kRegionsNan, "HHHVVVV", "IIIVVVV"},
    {"regions_are_not_weighed", Fault::kRegionsUnweighed, "V", "V"},
    {"regions_are_none", Fault::kRegionsNone, "V", "V"},
    {"regions_are_doubtful", Fault::kRegionsDoubtful, "V", "V"},
    {"regions_are_not_seen_at_their_ends", Fault::kRegionsUnseenAtEnds, "V", "V"},
    {"freedom_of_regions_is_nan", Fault::kRegionFreedomNan, "H", "I"},
    {"waves_of_regions_unsolved", Fault::kRegionWavesUnsolved, "V", "V"},
    {"waves_of_regions_are_nan", Fault::kRegionWavesNan, "HHHVVVV", "IIIVVVV"},
    {"waves_of_regions_are_unbounded", Fault::kRegionWavesUnbounded, "H", "I"},
    {"waves_of_regions_turn_by_nan", Fault::kRegionTurnNan, "V", "V"},
    {"steps_of_regions_are_nan", Fault::kRegionStepNan, "VVVHHHH", "VVVIIII"},
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
  FaultRoom room(config_of(GetParam()), GetParam().frames_of);
  EngineUnderTest engine(config_of(GetParam()));
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
  FaultRoom room(config_of(GetParam()), GetParam().frames_of);
  EngineUnderTest engine(config_of(GetParam()));
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
