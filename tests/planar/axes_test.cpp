// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what include/AXES.md says of each part holds for every forward_axis. One machine does one thing, and base is
// turned under it, so that its forward axis is +X, -X, +Y or -Y of base.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "planar/bytes_needed.hpp"
#include "planar/encounter/plans.hpp"
#include "pose_wall_motion.h"
#include "pose_wall_planar.h"
#include "support/aligned_block.hpp"
#include "support/engine_under_test.hpp"
#include "support/motion_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr std::int64_t kPeriod_ns = 100000000;

struct Axis {
  const char* name;
  double ahead_rad;  // from +X of base to forward_axis
};
constexpr Axis kAxes[] = {{"+X", 0.0}, {"-X", M_PI}, {"+Y", 0.5 * M_PI}, {"-Y", -0.5 * M_PI}};

class Axes : public testing::TestWithParam<Axis> {
 protected:
  Axes() : config_(small_config()) { set(&config_, "forward_axis", axis().name); }

  const Axis& axis() const { return GetParam(); }
  // Of base, forwards: as x and y of what lies `ahead` and `left` of the machine's origin.
  std::array<double, 2> in_base(double ahead, double left) const {
    const double c = std::cos(axis().ahead_rad), s = std::sin(axis().ahead_rad);
    return {c * ahead - s * left, s * ahead + c * left};
  }
  // From the machine's frame (x ahead, y left) to base, where the sensor stands.
  Points seen(Points points, double turned_left_rad = 0.0) const {
    const double c = std::cos(axis().ahead_rad - turned_left_rad), s = std::sin(axis().ahead_rad - turned_left_rad);
    for (auto& p : points) {
      const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
      p[0] = static_cast<float>(x), p[1] = static_cast<float>(y);
    }
    return points;
  }

  pose_wall_config config_;
};

TEST_P(Axes, EngineYawIsPositiveWhereTheMachineIsTurnedRight) {
  EngineUnderTest engine(config_);
  const pose_wall_result r = engine.process(cloud_of(seen(room_points(1, 0.5), 5.0 * kDegree), 0));
  EXPECT_NEAR(r.quantity[POSE_WALL_YAW].raw, -5.0 * kDegree, 0.3 * kDegree);
  EXPECT_LT(r.quantity[POSE_WALL_D_LF].raw, r.quantity[POSE_WALL_D_RB].raw);
  EXPECT_NEAR(r.quantity[POSE_WALL_D_LB].raw + r.quantity[POSE_WALL_D_RB].raw, 5.0 / std::cos(5.0 * kDegree), 0.1);
}

TEST_P(Axes, MotionGoesAheadAndTurnsLeftAsItWasTold) {
  MotionUnderTest motion(config_);
  pose_wall_motion_result r{};
  for (int i = 0; i < 12; ++i) {
    const Points points = seen(room_points(static_cast<std::uint32_t>(i + 1)), i * kDegree);
    pose_wall_cloud cloud = cloud_of(points, i * kPeriod_ns);
    pose_wall_inputs inputs{};
    inputs.struct_size = sizeof inputs;
    inputs.given = POSE_WALL_INPUT_SPEED;
    inputs.speed_m_s = 0.5, inputs.speed_sigma_m_s = 0.02;
    cloud.inputs = &inputs;
    r = motion.process(cloud);
  }
  const auto ahead = in_base(1.0, 0.0);
  EXPECT_NEAR(r.along_m, 0.55, 0.1);
  EXPECT_NEAR(r.position_m[0] * ahead[0] + r.position_m[1] * ahead[1], 0.55, 0.1);
  EXPECT_NEAR(2.0 * std::atan2(r.quaternion[2], r.quaternion[3]), 11.0 * kDegree, kDegree);
}

