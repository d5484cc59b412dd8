// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Steps of the engine that fail on demand. The linker sends every call of them through here (wrapped_symbols.txt). To
// be included once in the program.

#pragma once

#include <limits>

#include "base/estimation/plane_halves.hpp"
#include "engine/cloud/outliers.hpp"
#include "engine/cloud/voxels.hpp"
#include "engine/floor/candidates.hpp"
#include "engine/floor/fit.hpp"
#include "engine/floor/floor.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/floor/region.hpp"
#include "engine/output/quality.hpp"
#include "engine/output/temporal.hpp"
#include "engine/region/region_plane.hpp"
#include "engine/report.hpp"
#include "engine/walls/choose/choose.hpp"
#include "engine/walls/direction.hpp"
#include "engine/walls/doubts/doubts.hpp"
#include "engine/walls/doubts/edges.hpp"
#include "engine/walls/doubts/sight.hpp"
#include "engine/walls/fit/groove_profile.hpp"
#include "engine/walls/fit/strip_profile.hpp"
#include "engine/walls/fit/two_layers.hpp"
#include "engine/walls/region.hpp"
#include "engine/walls/sample/at_sample.hpp"
#include "engine/walls/sample/measure.hpp"
#include "engine/walls/sample/step_profile.hpp"
#include "engine/walls/walls.hpp"
#include "faults/fault.hpp"
#include "wrapped_symbols.h"  // written by faults.cmake

namespace pose_wall::test {

namespace wraps {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline bool fails(Fault which) {
  if (fault != which) return false;
  ++failures;
  return true;
}

inline void refuse(PlaneFit* fit, std::uint32_t reason) {
  fit->refused = true;
  fit->reasons |= reason;
}

inline void spoil(Plane* plane) {
  plane->n.fill(kNan);
  plane->d = kNan;
}

}  // namespace wraps

}  // namespace pose_wall::test

