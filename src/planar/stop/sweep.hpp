// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The footprint along the arc of the motion, and the highest speed at which it stays clear until standstill.
//
// Speeds are rim speeds: that of the footprint's fastest point. A sweep has slices of equal rim path. A hazard is a
// place with its margin. Between two slices each edge of the footprint moves in a straight line past a place, but for
// a sagitta that is added to all margins. So the least distance between slices is bounded by the distances to each
// edge at both slices, and nothing slips through between them.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/span.hpp"
#include "base/simd/four_floats.hpp"
#include "planar/stop/settings.hpp"

namespace pose_wall::planar {

constexpr std::uint32_t kSweepSlices = 64;  // steps of 0.1 m, or longer ones for a long path
constexpr std::uint32_t kSweepLevels = 24;  // speeds that are tried: steps of 4 % of the top speed
constexpr std::uint32_t kSweepEdges = POSE_WALL_PLANAR_STOP_CORNERS_MAX;  // of the public header
constexpr double kSweepReach_m = 7.8;                                     // places are known this far around base

// The motion that a sweep is about: every motion s * twist + deviation, s from 0 to the rim speed.
struct SweepMotion {
  Eigen::Vector2d velocity = Eigen::Vector2d::UnitX();     // of base, for a rim speed of 1 m/s
  double turn_rad_m = 0.0;                                 // likewise
  double speed_error_ratio = 0.0, speed_error_m_s = 0.0;   // along the arc: it may be so much faster
  double turn_error_rad_s = 0.0, aside_m_s = 0.0;          // deviation from the arc
  Eigen::Vector2d measured_m_s = Eigen::Vector2d::Zero();  // what it does now, where that is known
  double measured_turn_rad_s = 0.0;
  bool may_go_on = false;  // a change of the command is under way: the machine may move as it was told before
  bool any = false;        // every motion up to the top speed
};

// A place in the way: thing or blind.
struct Hazard {
  float x_m, y_m;  // in base
  float margin_m;  // its own size and the protection level
  float approach_m_s;
  float sooner_s;  // it is seen to come by so much sooner than the reaction time; more than 0 of what stood still
  std::uint32_t place;
  std::uint32_t kind;
};

class Sweep {
 public:
  void open(const StopSettings& settings);
  // The slices of a motion, up to the top speed and with reaction time `reaction_s`.
  void set_motion(const SweepMotion& motion, double reaction_s);

  // False where a hazard lies too far away to matter at the top speed.
  FourTruths concerns(FourFloats x_m, FourFloats y_m, float reach_m) const {
    return (x_m >= low_x_ - reach_m) & (x_m <= high_x_ + reach_m) & (y_m >= low_y_ - reach_m) &
           (y_m <= high_y_ + reach_m);
  }
  // The middle of the square around the whole sweep, and half its side.
  Eigen::Vector2d middle_m() const {
    return Eigen::Vector2f(0.5F * (low_x_ + high_x_), 0.5F * (low_y_ + high_y_)).cast<double>();
  }
  double half_m() const { return 0.5 * static_cast<double>(larger_of_two(high_x_ - low_x_, high_y_ - low_y_)); }
  // How far margins grow at the top speed, for a hazard that approaches.
  float growth_m(float approach_m_s) const { return growth_[kSweepLevels] + approach_m_s * time_[kSweepLevels]; }
  // Distance from the footprint where it stands; negative inside.
  float distance_now(float x_m, float y_m) const;

  // The highest level at which no hazard is touched, 0 to kSweepLevels; *limiting is the hazard that limits it, or -1.
  std::uint32_t highest_level(Span<const Hazard> hazards, std::int32_t* limiting) const;
  double speed_of(std::uint32_t level) const { return top_m_s_ * level / kSweepLevels; }
  // Rim path until the footprint is within the hazard's margin; infinite if never within the sweep.
  double path_to(const Hazard& hazard) const;
  double radius_m() const { return radius_m_; }

 private:
  static constexpr std::uint32_t kSegmentBounds = 4;  // half planes whose largest distance is no more than a segment's
  struct Four;
  static float larger_of_two(float a, float b) { return a > b ? a : b; }
  void set_levels(const SweepMotion& motion, double reaction_s);
  void set_slices(const SweepMotion& motion);
  Four lanes_of(Span<const Hazard> hazards, std::uint32_t first) const;
  void set_advancing(const SweepMotion& motion);
  // How near a hazard comes until a level's standstill: to the footprint, to where that is now, and to what of its rim
  // moves outwards.
  struct Nearness {
    float least_m, now_m, ahead_m;
  };
  bool is_clear(const Nearness& near, const Hazard& hazard, std::uint32_t level) const;
  Four from_slice(const Four& four, std::uint32_t slice) const;
  FourFloats distances(const Four& four, std::uint32_t slice, FourFloats* edges) const;
  FourFloats least_until(const Four& four, std::uint32_t slices, FourFloats* now) const;
  FourFloats ahead_at(const Four& four, std::uint32_t slice, FourFloats (*bounds)[kSegmentBounds]) const;
  FourFloats ahead_until(const Four& four, std::uint32_t slices) const;
  Nearness nearness_of(const Hazard& hazard, std::uint32_t slices) const;

  std::uint32_t edges_ = 0, slices_ = 0, top_level_ = 0;
  bool any_ = false;
  float normal_x_[kSweepEdges], normal_y_[kSweepEdges], offset_[kSweepEdges];
  // The parts of edges that move outwards: from where to where along the edge, in metres.
  struct Advancing {
    std::uint32_t edge;
    float from_m, to_m;
  };
  Advancing advancing_[kSweepEdges];
  std::uint32_t advancing_count_ = 0;
  double corner_x_[kSweepEdges], corner_y_[kSweepEdges];
  double radius_m_ = 0.0, top_m_s_ = 0.0, deceleration_ = 1.0, scan_s_ = 0.0, approach_m_s_ = 0.0;
  double creeping_m_s_ = 0.0, step_m_ = 0.1;
  // Base at each slice.
  float x_[kSweepSlices + 1], y_[kSweepSlices + 1], cosine_[kSweepSlices + 1], sine_[kSweepSlices + 1];
  // Of each level: slices until standstill, growth of static margins, time until standstill.
  std::uint32_t slices_of_[kSweepLevels + 1];
  float growth_[kSweepLevels + 1], time_[kSweepLevels + 1];
  double path_[kSweepLevels + 1];
  float low_x_ = 0.0F, high_x_ = 0.0F, low_y_ = 0.0F, high_y_ = 0.0F;
};

}  // namespace pose_wall::planar
