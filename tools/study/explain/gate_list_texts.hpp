// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Texts of the engine's table of gates, marked for the catalogues. A test finds one that lacks its Chinese.

#pragma once

#include "io/language/language.hpp"

namespace pose_wall::tools::explain {

// Measured quantities of the gates, as in src/engine/gates/gates.def.
inline constexpr const char* kGateMeasures[] = {
    translatable("edge of the voxels; voxel_leaf, where points_max has room for them, and had in the last frames"),
    translatable("its voxels fit, with the leaf as large as it may be"),
    translatable("voxels left after the filters"),
    translatable("voxels with nothing standing on them or hanging under them"),
    translatable("planes that may be the floor"),
    translatable("its points spread far enough for a fit"),
    translatable("another plane's score, of the chosen one's, by open ground that only one of them shows; on floors "
                 "below 5 m2 by all of it. A score is open area, twice that where the machine drives"),
    translatable("score of a plane that lies otherwise, of the small chosen one's"),
    translatable("tilt of the floor against base"),
    translatable("height of the sensor above the floor"),
    translatable("the fit stayed on the surface that it began with"),
    translatable("measured points on the floor"),
    translatable("open floor that is seen"),
    translatable("where the floor is seen on less than half a turn, share of it within 4.5 m of the machine; none "
                 "where other ground is seen"),
    translatable("how far other ground lies otherwise, on which the machine may stand"),
    translatable("tilt that the lean of both walls speaks of"),
    translatable("there is a floor to level by"),
    translatable("planes on this side"),
    translatable("measured points on the plane"),
    translatable("supported along the road"),
    translatable("share of the plane that is seen through"),
    translatable("lean from the vertical"),
    translatable("|n_left . n_right| of the best planes of both sides"),
    translatable("supported along the road, without a parallel wall on the other side"),
    translatable("the longest walls of both sides make a pair"),
    translatable("a plane of this side may be the wall"),
    translatable("what a pair of planes across the machine shows, of what the sides show; where none was looked for, "
                 "or none behind, what one could show at most"),
    translatable("what another plane of this side shows, of the chosen one"),
    translatable("what a parallel plane behind it shows, of the chosen one"),
    translatable("what a parallel plane that goes on past its ends shows, of the chosen one"),
    translatable("what a parallel plane before it that nothing passes shows, of the chosen one"),
    translatable("turn by its bend; a fifth of the alert limit is let pass"),
    translatable("around the sampling point in which nothing is seen of the wall"),
    translatable("how far the wall may step out or back at the sampling point"),
    translatable("along the road from the machine to where the wall is first seen"),
    translatable("measured points on the fitted wall"),
    translatable("the fit stayed on the surface that it began with, and that is a wall"),
    translatable("turn of the wall against the machine"),
    translatable("so much of it answers that a gap would be noticed"),
    translatable("it is seen high enough to be told from a conveyor"),
    translatable("near the sensor, share of it that is silent or seen through"),
    translatable("no grooves along its length, as between pipes"),
    translatable("near the sensor, share of it from where nothing comes back"),
    translatable("the sensor does not look past both of its ends"),
    translatable("the sensor does not look over its top"),
    translatable("no other surface shows itself behind it, equally far behind over a wall's length"),
    translatable("turn against it of what is seen on the other side, where nothing was accepted"),
    translatable("returns of this side nearer than range_min"),
    translatable("the stamp is a millisecond or more away from the last frame's"),
    translatable("time since the last frame"),
    translatable("the frame's inputs are sound, and nothing that was measured speaks against them"),
    translatable("repeats of the very same points under new stamps"),
    translatable("protection level of this frame by itself, without what earlier frames left in doubt"),
    translatable("turn of the smoothed yaw since the last frame"),
    translatable("jump from the last good value; as far as the machine can move and both may err"),
    translatable("for how many frames more a rival wall that was seen stays in the level"),
    translatable("how often it has to come again: frames before it were refused, and none was good yet"),
    translatable("protection level of the smoothed value"),
    translatable("it was measured before, so that there is something to hold"),
    translatable("protection level of the held value, which grows"),
    translatable("age of the held value"),
    translatable("what is held had not expired before, by time or by a stamp that jumped or stood still"),
    translatable("steps that the frame had taken when more were needed")};

// Their units that are words.
inline constexpr const char* kGateUnits[] = {translatable("share"), translatable("points"), translatable("frames"),
                                             translatable("steps")};

// Parts of a limit's origin, before its colon.
inline constexpr const char* kOriginParts[] = {translatable("key"),
                                               translatable("definition"),
                                               translatable("swept"),
                                               translatable("a fifth of it"),
                                               translatable("all nominal scenes"),
                                               translatable("recorded corridor"),
                                               translatable("after a review"),
                                               translatable("and what both may err by")};

}  // namespace pose_wall::tools::explain
