// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which step of the engine fails from now on; see stage_wraps.hpp.

#pragma once

namespace pose_wall::test {

enum class Fault {
  kNone,
  kVoxelsDoNotFit,
  kVoxelsNone,
  kOutliersAll,
  kFloorNotFound,
  kFloorNan,
  kFloorPlaneNan,
  kFloorNoHypotheses,
  kFloorFitFails,
  kFloorWavesUnsolved,
  kHalvesNan,
  kLevelNan,
  kBandEmpty,
  kWallsNotFound,
  kLeftNotFound,
  kRightNotFound,
  kWallsNan,
  kWallPlanesNan,
  kNothingProposed,
  kChooseNone,
  kStripsNotFound,
  kStripsUnjudgedFound,
  kStripsNotJudged,
  kLayersNotFound,
  kLayersNan,
  kGroovedAll,
  kSurfaceUnsolved,
  kPatchesUnsolved,
  kIrlsCloudUnsolved,
  kIrlsPointsUnsolved,
  kMeasureRefused,
  kDirectionsNotLearnt,
  kSightSilent,
  kSightNan,
  kSightDim,
  kEdgesIsland,
  kEdgesLow,
  kEdgesTopUnseen,
  kSampleInterrupted,
  kSampleNan,
  kShortStepNan,
  kDistanceNan,
  kFloorRegionSilent,
  kWallRegionsSilent,
  kRegionsNotFound,
  kRegionsNan,
  kRegionsUnweighed,
  kRegionsNone,
  kRegionsDoubtful,
  kRegionsUnseenAtEnds,
  kRegionFreedomNan,
  kRegionWavesUnsolved,
  kRegionWavesNan,
  kRegionWavesUnbounded,
  kRegionTurnNan,
  kRegionStepNan,
  kDirectionNotShared,
  kSidesBlocked,
  kNothingMeasured,
  kTimeNan,
  kTimeUnknown,
  kSmoothingSilent,
  kReportSilent,
  kCount
};

namespace wraps {

inline Fault fault = Fault::kNone;
inline int failures = 0;

}  // namespace wraps

inline void fail_from_now_on(Fault fault) {
  wraps::fault = fault;
  wraps::failures = 0;
}
inline int failures() {
  return wraps::failures;
}

}  // namespace pose_wall::test
