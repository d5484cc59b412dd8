// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: odometry is the first prediction, going on as before the last one, and odometry that stalled is expected to
// make up for it.

#include "place/step_predictor.hpp"

#include <gtest/gtest.h>

namespace pose_wall::planar {
namespace {

constexpr double kNear_m = 1e-9;

class Predicted {
 public:
  Predicted() { predictor_.open(0.1, 0.3); }

  std::uint32_t after(const Pose2* odometry) { return predictor_.predict(at_, odometry, all_); }
  const StepPredictor::Prediction& operator[](std::uint32_t k) const { return all_[k]; }
  void starts(const Pose2* odometry) { predictor_.start(odometry); }
  void moves_to(const Pose2& to, const Pose2* odometry, bool agrees) {
    predictor_.follow(at_, to, odometry, agrees);
    at_ = to;
  }

 private:
  StepPredictor predictor_;
  StepPredictor::Prediction all_[StepPredictor::kMost];
  Pose2 at_;
};

TEST(StepPredictor, WithoutOdometryBaseGoesOn) {
  Predicted predicted;
  predicted.moves_to({0.2, 0.0, 0.1}, nullptr, true);
  ASSERT_EQ(predicted.after(nullptr), 1U);
  EXPECT_NEAR(predicted[0].pose.x_m, 0.2 + 0.2 * std::cos(0.1), kNear_m);
  EXPECT_NEAR(predicted[0].pose.yaw_rad, 0.2, kNear_m);
  EXPECT_FALSE(predicted[0].is_odometry);
  EXPECT_EQ(predicted[0].unlikely, 0.0);
}

TEST(StepPredictor, OdometryIsTheFirstAndItsFrameDoesNotMatter) {
  Predicted predicted;
  const Pose2 before{100.0, -7.0, 0.5 * kPi}, now{100.0, -6.6, 0.5 * kPi};  // 0.4 m ahead
  predicted.moves_to({}, &before, true);
  ASSERT_EQ(predicted.after(&now), 2U);
  EXPECT_TRUE(predicted[0].is_odometry);
  EXPECT_NEAR(predicted[0].pose.x_m, 0.4, kNear_m);
  EXPECT_NEAR(predicted[0].pose.y_m, 0.0, kNear_m);
  EXPECT_NEAR(predicted[0].sigma_m, 0.01 + 0.1 * 0.4, kNear_m);
  EXPECT_FALSE(predicted[1].is_odometry);
  EXPECT_NEAR(predicted[1].pose.x_m, 0.0, kNear_m);  // it stood
  EXPECT_GT(predicted[1].unlikely, predicted[0].unlikely);
}

TEST(StepPredictor, OdometryThatStalledMayMakeUpForIt) {
  Predicted predicted;
  const Pose2 stalled{5.0, 5.0, 0.0}, made_up{5.75, 5.0, 0.0};
  predicted.moves_to({}, &stalled, true);
  predicted.moves_to({0.25, 0.0, 0.0}, &stalled, false);
  predicted.moves_to({0.5, 0.0, 0.0}, &stalled, false);
  ASSERT_EQ(predicted.after(&made_up), 3U);
  EXPECT_NEAR(predicted[0].pose.x_m, 1.25, kNear_m);  // odometry's last step
  EXPECT_NEAR(predicted[1].pose.x_m, 0.75, kNear_m);  // its way since it last agreed
  EXPECT_NEAR(predicted[2].pose.x_m, 0.75, kNear_m);  // going on
  predicted.moves_to({0.75, 0.0, 0.0}, &made_up, false);
  const Pose2 next{6.0, 5.0, 0.0};
  predicted.moves_to({1.0, 0.0, 0.0}, &next, true);
  EXPECT_EQ(predicted.after(&next), 2U) << "it agrees again";
}

TEST(StepPredictor, OdometryThatStalledForGoodDoesNotAgreeWithAMachineThatStands) {
  Predicted predicted;
  const Pose2 stalled{5.0, 5.0, 0.0}, made_up{5.25, 5.0, 0.0};
  predicted.moves_to({}, &stalled, true);
  predicted.moves_to({0.25, 0.0, 0.0}, &stalled, false);
  predicted.moves_to({0.25, 0.0, 0.0}, &stalled, true);  // both stand
  ASSERT_EQ(predicted.after(&made_up), 3U);
  EXPECT_NEAR(predicted[1].pose.x_m, 0.25, kNear_m) << "it still owes the first step";
}

TEST(StepPredictor, AStartTellsNoStepAndForgetsWhatWas) {
  Predicted predicted;
  const Pose2 before{100.0, 0.0, 0.0}, here{0.0, 0.0, 0.0}, next{0.5, 0.0, 0.0};
  predicted.moves_to({0.4, 0.0, 0.0}, &before, true);
  predicted.starts(&here);
  ASSERT_EQ(predicted.after(&next), 2U);
  EXPECT_NEAR(predicted[0].pose.x_m, 0.9, kNear_m) << "odometry's step since the start";
  EXPECT_NEAR(predicted[1].pose.x_m, 0.4, kNear_m) << "no step is known";
  EXPECT_GE(predicted[1].sigma_m, 0.3);
  predicted.starts(nullptr);
  EXPECT_EQ(predicted.after(&next), 1U) << "one pose of odometry tells no step";
}

TEST(StepPredictor, ALeapOfOdometryDoesNotExplainAnyPlace) {
  Predicted predicted;
  const Pose2 here{}, leapt{50.0, 0.0, 0.0};
  predicted.moves_to({}, &here, true);
  ASSERT_EQ(predicted.after(&leapt), 2U);
  EXPECT_LT(predicted[0].sigma_m, 0.5);
}

TEST(StepPredictor, OdometryThatBeginsLateIsTakenUp) {
  Predicted predicted;
  predicted.moves_to({0.1, 0.0, 0.0}, nullptr, true);
  const Pose2 first{40.0, 0.0, 0.0}, next{40.3, 0.0, 0.0};
  EXPECT_EQ(predicted.after(&first), 1U) << "one pose tells no step";
  predicted.moves_to({0.2, 0.0, 0.0}, &first, false);
  ASSERT_GE(predicted.after(&next), 2U);
  EXPECT_NEAR(predicted[0].pose.x_m, 0.5, kNear_m);
  EXPECT_NEAR(predicted[1].pose.x_m, 0.5, kNear_m) << "since it first spoke";
}

}  // namespace
}  // namespace pose_wall::planar
