// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

namespace pose_wall {

// How many standard deviations the protection level spans when the standard deviation itself comes from only so many
// independent patches: the normal quantile k stretched to Student's t (Fisher and Cornish 1960, first term).
inline double protection_factor(double k, double dof) {
  return k * (1.0 + (k * k + 1.0) / (4.0 * dof));
}

}  // namespace pose_wall
