// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the motion image holds a result's numbers, rounded so that no value with its level promises more than the
// result did, also where a turn is told as three angles; a result without a pose gives no value and no bound; damage to
// any bit is found; refused calls change nothing. And what a runtime needs of the library: the table of its functions,
// a result without a frame, runs that tell new starts apart, the pose as the engine takes it.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "support/engine_under_test.hpp"
#include "support/motion_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kImagePeriod_ns = 100000000;
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kMilliDegree = 3.14159265358979323846 / 180000.0;

pose_wall_config config_of_seven() {
  return config_with({{"points_max", "20000"}, {"source_id", "7"}});
}

// Three frames of a ribbed road.
pose_wall_motion_result measured_motion() {
  static const pose_wall_motion_result result = [] {
    MotionUnderTest motion(config_of_seven());
    pose_wall_motion_result last{};
    for (std::uint32_t i = 0; i < 3; ++i)
      last = motion.process(cloud_of(ribbed_room_points(i + 1), i * kImagePeriod_ns));
    return last;
  }();
  return result;
}

pose_wall_motion_image motion_image_of(const pose_wall_motion_result& result,
                                       const pose_wall_image_source* source = nullptr) {
  pose_wall_motion_image image;
  std::memset(&image, 0x5A, sizeof image);
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_motion_image_fill(&result, source, &image), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_motion_image_check(&image), POSE_WALL_OK);
  return image;
}

using TurnMatrix = std::array<std::array<double, 3>, 3>;

TurnMatrix turned(const TurnMatrix& a, const TurnMatrix& b) {
  TurnMatrix m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) m[i][j] += a[i][k] * b[k][j];
    }
  }
  return m;
}

struct TurnAngles {
  double roll, pitch, yaw;
};

// About z, then y, then x, as the header says.
TurnAngles turn_angles(const TurnMatrix& m) {
  return {std::atan2(m[2][1], m[2][2]), std::atan2(-m[2][0], std::hypot(m[0][0], m[1][0])),
          std::atan2(m[1][0], m[0][0])};
}

TurnMatrix turn_about(const std::array<double, 3>& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
  const auto [x, y, z] = axis;
  return {{{c + d * x * x, d * x * y - s * z, d * x * z + s * y},
           {d * x * y + s * z, c + d * y * y, d * y * z - s * x},
           {d * x * z - s * y, d * y * z + s * x, c + d * z * z}}};
}

TurnMatrix turn_matrix(const TurnAngles& a) {
  return turned(turned(turn_about({0, 0, 1}, a.yaw), turn_about({0, 1, 0}, a.pitch)), turn_about({1, 0, 0}, a.roll));
}

void set_turn(const TurnAngles& a, pose_wall_motion_result* r) {
  const double cr = std::cos(a.roll / 2), sr = std::sin(a.roll / 2), cp = std::cos(a.pitch / 2);
  const double sp = std::sin(a.pitch / 2), cy = std::cos(a.yaw / 2), sy = std::sin(a.yaw / 2);
  double* const q = r->quaternion;
  q[0] = sr * cp * cy - cr * sp * sy;
  q[1] = cr * sp * cy + sr * cp * sy;
  q[2] = cr * cp * sy - sr * sp * cy;
  q[3] = cr * cp * cy + sr * sp * sy;
}