namespace pose_wall {

using test::Fault;
using test::wraps::fails;
using test::wraps::kNan;
using test::wraps::refuse;
using test::wraps::spoil;

// The type of a method of C, from that of a function that takes self first.
template <typename Function>
struct AsMethod;
template <typename R, typename C, typename... A>
struct AsMethod<R(C*, A...)> {
  using type = R (C::*)(A...);
};
template <typename R, typename C, typename... A>
struct AsMethod<R(const C*, A...)> {
  using type = R (C::*)(A...) const;
};

// POSE_WALL_WRAP(result, function, (parameters)): declares function_for_real, and begins what stands for it. The linker
// knows nothing of types, so the function is cast to what is declared here: where they differ nothing compiles.
// _OVERLOAD and _METHOD (whose self comes first) are called by a name of their own, as in wrapped_symbols.txt.
#define POSE_WALL_WRAP_BEGIN(result, name, parameters)                           \
  result name##_for_real parameters __asm__("__real_" POSE_WALL_WRAPPED_##name); \
  result name##_wrapped parameters __asm__("__wrap_" POSE_WALL_WRAPPED_##name);  \
  result name##_wrapped parameters
#define POSE_WALL_WRAP_OVERLOAD(result, name, function, parameters)            \
  using name##_is_so = decltype(static_cast<result(*) parameters>(&function)); \
  POSE_WALL_WRAP_BEGIN(result, name, parameters)
#define POSE_WALL_WRAP(result, function, parameters) POSE_WALL_WRAP_OVERLOAD(result, function, function, parameters)
#define POSE_WALL_WRAP_METHOD(result, name, method, parameters)                           \
  using name##_is_so = decltype(static_cast<AsMethod<result parameters>::type>(&method)); \
  POSE_WALL_WRAP_BEGIN(result, name, parameters)

POSE_WALL_WRAP(VoxelResult, build_voxels,
               (const pose_wall_cloud& cloud, const pose_wall_odometry* odometry, const Settings& s,
                const Extrinsic& extrinsic, const Axes& axes, const LeafMemory& last, VoxelGrid* grid,
                const AllReturns& all_returns, PointSet* out)) {
  VoxelResult r = build_voxels_for_real(cloud, odometry, s, extrinsic, axes, last, grid, all_returns, out);
  const bool overflow = fails(Fault::kVoxelsDoNotFit);
  if (overflow || fails(Fault::kVoxelsNone)) out->count = 0;
  if (overflow) r.fits = false;
  return r;
}

POSE_WALL_WRAP(std::uint32_t, remove_outliers,
               (const Settings& s, VoxelGrid* grid, Span<std::uint8_t> marks, BoundedPoints* points, Work* work)) {
  const std::uint32_t before = points->count;
  const std::uint32_t outliers = remove_outliers_for_real(s, grid, marks, points, work);
  if (!fails(Fault::kOutliersAll)) return outliers;
  points->count = 0;
  return before;
}

POSE_WALL_WRAP(FloorResult, find_floor, (const FloorScene& scene, Random* random, FloorScratch* scratch)) {
  FloorResult r = find_floor_for_real(scene, random, scratch);
  if (fails(Fault::kFloorNotFound)) {
    r = FloorResult{};
    refuse(&r.fit, POSE_WALL_R_FLOOR_NOT_FOUND);
  }
  if (fails(Fault::kFloorNan)) {
    r.roll.sigma_rad = r.pitch.sigma_rad = kNan;
    r.roll.bound_rad[POSE_WALL_PART_BEND] = r.pitch.bound_rad[POSE_WALL_PART_BEND] = kNan;
  }
  if (fails(Fault::kFloorPlaneNan)) spoil(&r.fit.plane);
  return r;
}

POSE_WALL_WRAP(std::uint32_t, find_candidates,
               (const FloorScene& scene, const PointSet& within, Among among, Random* random, FloorScratch* scratch,
                FloorCandidates* out)) {
  const std::uint32_t scored = find_candidates_for_real(scene, within, among, random, scratch, out);
  if (!fails(Fault::kFloorNoHypotheses)) return scored;
  out->count = 0;
  return 0;
}

POSE_WALL_WRAP(FloorResult, fit_floor,
               (const FloorScene& scene, const FloorLook& look, const Plane& start, FloorScratch* scratch)) {
  FloorResult r = fit_floor_for_real(scene, look, start, scratch);
  if (fails(Fault::kFloorFitFails)) refuse(&r.fit, POSE_WALL_R_FLOOR_THIN);
  return r;
}

POSE_WALL_WRAP_METHOD(UnevenFit, floor_waves, UnevenPlane::fit,
                      (UnevenPlane * self, Span<const SurfacePatch> patches, double sigmas)) {
  if (fails(Fault::kFloorWavesUnsolved)) return {};
  return floor_waves_for_real(self, patches, sigmas);
}

POSE_WALL_WRAP(double, reach_of_halves,
               (Span<const SurfacePatch> patches, const Eigen::Vector3d& correction, const Eigen::Vector3d& of)) {
  return fails(Fault::kHalvesNan) ? kNan : reach_of_halves_for_real(patches, correction, of);
}

POSE_WALL_WRAP(Levelling, levelling_by, (const Plane& floor, const Axes& axes)) {
  Levelling r = levelling_by_for_real(floor, axes);
  if (fails(Fault::kLevelNan)) r.roll_rad = r.pitch_rad = r.forward_up = r.floor_z_level_m = kNan;
  return r;
}

POSE_WALL_WRAP(void, cut_wall_band,
               (const PointSet& cloud, const Levelling& levelling, const Settings& s, VoxelGrid* grid,
                BoundedPoints* band, BoundedPoints* beyond)) {
  cut_wall_band_for_real(cloud, levelling, s, grid, band, beyond);
  if (fails(Fault::kBandEmpty)) band->count = beyond->count = 0;
}

POSE_WALL_WRAP(WallsResult, find_walls,
               (const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch)) {
  WallsResult r = find_walls_for_real(scene, last, random, scratch);
  const bool both = fails(Fault::kWallsNotFound);
  if (both || fails(Fault::kLeftNotFound)) refuse(&r.side[0].fit, POSE_WALL_R_WALL_NOT_FOUND);
  if (both || fails(Fault::kRightNotFound)) refuse(&r.side[1].fit, POSE_WALL_R_WALL_NOT_FOUND);
  if (fails(Fault::kWallPlanesNan)) {
    for (JudgedWall& wall : r.side) spoil(&wall.fit.plane);
  }
  if (!fails(Fault::kWallsNan)) return r;
  for (JudgedWall& wall : r.side) wall.yaw_rad = wall.distance_m[0] = wall.distance_m[1] = kNan;
  return r;
}

POSE_WALL_WRAP(void, propose_walls,
               (const WallScene& scene, const SideView (&views)[2], const Plane* const last[2], Random* random,
                ProposeScratch* scratch, WallCandidates (*out)[2])) {
  propose_walls_for_real(scene, views, last, random, scratch, out);
  if (!fails(Fault::kNothingProposed)) return;
  for (WallCandidates& side : *out) side.count = 0;
}

POSE_WALL_WRAP(WallChoice, choose_walls, (const WallCandidates& left, const WallCandidates& right, const Settings& s)) {
  WallChoice r = choose_walls_for_real(left, right, s);
  if (!fails(Fault::kChooseNone)) return r;
  r = WallChoice{};
  for (int side = 0; side < 2; ++side) {
    r.verdict[side].refused = true;
    r.verdict[side].reasons = POSE_WALL_R_WALL_NOT_FOUND;
  }
  return r;
}

// "Found" without a look: no column is judged then.
POSE_WALL_WRAP_METHOD(bool, strips, StripProfile::find,
                      (StripProfile * self, const PlaneOver& over, double u_m, double reach_m, double gate_m)) {
  if (fails(Fault::kStripsUnjudgedFound)) return true;
  return !fails(Fault::kStripsNotFound) && strips_for_real(self, over, u_m, reach_m, gate_m);
}

POSE_WALL_WRAP_METHOD(double, judge_strips, StripProfile::judge,
                      (StripProfile * self, const PlaneOver& over, double u_m, double reach_m)) {
  return fails(Fault::kStripsNotJudged) ? 0.0 : judge_strips_for_real(self, over, u_m, reach_m);
}

POSE_WALL_WRAP(TwoLayers, find_two_layers, (const LayerHistogram& histogram, const LayerDemands& demands)) {
  if (fails(Fault::kLayersNotFound)) return {};
  TwoLayers r = find_two_layers_for_real(histogram, demands);
  if (fails(Fault::kLayersNan)) r = {true, kNan, kNan, kNan, kNan};
  return r;
}

POSE_WALL_WRAP_METHOD(bool, grooves, GrooveProfile::is_grooved, (const GrooveProfile* self)) {
  return fails(Fault::kGroovedAll) || grooves_for_real(self);
}

POSE_WALL_WRAP(WallSurface, fit_surface,
               (const WallScene& scene, const Plane& start, WallGrid* grid, WallFitScratch* scratch)) {
  WallSurface r = fit_surface_for_real(scene, start, grid, scratch);
  if (fails(Fault::kSurfaceUnsolved)) r.patch.solved = false;
  return r;
}

POSE_WALL_WRAP_METHOD(PatchFit, patches, PatchGrid::fit, (PatchGrid * self, PatchGrid::Errors errors)) {
  if (fails(Fault::kPatchesUnsolved)) return {};
  return patches_for_real(self, errors);
}

POSE_WALL_WRAP_OVERLOAD(IrlsResult, irls_cloud, irls_tukey,
                        (const PointSet& cloud, Span<const std::uint32_t> indices, const Plane& start,
                         const Eigen::Vector3d& u_hint, const IrlsSettings& s, TangentPoints* points)) {
  IrlsResult r = irls_cloud_for_real(cloud, indices, start, u_hint, s, points);
  if (fails(Fault::kIrlsCloudUnsolved)) r.solved = false;
  return r;
}

POSE_WALL_WRAP_OVERLOAD(IrlsOver, irls_points, irls_tukey,
                        (const TangentPoints& points, std::uint32_t count, const PlaneOver& start,
                         const IrlsSettings& s)) {
  IrlsOver r = irls_points_for_real(points, count, start, s);
  if (fails(Fault::kIrlsPointsUnsolved)) r.solved = false;
  return r;
}

POSE_WALL_WRAP(FittedWall, measure_wall,
               (const WallScene& scene, const WallSurface& surface, int side, const WallGrid& grid,
                PatchErrors* errors)) {
  FittedWall r = measure_wall_for_real(scene, surface, side, grid, errors);
  if (fails(Fault::kMeasureRefused)) refuse(&r.fit, POSE_WALL_R_WALL_SHORT);
  return r;
}

POSE_WALL_WRAP(void, learn_directions, (const WallScene& scene, SightScratch* scratch)) {
  if (!fails(Fault::kDirectionsNotLearnt)) learn_directions_for_real(scene, scratch);
}

POSE_WALL_WRAP(WallSight, look_at,
               (const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along, double behind_m,
                SightScratch* scratch)) {
  WallSight r = look_at_for_real(scene, wall, along, behind_m, scratch);
  if (fails(Fault::kSightSilent)) r.silent = 1.0;
  if (fails(Fault::kSightNan)) r.silent = r.open = r.depth_m = kNan;
  if (fails(Fault::kSightDim)) r.dim = true;
  return r;
}

POSE_WALL_WRAP(AtSample, look_at_sample,
               (const WallScene& scene, const WallSurface& surface, const WallGrid& grid, const FittedWall& wall,
                const Eigen::Vector3d& sample_m)) {
  AtSample r = look_at_sample_for_real(scene, surface, grid, wall, sample_m);
  if (fails(Fault::kSampleInterrupted)) r = {1.0, 0.0};
  if (fails(Fault::kSampleNan)) r.bound_m = kNan;
  return r;
}

POSE_WALL_WRAP_METHOD(double, step_before, StepProfile::before_m, (const StepProfile* self)) {
  return fails(Fault::kShortStepNan) ? kNan : step_before_for_real(self);
}

POSE_WALL_WRAP_METHOD(double, step_behind, StepProfile::behind_m, (const StepProfile* self)) {
  return fails(Fault::kShortStepNan) ? kNan : step_behind_for_real(self);
}

POSE_WALL_WRAP(WallEdges, look_past,
               (const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along, double margin_m,
                EdgeScratch* scratch)) {
  WallEdges r = look_past_for_real(scene, wall, along, margin_m, scratch);
  r.island = r.island || fails(Fault::kEdgesIsland);
  r.low = r.low || fails(Fault::kEdgesLow);
  r.top_unseen = r.top_unseen || fails(Fault::kEdgesTopUnseen);
  return r;
}

POSE_WALL_WRAP(double, distance_at, (const Plane& plane, const Eigen::Vector3d& sample_m)) {
  return fails(Fault::kDistanceNan) ? kNan : distance_at_for_real(plane, sample_m);
}

POSE_WALL_WRAP(void, measure_floor_region, (const FloorScene& scene, FloorScratch* scratch, FloorResult* floor)) {
  if (!fails(Fault::kFloorRegionSilent)) measure_floor_region_for_real(scene, scratch, floor);
}

POSE_WALL_WRAP(void, measure_wall_regions, (const WallScene& scene, WallsScratch* scratch, MeasuredWalls* walls)) {
  if (!fails(Fault::kWallRegionsSilent)) measure_wall_regions_for_real(scene, scratch, walls);
}

POSE_WALL_WRAP_METHOD(RegionPlane, region_plane, RegionFit::fit,
                      (RegionFit * self, const BoundedPoints& points, const Region& region, const Settings& settings,
                       UnevenPlane* waves, Work* work, const UnevenFit& endless, RegionPlane* by_endless)) {
  if (fails(Fault::kRegionsNotFound)) return {};
  RegionPlane r = region_plane_for_real(self, points, region, settings, waves, work, endless, by_endless);
  if (fails(Fault::kRegionsNan)) r.at.fill(kNan);
  if (fails(Fault::kRegionsUnweighed)) r.near = kNan;
  if (fails(Fault::kRegionsNone)) r.near = 0.0;
  if (fails(Fault::kRegionsDoubtful)) r.near = 0.5;  // half of it may be no surface: neither one nor none
  if (fails(Fault::kRegionsUnseenAtEnds)) r.seen_at_ends = 0.0;
  if (fails(Fault::kRegionFreedomNan)) r.dof = kNan;
  return r;
}

POSE_WALL_WRAP_METHOD(double, region_step, RegionFit::step_at,
                      (const RegionFit* self, double u_m, const Eigen::Vector3d& plane)) {
  return fails(Fault::kRegionStepNan) ? kNan : region_step_for_real(self, u_m, plane);
}

POSE_WALL_WRAP_METHOD(PredictedPlane, region_waves, UnevenPlane::predict,
                      (UnevenPlane * self, Span<const SurfacePatch> patches, std::uint32_t seen,
                       Span<const Eigen::Vector3d> responses, const UnevenFit& endless, double sigmas)) {
  if (fails(Fault::kRegionWavesUnsolved)) return {};
  PredictedPlane r = region_waves_for_real(self, patches, seen, responses, endless, sigmas);
  if (fails(Fault::kRegionWavesNan)) r.correction.fill(kNan);
  if (fails(Fault::kRegionWavesUnbounded)) r.covariance.fill(kNan);
  if (fails(Fault::kRegionTurnNan)) r.about_endless.fill(kNan);
  return r;
}

POSE_WALL_WRAP(void, share_direction, (const WallScene& scene, JudgedWall (*walls)[2])) {
  if (!fails(Fault::kDirectionNotShared)) share_direction_for_real(scene, walls);
}

POSE_WALL_WRAP(void, refuse_blocked_sides, (const IngestCounts& counts, const Settings& s, JudgedWall (*walls)[2])) {
  refuse_blocked_sides_for_real(counts, s, walls);
  if (!fails(Fault::kSidesBlocked)) return;
  for (JudgedWall& wall : *walls) refuse(&wall.fit, POSE_WALL_R_WALL_TOO_NEAR);
}

POSE_WALL_WRAP(Measurements, measure_quantities,
               (const FloorResult& floor, const Levelling& levelling, const MeasuredWalls& walls, const Settings& s)) {
  Measurements r = measure_quantities_for_real(floor, levelling, walls, s);
  if (!fails(Fault::kNothingMeasured)) return r;
  r = Measurements{};
  for (Measurement& m : r.quantity) m.reasons = POSE_WALL_R_ALERT_LIMIT;
  return r;
}

POSE_WALL_WRAP(FrameTiming, time_frame, (const TemporalState& state, std::int64_t stamp_ns, const Settings& settings)) {
  FrameTiming r = time_frame_for_real(state, stamp_ns, settings);
  if (fails(Fault::kTimeNan)) r.dt_s = kNan;
  if (fails(Fault::kTimeUnknown)) r = {};
  return r;
}

POSE_WALL_WRAP(void, smooth_and_hold,
               (const Measurements& measured, const FrameTiming& timing, std::int64_t stamp_ns, const Change& change,
                const Settings& s, TemporalState* state, pose_wall_value (*values)[POSE_WALL_QUANTITIES])) {
  if (!fails(Fault::kSmoothingSilent)) smooth_and_hold_for_real(measured, timing, stamp_ns, change, s, state, values);
}

POSE_WALL_WRAP(void, report_findings, (const FrameFindings& found, pose_wall_result* result)) {
  if (!fails(Fault::kReportSilent)) report_findings_for_real(found, result);
}

#undef POSE_WALL_WRAP
#undef POSE_WALL_WRAP_OVERLOAD
#undef POSE_WALL_WRAP_METHOD
#undef POSE_WALL_WRAP_BEGIN

}  // namespace pose_wall
