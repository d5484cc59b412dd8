// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "names.hpp"

#include "pose_wall.h"

namespace pose_wall {
namespace {

// The lone bit as the enum's number, 0 for an index out of range.
std::uint32_t bit_of(std::uint32_t bit_index) {
  return bit_index < POSE_WALL_REASON_COUNT ? 1U << bit_index : 0U;
}

}  // namespace

const char* status_text(std::int32_t status) {  // NOLINT(readability-function-size): a table
  switch (status) {
    case POSE_WALL_OK:
      return "ok";
    case POSE_WALL_E_NULL:
      return "a required pointer is NULL";
    case POSE_WALL_E_STRUCT_SIZE:
      return "struct_size unknown: set it to sizeof, or call the init function";
    case POSE_WALL_E_BLOCK_SMALL:
      return "block smaller than pose_wall_memory_needed() (of a runtime, pose_wall_runtime_memory_needed()) says";
    case POSE_WALL_E_BLOCK_ALIGN:
      return "block not aligned to POSE_WALL_BLOCK_ALIGNMENT";
    case POSE_WALL_E_ENGINE:
      return "engine pointer does not point to an open engine, or somebody wrote into its block";
    case POSE_WALL_E_INDEX:
      return "index out of range";
    case POSE_WALL_E_BUFFER_SMALL:
      return "text does not fit the caller's buffer";
    case POSE_WALL_E_MEMENTO:
      return "not what pose_wall_save() wrote, of another version, or damaged";
    case POSE_WALL_E_KEY_UNKNOWN:
      return "no such key";
    case POSE_WALL_E_VALUE_TYPE:
      return "value cannot be read as the key's type, or is not one of its choices";
    case POSE_WALL_E_VALUE_RANGE:
      return "value outside the key's range, or not finite";
    case POSE_WALL_E_CONFIG_RULE:
      return "two keys contradict each other; see pose_wall_config_check()";
    case POSE_WALL_E_IMAGE_VERSION:
      return "an image of another version or size";
    case POSE_WALL_E_IMAGE_CRC:
      return "its CRC is not that of its bytes: damaged, torn, or never filled";
    case POSE_WALL_E_TEXT_LONG:
      return "text value longer than POSE_WALL_TEXT_MAX - 1";
    case POSE_WALL_E_CLOUD_FIELD:
      return "x, y or z missing, or a field of a type that cannot be read";
    case POSE_WALL_E_CLOUD_STEP:
      return "a field reaches past point_step, or a row past row_step";
    case POSE_WALL_E_CLOUD_SIZE:
      return "data_bytes does not hold width x height points, or those are more than 2^26";
    default:
      return "unknown status";
  }
}

const char* reason_name(std::uint32_t bit_index) {  // NOLINT(readability-function-size): a table
  switch (bit_of(bit_index)) {
    case POSE_WALL_R_NO_POINTS:
      return "no_points";
    case POSE_WALL_R_LEAF_GROWN:
      return "leaf_grown";
    case POSE_WALL_R_STAMP_STILL:
      return "stamp_still";
    case POSE_WALL_R_STAMP_BACK:
      return "stamp_back";
    case POSE_WALL_R_STAMP_LEAP:
      return "stamp_leap";
    case POSE_WALL_R_FROZEN:
      return "frozen";
    case POSE_WALL_R_FLOOR_NOT_FOUND:
      return "floor_not_found";
    case POSE_WALL_R_FLOOR_FEW_INLIERS:
      return "floor_few_inliers";
    case POSE_WALL_R_FLOOR_THIN:
      return "floor_thin";
    case POSE_WALL_R_FLOOR_AMBIGUOUS:
      return "floor_ambiguous";
    case POSE_WALL_R_WALL_NOT_FOUND:
      return "wall_not_found";
    case POSE_WALL_R_WALL_FEW_INLIERS:
      return "wall_few_inliers";
    case POSE_WALL_R_WALL_SHORT:
      return "wall_short";
    case POSE_WALL_R_WALL_LEANS:
      return "wall_leans";
    case POSE_WALL_R_WALL_SEEN_THROUGH:
      return "wall_seen_through";
    case POSE_WALL_R_WALL_AMBIGUOUS:
      return "wall_ambiguous";
    case POSE_WALL_R_WALLS_NOT_PARALLEL:
      return "walls_not_parallel";
    case POSE_WALL_R_YAW_OUT_OF_RANGE:
      return "yaw_out_of_range";
    case POSE_WALL_R_CROSS_ROAD:
      return "cross_road";
    case POSE_WALL_R_CURVED:
      return "curved";
    case POSE_WALL_R_EXTRAPOLATED:
      return "extrapolated";
    case POSE_WALL_R_LEVEL_MISSING:
      return "level_missing";
    case POSE_WALL_R_ALERT_LIMIT:
      return "alert_limit";
    case POSE_WALL_R_INNOVATION:
      return "innovation";
    case POSE_WALL_R_RATE_LIMITED:
      return "rate_limited";
    case POSE_WALL_R_HOLD_EXPIRED:
      return "hold_expired";
    case POSE_WALL_R_WALL_TOO_NEAR:
      return "wall_too_near";
    case POSE_WALL_R_NEVER_MEASURED:
      return "never_measured";
    case POSE_WALL_R_NO_FRAME:
      return "no_frame";
    default:
      return "unknown";
  }
}

const char* reason_text(std::uint32_t bit_index) {  // NOLINT(readability-function-size): a table
  switch (bit_of(bit_index)) {
    case POSE_WALL_R_NO_POINTS:
      return "too few points survive the filters";
    case POSE_WALL_R_LEAF_GROWN:
      return "the voxel leaf was enlarged to stay within points_max; of a value: even the largest was too small";
    case POSE_WALL_R_STAMP_STILL:
      return "the stamp equals the last frame's: taken as the same frame again";
    case POSE_WALL_R_STAMP_BACK:
      return "the stamp is older than the last frame's";
    case POSE_WALL_R_STAMP_LEAP:
      return "the stamp is more than stamp_gap_max ahead of the last one: smoothing starts afresh";
    case POSE_WALL_R_FROZEN:
      return "the very points of the last frame came again: the sensor may be frozen";
    case POSE_WALL_R_FLOOR_NOT_FOUND:
      return "no plane below the sensor could be a floor (ground_tilt_max_deg, ground_height_min, ground_height_max)";
    case POSE_WALL_R_FLOOR_FEW_INLIERS:
      return "the floor has fewer than ground_inlier_min points";
    case POSE_WALL_R_FLOOR_THIN:
      return "the floor is seen over too small or too narrow an area";
    case POSE_WALL_R_FLOOR_AMBIGUOUS:
      return "another level or slope (bench, pile, reflection, uneven ground) explains the view nearly as well as the "
             "floor, or both walls lean against it";
    case POSE_WALL_R_WALL_NOT_FOUND:
      return "no plane on this side could be a wall";
    case POSE_WALL_R_WALL_FEW_INLIERS:
      return "the wall has fewer than wall_inlier_min points, answers so little that a gap would go unnoticed, or "
             "is not seen high enough to be told from a conveyor";
    case POSE_WALL_R_WALL_SHORT:
      return "the wall is seen over less than wall_length_min";
    case POSE_WALL_R_WALL_LEANS:
      return "the wall leans more than wall_lean_max_deg";
    case POSE_WALL_R_WALL_SEEN_THROUGH:
      return "rays pass the plane, its top or both of its ends, or nothing answers, where a wall would be solid: "
             "pipes, props, a conveyor, a vehicle, a curtain";
    case POSE_WALL_R_WALL_AMBIGUOUS:
      return "another plane on this side explains the view nearly as well, or it is grooved like a row of pipes";
    case POSE_WALL_R_WALLS_NOT_PARALLEL:
      return "the planes on the two sides are not parallel";
    case POSE_WALL_R_YAW_OUT_OF_RANGE:
      return "the machine is turned more than yaw_max_deg, where side wall and face cannot be told apart";
    case POSE_WALL_R_CROSS_ROAD:
      return "a better pair of walls runs across the machine than along it";
    case POSE_WALL_R_CURVED:
      return "the surface bends significantly; the protection level includes by how much";
    case POSE_WALL_R_EXTRAPOLATED:
      return "no wall is seen at the sampling point: its plane is prolonged to it";
    case POSE_WALL_R_LEVEL_MISSING:
      return "walls were not looked for: this frame has no floor to level by";
    case POSE_WALL_R_ALERT_LIMIT:
      return "the protection level is above the alert limit";
    case POSE_WALL_R_INNOVATION:
      return "the value jumped further than the machine can move, or was refused until now, and waits to be confirmed";
    case POSE_WALL_R_RATE_LIMITED:
      return "the smoothed yaw follows by yaw_rate_limit_deg per frame";
    case POSE_WALL_R_HOLD_EXPIRED:
      return "the held value's protection level passed the alert limit, or it was held longer than hold_max";
    case POSE_WALL_R_WALL_TOO_NEAR:
      return "returns nearer than range_min block the view to this side";
    case POSE_WALL_R_NEVER_MEASURED:
      return "there was no good measurement yet";
    case POSE_WALL_R_NO_FRAME:
      return "no frame has come since";
    default:
      return "unknown reason";
  }
}

const char* state_name(std::uint32_t state) {
  switch (state) {
    case POSE_WALL_INVALID:
      return "invalid";
    case POSE_WALL_HELD:
      return "held";
    case POSE_WALL_DEGRADED:
      return "degraded";
    case POSE_WALL_VALID:
      return "valid";
    default:
      return "unknown";
  }
}

const char* quantity_name(std::uint32_t quantity) {
  switch (quantity) {
    case POSE_WALL_ROLL:
      return "roll";
    case POSE_WALL_PITCH:
      return "pitch";
    case POSE_WALL_YAW:
      return "yaw";
    case POSE_WALL_D_LF:
      return "d_lf";
    case POSE_WALL_D_LB:
      return "d_lb";
    case POSE_WALL_D_RF:
      return "d_rf";
    case POSE_WALL_D_RB:
      return "d_rb";
    default:
      return "unknown";
  }
}

const char* stage_name(std::uint32_t stage) {
  switch (stage) {
    case POSE_WALL_STAGE_VOXEL:
      return "voxel";
    case POSE_WALL_STAGE_OUTLIERS:
      return "outliers";
    case POSE_WALL_STAGE_GROUND:
      return "ground";
    case POSE_WALL_STAGE_BAND:
      return "band";
    case POSE_WALL_STAGE_WALLS:
      return "walls";
    case POSE_WALL_STAGE_OUTPUT:
      return "output";
    default:
      return "unknown";
  }
}

}  // namespace pose_wall