TEST(MotionImage, HoldsTheHeadOfTheResult) {
  pose_wall_motion_result r = measured_motion();
  r.stamp_ns = -2;
  const pose_wall_image_source source = {sizeof source, 2, 4, 8, 0x100000009ULL, 1500000};
  pose_wall_motion_image image = motion_image_of(r, &source);
  EXPECT_EQ(image.struct_size, std::uint32_t{POSE_WALL_MOTION_IMAGE_BYTES});
  EXPECT_EQ(image.version, std::uint32_t{POSE_WALL_MOTION_IMAGE_VERSION});
  EXPECT_EQ(image.sequence, 3U);
  EXPECT_EQ(image.publication, 9U);
  EXPECT_EQ(image.run, static_cast<std::uint32_t>(r.run));
  EXPECT_NE(image.run, 0U);
  std::uint32_t crc = 0;
  const pose_wall_config config = config_of_seven();
  pose_wall_config_crc(&config, &crc);
  EXPECT_EQ(image.config_crc32, crc);
  EXPECT_EQ(image.stamp_low, 0xFFFFFFFEU);
  EXPECT_EQ(image.stamp_high, 0xFFFFFFFFU);
  EXPECT_EQ(image.source_id, 7U);
  EXPECT_EQ(image.latency_ms, 2U) << "rounded up";
  EXPECT_EQ(image.thinning, 4U);
  EXPECT_EQ(image.told_by, 2U);
  EXPECT_EQ(image.along_state, r.along_state);
  EXPECT_EQ(image.reasons, r.reasons);
  image = motion_image_of(r);
  EXPECT_EQ(image.publication, image.sequence);
  EXPECT_EQ(image.latency_ms, 0xFFFFFFFFU);
  EXPECT_EQ(image.thinning, 0U);
  EXPECT_EQ(image.told_by, 0U);
}

TEST(MotionImage, NoValuePromisesMoreThanTheResult) {
  std::mt19937_64 random(5);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 2000; ++i) {
    pose_wall_motion_result r = measured_motion();
    r.along_m = in(-500.0, 500.0);
    for (double& p : r.position_m) p = in(-500.0, 500.0);
    for (double& level : r.protection_level) level = std::exp(in(-9.0, 3.0));
    const pose_wall_motion_image image = motion_image_of(r);
    EXPECT_GE(image.travel_protection_mm,
              r.protection_level[POSE_WALL_MOTION_ALONG] * 1e3 + std::fabs(r.along_m * 1e3 - image.travel_mm));
    // The place as it stands errs by its own rounding, in any direction.
    const double dx = r.position_m[0] * 1e3 - image.x_mm, dy = r.position_m[1] * 1e3 - image.y_mm,
                 dz = r.position_m[2] * 1e3 - image.z_mm, rounded = std::sqrt(dx * dx + dy * dy + dz * dz);
    EXPECT_LE(rounded, 0.8661);
    EXPECT_GE(image.travel_protection_mm, r.protection_level[POSE_WALL_MOTION_ALONG] * 1e3 + rounded);
    EXPECT_GE(image.across_protection_mm, r.protection_level[POSE_WALL_MOTION_ACROSS] * 1e3 + rounded);
    EXPECT_GE(image.up_protection_mm, r.protection_level[POSE_WALL_MOTION_UP] * 1e3 + rounded);
    EXPECT_LE(image.across_protection_mm, r.protection_level[POSE_WALL_MOTION_ACROSS] * 1e3 + 2.0) << "nor much less";
  }
}

