// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// corridor_vlp16: a hand-held VLP-16 in a corridor 2.03 m wide, +Y ahead, by config/vlp16.yaml alone and with
// config/hand_held.yaml over it.
// Proves: frames 09 to 21 are measured as the plane fits of the reference say, within what those fits differ among
// themselves. Does not prove accuracy: the reference is no ground truth.

#include <algorithm>
#include <iterator>

#include "io/config_file/load_config.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr int kFirst = 9, kLast = 21;
// Roll and yaw of two independent fits differ by up to 0.6 deg in these frames (floor against ceiling, wall against
// wall); pitch, across a floor 2 m wide that is a few lines, by up to 1.2 deg. The width holds within 3 cm.
constexpr double kRollYaw_deg = 0.6, kPitch_deg = 1.2, kWidth_m = 2.033, kWidthTolerance_m = 0.035;

// A direction without a sense, in (-90, 90] degrees.
double folded_deg(double angle_deg) {
  return angle_deg - 180.0 * std::ceil((angle_deg - 90.0) / 180.0);
}

// How far an azimuth of the road lies outside what the reference's own fits span: either wall's normal and the axis
// of both. They differ by up to half a degree in these frames.
double outside_deg(double azimuth_deg, const Reference& reference, int frame) {
  const double off[] = {folded_deg(azimuth_deg - reference(frame, "axis_az_deg")),
                        folded_deg(azimuth_deg - 90.0 - reference(frame, "wall1_azimuth_deg")),
                        folded_deg(azimuth_deg - 90.0 - reference(frame, "wall2_azimuth_deg"))};
  const double least = *std::min_element(std::begin(off), std::end(off));
  const double most = *std::max_element(std::begin(off), std::end(off));
  return least <= 0.0 && most >= 0.0 ? 0.0 : std::min(std::fabs(least), std::fabs(most));
}

class CorridorVlp16 : public RealFrames, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    RealFrames::SetUp();
    if (IsSkipped()) return;
    results_ = results("region=on");
    reference_.emplace(data_folder() / "corridor_vlp16" / "reference.csv");
  }

  std::map<int, pose_wall_result> results(const char* setting) const {
    const tools::LoadedConfig loaded = tools::load_config(GetParam(), {"forward_axis=+Y", setting});
    EngineUnderTest engine(*loaded.config.get());
    std::map<int, pose_wall_result> out;
    for (int i = kFirst; i <= kLast; ++i) {
      const std::string name = (i < 10 ? "0" : "") + std::to_string(i) + ".pcd";
      out[i] = process(&engine, std::filesystem::path("corridor_vlp16") / name, i * 100000000LL);
    }
    return out;
  }

  std::map<int, pose_wall_result> results_;
  std::optional<Reference> reference_;
};

TEST_P(CorridorVlp16, BothWallsAreMeasuredAndTheWidthIsRight) {
  int both = 0;
  for (const auto& [frame, r] : results("region=off")) {
    const double left = r.quantity[POSE_WALL_D_LF].raw, right = r.quantity[POSE_WALL_D_RF].raw;
    if (std::isnan(left) || std::isnan(right)) continue;
    ++both;
    EXPECT_NEAR(left + right, kWidth_m, kWidthTolerance_m) << "frame " << frame;
  }
  EXPECT_GE(both, 12);
}

// Both walls have pillars and doors, which move the planes of the five metres beside the sensor.
TEST_P(CorridorVlp16, TheWidthBesideTheSensorIsRightWithinTheLevels) {
  int both = 0;
  for (const auto& [frame, r] : results_) {
    const pose_wall_value &left = r.quantity[POSE_WALL_D_LF], &right = r.quantity[POSE_WALL_D_RF];
    if (std::isnan(left.raw) || std::isnan(right.raw)) continue;
    ++both;
    const double levels_m = left.raw_protection_level + right.raw_protection_level;
    EXPECT_NEAR(left.raw + right.raw, kWidth_m, levels_m) << "frame " << frame;
  }
  EXPECT_GE(both, 12);
}

TEST_P(CorridorVlp16, RollAndYawAreTheReferences) {
  for (const auto& [frame, r] : results_) {
    const pose_wall_value &roll = r.quantity[POSE_WALL_ROLL], &yaw = r.quantity[POSE_WALL_YAW];
    if (is_measured(roll)) {
      EXPECT_NEAR(roll.raw * kDegPerRad, (*reference_)(frame, "roll_floor_deg"), kRollYaw_deg) << "frame " << frame;
    }
    if (is_measured(yaw)) {
      // Ahead is +Y, at azimuth 90: the road's azimuth is that plus the yaw.
      EXPECT_LE(outside_deg(90.0 + yaw.raw * kDegPerRad, *reference_, frame), kRollYaw_deg) << "frame " << frame;
    }
  }
}

TEST_P(CorridorVlp16, PitchIsTheReferencesOrSaysHowFarItMayBe) {
  for (const auto& [frame, r] : results_) {
    const pose_wall_value& pitch = r.quantity[POSE_WALL_PITCH];
    if (!is_measured(pitch)) continue;
    const double error = std::fabs(pitch.raw * kDegPerRad - (*reference_)(frame, "pitch_floor_deg"));
    const bool told = pitch.state == POSE_WALL_DEGRADED && error <= pitch.protection_level * kDegPerRad;
    EXPECT_TRUE(error <= kPitch_deg || told)
        << "frame " << frame << ": " << error << " deg off, level " << pitch.protection_level * kDegPerRad;
  }
}

INSTANTIATE_TEST_SUITE_P(ByConfig, CorridorVlp16,
                         ::testing::Values("config/vlp16.yaml", "config/vlp16.yaml,config/hand_held.yaml"));

}  // namespace
}  // namespace pose_wall::test
