// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// negative: frames in which nobody would call two surfaces the side walls of a road, and room_dense: a room whose
// cloud is dense enough to overflow the voxels.
// Proves: no axis and no config makes two valid side walls of the former; the latter is processed, and what it claims
// to be valid is consistent in itself.

#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr const char* kAxes[] = {"+X", "-X", "+Y", "-Y"};

class Negative : public RealFrames, public ::testing::WithParamInterface<const char*> {};

TEST_P(Negative, NoAxisGivesTwoValidSideWalls) {
  const auto file = std::filesystem::path("negative") / GetParam();
  for (const bool sparse : {false, true}) {
    for (const char* axis : kAxes) {
      pose_wall_config config = sparse ? sparse_config() : config_with();
      set(&config, "forward_axis", axis);
      const pose_wall_result r = process_alone(config, file);
      const bool left = is_valid(r.quantity[POSE_WALL_D_LF]) || is_valid(r.quantity[POSE_WALL_D_LB]);
      const bool right = is_valid(r.quantity[POSE_WALL_D_RF]) || is_valid(r.quantity[POSE_WALL_D_RB]);
      EXPECT_FALSE(left && right) << axis << (sparse ? " sparse config" : " default config") << ": left "
                                  << r.quantity[POSE_WALL_D_LF].raw << " m, right " << r.quantity[POSE_WALL_D_RF].raw
                                  << " m";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, Negative,
                         ::testing::Values("street_one_wall_os0_32.pcd", "lab_no_floor_vlp16.pcd",
                                           "lab_cluttered_qt64.pcd", "odd_6281_points.pcd", "street_kitti.bin"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

class RoomDense : public RealFrames {};

TEST_F(RoomDense, IsProcessedWithinItsRoomAndClaimsNothingImpossible) {
  for (const char* axis : kAxes) {
    const pose_wall_config config = config_with({{"forward_axis", axis}});
    const pose_wall_result r = process_alone(config, "room_dense/room_scan1.pcd");
    EXPECT_GT(r.points_in, 50000U);
    EXPECT_LE(r.voxels, 60000U);
    for (const pose_wall_value& v : r.quantity) {
      EXPECT_TRUE(!is_measured(v) || (std::isfinite(v.raw) && std::isfinite(v.protection_level))) << axis;
    }
  }
}

}  // namespace
}  // namespace pose_wall::test
