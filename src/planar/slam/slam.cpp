// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/slam.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "place/slide.hpp"
#include "planar/gates.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kLookBack_m = 12.0;         // of travel that a scan is matched with
constexpr std::uint32_t kLookBackMost = 60;  // keyframes: half as many again as in 12 m by the default distance

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
  follower_.open(settings.odometry_m, settings.odometry_rad);
  pose_ = Pose2();
  is_full_ = false;
  rounds_left_ = solution_ = resumes_at_ = doubtful_ = 0;
  resumes_ = false;
  scatter_ = 1.0;
}

// Range noise and what the surfaces scatter beyond it: a scan of a cloud cuts rough walls at many heights.
double Slam::noise_m(const BeamScan& scan) const {
  return scan.sigma_m * scatter_;
}

// So much scatter that all but a few points are explained (Robbins and Monro 1951). Within limits: crowds are no
// scatter.
void Slam::learn_scatter(const Fit& placed) {
  // Share, step and limit. With 0.85 and 0.97, and with half and twice of the others, the sweep's log errs by 0.0335 to
  // 0.0343 m. A twelfth of it errs by 0.05 to 0.19 m, in no order.
  constexpr double kExplained = 0.92, kGain = 0.2, kMost = 3.0;
  if (placed.is_valid)
    scatter_ = std::min(kMost, std::max(1.0, scatter_ * (1.0 + kGain * (kExplained - placed.explained))));
}

// A scan that fits badly may stand wrong, and would spoil the map: the next may fit better.
bool Slam::is_due(const Fit& placed) const {
  if (trail_.size() == 0) return true;
  const bool is_trusted = passes<gate::TRUSTED>(placed.explained);
  if (resumes_) return is_trusted;
  constexpr double kPatience = 3.0;  // keyframes' distances that a bad fit may wait
  const double patience = is_trusted ? 1.0 : kPatience;
  const Pose2 since = between(trail_.pose(trail_.size() - 1), pose_);
  return since.place().squaredNorm() > patience * patience * settings_.keyframe_m * settings_.keyframe_m ||
         std::abs(since.yaw_rad) > patience * settings_.keyframe_rad;
}

SlamStep Slam::process(const BeamScan& scan, const Pose2* odometry) {
  SlamStep step;
  const Span<const ScanPoint> points = even_points(scan, kMatchSpacing_m, scan_points_);
  Prior prior;
  Fit placed;
  if (trail_.size() > 0) {
    const ScanFollower::Followed followed = follower_.follow(pose_, points, near_, noise_m(scan), odometry, matcher_);
    placed = followed.match;
    prior = followed.prior;
    pose_ = placed.pose;
    if (!placed.is_valid || !passes<gate::TRUSTED>(placed.explained)) ++doubtful_;
    learn_scatter(placed);
  } else {
    follower_.see_first(odometry);
  }
  step.is_valid = placed.is_valid;
  step.is_trusted = passes<gate::TRUSTED>(placed.explained);
  step.explained = placed.explained;
  step.rms_m = placed.rms_m;
  if (is_due(placed)) {
    const Slide slide =
        slide_of(near_, matcher_.sort(points, noise_m(scan)), placed, limit_of<gate::EXCLUDED>(), kRefit);
    begin_keyframe(points, scan, told_by(placed, slide) + prior.information);
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
  constexpr double kLeap_m = 4.0 / 3.0 * Loops::kOld_m;  // the saved trail is an old place
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
  follower_.begin();
  is_full_ = false;
  rounds_left_ = 0;
  ++solution_;
  resumes_ = trail_.size() > 0;
  if (!resumes_) return;
  resumes_at_ = trail_.nearest(base.place());
  trail_.draw(&near_, resumes_at_, trail_.around(resumes_at_, kLookBack_m, kLookBackMost, {0, trail_.size() - 1}));
}

// One round of the graph. The last keyframe takes the machine along.
void Slam::improve() {
  constexpr double kStill_m = 1e-4;  // no map shows it, and no later round is worth its time
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
