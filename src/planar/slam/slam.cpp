// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/slam.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace pose_wall::planar {
namespace {

constexpr double kLookBack_m = 12.0;  // of travel that a scan is matched with
constexpr std::uint32_t kLookBackMost = 60;
constexpr double kTrusted = 0.75;  // share of points that a right pose explains at least, but for crowds

}  // namespace

void Slam::lay_out(Arena& arena, const SlamSettings& settings) {
  matcher_.lay_out(arena);
  graph_.lay_out(arena, settings.keyframes_most);
  trail_.lay_out(arena, settings.keyframes_most);
  loops_.lay_out(arena);
  near_.lay_out(arena);
  beams_ = arena.take<Beam>(POSE_WALL_PLANAR_BEAMS_MAX);
  scan_points_ = arena.take<ScanPoint>(kMatchPointsMost);
}

void Slam::open(const SlamSettings& settings) {
  settings_ = settings;
  near_.open();
  trail_.open();
  loops_.open();
  pose_ = odometry_ = last_step_ = since_agreed_ = agreed_odometry_ = Pose2();
  is_astray_ = is_full_ = false;
  rounds_left_ = solution_ = resumes_at_ = doubtful_ = 0;
  resumes_ = false;
  has_odometry_ = false;
  scatter_ = 1.0;
}

Prior Slam::prior_of(const Pose2& from, const Pose2& step, double sigma_m, double sigma_rad) const {
  Prior out{compose(from, step), Eigen::Matrix3d::Zero()};
  const double length_m = std::sqrt(step.x_m * step.x_m + step.y_m * step.y_m);
  sigma_m += settings_.odometry_m * length_m;
  sigma_rad += settings_.odometry_rad * std::abs(step.yaw_rad);
  const double place = 1.0 / (sigma_m * sigma_m);
  out.information.diagonal() << place, place, 1.0 / (sigma_rad * sigma_rad);
  return out;
}

// Where the machine may be now. Odometry may stall and then make up for it in one step: so also its way since it last
// agreed with the scans, and the last step once more.
std::uint32_t Slam::predict(const Pose2* odometry, Prediction* predictions) const {
  constexpr double kStep_m = 0.01, kStep_rad = 0.01, kInertia_m = 0.1, kInertia_rad = 0.1;
  // Halves of squared distances: how unlikely it is that each of them is the one to follow.
  constexpr double kStalled = 3.0, kWrong = 6.0;
  std::uint32_t count = 0;
  if (odometry != nullptr && has_odometry_) {
    predictions[count++] = {prior_of(pose_, between(odometry_, *odometry), kStep_m, kStep_rad), 0.0};
    if (is_astray_) {
      predictions[count++] = {
          prior_of(compose(pose_, inverse(since_agreed_)), between(agreed_odometry_, *odometry), kStep_m, kStep_rad),
          kStalled};
    }
  }
  predictions[count] = {prior_of(pose_, last_step_, kInertia_m, kInertia_rad), count > 0 ? kWrong : 0.0};
  return count + 1;
}

// Range noise and what the surfaces scatter beyond it: a scan of a cloud cuts rough walls at many heights.
double Slam::noise_m(const BeamScan& scan) const {
  return scan.sigma_m * scatter_;
}

// So much scatter that all but a few points are explained (Robbins and Monro 1951). Within limits: crowds are no
// scatter.
void Slam::learn_scatter(const Refined& placed) {
  constexpr double kExplained = 0.92, kGain = 0.2, kMost = 3.0;
  if (placed.is_valid)
    scatter_ = std::min(kMost, std::max(1.0, scatter_ * (1.0 + kGain * (kExplained - placed.explained))));
}

