// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/remedies/gate_table.hpp"

#include <iterator>

namespace pose_wall::tools::explain {
namespace {

constexpr GateWords kFrameWords[] = {
    {"leaf", translatable("The voxels grew to {value}: with {limit} there were more than points_max has room for."),
     translatable("raise points_max")},
    {"voxels_fit",
     translatable(
         "Even the largest voxels do not fit into points_max. Points fill the air, or points_max is far too small."),
     translatable("raise points_max; where dust or spray fills the air, wait")},
    {"points", translatable("Only {value} voxels are left after the filters; {limit} are needed."), ""},
    {"stamp_still",
     translatable(
         "The stamp is less than a millisecond after the last frame's, so the frame counts as the same one again."),
     translatable("check the driver: its clock stands still, or its stamps are not in nanoseconds")},
    {"stamp_back",
     translatable(
         "The stamp is {value} from the frame before: the clock jumped back. The age of held values is unknown."),
     translatable("the clock that stamps the frames was set back")},
    {"stamp_leap",
     translatable("The stamp is {value} after the frame before; {limit} is the most ({key}). Smoothing starts afresh."),
     translatable("frames were lost, or the clock was set")},
    {"inputs",
     translatable("The motion given with this frame (the caller's, or the odometry's) was not used: it contradicts "
                  "itself or the measurement."),
     translatable("check the caller's speed, turn rate and standing still (signs, units, sigmas); without a caller try "
                  "motion=off")},
    {"work",
     translatable(
         "The frame was not finished: it had taken {value} steps when more were needed; {limit} is the most ({key})."),
     translatable("dust, clutter or very many points make a frame expensive; lower points_max or range_max; raise "
                  "{key} where there is time")},
    {"repeated", translatable("The same points came again {value} times under new stamps. No running LiDAR does that."),
     translatable("check whether the sensor, its driver or the network is frozen")},
    {"frozen", translatable("After {limit} repeats ({key}) the sensor counts as frozen, and nothing new is measured."),
     translatable("check whether the sensor, its driver or the network is frozen")},
};

constexpr GateWords kFloorWords[] = {
    {"floor_points",
     translatable(
         "Only {value} voxels are open ground, with nothing on them or hanging under them; {limit} are needed."),
     translatable("the floor gives no return (water, dark ground), is hidden, or the sensor does not look down; "
                  "ground_roi_radius_max widens the search")},
    {"floor_planes", translatable("No plane was found that may be the floor."),
     translatable("the floor gives no return (water, dark ground) or is hidden; check extrinsic_*, ground_height_min, "
                  "ground_height_max and ground_tilt_max_deg")},
    {"floor_fit", translatable("The floor's points lie nearly on one line, or in too few places to fit a plane."),
     translatable("show more of the floor; raise ground_roi_radius_max")},
    {"floor_rival",
     translatable("Where only one of both planes has points, another one scores {value} of the chosen one, by open"
                  " ground, which counts twice where the machine drives. From {limit} on either may be the floor, "
                  "and the protection levels reach to it. If the floor is steep, they grow by its tilt as well, "
                  "since a machine stands about upright."),
     translatable("look for a bench, a heap or a reflection among the planes below")},
    {"floor_alone",
     translatable("The chosen floor is small, and a plane that lies otherwise scores {value} of it, by open ground, "
                  "which counts twice where the machine drives. From {limit} on neither is taken for the floor."),
     translatable("show more of the floor")},
    {"floor_tilt", translatable("The floor is tilted by {value} against base; {limit} is allowed ({key})."),
     translatable("check extrinsic_roll and extrinsic_pitch; raise {key} where the machine really stands so")},
    {"floor_height_min", translatable("The sensor is {value} above the floor; at least {limit} is required ({key})."),
     translatable("check extrinsic_z; lower {key} where the sensor hangs so low")},
    {"floor_height_max", translatable("The sensor is {value} above the floor; {limit} is allowed ({key})."),
     translatable("check extrinsic_z; raise {key} where the sensor hangs so high")},
    {"floor_stayed", translatable("The fit drifted off the surface that it began with."),
     translatable("show more of the floor")},
    {"floor_inliers", translatable("{value} measured points lie on the floor; {limit} are needed ({key})."),
     translatable("lower {key} for a sensor of few points; ground_roi_radius_max lets it look farther out")},
    {"floor_area", translatable("{value} of the floor are seen as open ground; {limit} are needed."),
     translatable("show more of the floor; ground_roi_radius_max lets it look farther out")},
    {"floor_near",
     translatable(
         "The floor is seen on one side of the machine only, and {value} of it near the machine; {limit} is "
         "needed. Where other ground is seen too, none counts. It may be a ramp ahead, so the protection levels "
         "grow by the slope of one, and of a steep floor by its tilt as well."),
     translatable("show the ground that the machine stands on; mount the sensor so that it looks further down")},
    {"floor_beside",
     translatable("The floor is seen on one side of the machine only; ground on the other side lies otherwise by "
                  "{value}. The machine may stand on that, and the protection levels reach to it. Of a steep floor "
                  "they grow by its tilt as well."),
     translatable("a ramp, a belt or a table; show more of the floor around the machine")},
    {"floor_by_walls",
     translatable(
         "Both walls lean the same way about the road. The floor may be off by {value}, as on a heap's flank."),
     translatable("clear the heap")},
};

constexpr GateWords kOutcomeWords[] = {
    {"protection_raw",
     translatable(
         "This frame's own measurement has a protection level of {value}, above the alert limit of {limit} ({key})."),
     ""},
    {"rate", translatable("The smoothed yaw was to turn by {value}; {limit} a frame is the most ({key})."), ""},
    {"innovation",
     translatable("The value jumped by {value} from the last good one; motion and errors explain {limit} ({key}). Both "
                  "stay possible until it comes again."),
     translatable("raise {key} for a faster machine")},
    {"doubted",
     translatable("A rival wall was seen a moment ago, and the level still reaches to it. Frames left, this one "
                  "included: {value}."),
     ""},
    {"confirmed",
     translatable(
         "Earlier frames were refused, and none was good yet. Times that the value has to come again: {value}."),
     ""},
    {"protection_smoothed", translatable("Its protection level of {value} exceeds the alert limit of {limit} ({key})."),
     ""},
    {"ever", translatable("It was never measured before, so there is nothing to hold."), ""},
    {"protection_held",
     translatable("The held value's protection level has grown to {value}, above the alert limit of {limit} ({key})."),
     ""},
    {"held_age", translatable("The held value is {value} old; {limit} is the most ({key})."), ""},
    {"held_before",
     translatable("The held value had expired before, by its age or by a stamp that jumped or stood still."), ""},
};

}  // namespace

const GateWords* find_frame_gate(const char* gate) {
  return find_gate(gate, {{kFrameWords, std::size(kFrameWords)},
                          {kFloorWords, std::size(kFloorWords)},
                          {kOutcomeWords, std::size(kOutcomeWords)}});
}

}  // namespace pose_wall::tools::explain
