// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What the C ABIs of all parts share.

#include "base/math/elementary.hpp"
#include "lidar/mount.hpp"
#include "part/export.hpp"
#include "place/pose2.hpp"
#include "pose_wall_planar_types.h"

namespace pose_wall::planar {
namespace {

// Where the machine's frame stands in base.
std::int32_t machine_in_base(const pose_wall_config* config, const double* centre_m, Pose2* machine) {
  if (config == nullptr) return POSE_WALL_E_NULL;
  const std::int32_t status = pose_wall_config_check(config, nullptr);
  if (status != POSE_WALL_OK) return status;
  constexpr double kFarthest_m = 20.0;  // the largest edge of the planner's rectangle
  for (int k = 0; centre_m != nullptr && k < 2; ++k) {
    if (!is_within(centre_m[k], -kFarthest_m, kFarthest_m)) return POSE_WALL_E_VALUE_RANGE;
  }
  const Eigen::Vector2d forward = mount_of(*config).forward_base;
  *machine = {centre_m != nullptr ? centre_m[0] : 0.0, centre_m != nullptr ? centre_m[1] : 0.0,
              arc_tangent2(forward.y(), forward.x())};
  return POSE_WALL_OK;
}

// change(pose, where the machine's frame stands in base) gives the other frame's pose.
template <typename Change>
std::int32_t change_frame(const pose_wall_config* config, const double* centre_m, const pose_wall_planar_pose* from,
                          pose_wall_planar_pose* to, const Change& change) {
  if (from == nullptr || to == nullptr) return POSE_WALL_E_NULL;
  Pose2 in_base;
  const std::int32_t status = machine_in_base(config, centre_m, &in_base);
  if (status != POSE_WALL_OK) return status;
  if (!is_pose(*from)) return POSE_WALL_PLANAR_E_POSE;
  *to = pose_for_caller(change(pose_of(*from), in_base));
  return POSE_WALL_OK;
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT uint32_t pose_wall_planar_abi_version(void) {
  return POSE_WALL_PLANAR_ABI_VERSION;
}

POSE_WALL_EXPORT const char* pose_wall_planar_status_text(int32_t status) {
  return pose_wall_status_text(status);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_machine_of_base(const pose_wall_config* config, const double centre_m[2],
                                                          const pose_wall_planar_pose* base,
                                                          pose_wall_planar_pose* machine) {
  return change_frame(config, centre_m, base, machine, compose);
}

POSE_WALL_EXPORT int32_t pose_wall_planar_base_of_machine(const pose_wall_config* config, const double centre_m[2],
                                                          const pose_wall_planar_pose* machine,
                                                          pose_wall_planar_pose* base) {
  return change_frame(config, centre_m, machine, base,
                      [](const Pose2& given, const Pose2& in_base) { return compose(given, inverse(in_base)); });
}

}  // extern "C"

}  // namespace pose_wall::planar