// A sensor of 31 lines in a chamber of 12 x 7 m with a niche, a slanted wall and a pillar.
Points chamber_points(double x, double y, double yaw) {
  constexpr double kWalls[][4] = {{-6, -3.5, 6, -3.5},  {6, -3.5, 6, 1},       {6, 1, 4.5, 1},    {4.5, 1, 4.5, 3.5},
                                  {4.5, 3.5, -2, 3.5},  {-2, 3.5, -2, 5},      {-2, 5, -4, 5},    {-4, 5, -4, 3.5},
                                  {-4, 3.5, -4.5, 3.5}, {-4.5, 3.5, -6, -3.5}, {-1, -1, 0, -1.4}, {0, -1.4, 0, -0.4},
                                  {0, -0.4, -1, -1}};
  Points points;
  for (int column = 0; column < 720; ++column) {
    const double azimuth = 2.0 * M_PI * column / 720, dx = std::cos(yaw + azimuth), dy = std::sin(yaw + azimuth);
    double flat = 1e9;
    for (const auto& w : kWalls) {
      const double ex = w[2] - w[0], ey = w[3] - w[1], det = dx * ey - dy * ex;
      if (std::abs(det) < 1e-12) continue;
      const double t = ((w[0] - x) * ey - (w[1] - y) * ex) / det, u = ((w[0] - x) * dy - (w[1] - y) * dx) / det;
      if (t > 0 && u >= 0 && u <= 1) flat = std::min(flat, t);
    }
    for (int line = -15; line <= 15; ++line) {
      const double rise = std::tan(2.0 * line * kDegree), end = std::min(flat, (rise < 0.0 ? -1.4 : 1.8) / rise);
      const double range = line == 0 ? flat : end;
      points.push_back({static_cast<float>(range * std::cos(azimuth)), static_cast<float>(range * std::sin(azimuth)),
                        static_cast<float>(range * (line == 0 ? 0.0 : rise))});
    }
  }
  return points;
}

// Planar scans of clouds, about a floor 1.4 m below base.
class ScannerOfAxes {
 public:
  explicit ScannerOfAxes(const pose_wall_config& config) {
    EXPECT_EQ(pose_wall_planar_scanner_settings_init(&settings_), POSE_WALL_OK);
    settings_.angle_step_rad = 2.0 * M_PI / 720;
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_planar_scanner_memory_needed(&settings_, &bytes), POSE_WALL_OK);
    block_ = AlignedBlock(bytes, Dirt::kRandom);
    EXPECT_EQ(pose_wall_planar_scanner_open(&config, &settings_, block_.data(), block_.size(), &scanner_),
              POSE_WALL_OK);
  }
  pose_wall_planar_scan scan(const Points& points) {
    const pose_wall_planar_floor floor{sizeof floor, 1, {0.0, 0.0, 1.0}, 1.4, 0.001, 0.004, 10.0};
    pose_wall_planar_scan scan{};
    scan.struct_size = sizeof scan;
    const pose_wall_cloud cloud = cloud_of(points, stamp_ns_ += kPeriod_ns);
    EXPECT_EQ(pose_wall_planar_scanner_process(scanner_, &cloud, &floor, &scan, nullptr), POSE_WALL_OK);
    return scan;
  }

 private:
  pose_wall_planar_scanner_settings settings_{};
  AlignedBlock block_{1, Dirt::kRandom};
  pose_wall_planar_scanner* scanner_ = nullptr;
  std::int64_t stamp_ns_ = 0;
};

TEST_P(Axes, ScanAnglesCountFromXOfBase) {
  ScannerOfAxes scanner(config_);
  const pose_wall_planar_scan scan = scanner.scan(seen(room_points(1, 0.5)));
  const auto range_at = [&](double rad) {  // a beam and its neighbour: a scan begins and ends at +-pi
    const double beam = std::remainder(rad - scan.angle_min_rad - M_PI, 2.0 * M_PI) + M_PI;
    const auto k = static_cast<std::uint32_t>(beam / scan.angle_step_rad);
    return std::fmin(scan.range_m[k % scan.beams], scan.range_m[(k + 1) % scan.beams]);
  };
  EXPECT_NEAR(range_at(axis().ahead_rad + 0.5 * M_PI), 2.0, 0.05);  // the wall to the left is nearer
  EXPECT_NEAR(range_at(axis().ahead_rad - 0.5 * M_PI), 3.0, 0.05);
}

