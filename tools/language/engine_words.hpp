// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Names and texts of the engine as people read them. The engine speaks English; its texts are marked here.

#pragma once

#include <cstdint>
#include <string>

#include "language/language.hpp"
#include "pose_wall.h"
#include "quantities.hpp"

namespace pose_wall::tools {

// As in src/names.def; a test finds one that lacks its Chinese.
inline constexpr const char* kEngineTexts[] = {
    // states
    translatable("invalid"),
    translatable("held"),
    translatable("degraded"),
    translatable("valid"),
    // parts of a protection level
    translatable("random"),
    translatable("range bias"),
    translatable("bend"),
    translatable("rival"),
    translatable("extrapolation"),
    translatable("lag"),
    translatable("age"),
    // what a positive angle means
    translatable("right side down"),
    translatable("left side down"),
    translatable("nose down"),
    translatable("nose up"),
    translatable("turned right"),
    // reasons
    translatable("too few points survive the filters"),
    translatable("the voxel leaf was enlarged to stay within points_max; of a value: even the largest was too small"),
    translatable("less than 1 ms after the last frame: the same again, or no nanoseconds"),
    translatable("the stamp is older than the last frame's"),
    translatable("the stamp is more than stamp_gap_max ahead: smoothing starts afresh"),
    translatable("an earlier cloud came again: the sensor may be frozen"),
    translatable("no plane below the sensor could be a floor (ground_tilt_max_deg, ground_height_min, "
                 "ground_height_max)"),
    translatable("the floor has fewer than ground_inlier_min points"),
    translatable("the floor is seen over too small or too narrow an area"),
    translatable("another level or slope (bench, pile, reflection, uneven ground) explains the view nearly as well as "
                 "the floor, or both walls lean against it"),
    translatable("no plane on this side could be a wall"),
    translatable("the wall has fewer than wall_inlier_min points"),
    translatable("the wall is seen over less than wall_length_min"),
    translatable("the wall leans more than wall_lean_max_deg"),
    translatable("the plane does not show itself solid like a wall: rays pass it, its top or both of its ends, too "
                 "little of it answers, or it is seen too low: pipes, props, a conveyor, a vehicle, a curtain"),
    translatable("another plane on this side explains the view nearly as well, or it is grooved like a row of pipes"),
    translatable("the planes on the two sides are not parallel"),
    translatable("the machine is turned beyond yaw_max_deg, where side wall and face cannot be told apart"),
    translatable("a better pair of walls runs across the machine than along it"),
    translatable("the surface bends significantly; the protection level includes by how much"),
    translatable("no wall is seen at the sampling point, or of yaw beside the machine: it is prolonged"),
    translatable("walls were not looked for: this frame has no floor to level by"),
    translatable("the protection level is above the alert limit"),
    translatable("the value jumped further than the machine moves, or was refused until now: waits to be confirmed"),
    translatable("the smoothed yaw follows by yaw_rate_limit_deg per frame"),
    translatable("held until its level passed the alert limit or its age hold_max, or until stamps no longer told its "
                 "age"),
    translatable("returns nearer than range_min block the view to this side"),
    translatable("there was no good measurement yet"),
    translatable("no frame has come since"),
    translatable("the frame had taken work_max steps: what was not finished by then is refused"),
    translatable("the frame's inputs were not used: they contradict each other or what was measured"),
};

inline std::string state_words(std::uint32_t state) {
  return tr(pose_wall_state_name(state));
}

// "range bias"
inline std::string spoken_part(std::uint32_t part) {
  return tr(part_words(part).c_str());
}

// "right side down"; empty where nobody knows.
inline std::string positive_words(const pose_wall_result& result, std::uint32_t quantity) {
  const std::string sense = positive_means(result, quantity);
  return sense.empty() ? "" : tr(sense.c_str());
}

inline std::string reason_words(std::uint32_t bit) {
  return tr(pose_wall_reason_text(bit));
}

}  // namespace pose_wall::tools
