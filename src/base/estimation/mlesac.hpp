// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Scores of plane hypotheses: a quick one on a subset for all of them, and MLESAC (Torr and Zisserman 2000) on all
// points for the few that are left.

#pragma once

#include <cstdint>

#include "base/containers/point_set.hpp"
#include "base/estimation/plane.hpp"

namespace pose_wall {

// Points of a first score. A share of them errs by 2.2 % at most: enough to nominate a plane, not to choose it.
constexpr std::uint32_t kSubsetPoints = 512;

// Mean of min(r^2, threshold^2) / threshold^2 over the points: 0 perfect, 1 nothing near the plane. The points are in
// random order. If those read so far show by three standard errors that the mean will be too_much or more, the rest is
// skipped and the answer is too_much (a sequential test after Wald 1945, as in Matas and Chum 2005).
double truncated_cost(const PointSet& points, const Plane& plane, double threshold_m, double too_much);

struct MlesacScore {
  double cost;          // mean negative log likelihood, relative to the all-outlier model: below 0 is evidence
  double inlier_share;  // mixing weight found by expectation maximisation
};

// Mixture of a Gaussian of the given sigma around the plane and a uniform density over outlier_span_m. EM finds the
// mixing weight on a histogram of |r|: one pass over the points, then a bounded number of passes over the bins.
MlesacScore mlesac_score(const PointSet& points, const Plane& plane, double sigma_m, double outlier_span_m);

}  // namespace pose_wall
