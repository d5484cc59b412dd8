// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/loops.hpp"

#include <algorithm>
#include <cmath>

#include "place/slide.hpp"
#include "planar/gates.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kGroup_m = 2.5;            // travel to each side that is matched as one scan
constexpr double kBeyond_m = 3.5;           // of the old trail beyond a group, to each side
constexpr double kLong_m = 7.0;             // of a group that decides, to each side
constexpr std::uint32_t kStretchMost = 48;  // keyframes to each side
constexpr double kEvery_m = 0.5;            // travel between two looks
constexpr double kNoise_m = 0.03;           // range noise and drift within a group
// Drift of the trail per metre: what matching left on recorded logs of buildings stays below a third of this.
constexpr double kDrift = 0.02, kDriftYaw_rad = 0.002;
constexpr std::uint32_t kBearings = 360;  // bins of a whole turn: a degree, as scanners of recorded logs have
constexpr double kConfirm_m = 3.0;        // travel between two long looks

}  // namespace

void Loops::lay_out(Arena& arena) {
  old_.lay_out(arena);
  group_ = arena.take<ScanPoint>(kMatchPointsMost);
  pool_ = arena.take<Candidate>(kPoolMost);
  believed_ = arena.take<Believed>(4096);
  profile_ = arena.take<float>(kBearings);
}

void Loops::open() {
  old_.open();
  pool_count_ = believed_count_ = taken_back_ = groups_ = fits_ = contradictions_ = 0;
  believed_at_m_ = 0.0;
  looked_at_m_ = confirmed_at_m_ = 0.0;
}

void Loops::adopt(const Trail& trail) {
  open();
  for (std::uint32_t k = 0; k < trail.edges().size(); ++k) {
    const Edge& edge = trail.edges()[k];
    const bool is_held = edge.is_closure && edge.information(0, 0) > 0.0;
    if (is_held && believed_count_ < believed_.size()) believed_[believed_count_++] = {edge.from, edge.to, k, 0};
  }
}

void Loops::assume(const Trail& trail) {
  const std::uint32_t k = trail.edges().size() - 1;
  const Edge& edge = trail.edges()[k];
  if (believed_count_ < believed_.size()) believed_[believed_count_++] = {edge.from, edge.to, k, 0};
}

// A doubt about yaw turns what was driven since then about the place of the doubt.
double Drift::place_m() const {
  // At least what a match is off by; the travel that a doubt turns; a bound on the window. With half and with twice of
  // each the sweep's maps had no wrong closure. A twelfth of the log errs by 0.095 and 0.082 m with a lever of 7.5 and
  // 30 m, by 0.089 m as it is.
  constexpr double kLeast_m = 0.5, kLever_m = 15.0, kMost_m = 20.0;
  return std::min(kMost_m, kLeast_m + kDrift * travel_m + doubt_rad * std::min(travel_m, kLever_m));
}

double Drift::yaw_rad() const {
  // At least what a match is off by, and a bound on the window: with half and with twice of each the sweep's maps were
  // the same to 0.1 mm.
  constexpr double kLeast_rad = 0.1, kMost_rad = 0.8;
  return std::min(kMost_rad, kLeast_rad + kDriftYaw_rad * travel_m + doubt_rad);
}

// Along the trail, or by one closure, whichever is less.
Drift Loops::drift(const Trail& trail, std::uint32_t old, std::uint32_t now) const {
  Drift least{trail.travel_between_m(old, now), trail.doubt_between_rad(old, now)};
  for (std::uint32_t k = 0; k < believed_count_; ++k) {
    const Believed& by = believed_[k];
    const Drift drift{trail.travel_between_m(old, by.from) + trail.travel_between_m(by.to, now),
                      trail.doubt_between_rad(old, by.from) + trail.doubt_between_rad(by.to, now)};
    if (drift.place_m() < least.place_m()) least = drift;
  }
  return least;
}

