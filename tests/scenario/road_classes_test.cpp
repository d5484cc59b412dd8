// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, for simulated classes of roads with random sizes and exact truth: what is claimed to be valid is within its
// protection level and within the alert limit, and what the class allows to be measured is measured often enough.
// Does not prove a rate: a few hundred frames per class bound one at a per cent; the campaign does more.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

// The truth is that of mean surfaces; beyond a level by this much is the simulator's own grid and rounding.
constexpr double kMargin_rad = 1e-4, kMargin_m = 0.001;

struct Class {
  const char* scene;
  const char* sensor;
  std::uint32_t seeds;    // sizes drawn anew for each
  double measured_share;  // of angles and distances that have a truth: at least this much valid or degraded
  double valid_share;     // and this much valid
};

void PrintTo(const Class& c, std::ostream* os) {
  *os << c.scene << " " << c.sensor;
}

bool is_angle(std::uint32_t q) {
  return q <= POSE_WALL_YAW;
}

double alert_limit(std::uint32_t q) {
  return is_angle(q) ? 1.0 * kRadPerDeg : 0.10;
}

struct Counts {
  double with_truth = 0, measured = 0, valid = 0;
};

void judge(const JudgedFrame& f, std::uint64_t seed, std::uint32_t frame, Counts* counts) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = f.result.quantity[q];
    const bool valid = v.state == POSE_WALL_VALID, measured = valid || v.state == POSE_WALL_DEGRADED;
    const double error = std::fabs(f.error(q)), raw_error = std::fabs(f.raw_error(q));
    const double margin = is_angle(q) ? kMargin_rad : kMargin_m;
    const auto where = [&] {
      return std::string(pose_wall_quantity_name(q)) + " seed " + std::to_string(seed) + " frame " +
             std::to_string(frame) + " value " + std::to_string(v.value) + " truth " +
             std::to_string(f.truth.value[q]) + " level " + std::to_string(v.protection_level);
    };
    if (std::isnan(f.truth.value[q])) {
      EXPECT_FALSE(valid) << where() << ": valid where there is nothing";
      continue;
    }
    counts->with_truth += 1.0;
    counts->measured += measured ? 1.0 : 0.0;
    counts->valid += valid ? 1.0 : 0.0;
    if (!valid) continue;
    EXPECT_LE(error, v.protection_level + margin) << where();
    EXPECT_LE(raw_error, v.protection_level + margin) << where();
    EXPECT_LE(error, alert_limit(q)) << where();
  }
}

// Sanitizers are slow and look for faults of another kind: two draws of each class are enough for them.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t kDrawsMax = 2;
#else
constexpr std::uint64_t kDrawsMax = 1000;
#endif

class RoadClass : public ::testing::TestWithParam<Class> {};

TEST_P(RoadClass, ValidIsRightAndWhatCanBeMeasuredIs) {
  constexpr std::uint32_t kFramesARoad = 3;
  const Class& c = GetParam();
  Counts counts;
  for (std::uint64_t seed = 1; seed <= std::min<std::uint64_t>(c.seeds, kDrawsMax); ++seed) {
    const sim::SceneSetup setup = sim::make_setup(c.scene, c.sensor, true, seed);
    const std::vector<JudgedFrame> frames = run_frames(setup, seed, kFramesARoad);
    for (std::uint32_t i = 0; i < kFramesARoad; ++i) judge(frames[i], seed, i, &counts);
  }
  ASSERT_GT(counts.with_truth, 0.0);
  RecordProperty("measured_share", std::to_string(counts.measured / counts.with_truth));
  RecordProperty("valid_share", std::to_string(counts.valid / counts.with_truth));
  if (c.seeds > kDrawsMax) return;  // too few for shares
  EXPECT_GE(counts.measured / counts.with_truth, c.measured_share);
  EXPECT_GE(counts.valid / counts.with_truth, c.valid_share);
}

// Shares are floors, well below what was seen, so that a level that becomes more honest breaks none. A sensor that is
// mounted upside down without a word is not among them: at half the height of the road, roof and floor look alike.
const Class kClasses[] = {
    {"clean", "os0-128", 6, 1, 0.99},
    {"clean", "os1-64", 10, 0.99, 0.95},
    {"rough", "os1-64", 20, 0.97, 0.75},
    {"rough", "os0-128", 8, 0.97, 0.8},
    {"steel_sets", "os1-64", 15, 0.97, 0.4},
    {"shotcrete", "os1-64", 10, 0.97, 0.8},
    {"nominal", "os1-64", 15, 0.97, 0.5},
    {"pipes", "os1-64", 20, 0.9, 0.5},
    {"conveyor", "os1-64", 20, 0.9, 0.5},
    {"props", "os1-64", 20, 0.9, 0.3},
    {"vehicle", "os1-64", 20, 0.8, 0.5},
    {"people", "os1-64", 10, 0.95, 0.8},
    {"near_wall", "os1-64", 10, 0.95, 0.8},
    {"wide", "os1-64", 10, 0.8, 0.7},
    {"below_range_min", "os1-64", 5, 0.6, 0.5},
    {"crosscut", "os1-64", 20, 0.9, 0.5},
    {"crossing", "os1-64", 10, 0.7, 0.4},
    {"face", "os1-64", 20, 0.95, 0.7},
    {"oblique_face", "os1-64", 20, 0.95, 0.6},
    {"one_wall", "os1-64", 10, 0.95, 0.8},
    {"cavern", "os1-64", 20, 0.5, 0.5},
    {"blocked", "os1-64", 10, 0.7, 0.5},
    {"half_blocked", "os1-64", 10, 0.6, 0.5},
    {"curtain", "os1-64", 15, 0.7, 0.3},
    {"trapezoid", "os1-64", 10, 0.95, 0.8},
    {"arch", "os1-64", 10, 0.9, 0.6},
    {"curved", "os1-64", 15, 0.8, 0.25},
    {"splayed", "os1-64", 15, 0.8, 0.5},
    {"widening", "os1-64", 15, 0.8, 0.3},
    {"narrow", "os1-64", 15, 0.8, 0.4},
    {"cross_fall", "os1-64", 10, 0.95, 0.8},
    {"humps", "os1-64", 15, 0.9, 0.4},
    {"bench", "os1-64", 15, 0.8, 0.6},
    {"muck", "os1-64", 15, 0.8, 0.6},
    {"puddles", "os1-64", 10, 0.9, 0.7},
    {"ghosts", "os1-64", 20, 0.7, 0.6},
    {"no_floor", "os1-64", 5, 0, 0},
    {"dust", "os1-64", 10, 0.9, 0.7},
    {"dropout", "os1-64", 10, 0.95, 0.8},
    {"wet_wall", "os1-64", 10, 0.7, 0.6},
    {"body", "os1-64", 10, 0.95, 0.7},
    {"boom_sweep", "os1-64", 10, 0.95, 0.7},
    {"tilted", "os0-128", 10, 0.95, 0.8},
    {"turned", "os1-64", 20, 0.5, 0.5},
    {"range_bias", "os1-64", 15, 0.95, 0.5},
    {"range_noise", "os1-64", 10, 0.95, 0.8},
    {"upside_down", "os1-64", 10, 0.95, 0.8},
    {"millimetres", "os1-64", 5, 0, 0},
};

INSTANTIATE_TEST_SUITE_P(Classes, RoadClass, ::testing::ValuesIn(kClasses), [](const auto& test) {
  std::string name = std::string(test.param.scene) + "_" + test.param.sensor;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace pose_wall::test
