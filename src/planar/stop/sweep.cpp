// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/sweep.hpp"

#include <cmath>
#include <limits>

#include "base/math/elementary.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kStepLeast_m = 0.1;   // of the rim, between slices
constexpr float kNearer_m = 0.01F;     // a place within its margin may come nearer by less than this
constexpr float kFar_m = 1e9F;         // further than anything
constexpr double kTowards_m_s = 0.01;  // a surface that moves outwards more slowly does not touch, it is touched

}  // namespace

struct Sweep::Four {
  FourFloats x, y;
};

void Sweep::open(const StopSettings& settings) {
  edges_ = settings.corners;
  radius_m_ = 0.0;
  for (std::uint32_t k = 0; k < edges_; ++k) {
    const double *a = settings.corner_m[k], *b = settings.corner_m[(k + 1) % edges_];
    const double ex = b[0] - a[0], ey = b[1] - a[1], length = std::sqrt(ex * ex + ey * ey);
    normal_x_[k] = static_cast<float>(ey / length);
    normal_y_[k] = static_cast<float>(-ex / length);
    offset_[k] = static_cast<float>((ey * a[0] - ex * a[1]) / length);
    corner_x_[k] = a[0], corner_y_[k] = a[1];
    const double r = std::sqrt(a[0] * a[0] + a[1] * a[1]);
    if (r > radius_m_) radius_m_ = r;
  }
  top_m_s_ = settings.speed_max_m_s;
  deceleration_ = settings.deceleration_m_s2;
  scan_s_ = settings.scan_s;
  approach_m_s_ = settings.approach_m_s;
  creeping_m_s_ = creeping_speed_m_s(settings);
}

void Sweep::set_motion(const SweepMotion& motion, double reaction_s) {
  set_levels(motion, reaction_s);
  set_slices(motion);
  set_advancing(motion);
}

// Who walks cannot be touched by surfaces that slide along or recede, neither as the machine moves now nor as it will.
void Sweep::set_advancing(const SweepMotion& motion) {
  const bool is_every = motion.any || motion.may_go_on;
  advancing_count_ = 0;
  for (std::uint32_t e = 0; e < edges_; ++e) {
    const std::uint32_t next = e + 1 < edges_ ? e + 1 : 0;
    const double nx = static_cast<double>(normal_x_[e]), ny = static_cast<double>(normal_y_[e]);
    const double from_m = nx * corner_y_[e] - ny * corner_x_[e], to_m = nx * corner_y_[next] - ny * corner_x_[next];
    Advancing part{e, static_cast<float>(to_m), static_cast<float>(from_m)};  // of no length yet
    // Outward speed is linear along an edge.
    const auto add = [&](const Eigen::Vector2d& velocity, double turn, double least) {
      const auto over_at = [&](std::uint32_t corner) {
        return nx * (velocity.x() - turn * corner_y_[corner]) + ny * (velocity.y() + turn * corner_x_[corner]) - least;
      };
      const double first = over_at(e), last = over_at(next);
      if (first <= 0.0 && last <= 0.0) return;
      const double zero_m = from_m + (to_m - from_m) * first / (first - last);
      const auto begins_m = static_cast<float>(first < 0.0 ? zero_m : from_m);
      const auto ends_m = static_cast<float>(last < 0.0 ? zero_m : to_m);
      if (begins_m < part.from_m) part.from_m = begins_m;
      if (ends_m > part.to_m) part.to_m = ends_m;
    };
    add(motion.velocity, motion.turn_rad_m, kTowards_m_s / top_m_s_);
    add(motion.measured_m_s, motion.measured_turn_rad_s, kTowards_m_s);
    if (is_every) part.from_m = static_cast<float>(from_m), part.to_m = static_cast<float>(to_m);
    if (part.from_m < part.to_m) advancing_[advancing_count_++] = part;
  }
}

