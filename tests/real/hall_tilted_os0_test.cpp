// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// hall_tilted_os0: an OS0 carried and tilted in a large hall.
// Proves: roll to -21 and pitch to 17 degrees are the reference's in at least seven of eight frames; tilts to -32
// degrees are right or refused. The floor beside the sensor is within its level of the reference.

#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr double kAngle_deg = 0.5;

class HallTiltedOs0 : public RealFrames {
 protected:
  void SetUp() override {
    RealFrames::SetUp();
    if (!IsSkipped()) reference_.emplace(data_folder() / "hall_tilted_os0" / "reference.csv");
  }

  // The reference is of all of the hall's floor.
  pose_wall_result measured(int frame, const char* region = "off") {
    return process_alone(config_with({{"region", region}}), "hall_tilted_os0/full" + std::to_string(frame) + ".pcd");
  }
  double roll_error_deg(int frame, const pose_wall_result& r) {
    return r.quantity[POSE_WALL_ROLL].raw * kDegPerRad - (*reference_)(frame, "roll_deg");
  }
  double pitch_error_deg(int frame, const pose_wall_result& r) {
    return r.quantity[POSE_WALL_PITCH].raw * kDegPerRad - (*reference_)(frame, "pitch_deg");
  }

  std::optional<Reference> reference_;
};

TEST_F(HallTiltedOs0, AnglesAreTheReferencesInSevenOfEight) {
  int right = 0;
  for (int frame = 24; frame <= 31; ++frame) {
    const pose_wall_result r = measured(frame);
    const double roll = roll_error_deg(frame, r), pitch = pitch_error_deg(frame, r);
    // NaN where refused: not right.
    if (std::fabs(roll) <= kAngle_deg && std::fabs(pitch) <= kAngle_deg) ++right;
    RecordProperty("frame_" + std::to_string(frame), std::to_string(roll) + " " + std::to_string(pitch));
  }
  EXPECT_GE(right, 7);
}

TEST_F(HallTiltedOs0, SteepTiltsAreRightOrRefused) {
  for (int frame = 24; frame <= 35; ++frame) {
    const pose_wall_result r = measured(frame);
    if (is_valid(r.quantity[POSE_WALL_ROLL])) {
      EXPECT_NEAR(roll_error_deg(frame, r), 0.0, kAngle_deg) << "frame " << frame;
    }
    if (is_valid(r.quantity[POSE_WALL_PITCH])) {
      EXPECT_NEAR(pitch_error_deg(frame, r), 0.0, kAngle_deg) << "frame " << frame;
    }
  }
}

// Beside the sensor half of the floor is seen.
TEST_F(HallTiltedOs0, TheFloorBesideTheSensorIsTheReferenceWithinItsLevel) {
  constexpr double kOfReference_deg = 0.2;  // as the reference's own first line says
  int measured_frames = 0;
  for (int frame = 24; frame <= 35; ++frame) {
    const pose_wall_result r = measured(frame, "on");
    const pose_wall_value &roll = r.quantity[POSE_WALL_ROLL], &pitch = r.quantity[POSE_WALL_PITCH];
    if (!is_measured(roll)) continue;
    ++measured_frames;
    const auto allowed_deg = [](const pose_wall_value& v) {
      return v.raw_protection_level * kDegPerRad + kOfReference_deg;
    };
    EXPECT_LE(std::fabs(roll_error_deg(frame, r)), allowed_deg(roll)) << "frame " << frame;
    EXPECT_LE(std::fabs(pitch_error_deg(frame, r)), allowed_deg(pitch)) << "frame " << frame;
  }
  EXPECT_GE(measured_frames, 8);
}

}  // namespace
}  // namespace pose_wall::test
