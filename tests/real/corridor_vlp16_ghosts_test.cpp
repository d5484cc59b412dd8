// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// corridor_vlp16, with up to a fifth of what comes back from the left wall thrown behind it, as by way of a wet or
// shining face. A sparse sensor near the wall sees it in few voxels, and its ghosts in many.
// Proves: the left distances are never valid and further from those of the frame as it was recorded than their level
// and what the frames differ by. Does not prove that the nearer surface is taken: it may be a mesh before the rock.

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <random>

#include "config_file/load_config.hpp"
#include "support/clouds.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr double kFramesDiffer_m = 0.03;

// Outward normal and distance of the wall to the left of +Y, and the turn that levels the sensor.
struct LeftWall {
  Eigen::Matrix3d R_level_sensor;
  Eigen::Vector3d out_level;
  double distance_m;
};

LeftWall left_wall(const Reference& reference, long frame) {
  const auto radians_of = [&](const char* column) { return reference(frame, column) * kRadPerDeg; };
  const double azimuth1 = radians_of("wall1_azimuth_deg"), azimuth2 = radians_of("wall2_azimuth_deg");
  const bool first = std::cos(azimuth1) < std::cos(azimuth2);
  const double azimuth = first ? azimuth1 : azimuth2;
  const Eigen::AngleAxisd pitch(radians_of("pitch_floor_deg"), Eigen::Vector3d::UnitY()),
      roll(radians_of("roll_floor_deg"), Eigen::Vector3d::UnitX());
  return {(pitch * roll).toRotationMatrix(),
          {std::cos(azimuth), std::sin(azimuth), 0.0},
          reference(frame, first ? "wall1_m" : "wall2_m")};
}

std::size_t throw_ghosts(const LeftWall& wall, std::uint32_t percent, double behind_m, Points* points) {
  constexpr double kOnWall_m = 0.1;
  std::mt19937 random(7);
  std::size_t thrown = 0;
  for (auto& p : *points) {
    const double out_m = wall.out_level.dot(wall.R_level_sensor * Eigen::Vector3d(p[0], p[1], p[2]));
    if (std::fabs(out_m - wall.distance_m) > kOnWall_m || random() % 100 >= percent) continue;
    for (float& c : p) c *= static_cast<float>(1.0 + behind_m / out_m);
    ++thrown;
  }
  return thrown;
}

// Of a recording that is known to hold floats, one after the other.
Points recorded_points(const pose_wall_cloud& cloud) {
  Points points(std::size_t{cloud.width} * cloud.height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(points[i].data(), static_cast<const char*>(cloud.data) + i * cloud.point_step + cloud.x.offset,
                sizeof points[i]);
  }
  return points;
}

class CorridorVlp16Ghosts : public RealFrames {};

TEST_F(CorridorVlp16Ghosts, AreNeverAWallWithoutDoubt) {
  const tools::LoadedConfig loaded = tools::load_config("config/vlp16.yaml", {"forward_axis=+Y"});
  const Reference reference(data_folder() / "corridor_vlp16" / "reference.csv");
  int compared = 0;
  for (long i = 9; i <= 21; ++i) {
    const tools::Frame frame =
        tools::load_frame(data_folder() / "corridor_vlp16" / ((i < 10 ? "0" : "") + std::to_string(i) + ".pcd"));
    const Points recorded = recorded_points(frame.cloud);
    const pose_wall_result before = EngineUnderTest(*loaded.config.get()).process(cloud_of(recorded, 0));
    for (const std::uint32_t percent : {5U, 8U, 10U, 15U, 20U}) {
      Points points = recorded;
      ASSERT_GT(throw_ghosts(left_wall(reference, i), percent, 1.5, &points), 40U * percent) << "frame " << i;
      const pose_wall_result r = EngineUnderTest(*loaded.config.get()).process(cloud_of(points, 0));
      for (const std::uint32_t q : {POSE_WALL_D_LF, POSE_WALL_D_LB}) {
        const pose_wall_value& v = r.quantity[q];
        if (std::isnan(before.quantity[q].raw)) continue;
        ++compared;
        if (!is_valid(v)) continue;
        EXPECT_LE(std::fabs(v.value - before.quantity[q].raw), v.protection_level + kFramesDiffer_m)
            << pose_wall_quantity_name(q) << " of frame " << i << ", " << percent << " %";
      }
    }
  }
  EXPECT_GE(compared, 100);
}

}  // namespace
}  // namespace pose_wall::test
