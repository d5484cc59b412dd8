// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The same pipeline from PCL's parts, as an engineer would put it together from its tutorials.
#pragma once

#include <array>
#include <vector>

namespace pose_wall::bench {

enum class PclMethod { kRansac, kMlesac };

// In the order of pose_wall_quantity; NaN where it found nothing.
using PclMeasurement = std::array<double, 7>;

// Points in base, four floats each, +X forward, the machine's body as a box to leave out. Same radii, leaves,
// thresholds, iterations and band as pose_wall's defaults.
PclMeasurement measure_with_pcl(const std::vector<float>& xyz_intensity, const std::array<double, 6>& body_box,
                                PclMethod method);

}  // namespace pose_wall::bench