// The match that scan and predictions together like best. Where the scan is not explained even then, the best place
// that the machine can have reached joins in.
Refined Slam::place(Span<const ScanPoint> points, const BeamScan& scan, const Prediction* predictions,
                    std::uint32_t count) const {
  constexpr double kGood = 0.9;
  constexpr double kFar_m = 0.6, kFar_rad = 0.6, kAnywhere = 12.0;
  constexpr std::uint32_t kNodes = 128;
  const auto cost_of = [&](const Refined& match) {
    double unlikely = kAnywhere;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Prior& prior = predictions[k].prior;
      const Eigen::Vector3d off(match.pose.x_m - prior.pose.x_m, match.pose.y_m - prior.pose.y_m,
                                wrapped(match.pose.yaw_rad - prior.pose.yaw_rad));
      unlikely = std::min(unlikely, predictions[k].unlikely + 0.5 * off.dot(prior.information * off));
    }
    return 0.5 * match.misfit / kAlike + unlikely;
  };
  Refined best;
  double least = 0.0;
  const auto offer = [&](const Pose2& start, const Prior& prior) {
    const Refined match = matcher_.refine(points, near_, start, prior, noise_m(scan));
    const double cost = cost_of(match);
    if (!match.is_valid || (best.is_valid && cost >= least)) return;
    best = match;
    least = cost;
  };
  for (std::uint32_t k = 0; k < count; ++k) {
    offer(predictions[k].prior.pose, predictions[k].prior);
    if (best.is_valid && best.explained > kGood) return best;
  }
  const Prior around = best.is_valid ? Prior{best.pose, Eigen::Matrix3d::Zero()} : predictions[0].prior;
  const Found found = matcher_.search(points, near_, {around.pose, kFar_m, kFar_rad, kNodes});
  Prior loose{around.pose, Eigen::Matrix3d::Zero()};
  loose.information.diagonal() << 1.0 / (kFar_m * kFar_m), 1.0 / (kFar_m * kFar_m), 1.0 / (kFar_rad * kFar_rad);
  offer(found.pose, loose);
  if (!best.is_valid) best.pose = predictions[0].prior.pose;
  return best;
}

void Slam::follow(const Pose2& pose, const Pose2* odometry, const Prediction& first) {
  const Eigen::Vector3d off(pose.x_m - first.prior.pose.x_m, pose.y_m - first.prior.pose.y_m,
                            wrapped(pose.yaw_rad - first.prior.pose.yaw_rad));
  constexpr double kAgrees = 11.3;  // 99 % of a chi-square of three
  const bool agrees = off.dot(first.prior.information * off) < kAgrees;
  const bool stood_still =
      odometry != nullptr && has_odometry_ &&
      between(odometry_, *odometry).place().squaredNorm() + std::abs(wrapped(odometry->yaw_rad - odometry_.yaw_rad)) ==
          0.0;
  last_step_ = between(pose_, pose);
  since_agreed_ = compose(since_agreed_, last_step_);
  pose_ = pose;
  is_astray_ = odometry == nullptr || (is_astray_ ? !agrees || stood_still : !agrees);
  if (is_astray_ || odometry == nullptr) return;
  since_agreed_ = Pose2();
  agreed_odometry_ = *odometry;
}

// A scan that fits badly may stand wrong, and would spoil the map: the next may fit better.
bool Slam::is_due(const Refined& placed) const {
  if (trail_.size() == 0) return true;
  if (resumes_) return placed.explained >= kTrusted;
  constexpr double kPatience = 3.0;  // keyframes' distances that a bad fit may wait
  const double patience = placed.explained >= kTrusted ? 1.0 : kPatience;
  const Pose2 since = between(trail_.pose(trail_.size() - 1), pose_);
  return since.place().squaredNorm() > patience * patience * settings_.keyframe_m * settings_.keyframe_m ||
         std::abs(since.yaw_rad) > patience * settings_.keyframe_rad;
}

SlamStep Slam::process(const BeamScan& scan, const Pose2* odometry) {
  SlamStep step;
  const Span<const ScanPoint> points = even_points(scan, kMatchSpacing_m, scan_points_);
  Prior prior;
  Refined placed;
  if (trail_.size() > 0) {
    Prediction predictions[kPredictionsMost];
    const std::uint32_t count = predict(odometry, predictions);
    placed = place(points, scan, predictions, count);
    follow(placed.pose, odometry, predictions[0]);
    if (!placed.is_valid || placed.explained < kTrusted) ++doubtful_;
    learn_scatter(placed);
    prior = predictions[0].prior;
  }
  if (odometry != nullptr) odometry_ = *odometry;
  if (trail_.size() == 0 && odometry != nullptr) agreed_odometry_ = *odometry;
  has_odometry_ = odometry != nullptr;
  step.is_valid = placed.is_valid;
  step.explained = placed.explained;
  step.rms_m = placed.rms_m;
  if (is_due(placed)) {
    const Slide slide = matcher_.slide(points, near_, placed, noise_m(scan));
    begin_keyframe(points, scan, matcher_.information(placed, slide) + prior.information);
    step.is_keyframe = true;
    const std::uint32_t believed = loops_.believed();
    if (loops_.look(&trail_, matcher_)) rounds_left_ = kRoundsMost;
    step.closures = loops_.believed() > believed ? loops_.believed() - believed : 0;
  }
  const bool improves = rounds_left_ > 0;
  if (improves) improve();
  if (improves || step.is_keyframe) draw_near();
  step.pose = pose_;
  step.keyframe = trail_.size() - 1;
  step.in_keyframe = between(trail_.pose(step.keyframe), pose_);
  return step;
}

