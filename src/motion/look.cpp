// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/look.hpp"

#include "motion/frame_steps.hpp"

namespace pose_wall::motion {
namespace {

std::uint64_t points_of(const pose_wall_cloud& cloud) {
  return std::uint64_t{cloud.width} * cloud.height;
}

}  // namespace

void Imager::lay_out(Arena& arena) {
  image_.lay_out(arena);
  segment_.lay_out(arena);
  choice_.lay_out(arena);
  observation_ = arena.take<Observation>(kObservationsMost);
  print_ = arena.take_one<CloudPrint>();
}

bool Imager::repeats(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, Work* work) {
  project(cloud, mount, twist, &image_, print_);
  work->add(points_of(cloud), steps::kPointProjected);
  return repeat_guard_.keep(*print_, cloud.stamp_ns).is_one;
}

Seen Imager::look(const Pose& expected, const Mount& mount, Work* work) {
  Seen out;
  out.segments = segment(expected.R, mount, &segment_, &image_);
  out.features = mark_features(&image_);
  out.observations = observation_.first(choose_observations(image_, expected, &choice_, observation_));
  work->add(image_.count, steps::kPointLookedAt);
  return out;
}

void Imager::look_again(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, const Pose& at,
                        Work* work) {
  const std::uint32_t count = image_.count;
  work->add(points_of(cloud), steps::kPointProjected);
  project_again(cloud, mount, twist, &image_);
  if (image_.count == count) return;
  work->add(image_.count, steps::kPointLookedAt);
  image_.flags.fill(0);
  segment(at.R, mount, &segment_, &image_);
  mark_features(&image_);
}

}  // namespace pose_wall::motion