bool Loops::nearest_old(const Trail& trail, std::uint32_t now, std::uint32_t* old, double* reach_m) {
  double nearest_m = 1e30;
  for (std::uint32_t k = 0; k < now; ++k) {
    if (trail.travel_between_m(k, now) < kOld_m) break;
    const double apart_m = (trail.pose(k).place() - trail.pose(now).place()).norm();
    if (apart_m >= nearest_m) continue;
    nearest_m = apart_m;
    *old = k;
  }
  if (nearest_m > 1e29) return false;
  *reach_m = drift(trail, *old, now).place_m();
  return nearest_m < *reach_m + 3.0;
}

// The points about a keyframe as if that one had seen them all.
Span<const ScanPoint> Loops::group(const Trail& trail, std::uint32_t now, Trail::Range range) const {
  std::uint32_t all = 0;
  for (std::uint32_t k = range.first; k <= range.last; ++k) all += trail[k].count;
  const std::uint32_t stride = (all + group_.size() - 1) / group_.size();
  std::uint32_t seen = 0, count = 0;
  for (std::uint32_t k = range.first; k <= range.last; ++k) {
    const Pose2 in_now = between(trail.pose(now), trail.pose(k));
    const Turn2 turn(in_now.yaw_rad);
    for (const ScanPoint& point : trail.points(k)) {
      if (seen++ % stride != 0 || count == group_.size()) continue;
      const Eigen::Vector2d p = turn * as_double(point) + in_now.place();
      group_[count++] = {static_cast<float>(p.x()), static_cast<float>(p.y())};
    }
  }
  return group_.first(count);
}

// The share of one keyframe's surfaces that the other's lines of sight pass through.
double Loops::seen_through(const Trail& trail, std::uint32_t old, std::uint32_t now, const Pose2& now_in_old) const {
  std::uint32_t through = 0, judged = 0;
  const auto judge = [&](std::uint32_t viewer, std::uint32_t seen, const Pose2& seen_in_viewer) {
    profile_.fill(0.0F);
    const auto bearing_of = [](double x_m, double y_m) {
      const auto bin = static_cast<std::uint32_t>((arc_tangent2(y_m, x_m) + kPi) * (kBearings / (2.0 * kPi)));
      return bin < kBearings ? bin : kBearings - 1;
    };
    for (const ScanPoint& point : trail.points(viewer)) {
      const auto x = static_cast<double>(point.x_m), y = static_cast<double>(point.y_m);
      float& nearest = profile_[bearing_of(x, y)];
      const auto range_m = static_cast<float>(std::sqrt(x * x + y * y));
      if (nearest == 0.0F || range_m < nearest) nearest = range_m;
    }
    const Turn2 turn(seen_in_viewer.yaw_rad);
    for (const ScanPoint& point : trail.points(seen)) {
      const Eigen::Vector2d p = turn * as_double(point) + seen_in_viewer.place();
      const double range_m = p.norm();
      const auto sight_m = static_cast<double>(profile_[bearing_of(p.x(), p.y())]);
      constexpr double kTolerance_m = 0.3, kTolerance = 0.05;  // of the range: a wall met at a low angle
      if (sight_m == 0.0 || range_m > sight_m + kTolerance_m) continue;
      ++judged;
      if (sight_m > range_m * (1.0 + kTolerance) + kTolerance_m) ++through;
    }
  };
  judge(now, old, inverse(now_in_old));
  judge(old, now, now_in_old);
  return judged > 0 ? static_cast<double>(through) / judged : 1.0;
}