// Turns of the pose about the road's axes, as large as their levels let them be, change no angle by more than its
// level.
TEST(MotionImage, LevelsOfAnglesHoldForEveryTurnWithinTheirs) {
  std::mt19937_64 random(6);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  double tightest = 1e9;
  for (int i = 0; i < 3000; ++i) {
    pose_wall_motion_result r = measured_motion();
    const TurnAngles truth = {in(-0.3, 0.3), in(-0.3, 0.3), in(-2.5, 2.5)};
    set_turn(truth, &r);
    const double heading = in(-3.1, 3.1), rise = in(-0.2, 0.2);
    const std::array<double, 3> along = {std::cos(rise) * std::cos(heading), std::cos(rise) * std::sin(heading),
                                         std::sin(rise)};
    const std::array<double, 3> across = {-std::sin(heading), std::cos(heading), 0.0};
    const std::array<double, 3> up = {-std::sin(rise) * std::cos(heading), -std::sin(rise) * std::sin(heading),
                                      std::cos(rise)};
    for (std::size_t k = 0; k < 3; ++k) r.road_axis[k] = along[k];
    double* const level = &r.protection_level[POSE_WALL_MOTION_ROLL];
    for (std::size_t k = 0; k < 3; ++k) level[k] = in(0.0005, 0.002);
    const pose_wall_motion_image image = motion_image_of(r);
    EXPECT_NEAR(image.roll_mdeg, truth.roll / kMilliDegree, 0.51);
    EXPECT_NEAR(image.pitch_mdeg, truth.pitch / kMilliDegree, 0.51);
    EXPECT_NEAR(image.yaw_mdeg, truth.yaw / kMilliDegree, 0.51);
    const auto sign = [&] { return in(-1.0, 1.0) < 0.0 ? -1.0 : 1.0; };
    const TurnMatrix error = turned(turned(turn_about(along, sign() * level[0]), turn_about(across, sign() * level[1])),
                                    turn_about(up, sign() * level[2]));
    const TurnAngles off = turn_angles(turned(error, turn_matrix(truth)));
    const double told[3] = {static_cast<double>(image.roll_protection_mdeg),
                            static_cast<double>(image.pitch_protection_mdeg),
                            static_cast<double>(image.yaw_protection_mdeg)};
    const double differs[3] = {off.roll / kMilliDegree - image.roll_mdeg, off.pitch / kMilliDegree - image.pitch_mdeg,
                               off.yaw / kMilliDegree - image.yaw_mdeg};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(std::fabs(differs[k]), told[k] + 1.0) << "to the second order of the turn";
      tightest = std::fmin(tightest, told[k] - std::fabs(differs[k]));
    }
  }
  EXPECT_LT(tightest, 2.0) << "nor are they too large";
}

TEST(MotionImage, SpeedAndTurnAreOfTheLastStep) {
  pose_wall_motion_result r = measured_motion();
  // The machine turned left by 0.1 rad from a heading of 0.5, and went half a metre ahead of itself as it stood before.
  set_turn({0.0, 0.0, 0.6}, &r);
  const double before[3] = {std::cos(0.5), std::sin(0.5), 0.0};
  const double nothing[3] = {0.0, 0.0, 0.0};
  std::memcpy(r.road_axis, before, sizeof before);
  std::memcpy(r.step_m, nothing, sizeof nothing);
  std::memcpy(r.step_rad, nothing, sizeof nothing);
  r.step_m[0] = -0.05;
  r.step_m[1] = 0.3;  // across: does not count
  r.step_rad[2] = 0.1;
  r.step_s = 0.1;
  r.step_protection_level[POSE_WALL_MOTION_ALONG] = 0.004;
  r.step_protection_level[POSE_WALL_MOTION_YAW] = 0.001;
  pose_wall_motion_image image = motion_image_of(r);
  EXPECT_EQ(image.speed_mm_s, -500);
  EXPECT_NEAR(image.speed_protection_mm_s, 40, 1);
  EXPECT_EQ(image.turn_mdeg_s, 57296);
  EXPECT_NEAR(image.turn_protection_mdeg_s, 573.5, 1.0);
  r.step_s = r.step_m[0] = r.step_m[1] = r.step_m[2] = kNotKnown;
  image = motion_image_of(r);
  EXPECT_EQ(image.speed_mm_s, POSE_WALL_IMAGE_NO_VALUE);
  EXPECT_EQ(image.speed_protection_mm_s, POSE_WALL_IMAGE_NO_BOUND);
  EXPECT_NE(image.travel_mm, POSE_WALL_IMAGE_NO_VALUE) << "the first frame has a place and no speed";
}