void Sweep::set_levels(const SweepMotion& motion, double reaction_s) {
  const double fastest = top_m_s_ * (1.0 + motion.speed_error_ratio) + motion.speed_error_m_s;
  const double longest_m = fastest * reaction_s + fastest * fastest / (2.0 * deceleration_);
  step_m_ = longest_m > kStepLeast_m * kSweepSlices ? longest_m / kSweepSlices : kStepLeast_m;
  const double turn = std::fabs(motion.turn_rad_m), speed = motion.velocity.norm();
  // Places within reach move past the footprint on arcs: by how much these leave their chords.
  const double sagitta_m = (speed + turn * kSweepReach_m) * turn * step_m_ * step_m_ / 8.0;
  any_ = motion.any;
  top_level_ = 0;
  for (std::uint32_t level = 0; level <= kSweepLevels; ++level) {
    const double rim = speed_of(level), time_s = reaction_s + rim / deceleration_;
    const double fast = rim * (1.0 + motion.speed_error_ratio) + motion.speed_error_m_s;
    const double path_m = motion.any || level == 0 ? 0.0 : fast * reaction_s + fast * fast / (2.0 * deceleration_);
    const double lever_m = radius_m_ + path_m;
    const double turn_error = motion.turn_error_rad_s + motion.speed_error_ratio * turn * rim;
    double growth_m = motion.aside_m_s * time_s + turn_error * time_s * lever_m + turn * rim * scan_s_ * lever_m;
    growth_m = motion.any ? longest_m : growth_m + sagitta_m;
    path_[level] = path_m;
    slices_of_[level] = static_cast<std::uint32_t>(std::ceil(path_m / step_m_ - 1e-9));
    if (slices_of_[level] > kSweepSlices) slices_of_[level] = kSweepSlices;
    growth_[level] = static_cast<float>(growth_m);
    time_[level] = static_cast<float>(time_s);
    if (lever_m + growth_m + approach_m_s_ * time_s <= kSweepReach_m) top_level_ = level;
  }
  slices_ = slices_of_[kSweepLevels];
}

void Sweep::set_slices(const SweepMotion& motion) {
  low_x_ = low_y_ = kFar_m;
  high_x_ = high_y_ = -kFar_m;
  for (std::uint32_t k = 0; k <= slices_; ++k) {
    const double l = k * step_m_, angle = motion.turn_rad_m * l;
    const double c = cosine(angle), s = sine(angle);
    // The integral of the turning velocity; its series where the turn is too small to divide by.
    const double half_s = sine(0.5 * angle), half_c = cosine(0.5 * angle);
    const double chord = std::fabs(angle) > 1e-6 ? 2.0 * half_s / angle * l : l;
    const double x = chord * (half_c * motion.velocity.x() - half_s * motion.velocity.y());
    const double y = chord * (half_s * motion.velocity.x() + half_c * motion.velocity.y());
    x_[k] = static_cast<float>(x), y_[k] = static_cast<float>(y);
    cosine_[k] = static_cast<float>(c), sine_[k] = static_cast<float>(s);
    for (std::uint32_t e = 0; e < edges_; ++e) {
      const auto at_x = static_cast<float>(x + c * corner_x_[e] - s * corner_y_[e]);
      const auto at_y = static_cast<float>(y + s * corner_x_[e] + c * corner_y_[e]);
      if (at_x < low_x_) low_x_ = at_x;
      if (at_x > high_x_) high_x_ = at_x;
      if (at_y < low_y_) low_y_ = at_y;
      if (at_y > high_y_) high_y_ = at_y;
    }
  }
}

float Sweep::distance_now(float x_m, float y_m) const {
  float most = -kFar_m;
  for (std::uint32_t e = 0; e < edges_; ++e) {
    const float d = normal_x_[e] * x_m + normal_y_[e] * y_m - offset_[e];
    if (d > most) most = d;
  }
  return most;
}

Sweep::Four Sweep::lanes_of(Span<const Hazard> hazards, std::uint32_t first) const {
  Four four{};
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    const Hazard& hazard = hazards[first + lane < hazards.size() ? first + lane : first];
    four.x[lane] = hazard.x_m;
    four.y[lane] = hazard.y_m;
  }
  return four;
}

// Places as base sees them at a slice.
Sweep::Four Sweep::from_slice(const Four& four, std::uint32_t slice) const {
  const FourFloats dx = four.x - x_[slice], dy = four.y - y_[slice];
  return {cosine_[slice] * dx + sine_[slice] * dy, cosine_[slice] * dy - sine_[slice] * dx};
}

// To each edge at a slice; returns the largest.
FourFloats Sweep::distances(const Four& four, std::uint32_t slice, FourFloats* edges) const {
  const Four q = from_slice(four, slice);
  FourFloats most = all_four(-kFar_m);
  for (std::uint32_t e = 0; e < edges_; ++e) {
    edges[e] = normal_x_[e] * q.x + normal_y_[e] * q.y - offset_[e];
    most = larger_of(most, edges[e]);
  }
  return most;
}

// A lower bound of the distance to the footprint between the first slice and this one; *now: at the first.
FourFloats Sweep::least_until(const Four& four, std::uint32_t slices, FourFloats* now) const {
  FourFloats before[kSweepEdges], here[kSweepEdges];
  FourFloats least = distances(four, 0, before);
  *now = least;
  for (std::uint32_t k = 1; k <= slices; ++k) {
    distances(four, k, here);
    FourFloats between = all_four(-kFar_m);
    for (std::uint32_t e = 0; e < edges_; ++e) {
      between = larger_of(between, smaller_of(before[e], here[e]));
      before[e] = here[e];
    }
    least = smaller_of(least, between);
  }
  return least;
}