void Slam::begin_keyframe(Span<const ScanPoint> points, const BeamScan& scan, const Eigen::Matrix3d& information) {
  constexpr double kLeap_m = 20.0;  // more than kOld_m of loops.cpp: the saved trail is an old place
  const std::uint32_t k = trail_.size();
  constexpr double kDoubt_rad = 0.3, kDoubtMost_rad = 0.6;  // a scan that says nothing; several
  const double doubt_rad = std::min(kDoubtMost_rad, kDoubt_rad * doubtful_);
  doubtful_ = 0;
  is_full_ = !trail_.add(points, pose_, scan.stamp_ns, {resumes_ ? kLeap_m : 0.0, doubt_rad});
  if (is_full_ || k == 0) return;
  if (resumes_) {
    tie_to_saved(information);
    return;
  }
  const Pose2& from = trail_.pose(k - 1);
  Eigen::Matrix3d known = information;
  if (doubt_rad > 0.0) {
    const double doubt = 1.0 / (doubt_rad * doubt_rad);  // of information, also in metres: some steps' length
    known = (information.inverse() + Eigen::Matrix3d::Identity() / doubt).inverse();
  }
  trail_.tie({k - 1, k, between(from, pose_), in_frame_of(from, known), false});
}

// The first keyframe after a restart: loosely to the last one of the saved trail, for nobody saw that way, and as
// measured to the one that it was matched with.
void Slam::tie_to_saved(const Eigen::Matrix3d& information) {
  constexpr double kLoose = 1.0;  // of information: a metre, a radian
  const std::uint32_t k = trail_.size() - 1;
  trail_.tie({k - 1, k, between(trail_.pose(k - 1), pose_), kLoose * Eigen::Matrix3d::Identity(), false});
  const Pose2& from = trail_.pose(resumes_at_);
  const Edge edge{resumes_at_, k, between(from, pose_), in_frame_of(from, information), true};
  if (resumes_at_ + 1 < k && trail_.tie(edge)) loops_.assume(trail_);
  resumes_ = false;
}

void Slam::resume(const Pose2& base) {
  loops_.adopt(trail_);
  pose_ = base;
  last_step_ = since_agreed_ = Pose2();
  has_odometry_ = is_astray_ = is_full_ = false;
  rounds_left_ = 0;
  ++solution_;
  resumes_ = trail_.size() > 0;
  if (!resumes_) return;
  resumes_at_ = trail_.nearest(base.place());
  trail_.draw(&near_, resumes_at_, trail_.around(resumes_at_, kLookBack_m, kLookBackMost, {0, trail_.size() - 1}));
}

// One round of the graph. The last keyframe takes the machine along.
void Slam::improve() {
  constexpr double kStill_m = 1e-4;
  const std::uint32_t last = trail_.size() - 1;
  const Pose2 in_keyframe = between(trail_.pose(last), pose_);
  const GraphRound round = graph_.improve(trail_.poses(), trail_.edges());
  pose_ = compose(trail_.pose(last), in_keyframe);
  --rounds_left_;
  ++solution_;
  if (round.moved_m < kStill_m) rounds_left_ = 0;
}

void Slam::settle() {
  if (trail_.size() == 0 || rounds_left_ == 0) return;
  while (rounds_left_ > 0) improve();
  draw_near();
}

void Slam::draw_near() {
  const std::uint32_t last = trail_.size() - 1;
  trail_.draw(&near_, last, trail_.around(last, kLookBack_m, kLookBackMost, {0, last}));
}

}  // namespace pose_wall::planar