void expect_no_motion(const pose_wall_motion_image& image) {
  EXPECT_EQ(image.run, 0U);
  EXPECT_EQ(image.along_state, std::uint32_t{POSE_WALL_ALONG_LOST});
  for (const std::int32_t value : {image.travel_mm, image.x_mm, image.y_mm, image.z_mm, image.roll_mdeg,
                                   image.pitch_mdeg, image.yaw_mdeg, image.speed_mm_s, image.turn_mdeg_s}) {
    EXPECT_EQ(value, POSE_WALL_IMAGE_NO_VALUE);
  }
  for (const std::int32_t level : {image.travel_protection_mm, image.across_protection_mm, image.up_protection_mm,
                                   image.roll_protection_mdeg, image.pitch_protection_mdeg, image.yaw_protection_mdeg,
                                   image.speed_protection_mm_s, image.turn_protection_mdeg_s}) {
    EXPECT_EQ(level, POSE_WALL_IMAGE_NO_BOUND);
  }
}

TEST(MotionImage, WithoutAPoseThereIsNoValue) {
  MotionUnderTest motion(config_of_seven());
  pose_wall_motion_result blank = blank_motion_result();
  ASSERT_EQ(pose_wall_motion_blank(motion.get(), &blank), POSE_WALL_OK);
  expect_no_motion(motion_image_of(blank));
  EXPECT_EQ(motion_image_of(blank).sequence, 0U);
  const pose_wall_motion_result lost = motion.process(cloud_of(Points(), 5));
  EXPECT_EQ(lost.run, 0U);
  expect_no_motion(motion_image_of(lost));
  EXPECT_EQ(motion_image_of(lost).sequence, 1U);
}

TEST(MotionImage, WhatDoesNotFitSaturates) {
  pose_wall_motion_result r = measured_motion();
  r.along_m = 1e9;
  r.position_m[1] = -1e9;
  r.protection_level[POSE_WALL_MOTION_ALONG] = 1e9;
  r.protection_level[POSE_WALL_MOTION_ACROSS] = kUnbounded;
  r.protection_level[POSE_WALL_MOTION_UP] = -1.0;
  r.protection_level[POSE_WALL_MOTION_YAW] = kNotKnown;
  const pose_wall_motion_image image = motion_image_of(r);
  EXPECT_EQ(image.travel_mm, 2147483647);
  EXPECT_EQ(image.y_mm, -2147483647);
  for (const std::int32_t level :
       {image.travel_protection_mm, image.across_protection_mm, image.up_protection_mm, image.yaw_protection_mdeg}) {
    EXPECT_EQ(level, POSE_WALL_IMAGE_NO_BOUND);
  }
}

