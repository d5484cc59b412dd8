// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Ground marks and clusters of the range image (the document's sections 1.2 and 1.3): marks ground, and things too
// small to be rock.

#pragma once

#include "motion/range_image.hpp"

namespace pose_wall::motion {

struct Segments {
  std::uint32_t ground = 0;    // points marked
  std::uint32_t clusters = 0;  // that were kept
};

struct SegmentScratch {
  void lay_out(Arena& arena);
  Span<std::uint16_t> label;     // of a point
  Span<std::uint16_t> leads_to;  // another label of the same cluster, or itself
  Span<std::uint16_t> size;      // points of a cluster, by the label that stands for it
};

// Sets kGround and kKept. R_map_base: the attitude that is expected, which "level" is meant by.
Segments segment(const Eigen::Matrix3d& R_map_base, const Mount& mount, SegmentScratch* scratch, RangeImage* image);

}  // namespace pose_wall::motion
