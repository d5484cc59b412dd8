// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The second step of a frame: from the cloud to observations. The range image is cut into ground and clusters, then
// into edges and planes, and some of the planes' points are chosen evenly.

#pragma once

#include "base/containers/work.hpp"
#include "lidar/seen_clouds.hpp"
#include "motion/features.hpp"
#include "motion/gates.hpp"
#include "motion/segmentation.hpp"

namespace pose_wall::motion {

struct Seen {
  Segments segments;
  FeatureCounts features;
  Span<Observation> observations;  // their facings follow the attitude that they were last faced by

  bool suffices() const { return passes<gate::OBSERVATIONS>(observations.size()); }
};

// Owns the image of the last scan.
class Imager {
 public:
  void lay_out(Arena& arena);
  void reset() { repeat_guard_ = RepeatGuard{}; }
  // Reads the cloud, freed of the twist. True if its points, or a part of them, came before.
  bool repeats(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, Work* work);
  // Of a cloud that was read.
  Seen look(const Pose& expected, const Mount& mount, Work* work);
  // Frees the image of another twist. No observation is chosen anew.
  void look_again(const pose_wall_cloud& cloud, const Mount& mount, const Twist& twist, const Pose& at, Work* work);

  const RangeImage& image() const { return image_; }

 private:
  RangeImage image_;
  SegmentScratch segment_;
  ObservationScratch choice_;
  Span<Observation> observation_;
  CloudPrint* print_ = nullptr;
  RepeatGuard repeat_guard_;
};

}  // namespace pose_wall::motion
