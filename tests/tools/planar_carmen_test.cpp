// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every line of a CARMEN log is a scan or counted by its reason; stamps keep all digits; where nothing came
// back is found from the log; gzip is read, and a damaged archive is refused. Damage is in tests/fuzz.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#if POSE_WALL_HAS_ZLIB
#include <zlib.h>
#endif

#include "io/planar_files/carmen_log.hpp"
#include "support/said_by.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::planar_carmen {
namespace {

using test::contains;
using test::TempFolder;

constexpr double kPi = 3.14159265358979323846;

// A scan of `beams` beams of `range` metres, the robot at x.
std::string front(const std::string& stamp, double x = 1.0, int beams = 4, const std::string& range = "2.50") {
  std::string line = fmt::format("FLASER {}", beams);
  for (int i = 0; i < beams; ++i) line += " " + range;
  return line + fmt::format(" {0} 0.5 0.25 {0} 0.5 0.25 {1} nohost 0.1\n", x, stamp);
}

// Few beams, as the tests write them, are of no field of view by themselves.
const std::string kView = "PARAM laser_front_laser_fov 180 nohost 0\n";

std::string robot(const std::string& stamp) {
  return "ROBOTLASER1 0 -1.5 3.0 1.0 81.9 0.01 0 4 1 2 3 81.9 2 7 8 1.2 0 0 1 0 0 0.1 0.2 0 0 0 " + stamp + " h 0.5\n";
}

std::string refusal(const std::string& text) {
  return test::said_by<CarmenError>([&] { parse_carmen_log(text); });
}

std::int64_t stamp_of(const std::string& word) {
  std::int64_t stamp = -77;
  return parse_stamp_ns(word, &stamp) ? stamp : -99;
}

TEST(PlanarCarmen, ReadsTheFrontLaser) {
  const CarmenLog log = parse_carmen_log(kView + front("976052857.436207", 3.5));
  ASSERT_EQ(log.scans.size(), 1U);
  const CarmenScan& scan = log.scans[0];
  EXPECT_EQ(scan.line, 2U);
  EXPECT_EQ(scan.stamp_ns, 976'052'857'436'207'000);
  EXPECT_EQ(scan.logger_s, 0.1);
  EXPECT_EQ(scan.range_m, std::vector<float>(4, 2.5F));
  EXPECT_EQ(scan.odometry.x_m, 3.5);
  EXPECT_EQ(scan.odometry.y_m, 0.5);
  EXPECT_EQ(scan.laser.yaw_rad, 0.25);
}

TEST(PlanarCarmen, BeamsSpanHalfATurn) {
  const auto angles = [](int beams) { return parse_carmen_log(front("1", 0, beams)).scans[0]; };
  EXPECT_DOUBLE_EQ(angles(180).angle_min_rad, -kPi / 2);
  EXPECT_DOUBLE_EQ(angles(180).angle_step_rad, kPi / 180);
  EXPECT_DOUBLE_EQ(angles(181).angle_step_rad, kPi / 180);
  EXPECT_DOUBLE_EQ(angles(360).angle_step_rad, kPi / 360);
  EXPECT_DOUBLE_EQ(angles(361).angle_step_rad, kPi / 360);
}

TEST(PlanarCarmen, ParametersSayAnotherFieldOfView) {
  const auto scan_of = [](const std::string& params, int beams) {
    return parse_carmen_log(params + front("1", 0, beams)).scans[0];
  };
  const std::string fov = "PARAM laser_front_laser_fov 270 host 0\n";
  const std::string step = "PARAM laser_front_laser_resolution 0.5 host 0\n";
  for (const std::string& params : {fov, step, fov + step, std::string("PARAM front_laser_fov 270.0\n")}) {
    const CarmenScan scan = scan_of(params, 541);
    EXPECT_NEAR(scan.angle_min_rad, -0.75 * kPi, 1e-12) << params;
    EXPECT_NEAR(scan.angle_step_rad, kPi / 360, 1e-12) << params;
  }
  EXPECT_NEAR(scan_of(fov, 540).angle_min_rad, -0.75 * kPi, 1e-12);
  EXPECT_NEAR(scan_of("PARAM laser_front_laser_fov 240\n", 181).angle_step_rad, kPi / 135, 1e-12) << "not half a turn";
}

TEST(PlanarCarmen, BeamsWhoseFieldOfViewNobodyTellsAreRefused) {
  const std::string unclear = refusal(front("1", 0, 541));
  EXPECT_TRUE(contains(unclear, "line 1: 541 beams: 180, 181, 360 and 361 are taken for 180")) << unclear;
  EXPECT_TRUE(contains(unclear, "PARAM laser_front_laser_fov DEGREES")) << unclear;
  const std::string other = refusal(
      "PARAM laser_front_laser_fov 180 host 0\nPARAM laser_front_laser_resolution 0.5 host 0\n" + front("1", 0, 541));
  EXPECT_TRUE(contains(other, "541 beams do not fit the log's parameters: a field of view of 180")) << other;
  EXPECT_TRUE(contains(refusal("PARAM laser_front_laser_resolution 1 host 0\n" + front("1", 0, 541)), "do not fit"));
  EXPECT_TRUE(contains(refusal("PARAM laser_front_laser_fov wide host 0\n" + front("1", 0, 541)), "the log must tell"));
}

TEST(PlanarCarmen, ReadsTheRobotLaser) {
  const CarmenLog log = parse_carmen_log(robot("12.5"));
  ASSERT_EQ(log.scans.size(), 1U);
  const CarmenScan& scan = log.scans[0];
  EXPECT_EQ(scan.range_m, (std::vector<float>{1.0F, 2.0F, 3.0F, 81.9F}));
  EXPECT_EQ(scan.angle_min_rad, -1.5);
  EXPECT_EQ(scan.angle_step_rad, 1.0);
  EXPECT_EQ(scan.laser.x_m, 1.2);
  EXPECT_EQ(scan.odometry.x_m, 1.0);
  EXPECT_EQ(scan.stamp_ns, 12'500'000'000);
  EXPECT_EQ(scan.range_max_m, 81.83) << "codes of faults begin there";
}

TEST(PlanarCarmen, StampsKeepAllDigits) {
  EXPECT_EQ(stamp_of("976052857.436207"), 976'052'857'436'207'000);
  EXPECT_EQ(stamp_of("0.000000001"), 1);
  EXPECT_EQ(stamp_of("-0.5"), -500'000'000);
  EXPECT_EQ(stamp_of("7"), 7'000'000'000);
  EXPECT_EQ(stamp_of("7."), 7'000'000'000);
  EXPECT_EQ(stamp_of(".25"), 250'000'000);
  EXPECT_EQ(stamp_of("1.0189e+09"), 1'018'900'000'000'000'000);
  EXPECT_EQ(stamp_of("1.2345678901234"), 1'234'567'890);
  for (const char* word : {"", ".", "-", "+", "1.2.3", "1x", "nan", "inf", "99999999999", "1e30", "--1", "+-1"}) {
    EXPECT_EQ(stamp_of(word), -99) << word;
  }
}

TEST(PlanarCarmen, EachLineCountsOnce) {
  const std::string text = "# a comment\n\n" + kView +
                           "PARAM robot_frontlaser_offset 0.22 nohost 0\nODOM 0 0 0 0 0 0 1 nohost 0\n" + front("1") +
                           "ODOM 0 0 0 0 0 0 1 nohost 0\nSYNC x\n" + front("nan") + front("2", 1, 4, "far") +
                           front("3", std::nan("")) + robot("4") + "FLASER 4 1 2";
  const CarmenLog log = parse_carmen_log(text);
  EXPECT_EQ(log.lines, 13U);
  EXPECT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.skip(CarmenSkip::kComment).lines, 1U);
  EXPECT_EQ(log.skip(CarmenSkip::kEmpty).first_line, 2U);
  EXPECT_EQ(log.skip(CarmenSkip::kParam).lines, 2U);
  EXPECT_EQ(log.skip(CarmenSkip::kOtherMessage).lines, 3U);
  EXPECT_EQ(log.other_messages.at("ODOM"), 2U);
  EXPECT_EQ(log.skip(CarmenSkip::kBadLine).lines, 3U);
  EXPECT_EQ(log.skip(CarmenSkip::kBadLine).first_line, 9U);
  EXPECT_TRUE(contains(log.skip(CarmenSkip::kBadLine).first_fault, "ipc_timestamp is no number: 'nan'"));
  EXPECT_EQ(log.skip(CarmenSkip::kNotFinite).lines, 1U);
  std::size_t counted = log.scans.size();
  for (const CarmenSkipped& skipped : log.skipped) counted += skipped.lines;
  EXPECT_EQ(counted, log.lines);
  EXPECT_EQ(carmen_sensor_pose(log).x_m, 0.22);
  EXPECT_STREQ(carmen_skip_name(CarmenSkip::kNotFinite), "not_finite");
}

TEST(PlanarCarmen, NamesTheLineOfTheFirstFault) {
  EXPECT_TRUE(contains(refusal("# x\nFLASER 4 1 2 3"), "line 2: it ends before range_readings"));
  EXPECT_TRUE(contains(refusal("FLASER 1000000000 1"), "line 1: num_readings must be from 2 to 6284: '1000000000'"));
  EXPECT_TRUE(contains(refusal("FLASER -4 1"), "num_readings"));
  EXPECT_TRUE(contains(refusal("FLASER 2 1 2 0 0 0 0 0 0 1 h 1 9"), "more words"));
  EXPECT_TRUE(contains(refusal("x,y\n1,2\n"), "of 2 lines none begins with FLASER"));
  EXPECT_TRUE(contains(refusal(""), "of 0 lines"));
}

TEST(PlanarCarmen, KeepsTheOrderOfTheLogWhereStampsJumpBack) {
  const CarmenLog log =
      parse_carmen_log(kView + front("10.5", 1) + front("10.1", 2) + front("10.5", 3) + front("10.6", 4));
  ASSERT_EQ(log.scans.size(), 4U);
  EXPECT_EQ(log.stamps_back, 1U);
  EXPECT_EQ(log.scans[1].stamp_ns, 10'100'000'000);
  EXPECT_EQ(log.scans[1].rising_ns, 10'500'001'000);
  EXPECT_EQ(log.scans[2].rising_ns, 10'500'002'000);
  EXPECT_EQ(log.scans[3].rising_ns, 10'600'000'000);
  EXPECT_EQ(log.scans[2].odometry.x_m, 3.0);
}

TEST(PlanarCarmen, FindsWhereNothingCameBack) {
  const auto range_max = [](const std::string& far, int scans, double step_m = 0.1) {
    std::string text = kView;
    for (int i = 0; i < scans; ++i) {
      text += front(std::to_string(3 * i + 1), step_m * i, 4, fmt::format("{:.2f}", 1.0 + 0.01 * i));
      text += front(std::to_string(3 * i + 2), step_m * i, 2, far);
    }
    return parse_carmen_log(text).scans[0].range_max_m;
  };
  EXPECT_NEAR(range_max("50.00", 40), 49.995, 1e-9);
  EXPECT_NEAR(range_max("81.91", 40), 81.83, 1e-9);
  EXPECT_NEAR(range_max("32.56", 40), 32.555, 1e-9);
  EXPECT_NEAR(range_max("50.00", 4), 81.83, 1e-9) << "eight beams are no pile";
  EXPECT_NEAR(range_max("8.00", 40, 0.0), 81.83, 1e-9) << "a machine that stands sees the same wall";
  EXPECT_NEAR(range_max("1e9", 40, 0.0), 81.83, 1e-9) << "as far as no scanner sees";
}

TEST(PlanarCarmen, ARangeWithoutAReturnIsUnknown) {
  std::string text = kView + "PARAM robot_frontlaser_offset 0.04 nohost 0\n";
  for (int i = 0; i < 30; ++i) text += front(std::to_string(i), i, 4, "50.00");
  text += "FLASER 6 0 -1 nan 44.00 50.00 50.10 0 0 0 0 0 0 99 h 1\n";
  const CarmenLog log = parse_carmen_log(text);
  std::vector<float> ranges;
  const pose_wall_planar_scan scan = planar_scan_of(log.scans.back(), carmen_sensor_pose(log), 0.01, &ranges);
  EXPECT_EQ(scan.beams, 6U);
  EXPECT_EQ(scan.range_m, ranges.data());
  EXPECT_EQ(scan.sensor.x_m, 0.04);
  EXPECT_NEAR(scan.range_max_m, 49.995, 1e-9);
  EXPECT_EQ(scan.stamp_ns, 99'000'000'000);
  for (const std::size_t beam : {0U, 1U, 2U, 4U, 5U}) EXPECT_TRUE(std::isnan(ranges[beam])) << beam;
  EXPECT_FLOAT_EQ(ranges[3], 44.0F);
}

TEST(PlanarCarmen, NamesTheFile) {
  const TempFolder folder;
  const std::string said = test::said_by<CarmenError>([&] { read_carmen_log(folder.write("a.clf", "FLASER 4 x")); });
  EXPECT_TRUE(contains(said, folder.file("a.clf") + ": no scan can be read; the first fault is in line 1")) << said;
  EXPECT_THROW(read_carmen_log(folder.file("none.clf")), CarmenError);
}

#if POSE_WALL_HAS_ZLIB

std::string packed(const TempFolder& folder, const std::string& text) {
  gzFile file = gzopen(folder.file("x.gz").c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return test::text_of(folder.file("x.gz"));
}

TEST(PlanarCarmen, ReadsGzipWhateverItsName) {
  const TempFolder folder;
  std::string text;
  for (int i = 0; i < 3000; ++i) text += front(std::to_string(i), i, 180);
  const std::string archive = packed(folder, text);
  EXPECT_EQ(read_carmen_log(folder.write("a.clf", archive)).scans.size(), 3000U);
  EXPECT_EQ(read_carmen_log(folder.write("b.clf.gz", text)).scans.size(), 3000U);
  EXPECT_THROW(read_carmen_log(folder.write("c", archive.substr(0, archive.size() / 2))), CarmenError);
  EXPECT_THROW(read_carmen_log(folder.write("d", archive.substr(0, archive.size() - 4))), CarmenError);
  std::string damaged = archive;
  damaged[archive.size() / 2] = static_cast<char>(damaged[archive.size() / 2] ^ 0x55);
  EXPECT_THROW(read_carmen_log(folder.write("e", damaged)), CarmenError);
}

TEST(PlanarCarmen, ReadsTheAcesBuilding) {
  const char* data = std::getenv("POSE_WALL_DATA");
  const std::string file = std::string(data == nullptr ? "" : data) + "/planar_aces/aces.clf.gz";
  if (data == nullptr || !std::filesystem::exists(file))
    GTEST_SKIP() << "POSE_WALL_DATA names no folder with planar_aces";
  const CarmenLog log = read_carmen_log(file);
  EXPECT_EQ(log.scans.size(), 7374U);
  EXPECT_EQ(log.lines, 14762U);
  EXPECT_EQ(log.skip(CarmenSkip::kBadLine).lines, 0U);
  EXPECT_EQ(log.stamps_back, 0U);
  EXPECT_NEAR(log.scans[0].range_max_m, 49.755, 1e-9);
}

#endif

}  // namespace
}  // namespace pose_wall::tools::planar_carmen
