// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a field of times that is of no use is said by run, motion and info: of a type that is not read, all equal,
// longer than a scan. Good times, and scans without any, are not doubted.

#include "study/info/usable_times.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "io/frames/pcd_reader.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr int kPoints = 1600;

// A scan of 16 rings with a field t: `count` float64 a point.
std::string scan(const std::string& name, int count, const std::function<double(int)>& time_of) {
  std::string file = fmt::format(
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z {}\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 {}\nWIDTH {}\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      name, count, kPoints, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double azimuth = 2.0 * M_PI * (i / 16) / 100.0, elevation = (2 * (i % 16) - 15) * M_PI / 180.0;
    for (const double value : {5.0 * std::cos(azimuth), 5.0 * std::sin(azimuth), 5.0 * std::tan(elevation)}) {
      file += raw(static_cast<float>(value));
    }
    for (int k = 0; k < count; ++k) file += raw(time_of(i));
  }
  return file;
}

double even_s(int point) {
  return 0.1 * point / kPoints;
}

struct UnusableTimes {
  const char* what;
  std::string file;
  const char* said;
};

std::vector<UnusableTimes> unusable_cases() {
  return {{"two numbers", scan("t", 2, even_s), "called like a time"},
          {"all equal", scan("t", 1, [](int) { return 1.7e9; }), "all points of a scan have the same time"},
          {"longer than a scan", scan("timestamp", 1, [](int i) { return i * 1e12; }), "in none of s, ms, us and ns"}};
}

TEST(UnusableTimes, AreSaidByRunMotionAndInfo) {
  for (const UnusableTimes& unusable : unusable_cases()) {
    const TempFolder folder;
    const std::string file = folder.write("a.pcd", unusable.file), out = folder.file("o.csv");
    for (const char* verb : {"run", "motion"}) {
      const std::string said = command({verb, "-o", out, file}).errors;
      EXPECT_TRUE(contains(said, "times: 1 of 1 scans: ") && contains(said, unusable.said))
          << verb << ", " << unusable.what << ": " << said;
      EXPECT_FALSE(contains(command({verb, "-q", "-o", out, file}).errors, "times:")) << verb;
    }
    const std::string info = command({"info", file}).printed;
    // info folds its lines.
    EXPECT_TRUE(contains(info, "times?") && contains(info, "1 of 1 scans")) << unusable.what << ": " << info;
  }
}

TEST(UnusableTimes, GoodTimesAndNoneAreNotDoubted) {
  const TempFolder folder;
  for (const std::string& file : {scan("t", 1, even_s), scan("other", 1, even_s)}) {
    UsableTimes times;
    times.add(read_pcd(bytes_of(file)));
    EXPECT_EQ(times.doubt(), "");
    EXPECT_FALSE(contains(command({"run", "-o", folder.file("o.csv"), folder.write("a.pcd", file)}).errors, "times:"));
  }
}

TEST(UnusableTimes, SingleBrokenScansAreNotTheRecording) {
  UsableTimes times;
  for (int i = 0; i < 20; ++i) times.add(read_pcd(bytes_of(scan("t", 1, even_s))));
  times.add(read_pcd(bytes_of(scan("t", 1, [](int) { return 3.0; }))));
  EXPECT_EQ(times.doubt(), "");
  for (int i = 0; i < 10; ++i) times.add(read_pcd(bytes_of(scan("t", 1, [](int) { return 3.0; }))));
  EXPECT_TRUE(contains(times.doubt(), "11 of 31 scans")) << times.doubt();
}

pose_wall_motion_result step(double x_m, double yaw_rad, double level) {
  pose_wall_motion_result moved{};
  moved.step_s = 0.1;
  moved.step_m[0] = x_m;
  moved.step_rad[2] = yaw_rad;
  for (double& one : moved.step_protection_level) one = level;
  return moved;
}

std::string doubt_of(const std::string& file, const pose_wall_motion_result& moved, int scans) {
  UsableTimes times;
  for (int i = 0; i < scans; ++i) {
    times.add(read_pcd(bytes_of(file)));
    times.add_motion(moved);
  }
  return times.doubt();
}

TEST(UsableTimes, NoneAreDoubtedWhereTheMachineSurelyMoves) {
  const std::string none = scan("other", 1, even_s), good = scan("t", 1, even_s);
  for (const auto& moved : {step(0.021, 0.0, 1e-4), step(-0.021, 0.0, 1e-4), step(0.0, 0.0036, 1e-4)}) {
    const std::string doubt = doubt_of(none, moved, 3);
    EXPECT_TRUE(contains(doubt, "3 of 3 scans") && contains(doubt, "carry no times, and the machine moves")) << doubt;
    EXPECT_EQ(doubt_of(none, moved, 2), "") << "a single step may be a mistake";
    EXPECT_EQ(doubt_of(good, moved, 9), "");
  }
  for (const auto& stands : {step(0.019, 0.0034, 1e-4), step(0.5, 0.5, 1.0), step(NAN, NAN, NAN), step(0.5, 0.5, NAN),
                             step(0.5, 0.5, INFINITY), pose_wall_motion_result{}}) {
    EXPECT_EQ(doubt_of(none, stands, 9), "") << stands.step_m[0];
  }
}

}  // namespace
}  // namespace pose_wall::tools