TEST(MotionImage, AnyFlippedBitIsFound) {
  const pose_wall_motion_image good = motion_image_of(measured_motion());
  for (std::size_t bit = 0; bit < 8 * sizeof good; ++bit) {
    pose_wall_motion_image bad = good;
    reinterpret_cast<unsigned char*>(&bad)[bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
    const bool head = bit < 8 * offsetof(pose_wall_motion_image, crc32c);
    EXPECT_EQ(pose_wall_motion_image_check(&bad), head ? POSE_WALL_E_IMAGE_VERSION : POSE_WALL_E_IMAGE_CRC) << bit;
  }
}

// ------------------------------------------------------------------------------------------ for a runtime

TEST(MotionFunctions, AreThoseOfTheLibrary) {
  const pose_wall_motion_functions* const f = pose_wall_motion_functions_get();
  ASSERT_NE(f, nullptr);
  EXPECT_EQ(f->struct_size, sizeof *f);
  EXPECT_EQ(f->abi_version, pose_wall_motion_abi_version());
  EXPECT_EQ(f->settings_check, &pose_wall_motion_settings_check);
  EXPECT_EQ(f->memory_needed, &pose_wall_motion_memory_needed);
  EXPECT_EQ(f->open, &pose_wall_motion_open);
  EXPECT_EQ(f->reset, &pose_wall_motion_reset);
  EXPECT_EQ(f->process, &pose_wall_motion_process);
  EXPECT_EQ(f->give, &pose_wall_motion_give);
  EXPECT_EQ(f->blank, &pose_wall_motion_blank);
  EXPECT_EQ(f->image_fill, &pose_wall_motion_image_fill);
}

TEST(MotionBlank, KeepsTheLastFramesIndexAndStampAlone) {
  MotionUnderTest motion(config_of_seven());
  pose_wall_motion_result blank = blank_motion_result();
  ASSERT_EQ(pose_wall_motion_blank(motion.get(), &blank), POSE_WALL_OK);
  EXPECT_EQ(blank.frame_index, std::numeric_limits<std::uint64_t>::max());
  motion.process(cloud_of(ribbed_room_points(1), 5));
  motion.process(cloud_of(ribbed_room_points(2), 5 + kImagePeriod_ns));
  ASSERT_EQ(pose_wall_motion_blank(motion.get(), &blank), POSE_WALL_OK);
  EXPECT_EQ(blank.frame_index, 1U);
  EXPECT_EQ(blank.stamp_ns, 5 + kImagePeriod_ns);
  EXPECT_EQ(blank.run, 0U);
  EXPECT_TRUE(std::isnan(blank.along_m) && std::isnan(blank.quaternion[3]) && std::isinf(blank.protection_level[0]));
  motion.reset();
  ASSERT_EQ(pose_wall_motion_blank(motion.get(), &blank), POSE_WALL_OK);
  EXPECT_EQ(blank.frame_index, std::numeric_limits<std::uint64_t>::max());
}

TEST(MotionRun, IsAnotherAfterEachNewStart) {
  MotionUnderTest motion(config_of_seven());
  const auto frame = [&](std::int64_t number) {
    return motion
        .process(cloud_of(ribbed_room_points(static_cast<std::uint32_t>(number) + 1), number * kImagePeriod_ns))
        .run;
  };
  const std::uint64_t first = frame(0);
  EXPECT_NE(first, 0U);
  motion.reset();
  const std::uint64_t second = frame(0);
  EXPECT_NE(second, 0U);
  EXPECT_NE(second, first) << "also where the stamps are the same";
}

// A frame without a pose may have moved by all that the machine can.
TEST(MotionGive, IsTheLastPoseOrThatNothingIsKnown) {
  MotionUnderTest motion(config_of_seven());
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof inputs;
  inputs.given = POSE_WALL_INPUT_SPEED | POSE_WALL_INPUT_ODOMETRY;
  inputs.speed_m_s = 0.5;
  ASSERT_EQ(pose_wall_motion_give(motion.get(), &inputs), POSE_WALL_OK);
  EXPECT_EQ(inputs.given, std::uint32_t{POSE_WALL_INPUT_SPEED}) << "before any frame there is no pose";
  motion.process(cloud_of(ribbed_room_points(1), 0));
  const pose_wall_motion_result last = motion.process(cloud_of(ribbed_room_points(2), kImagePeriod_ns));
  ASSERT_EQ(pose_wall_motion_give(motion.get(), &inputs), POSE_WALL_OK);
  EXPECT_EQ(inputs.given, std::uint32_t{POSE_WALL_INPUT_SPEED | POSE_WALL_INPUT_ODOMETRY});
  EXPECT_EQ(inputs.speed_m_s, 0.5);
  EXPECT_EQ(inputs.odometry.run, last.run);
  motion.process(cloud_of(Points(), 2 * kImagePeriod_ns));
  ASSERT_EQ(pose_wall_motion_give(motion.get(), &inputs), POSE_WALL_OK);
  EXPECT_EQ(inputs.given, std::uint32_t{POSE_WALL_INPUT_SPEED | POSE_WALL_INPUT_ODOMETRY});
  EXPECT_NE(inputs.odometry.run, last.run) << "not to be compared with its neighbours";
  pose_wall_motion_settings limits;
  pose_wall_motion_settings_init(&limits);
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) {
    EXPECT_TRUE(std::isinf(inputs.odometry.level[k])) << k;
    EXPECT_GE(inputs.odometry.rate_level[k], k < 3 ? limits.speed_max_m_s : limits.turn_max_rad_s) << k;
  }
}

}  // namespace
}  // namespace pose_wall::test