TEST_P(Axes, APlaceIsThatOfBaseAndTheMachineStandsInIt) {
  ScannerOfAxes scanner(config_);
  pose_wall_planar_localise_settings settings;
  ASSERT_EQ(pose_wall_planar_localise_settings_init(&settings), POSE_WALL_OK);
  settings.map_is_whole = 1;
  settings.work = 1000000000;
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_planar_localise_memory_needed(&settings, &bytes), POSE_WALL_OK);
  AlignedBlock block(bytes, Dirt::kRandom);
  pose_wall_planar_localise* localise = nullptr;
  ASSERT_EQ(pose_wall_planar_localise_open(&settings, block.data(), block.size(), &localise), POSE_WALL_OK);
  const double places[][2] = {{2, 0}, {-4, 0}, {-3, 3}, {0.5, -2}, {-2, -2.5}};
  for (const auto& at : places) {  // the machine looks along x of the map
    const pose_wall_planar_scan scan = scanner.scan(seen(chamber_points(at[0], at[1], 0.0)));
    std::vector<float> xy;
    for (std::uint32_t k = 0; k < scan.beams; ++k) {
      if (!std::isfinite(scan.range_m[k])) continue;
      const double angle = scan.angle_min_rad + k * scan.angle_step_rad;
      xy.push_back(static_cast<float>(scan.range_m[k] * std::cos(angle)));
      xy.push_back(static_cast<float>(scan.range_m[k] * std::sin(angle)));
    }
    const pose_wall_planar_pose base{at[0], at[1], -axis().ahead_rad};
    ASSERT_EQ(pose_wall_planar_localise_add(localise, &base, xy.data(), static_cast<std::uint32_t>(xy.size() / 2)),
              POSE_WALL_OK);
  }
  ASSERT_EQ(pose_wall_planar_localise_finish(localise), POSE_WALL_OK);
  pose_wall_planar_localise_result found{};
  found.struct_size = sizeof found;
  const pose_wall_planar_scan scan = scanner.scan(seen(chamber_points(-1.5, 1.2, 2.0)));
  ASSERT_EQ(pose_wall_planar_localise_process(localise, &scan, nullptr, &found), POSE_WALL_OK);
  ASSERT_EQ(found.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
  EXPECT_NEAR(std::remainder(found.pose.yaw_rad + axis().ahead_rad - 2.0, 2.0 * M_PI), 0.0, 0.01);

  // Its turning centre lies 0.3 m ahead of base and 0.1 m to the left.
  const auto centre_m = in_base(0.3, 0.1);
  pose_wall_planar_pose machine{}, back{};
  ASSERT_EQ(pose_wall_planar_machine_of_base(&config_, centre_m.data(), &found.pose, &machine), POSE_WALL_OK);
  EXPECT_NEAR(machine.yaw_rad, 2.0, 0.01);
  EXPECT_NEAR(machine.x_m, -1.5 + 0.3 * std::cos(2.0) - 0.1 * std::sin(2.0), 0.02);
  EXPECT_NEAR(machine.y_m, 1.2 + 0.3 * std::sin(2.0) + 0.1 * std::cos(2.0), 0.02);
  ASSERT_EQ(pose_wall_planar_base_of_machine(&config_, centre_m.data(), &machine, &back), POSE_WALL_OK);
  EXPECT_NEAR(back.x_m, found.pose.x_m, 1e-12);
  EXPECT_NEAR(back.y_m, found.pose.y_m, 1e-12);
  EXPECT_NEAR(back.yaw_rad, found.pose.yaw_rad, 1e-12);
}

