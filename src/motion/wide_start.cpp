// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/wide_start.hpp"

#include <cmath>

#include "motion/frame_steps.hpp"

namespace pose_wall::motion {
namespace {

Eigen::Vector3d normal_of(const Observation& o) {
  return {static_cast<double>(o.normal[0]), static_cast<double>(o.normal[1]), static_cast<double>(o.normal[2])};
}

}  // namespace

Eigen::Matrix3d upright(Span<const Observation> observations, const Eigen::Matrix3d& R_map_base,
                        const Eigen::Vector3d& sensor_base_m) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  // Wide, then narrow: points off the ground drop out.
  for (const double cosine_least : {0.8, 0.9, 0.97, 0.985}) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::uint32_t count = 0;
    for (const Observation& o : observations) {
      const Eigen::Vector3d n = R_map_base * normal_of(o);
      const Eigen::Vector3d arm(static_cast<double>(o.x), static_cast<double>(o.y), static_cast<double>(o.z));
      if (!(n.dot(up) > cosine_least) || !(up.dot(R_map_base * (arm - sensor_base_m)) < -0.3)) continue;
      sum += n;
      ++count;
    }
    if (count < 30) return Eigen::Matrix3d::Identity();
    up = sum / std::sqrt(sum.squaredNorm());
  }
  const Eigen::Vector3d axis = up.cross(Eigen::Vector3d::UnitZ());
  const double sine_of = std::sqrt(axis.squaredNorm());
  return sine_of > 1e-9 ? turn_by(axis * (arc_tangent2(sine_of, up.z()) / sine_of)) : Eigen::Matrix3d::Identity();
}

double squaring_yaw_rad(Span<const Observation> observations, const Eigen::Matrix3d& R_map_base) {
  double c = 0.0, s = 0.0;
  for (const Observation& o : observations) {
    const Eigen::Vector3d n = R_map_base * normal_of(o);
    if (!(std::fabs(n.z()) < 0.5)) continue;
    const double angle = 4.0 * arc_tangent2(n.y(), n.x());  // the same for all four sides of a square
    c += cosine(angle);
    s += sine(angle);
  }
  return -0.25 * arc_tangent2(s, c);
}

namespace {

// How well a point lies on the map: 1 on a plane, 0 off the layer about it.
double nearness(const ReliefMap& map, const LocalPose& local, const Observation& o, std::uint8_t facing) {
  Surface at;
  const bool on = map.find(local(Eigen::Vector3f(o.x, o.y, o.z)), facing, &at);
  return on ? 1.0 - static_cast<double>(std::fabs(at.above_m) / kLayer_m) : 0.0;
}

}  // namespace

double share_on_map(const ReliefMap& map, Span<const Observation> observations, const Pose& pose,
                    std::uint32_t stride) {
  const LocalPose local(pose, map.corner());
  double on = 0.0, asked = 0.0;
  for (std::uint32_t i = 0; i < observations.size(); i += stride) {
    const Observation& o = observations[i];
    if (o.facing == kFacesZ) continue;  // is met wherever the machine turns and goes
    asked += 1.0;
    on += nearness(map, local, o, o.facing);
  }
  return asked > 0.0 ? on / asked : 0.0;
}

namespace {

// The observations that answer: evenly chosen of those on walls. Ground and roof are met wherever the machine turns and
// goes.
std::uint32_t choose_asked(Span<const Observation> observations, Span<Observation> asked) {
  std::uint32_t walls = 0;
  for (const Observation& o : observations) walls += o.facing != kFacesZ ? 1U : 0U;
  const std::uint32_t stride = walls / kAskedMost + 1;
  std::uint32_t count = 0, next = 0;
  for (const Observation& o : observations) {
    if (o.facing != kFacesZ && next++ % stride == 0) asked[count++] = o;
  }
  return count;
}

// The best start so far of a grid about a pose, each tried exactly.
class BestStart {
 public:
  BestStart(const ReliefMap& map, Span<const Observation> asked, const Pose& middle, double place_step_m, Work* work)
      : map_(map), asked_(asked), middle_(middle), pose_(middle), place_step_m_(place_step_m), work_(work) {}

  double share() const { return best_; }
  const Pose& pose() const { return pose_; }

