// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The stages of a frame one after the other, as the odometry runs them, each open to be looked at.

#pragma once

#include "motion/along_match.hpp"
#include "motion/boxes.hpp"
#include "motion/features.hpp"
#include "motion/registration.hpp"
#include "motion/relief_map.hpp"
#include "motion/segmentation.hpp"

namespace pose_wall::motion::test {

class Pipeline {
 public:
  Pipeline() : observation_(kObservationsMost) { map->clear(); }

  // What is seen, as of a scan from the expected pose.
  void see(const pose_wall::test::Points& points, const Pose& expected) {
    project(pose_wall::test::cloud_of(points, 0), mount, Twist{}, image.get(), &print);
    segments = segment(expected.R, mount, segment_.get(), image.get());
    features = mark_features(image.get());
    const Span<Observation> room(observation_.data(), kObservationsMost);
    observations = room.first(choose_observations(*image, expected, choice_.get(), room));
    map->set_corner(expected.t);
  }
  // Into the map, seen from there.
  void take_in(const Pose& pose) {
    map->set_corner(pose.t);
    map->begin_keyframe(pose.R * mount.sensor_base_m + pose.t);
    const LocalPose local(pose, map->corner());
    for (std::uint32_t i = 0; i < image->count; ++i) {
      Eigen::Vector3f normal;
      std::uint8_t facing = kFacesX;
      if ((image->flags[i] & kPlane) == 0 || !normal_about(*image, i, &normal)) continue;
      if (facing_of(local.R * normal, &facing)) map->add(local(image->point(i)), facing);
    }
    map->end_keyframe();
  }
  Scan scan() { return {map.get(), observations, mount.sensor_base_m.cast<float>()}; }

  // Both steps, coarse and then by the relief, from a pose that is nearly right.
  Alignment align(const Pose& from, bool with_along, int passes = 6) {
    Alignment a;
    a.pose = from;
    a.axes = find_axes(scan(), a.pose, from.R * Eigen::Vector3d::UnitX(), a.axes);
    StepOptions options;
    options.with_along = with_along;
    for (int pass = 0; pass < passes; ++pass) {
      if (pass == 4) options.use_relief = true;
      take_steps(scan(), options, steps.get(), &a);
    }
    return a;
  }

  pose_wall::Mount mount;
  Laid<RangeImage> image;
  CloudPrint print;
  Laid<ReliefMap> map;
  Laid<StepScratch> steps;
  Laid<CurveScratch> curve;
  Segments segments;
  FeatureCounts features;
  Span<Observation> observations;

 private:
  Laid<SegmentScratch> segment_;
  Laid<ObservationScratch> choice_;
  std::vector<Observation> observation_;
};

}  // namespace pose_wall::motion::test
