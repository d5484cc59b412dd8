// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Recordings of carried sensors, by config/hand_held.yaml: hall_tilted_os0, hall_walk_os0, corridor_vlp16.
// Proves: roll and pitch are valid in at least six frames of ten where the machine's rates take each turn of the hand
// for a jump; they are those of the recorders' poses. Does not prove distances: the halls are wider than range_max lets
// see.

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "io/config_file/load_config.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

constexpr double kAngle_deg = 0.5;  // the recorders' poses are good to 0.2 degrees
constexpr double kShare = 0.6;      // what the project asks of recorded halls; 0.98 was measured, 2026-11-27

struct Frames {
  const char* folder;
  const char* name;  // of a frame, by its number
  int first, last;
  std::int64_t step_ns;
};

constexpr Frames kTilted = {"hall_tilted_os0", "full%d.pcd", 24, 35, 100000000};
constexpr Frames kWalk = {"hall_walk_os0", "%03d.pcd", 0, 39, 500000000};
constexpr Frames kCorridor = {"corridor_vlp16", "%02d.pcd", 7, 21, 100000000};

// A turn of 14 degrees within a tenth of a second moved roll in hall_tilted_os0 by 0.03 degrees: its recorders took the
// motion out. Whether a jump is one shows where nothing else widens levels.
constexpr const char *kFreed = "scan_max=0", *kBent = "scan_max=0.2";

class HandHeld : public RealFrames {
 protected:
  static std::vector<pose_wall_result> measured(const Frames& frames, const std::string& config, const char* scan_max) {
    const tools::LoadedConfig loaded = tools::load_config(config, {"forward_axis=+Y", scan_max});
    EngineUnderTest engine(*loaded.config.get());
    std::vector<pose_wall_result> results;
    for (int i = frames.first; i <= frames.last; ++i) {
      char name[32];
      std::snprintf(name, sizeof name, frames.name, i);
      results.push_back(process(&engine, std::filesystem::path(frames.folder) / name, i * frames.step_ns));
    }
    return results;
  }

  static double valid_share(const std::vector<pose_wall_result>& results, std::uint32_t quantity) {
    double valid = 0.0;
    for (const pose_wall_result& r : results) valid += is_valid(r.quantity[quantity]) ? 1.0 : 0.0;
    return valid / static_cast<double>(results.size());
  }
};

TEST_F(HandHeld, ATiltedHallIsMeasured) {
  const std::vector<pose_wall_result> results = measured(kTilted, "config/hand_held.yaml", kFreed);
  const Reference reference(data_folder() / kTilted.folder / "reference.csv");
  const struct {
    std::uint32_t quantity;
    const char* column;
  } angles[] = {{POSE_WALL_ROLL, "roll_deg"}, {POSE_WALL_PITCH, "pitch_deg"}};
  for (const auto& angle : angles) {
    EXPECT_GE(valid_share(results, angle.quantity), kShare) << angle.column;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const pose_wall_value& value = results[i].quantity[angle.quantity];
      const int frame = kTilted.first + static_cast<int>(i);
      if (is_valid(value)) {
        EXPECT_NEAR(value.value * kDegPerRad, reference(frame, angle.column), kAngle_deg) << angle.column << frame;
      }
    }
  }
}

// The hall has one floor: turned by the recorders' poses, up is the same in all frames.
TEST_F(HandHeld, AWalkThroughAHallHasOneUp) {
  const std::vector<pose_wall_result> results = measured(kWalk, "config/hand_held.yaml", kBent);
  const Reference reference(data_folder() / kWalk.folder / "reference.csv");
  std::vector<Eigen::Vector3d> ups;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < results.size(); ++i) {
    const pose_wall_value &roll = results[i].quantity[POSE_WALL_ROLL], &pitch = results[i].quantity[POSE_WALL_PITCH];
    if (!is_valid(roll) || !is_valid(pitch)) continue;
    Eigen::Matrix3d R_map_sensor;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        const std::string name = "r" + std::to_string(row) + std::to_string(column);
        R_map_sensor(row, column) = reference(static_cast<long>(i), name.c_str());
      }
    }
    const Eigen::Vector3d up_sensor(-std::sin(pitch.value), std::cos(pitch.value) * std::sin(roll.value),
                                    std::cos(pitch.value) * std::cos(roll.value));
    ups.push_back(R_map_sensor * up_sensor);
    mean += ups.back();
  }
  ASSERT_GE(static_cast<double>(ups.size()), kShare * static_cast<double>(results.size()));
  mean.normalize();
  for (const Eigen::Vector3d& up : ups) EXPECT_LE(mean.cross(up).norm() * kDegPerRad, kAngle_deg);
}

TEST_F(HandHeld, ATurnOfTheHandIsNoJump) {
  const std::vector<pose_wall_result> by_hand = measured(kCorridor, "config/vlp16.yaml,config/hand_held.yaml", kFreed);
  const std::vector<pose_wall_result> by_machine = measured(kCorridor, "config/vlp16.yaml", kFreed);
  const auto jumps = [](const std::vector<pose_wall_result>& results) {
    int count = 0;
    for (const pose_wall_result& r : results) {
      count += (r.quantity[POSE_WALL_ROLL].reasons & POSE_WALL_R_INNOVATION) != 0 ? 1 : 0;
    }
    return count;
  };
  EXPECT_GE(jumps(by_machine), 5);
  EXPECT_EQ(jumps(by_hand), 0);
  EXPECT_GE(valid_share(by_hand, POSE_WALL_ROLL), valid_share(by_machine, POSE_WALL_ROLL) + 0.2);
}

}  // namespace
}  // namespace pose_wall::test