// To the parts of the rim that move outwards, at a slice: no more than that.
FourFloats Sweep::ahead_at(const Four& four, std::uint32_t slice, FourFloats (*bounds)[kSegmentBounds]) const {
  const Four q = from_slice(four, slice);
  FourFloats least = all_four(kFar_m);
  for (std::uint32_t k = 0; k < advancing_count_; ++k) {
    const Advancing& part = advancing_[k];
    const FourFloats out = normal_x_[part.edge] * q.x + normal_y_[part.edge] * q.y - offset_[part.edge];
    const FourFloats along = normal_x_[part.edge] * q.y - normal_y_[part.edge] * q.x;
    FourFloats* const bound = bounds[k];
    bound[0] = out, bound[1] = -out, bound[2] = part.from_m - along, bound[3] = along - part.to_m;
    least = smaller_of(least, larger_of(larger_of(bound[0], bound[1]), larger_of(bound[2], bound[3])));
  }
  return least;
}

FourFloats Sweep::ahead_until(const Four& four, std::uint32_t slices) const {
  FourFloats before[kSweepEdges][kSegmentBounds], here[kSweepEdges][kSegmentBounds];
  FourFloats least = ahead_at(four, 0, before);
  for (std::uint32_t k = 1; k <= slices; ++k) {
    ahead_at(four, k, here);
    for (std::uint32_t part = 0; part < advancing_count_; ++part) {
      FourFloats between = all_four(-kFar_m);
      for (std::uint32_t j = 0; j < kSegmentBounds; ++j) {
        between = larger_of(between, smaller_of(before[part][j], here[part][j]));
        before[part][j] = here[part][j];
      }
      least = smaller_of(least, between);
    }
  }
  return least;
}

// Accepted if inside: a distance that is no number is not clear.
bool Sweep::is_clear(const Nearness& near, const Hazard& hazard, std::uint32_t level) const {
  if (level == 0) return true;
  const float margin_m = hazard.margin_m + growth_[level];
  // A place that was not seen, beside the way: what counts is that the machine does not go there.
  if (hazard.kind == POSE_WALL_PLANAR_STOP_UNSEEN && near.least_m >= near.now_m - kNearer_m && !any_) return true;
  const bool may_pass = hazard.sooner_s > 0.0F && speed_of(level) <= creeping_m_s_;
  const float walk_m = may_pass ? 0.0F : hazard.approach_m_s * (time_[level] - hazard.sooner_s);
  if (walk_m > 0.0F && !(near.ahead_m > margin_m + walk_m)) return false;
  // Already within the margin: slowly, and not nearer.
  const bool is_beside = near.now_m <= hazard.margin_m + growth_[1] && !any_;
  if (is_beside) return near.least_m >= near.now_m - kNearer_m + (growth_[level] - growth_[1]);
  return near.least_m > margin_m;
}

Sweep::Nearness Sweep::nearness_of(const Hazard& hazard, std::uint32_t slices) const {
  const Four four{all_four(hazard.x_m), all_four(hazard.y_m)};
  FourFloats now;
  const float least_m = least_until(four, slices, &now)[0];
  return {least_m, now[0], hazard.approach_m_s > 0.0F ? ahead_until(four, slices)[0] : kFar_m};
}

std::uint32_t Sweep::highest_level(Span<const Hazard> hazards, std::int32_t* limiting) const {
  std::uint32_t level = top_level_;
  *limiting = -1;
  for (std::uint32_t first = 0; first < hazards.size() && level > 0; first += kFour) {
    const Four four = lanes_of(hazards, first);
    FourFloats now;
    const FourFloats least = least_until(four, slices_of_[level], &now);
    const std::uint32_t end =
        first + kFour < hazards.size() ? first + kFour : static_cast<std::uint32_t>(hazards.size());
    bool may_walk = false;
    for (std::uint32_t k = first; k < end; ++k) may_walk = may_walk || hazards[k].approach_m_s > 0.0F;
    const FourFloats ahead = may_walk ? ahead_until(four, slices_of_[level]) : all_four(kFar_m);
    for (std::uint32_t k = first; k < end; ++k) {
      Nearness near{least[k - first], now[k - first], ahead[k - first]};
      while (level > 0 && !is_clear(near, hazards[k], level)) {
        --level;
        near = nearness_of(hazards[k], slices_of_[level]);
        *limiting = static_cast<std::int32_t>(k);
      }
    }
  }
  return level;
}

double Sweep::path_to(const Hazard& hazard) const {
  const Four four{all_four(hazard.x_m), all_four(hazard.y_m)};
  for (std::uint32_t k = 0; k <= slices_; ++k) {
    FourFloats now;
    if (!(least_until(four, k, &now)[0] > hazard.margin_m)) return k > 0 ? (k - 1) * step_m_ : 0.0;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace pose_wall::planar