// Along a route of 3 m, forwards or backwards, with the machine where base says.
pose_wall_planar_track_command command_of(const pose_wall_config& config, double ahead_rad, std::int32_t drive) {
  pose_wall_planar_track_settings settings;
  EXPECT_EQ(pose_wall_planar_track_settings_init(&settings), POSE_WALL_OK);
  AlignedBlock block(bytes_needed(settings), Dirt::kRandom);
  pose_wall_planar_tracker* tracker = nullptr;
  EXPECT_EQ(pose_wall_planar_track_open(&settings, block.data(), block.size(), &tracker), POSE_WALL_OK);
  constexpr double kYaw = 0.7;  // of the machine in the map
  const pose_wall_planar_pose base{4.0, 5.0, kYaw - ahead_rad};
  pose_wall_planar_track_input input{};
  input.struct_size = sizeof input;
  input.has_pose = 1;
  input.speed_m_s = std::nan("");
  EXPECT_EQ(pose_wall_planar_machine_of_base(&config, nullptr, &base, &input.pose), POSE_WALL_OK);
  const pose_wall_planar_pose end{4.0 + drive * 3.0 * std::cos(kYaw), 5.0 + drive * 3.0 * std::sin(kYaw), kYaw};
  const pose_wall_planar_path_pose route[] = {{input.pose, 0.0, 0.0, 0, 0}, {end, 0.0, 3.0, drive, 1}};
  EXPECT_EQ(pose_wall_planar_track_route(tracker, route, 2, nullptr, nullptr), POSE_WALL_OK);
  pose_wall_planar_track_command command{};
  command.struct_size = sizeof command;
  for (int k = 0; k < 8; ++k) {
    input.now_ns = input.pose_ns = k * kPeriod_ns;
    EXPECT_EQ(pose_wall_planar_track_step(tracker, &input, &command), POSE_WALL_OK);
  }
  return command;
}

// A person stands ahead of the machine; nothing is behind it that its sensor sees.
pose_wall_planar_stop_result stop_with(pose_wall_config config, const Axis& axis, double speed_m_s) {
  const Sensor sensor(Pattern::os1_64, 2.0, 1.5, 0.0, 0.28, 1.0, 1024);
  set(&config, "extrinsic_x", sensor.x_m * std::cos(axis.ahead_rad));
  set(&config, "extrinsic_y", sensor.x_m * std::sin(axis.ahead_rad));
  set(&config, "extrinsic_z", sensor.z_m);
  set(&config, "extrinsic_pitch", sensor.pitch_rad);
  set(&config, "extrinsic_yaw", axis.ahead_rad);
  set(&config, "range_max", 100.0);
  pose_wall_planar_stop_settings settings = encounter_settings();
  settings.confirm_m = 2.5;     // what lies below the rays someone has looked at
  settings.approach_m_s = 0.0;  // the person stays there
  const bool is_along_x = std::abs(std::cos(axis.ahead_rad)) > 0.5;
  EXPECT_EQ(pose_wall_planar_stop_rectangle(&settings, is_along_x ? -2.25 : -0.6, is_along_x ? 2.25 : 0.6,
                                            is_along_x ? -0.6 : -2.25, is_along_x ? 0.6 : 2.25),
            POSE_WALL_OK);
  AlignedBlock block(stop_bytes_needed(), Dirt::kRandom);
  pose_wall_planar_stop* stop = nullptr;
  EXPECT_EQ(pose_wall_planar_stop_open(&config, &settings, block.data(), block.size(), &stop), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_planar_stop_confirm(stop), POSE_WALL_OK);
  World world;
  world.half_width_m = 3.0;
  world.things.push_back(round_thing(3.3, 0.0, 0.3, -0.1, 1.7));
  pose_wall_planar_stop_motion motion{};
  motion.struct_size = sizeof motion;
  motion.given = POSE_WALL_PLANAR_STOP_COMMANDED;
  motion.command_speed_m_s = speed_m_s;
  pose_wall_planar_stop_result result{};
  result.struct_size = sizeof result;
  Scan scan;
  Draw draw(7);
  for (int k = 1; k <= 10; ++k) {
    scan.take(sensor, world, 0.0, 0.0, 0.0, 0.0, 0.0, &draw);
    const pose_wall_cloud cloud = scan.cloud(k * kPeriod_ns);
    EXPECT_EQ(pose_wall_planar_stop_process(stop, &cloud, &motion, k * kPeriod_ns, &result), POSE_WALL_OK);
  }
  return result;
}

