// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A user's program in C++17: an engine by the wrapper, a frame of no points, its process image.

#include <cstdio>
#include <pose_wall.hpp>

int main() {
  if (pose_wall_abi_version() != POSE_WALL_ABI_VERSION) return 1;
  pose_wall::api::Config config;
  pose_wall::api::Engine engine;
  if (config.set("forward_axis", "+X") != POSE_WALL_OK || engine.open(config) != POSE_WALL_OK) return 2;
  pose_wall_cloud cloud;
  pose_wall_result result = pose_wall::api::make_result();
  pose_wall_image image = pose_wall::api::make_image();
  if (pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, 0) != POSE_WALL_OK) return 3;
  if (engine.process(cloud, result) != POSE_WALL_OK) return 4;
  if (engine.fill_image(result, image) != POSE_WALL_OK) return 5;
  std::printf("pose_wall %s: %s\n", pose_wall_version(), pose_wall_state_name(image.verdict));
  return pose_wall_image_check(&image) == POSE_WALL_OK && image.verdict == POSE_WALL_INVALID ? 0 : 6;
}
