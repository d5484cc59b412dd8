// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// hall_rotating: a VLP-16 turned by hand in a hall, with a box for the person who carries it.
// Proves: up to 34 degrees to the hall's axis yaw and distances are the reference's; from 47 degrees on, no side is
// swapped for the end wall as plain valid.

#include <utility>

#include "io/config_file/load_config.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

// The reference is good to 0.2 deg and 1 cm; the issue asks for 0.7 deg and 5 cm of the engine.
constexpr double kYaw_deg = 0.7, kDistance_m = 0.05;
constexpr double kSample_m = 2.0;

class HallRotating : public RealFrames {
 protected:
  pose_wall_result measured(int frame) {
    const tools::LoadedConfig loaded =
        tools::load_config("config/vlp16.yaml", {"body_box_1=-0.6 0.6 -0.6 0.6 -0.6 0.4"});
    return process_alone(*loaded.config.get(), "hall_rotating/" + std::to_string(frame) + ".pcd");
  }
  Reference reference() { return Reference(data_folder() / "hall_rotating" / "reference.csv"); }
};

// The wall's distance moved from the sensor to +-2 m along the machine's axis, which is turned by yaw from the road:
// going ahead by s on a machine turned right (yaw > 0) leads s sin(yaw) away from the left wall.
struct Expected {
  double yaw_rad;
  double distance[4];
};

Expected expected_of(const Reference& reference, int frame) {
  const double yaw = reference(frame, "axis_in_sensor_deg") / kDegPerRad;
  const double left = reference(frame, "d_left"), right = reference(frame, "d_right");
  const double aside = kSample_m * std::sin(yaw);
  return {yaw, {left + aside, left - aside, right - aside, right + aside}};
}

TEST_F(HallRotating, YawAndDistancesAreTheReferences) {
  for (int frame = 0; frame <= 2; ++frame) {
    const pose_wall_result r = measured(frame);
    const Expected expected = expected_of(reference(), frame);
    ASSERT_TRUE(is_measured(r.quantity[POSE_WALL_YAW])) << "frame " << frame;
    EXPECT_NEAR(r.quantity[POSE_WALL_YAW].raw * kDegPerRad, expected.yaw_rad * kDegPerRad, kYaw_deg)
        << "frame " << frame;
    for (std::uint32_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(r.quantity[POSE_WALL_D_LF + k].raw, expected.distance[k], kDistance_m)
          << "frame " << frame << " " << pose_wall_quantity_name(POSE_WALL_D_LF + k);
    }
  }
}

TEST_F(HallRotating, BeyondFortyFiveDegreesNoSideIsTheEndWall) {
  for (int frame = 3; frame <= 5; ++frame) {
    const pose_wall_result r = measured(frame);
    const Expected expected = expected_of(reference(), frame);
    const pose_wall_value& yaw = r.quantity[POSE_WALL_YAW];
    if (is_valid(yaw)) {
      EXPECT_NEAR(yaw.raw, expected.yaw_rad, yaw.protection_level + kYaw_deg / kDegPerRad) << "frame " << frame;
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      const pose_wall_value& d = r.quantity[POSE_WALL_D_LF + k];
      if (!is_valid(d)) continue;
      EXPECT_NEAR(d.raw, std::fabs(expected.distance[k]), d.protection_level + 0.01)
          << "frame " << frame << " " << pose_wall_quantity_name(POSE_WALL_D_LF + k);
    }
  }
}

}  // namespace
}  // namespace pose_wall::test