TEST_P(Axes, TrackerAndStopMeanTheSameByASpeed) {
  const auto ahead = in_base(1.0, 0.0);
  const auto along = [&](const pose_wall_planar_stop_result& r) {
    return r.nearest_m[0] * ahead[0] + r.nearest_m[1] * ahead[1];
  };
  const pose_wall_planar_track_command forwards = command_of(config_, axis().ahead_rad, 1);
  EXPECT_EQ(forwards.state, std::uint32_t{POSE_WALL_PLANAR_TRACK_FOLLOWING});
  EXPECT_GT(forwards.speed_m_s, 0.05);
  EXPECT_NEAR(forwards.turn_rad_s, 0.0, 1e-9);
  const pose_wall_planar_stop_result person = stop_with(config_, axis(), forwards.speed_m_s);
  EXPECT_GT(along(person), 2.25);  // what limits it: the person or the shadow
  const pose_wall_planar_track_command backwards = command_of(config_, axis().ahead_rad, -1);
  EXPECT_LT(backwards.speed_m_s, -0.05);
  const pose_wall_planar_stop_result blind = stop_with(config_, axis(), backwards.speed_m_s);
  EXPECT_NE(blind.reasons & POSE_WALL_PLANAR_STOP_R_BLIND, 0U);
  EXPECT_LT(along(blind), -2.25);
}

INSTANTIATE_TEST_SUITE_P(All, Axes, testing::ValuesIn(kAxes));

TEST(AxesConversion, RefusesWhatItsHeaderSays) {
  const pose_wall_config config = config_with();
  pose_wall_config never{};
  const pose_wall_planar_pose good{1.0, 2.0, 3.0}, bad{std::nan(""), 0.0, 0.0};
  const double far_m[] = {0.0, 20.5}, none_m[] = {std::nan(""), 0.0};
  pose_wall_planar_pose to = good;
  for (auto* const call : {pose_wall_planar_machine_of_base, pose_wall_planar_base_of_machine}) {
    EXPECT_EQ(call(nullptr, nullptr, &good, &to), POSE_WALL_E_NULL);
    EXPECT_EQ(call(&config, nullptr, nullptr, &to), POSE_WALL_E_NULL);
    EXPECT_EQ(call(&config, nullptr, &good, nullptr), POSE_WALL_E_NULL);
    EXPECT_EQ(call(&never, nullptr, &good, &to), POSE_WALL_E_STRUCT_SIZE);
    EXPECT_EQ(call(&config, far_m, &good, &to), POSE_WALL_E_VALUE_RANGE);
    EXPECT_EQ(call(&config, none_m, &good, &to), POSE_WALL_E_VALUE_RANGE);
    EXPECT_EQ(call(&config, nullptr, &bad, &to), POSE_WALL_PLANAR_E_POSE);
    EXPECT_EQ(to.x_m, 1.0);
    EXPECT_EQ(call(&config, nullptr, &to, &to), POSE_WALL_OK);  // +X about the origin of base: the same
    EXPECT_NEAR(to.yaw_rad, 3.0, 1e-12);
  }
}

}  // namespace
}  // namespace pose_wall::test
