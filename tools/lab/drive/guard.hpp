// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The obstacle stop between a wish and the tracks.

#pragma once

#include <cstdint>

#include "lab/drive/machine.hpp"
#include "study/planar/part_block.hpp"

namespace pose_wall::tools {

class DriveGuard {
 public:
  // Throws PlanarError. `has_looked`: someone has looked round the machine, as pose_wall_planar_stop_confirm wants it.
  DriveGuard(const sim::SensorModel& model, bool has_looked);

  // How the machine may move: the wished arc, as fast as the stop allows.
  Motion limit(const pose_wall_cloud& cloud, std::int64_t now_ns, const Motion& measured, const Motion& wished);

  const pose_wall_planar_stop_result& last() const { return result_; }

 private:
  PartBlock block_;
  pose_wall_planar_stop* stop_ = nullptr;
  pose_wall_planar_stop_result result_{};
  double rim_m_s_ = 0.0;  // that it let pass last
};

}  // namespace pose_wall::tools
