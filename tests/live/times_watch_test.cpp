// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the daemon's health names times of points that are of no use, by a code for each fault, and takes it back as
// soon as they are good again. A single broken scan changes nothing. Clouds without times are doubted only while the
// machine surely moves.

#include "apps/live/times_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "live/frame_catcher.hpp"

namespace pose_wall::tools::live {
namespace {

using pose_wall::test::fact;

enum class Times { kGood, kNone, kOne, kUnit, kType };

Frame cloud(Times times) {
  constexpr std::uint32_t kPoints = 100;  // unusable_times looks at 64 and more
  std::vector<float> numbers;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const auto part = static_cast<float>(i) / static_cast<float>(kPoints);
    const float time = times == Times::kOne ? 7.0F : times == Times::kUnit ? 1e15F * part : 0.1F * part;
    numbers.insert(numbers.end(), {5.0F, part, 1.0F, time});
  }
  Bytes bytes(numbers.size() * sizeof(float));
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  PointLayout layout;
  layout.count = kPoints;
  layout.point_step = 16;
  layout.fields = {
      {"x", {0, POSE_WALL_FIELD_FLOAT32}}, {"y", {4, POSE_WALL_FIELD_FLOAT32}}, {"z", {8, POSE_WALL_FIELD_FLOAT32}}};
  if (times != Times::kNone) {
    // As readers describe what is no single number of a type that is read.
    layout.fields.push_back({"t", {12, times == Times::kType ? POSE_WALL_FIELD_NONE : POSE_WALL_FIELD_FLOAT32}});
  }
  return describe_frame(std::move(bytes), layout);
}

pose_wall_publication moved_by(double step_m, double level_m) {
  pose_wall_publication publication{};
  publication.has_motion = 1;
  publication.motion.step_s = 0.1;
  publication.motion.step_m[0] = step_m;
  for (double& level : publication.motion.step_protection_level) level = level_m;
  return publication;
}

PartHealth told(const TimesWatch& watch) {
  PartHealth health;
  health.summary = "measures";
  watch.tell(&health);
  return health;
}

std::string code(const TimesWatch& watch) {
  return fact(told(watch), "times of points");
}

void note(TimesWatch* watch, Times times, int frames, const pose_wall_publication& publication = {}) {
  for (int i = 0; i < frames; ++i) watch->note(cloud(times), publication);
}

TEST(TimesWatch, EachFaultHasACodeAndClears) {
  const struct {
    Times times;
    const char* code;
  } cases[] = {{Times::kOne, "one_time"}, {Times::kUnit, "unit"}, {Times::kType, "type"}};
  for (const auto& one : cases) {
    TimesWatch watch;
    EXPECT_EQ(code(watch), "-");
    note(&watch, one.times, 2);
    const PartHealth health = told(watch);
    EXPECT_EQ(fact(health, "times of points"), one.code);
    EXPECT_EQ(health.grade, Grade::kWarning);
    EXPECT_EQ(health.summary, "measures; times of points are of no use");
    note(&watch, Times::kGood, 30);
    EXPECT_EQ(code(watch), "good");
    EXPECT_EQ(told(watch).grade, Grade::kGood);
    EXPECT_EQ(told(watch).summary, "measures");
    note(&watch, one.times, 30);
    EXPECT_EQ(code(watch), one.code) << "what begins later is noticed, too";
  }
}

TEST(TimesWatch, OneBrokenScanIsNoFault) {
  TimesWatch watch;
  note(&watch, Times::kGood, 10);
  note(&watch, Times::kOne, 1);  // the eleventh is looked at
  EXPECT_EQ(code(watch), "good");
  note(&watch, Times::kGood, 30);
  EXPECT_EQ(code(watch), "good");
}

TEST(TimesWatch, NoTimesAreDoubtedOnlyWhereTheMachineMoved) {
  TimesWatch watch;
  note(&watch, Times::kNone, 30);
  EXPECT_EQ(code(watch), "none");
  note(&watch, Times::kNone, 30, moved_by(0.001, 0.0001));  // 0.01 m/s
  note(&watch, Times::kNone, 30, moved_by(0.05, 0.1));      // within its level
  note(&watch, Times::kNone, 30, moved_by(NAN, NAN));
  EXPECT_EQ(code(watch), "none");
  EXPECT_EQ(told(watch).grade, Grade::kGood);
  note(&watch, Times::kNone, 3, moved_by(0.05, 0.001));  // 0.5 m/s
  EXPECT_EQ(code(watch), "none_moving");
  EXPECT_EQ(told(watch).grade, Grade::kWarning);
  note(&watch, Times::kNone, 30);
  EXPECT_EQ(code(watch), "none_moving") << "it stays true while the machine stands";
  note(&watch, Times::kGood, 30, moved_by(0.05, 0.001));
  EXPECT_EQ(code(watch), "good");
}

TEST(TimesWatch, WhatIsWorseKeepsItsGrade) {
  TimesWatch watch;
  note(&watch, Times::kOne, 2);
  PartHealth health;
  health.grade = Grade::kBad;
  health.summary = "no frame comes";
  watch.tell(&health);
  EXPECT_EQ(health.grade, Grade::kBad);
  EXPECT_EQ(health.summary, "no frame comes");
}

}  // namespace
}  // namespace pose_wall::tools::live