bool Loops::match(const Trail& trail, Matcher& matcher, const Revisit& visit, Candidate* candidate) {
  const std::uint32_t old = visit.old, now = visit.now;
  const double reach_m = visit.reach_m;
  const std::uint32_t last = trail.size() - 1;
  const Trail::Range stretch = trail.around(old, visit.group_m + kBeyond_m, kStretchMost, {0, now});
  trail.draw(&old_, old, {stretch.first, std::min(stretch.last, now - 1)});
  const Span<const ScanPoint> points = group(trail, now, trail.around(now, visit.group_m, kStretchMost, {0, last}));
  const double reach_rad = drift(trail, old, now).yaw_rad();
  const Found found = matcher.search(points, old_, {visit.guess, reach_m, reach_rad});
  const Fit fit = fit_pose(old_, points, found.pose, {kNoise_m});
  if (!fit.is_valid) return false;
  const Slide slide = slide_of(old_, matcher.sort(points, kNoise_m), fit, limit_of<gate::EXCLUDED>(), kRefit);
  candidate->explained = fit.explained;
  candidate->second = found.score > 0.0 ? found.second_score / found.score : 1.0;
  candidate->slide_m = slide.reach_m;
  const Pose2 step = between(trail.pose(old), fit.pose);
  candidate->edge = {old, now, step, in_frame_of(trail.pose(old), told_by(fit, slide)), true};
  candidate->seen_through = seen_through(trail, old, now, step);
  candidate->is_distinct = passes<gate::LOOP_HOLDS>(slide.reach_m) && passes<gate::LOOP_SECOND>(candidate->second);
  const bool is_inside = (fit.pose.place() - visit.guess.place()).norm() < 1.5 * reach_m + 0.2;
  return is_inside && passes<gate::LOOP_EXPLAINED>(candidate->explained) &&
         passes<gate::LOOP_THROUGH>(candidate->seen_through);
}

// Around the loop that two candidates and the trail between their ends make, all steps end where they began.
bool Loops::agrees(const Trail& trail, const Candidate& a, const Candidate& b) const {
  const Pose2 by_b = compose(between(trail.pose(a.edge.from), trail.pose(b.edge.from)), b.edge.step);
  const Pose2 by_a = compose(a.edge.step, between(trail.pose(a.edge.to), trail.pose(b.edge.to)));
  const double apart_m =
      trail.travel_between_m(a.edge.from, b.edge.from) + trail.travel_between_m(a.edge.to, b.edge.to);
  const double doubt_rad =
      trail.doubt_between_rad(a.edge.from, b.edge.from) + trail.doubt_between_rad(a.edge.to, b.edge.to);
  const double yaw_rad = 0.03 + kDriftYaw_rad * apart_m + doubt_rad;
  const double place_m = 0.1 + (kDrift + doubt_rad) * apart_m + a.slide_m + b.slide_m;
  return (by_a.place() - by_b.place()).norm() < place_m && std::abs(wrapped(by_a.yaw_rad - by_b.yaw_rad)) < yaw_rad;
}

// A longer stretch decides where short ones slide: all that the last metres saw, about where the newest candidate lies.
bool Loops::is_confirmed(const Trail& trail, Matcher& matcher, const Candidate& newest) {
  const std::uint32_t last = trail.size() - 1;
  if (trail[last].travel_m - confirmed_at_m_ < kConfirm_m) return false;
  confirmed_at_m_ = trail[last].travel_m;
  std::uint32_t now = last;
  while (now > 0 && trail.travel_between_m(now, last) < kLong_m) --now;
  const Pose2 newest_place = compose(trail.pose(newest.edge.from), newest.edge.step);
  const Pose2 guess = compose(newest_place, between(trail.pose(newest.edge.to), trail.pose(now)));
  std::uint32_t old = newest.edge.from;
  double nearest_m = 1e30;
  const Trail::Range about = trail.around(newest.edge.from, 3.0 * kLong_m, 4 * kStretchMost, {0, now});
  for (std::uint32_t k = about.first; k <= about.last; ++k) {
    const double apart_m = (trail.pose(k).place() - guess.place()).norm();
    if (apart_m >= nearest_m || trail.travel_between_m(k, now) < kOld_m) continue;
    nearest_m = apart_m;
    old = k;
  }
  Candidate whole;
  const double reach_m = 1.0 + newest.slide_m;
  const bool fits = match(trail, matcher, {old, now, guess, reach_m, kLong_m}, &whole);
  return fits && whole.is_distinct && passes<gate::STRETCH_EXPLAINED>(whole.explained);
}

