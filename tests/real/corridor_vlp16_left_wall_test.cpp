// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// corridor_vlp16, with its left wall changed: up to a fifth of what comes back from it thrown behind it, as by way of a
// wet or shining face; or all of it but pieces of which one stands at the sampling point, as between pillars.
// Proves: the left distances are never valid and further from those of the frame as it was recorded than their level
// and what the frames differ by. Does not prove that the nearer surface is taken: it may be a mesh before the rock, and
// the pillars may be things.

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <random>

#include "io/config_file/load_config.hpp"
#include "support/clouds.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr double kFramesDiffer_m = 0.03;
constexpr double kAhead_m = 2.0;

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

// Throws what comes back from the wall behind it, of what `chosen`, which is told where along the road it lies.
template <typename Chosen>
std::size_t throw_behind(const LeftWall& wall, double behind_m, const Chosen& chosen, Points* points) {
  constexpr double kOnWall_m = 0.1;
  const Eigen::Vector3d along_level = wall.out_level.cross(Eigen::Vector3d::UnitZ());
  std::size_t thrown = 0;
  for (auto& p : *points) {
    const Eigen::Vector3d p_level = wall.R_level_sensor * Eigen::Vector3d(p[0], p[1], p[2]);
    const double out_m = wall.out_level.dot(p_level);
    if (std::fabs(out_m - wall.distance_m) > kOnWall_m || !chosen(along_level.dot(p_level))) continue;
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

class CorridorVlp16LeftWall : public RealFrames {
 protected:
  // visit(points, left wall, result): of each frame as it was recorded.
  template <typename Visit>
  void for_each_frame(const Visit& visit) const {
    const std::filesystem::path folder = data_folder() / "corridor_vlp16";
    const Reference reference(folder / "reference.csv");
    for (long i = 9; i <= 21; ++i) {
      SCOPED_TRACE(testing::Message() << "frame " << i);
      const Points recorded =
          recorded_points(tools::load_frame(folder / ((i < 10 ? "0" : "") + std::to_string(i) + ".pcd")).cloud);
      visit(recorded, left_wall(reference, i), result(recorded));
    }
  }
  pose_wall_result result(const Points& points) const {
    return EngineUnderTest(*loaded_.config.get()).process(cloud_of(points, 0));
  }

  // How many values could be compared.
  int expect_no_wrong_one(const pose_wall_result& before, const pose_wall_result& r,
                          std::initializer_list<std::uint32_t> quantities) const {
    int compared = 0;
    for (const std::uint32_t q : quantities) {
      const pose_wall_value& v = r.quantity[q];
      if (std::isnan(before.quantity[q].raw)) continue;
      ++compared;
      if (!is_valid(v)) continue;
      EXPECT_LE(std::fabs(v.value - before.quantity[q].raw), v.protection_level + kFramesDiffer_m)
          << pose_wall_quantity_name(q);
    }
    return compared;
  }

 private:
  const tools::LoadedConfig loaded_ = tools::load_config("config/vlp16.yaml", {"forward_axis=+Y"});
};

TEST_F(CorridorVlp16LeftWall, ItsGhostsAreNeverAWallWithoutDoubt) {
  int compared = 0;
  for_each_frame([&](const Points& recorded, const LeftWall& wall, const pose_wall_result& before) {
    for (const std::uint32_t percent : {5U, 8U, 10U, 15U, 20U}) {
      SCOPED_TRACE(testing::Message() << percent << " %");
      Points points = recorded;
      std::mt19937 random(7);
      const auto by_chance = [&](double) { return random() % 100 < percent; };
      ASSERT_GT(throw_behind(wall, 1.5, by_chance, &points), 40U * percent);
      compared += expect_no_wrong_one(before, result(points), {POSE_WALL_D_LF, POSE_WALL_D_LB});
    }
  });
  EXPECT_GE(compared, 100);
}

TEST_F(CorridorVlp16LeftWall, ItsPillarsAreNeverSeenThrough) {
  int compared = 0;
  for_each_frame([&](const Points& recorded, const LeftWall& wall, const pose_wall_result& before) {
    for (const double apart_m : {3.0, 5.0}) {
      for (const double open : {0.5, 0.6, 0.7}) {
        SCOPED_TRACE(testing::Message() << "every " << apart_m << " m, open " << open);
        Points points = recorded;
        const auto in_gap = [&](double along_m) {
          const double places = (along_m - kAhead_m) / apart_m;
          return std::fabs(places - std::round(places)) > 0.5 * (1.0 - open);
        };
        ASSERT_GT(throw_behind(wall, 1.5, in_gap, &points), 500U);
        compared += expect_no_wrong_one(before, result(points), {POSE_WALL_D_LF});
      }
    }
  });
  EXPECT_GE(compared, 60);
}

}  // namespace
}  // namespace pose_wall::test