  // turn: of the start's yaw; facing: of the observations there.
  void try_out(const Start& start, const Eigen::Matrix3d& turn, Span<const std::uint8_t> facing) {
    const Pose at = {turn * middle_.R, middle_.t + place_step_m_ * Eigen::Vector3d(start.x, start.y, 0.0)};
    const double cost = start.cost(), share = share_above(at, facing, best_ + cost);
    if (!(share - cost > best_)) return;
    best_ = share - cost;
    pose_ = at;
  }

 private:
  // Which share of the observations lies on the map's surfaces, weighed by how near. Ends where it cannot become more
  // than `least`.
  double share_above(const Pose& pose, Span<const std::uint8_t> facing, double least) {
    const LocalPose local(pose, map_.corner());
    const double all = asked_.size();
    double on = 0.0;
    for (std::uint32_t i = 0; i < asked_.size(); ++i) {
      work_->add(steps::kStartLookedAt);
      on += nearness(map_, local, asked_[i], facing[i]);
      if (!(on + (all - i - 1.0) > least * all)) return 0.0;
    }
    return on / all;
  }

  const ReliefMap& map_;
  Span<const Observation> asked_;
  Pose middle_, pose_;
  double place_step_m_, best_ = 0.0;
  Work* work_;
};

// One pass of the search: how far to each side, and in which steps.
struct Pass {
  double yaw_rad, yaw_step_rad, place_m, place_step_m;

  StartGrid grid() const { return {steps_of(yaw_rad, yaw_step_rad), steps_of(place_m, place_step_m), yaw_step_rad}; }

 private:
  static int steps_of(double reach, double step) {
    const int steps = static_cast<int>(reach / step + 0.5);
    return steps < kStartsMost ? steps : kStartsMost;
  }
};

// All of a small grid.
double search_all(const ReliefMap& map, Span<const Observation> asked, const Pass& pass, StartScratch* scratch,
                  Work* work, Pose* pose) {
  const StartGrid grid = pass.grid();
  const Span<std::uint8_t> facing = scratch->facing.first(asked.size());
  BestStart best(map, asked, *pose, pass.place_step_m, work);
  for (int yaw = -grid.yaws; yaw <= grid.yaws; ++yaw) {
    const Eigen::Matrix3d turn = grid.turn(yaw);
    find_facings(turn * pose->R, asked, facing);
    for (int x = -grid.places; x <= grid.places; ++x) {
      for (int y = -grid.places; y <= grid.places; ++y) best.try_out({yaw, x, y}, turn, facing);
    }
  }
  *pose = best.pose();
  return best.share();
}

// Of a large one those whose bound is better than the best, the best bound first.
void search_bounded(const ReliefMap& map, Span<const Observation> asked, const Pass& pass, StartScratch* scratch,
                    Work* work, Pose* pose) {
  const StartGrid grid = pass.grid();
  const std::uint32_t count = count_starts(map, asked, *pose, grid, scratch, work);
  BestStart best(map, asked, *pose, pass.place_step_m, work);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t index = scratch->best[k];
    if (scratch->bound[index] * kBoundUnit <= best.share()) break;  // so are all that follow
    const Start start = grid.at(index);
    best.try_out(start, grid.turn(start.yaw), grid.of_yaw(scratch->facing, asked.size(), start.yaw));
  }
  *pose = best.pose();
}

}  // namespace

bool search_wide(const ReliefMap& map, Span<Observation> observations, const WideReach& reach, StartScratch* scratch,
                 Work* work, Pose* pose) {
  face(pose->R, observations);
  const Span<const Observation> asked = scratch->asked.first(choose_asked(observations, scratch->asked));
  // A layer of 0.35 m spans 2 degrees at 10 m; the second pass is for things further away.
  search_bounded(map, asked, {reach.yaw_rad, 0.035, reach.place_m, kPlaceStep_m}, scratch, work, pose);
  search_all(map, asked, {0.03, 0.01, 0.2, 0.1}, scratch, work, pose);
  const double best = search_all(map, asked, {0.008, 0.004, 0.05, 0.05}, scratch, work, pose);
  face(pose->R, observations);
  return passes<gate::ON_MAP_FOUND>(best);
}

}  // namespace pose_wall::motion