std::uint32_t Loops::believe(Trail* trail, Matcher& matcher, const Candidate& newest) {
  constexpr double kPool_m =
      12.0;  // travel after which candidates count no more: four times that over which they agree
  std::uint32_t agree = 0, differ = 0, distinct = 0;
  double span_m = 0.0;
  for (std::uint32_t k = 0; k < pool_count_; ++k) {
    if (trail->travel_between_m(pool_[k].edge.to, newest.edge.to) > kPool_m) continue;
    if (!agrees(*trail, pool_[k], newest)) {
      ++differ;
      continue;
    }
    ++agree;
    distinct += pool_[k].is_distinct ? 1U : 0U;
    span_m = std::max(span_m, trail->travel_between_m(pool_[k].edge.to, newest.edge.to));
  }
  if (!passes<gate::LOOP_AGREE>(agree) || differ > agree / 3 || !passes<gate::LOOP_SPAN>(span_m)) return 0;
  const bool same_space = passes<gate::SAME_SPACE>(newest.reach_m);
  if (!passes<gate::LOOP_DISTINCT>(distinct) && !same_space && !is_confirmed(*trail, matcher, newest)) return 0;
  std::uint32_t tied = 0;
  ++groups_;
  for (std::uint32_t k = 0; k < pool_count_;) {
    const bool is_near = trail->travel_between_m(pool_[k].edge.to, newest.edge.to) <= kPool_m;
    if (is_near && !agrees(*trail, pool_[k], newest)) {
      ++k;
      continue;
    }
    if (is_near && believed_count_ < believed_.size() && trail->tie(pool_[k].edge)) {
      believed_[believed_count_++] = {pool_[k].edge.from, pool_[k].edge.to, trail->edges().size() - 1, groups_};
      ++tied;
    }
    pool_[k] = pool_[--pool_count_];
  }
  if (!same_space) fits_ = contradictions_ = 0;
  believed_at_m_ = (*trail)[newest.edge.to].travel_m;
  return tied;
}

// A belief predicts that the next looks fit. Where they contradict it instead, the last group is taken back.
bool Loops::doubt(Trail* trail, const Candidate& newest) {
  constexpr double kProbation_m = 10.0;  // travel in which the next looks test a belief (README.md)
  if (groups_ == 0 || (*trail)[newest.edge.to].travel_m - believed_at_m_ > kProbation_m) return false;
  if (passes<gate::LOOK_MISFITS>(newest.explained) && passes<gate::LOOK_THROUGH>(newest.seen_through)) {
    ++contradictions_;
  } else if (newest.explained > limit_of<gate::LOOK_MISFITS>()) {
    ++fits_;
  }
  if (!passes<gate::LOOKS_AGAINST>(contradictions_) || contradictions_ < 2 * fits_) return false;
  while (believed_count_ > 0 && groups_ > 0 && believed_[believed_count_ - 1].group == groups_) {
    trail->untie(believed_[--believed_count_].edge);
    ++taken_back_;
  }
  --groups_;
  fits_ = contradictions_ = 0;
  pool_count_ = 0;
  return true;
}

bool Loops::look(Trail* trail, Matcher& matcher) {
  const std::uint32_t last = trail->size() - 1;
  if ((*trail)[last].travel_m - looked_at_m_ < kEvery_m) return false;
  looked_at_m_ = (*trail)[last].travel_m;
  // The keyframe in the middle of the last metres.
  std::uint32_t now = last;
  while (now > 0 && trail->travel_between_m(now, last) < kGroup_m) --now;
  std::uint32_t old = 0;
  double reach_m = 0.0;
  if (!nearest_old(*trail, now, &old, &reach_m)) return false;
  Candidate candidate;
  candidate.reach_m = reach_m;
  const bool fits = match(*trail, matcher, {old, now, trail->pose(now), reach_m, kGroup_m}, &candidate);
  if (doubt(trail, candidate)) return true;
  if (!fits) return false;
  if (pool_count_ == kPoolMost) {
    std::copy(pool_.begin() + 1, pool_.end(), pool_.begin());
    --pool_count_;
  }
  pool_[pool_count_++] = candidate;
  return believe(trail, matcher, candidate) > 0;
}

}  // namespace pose_wall::planar
