// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How the machine drives along its road: where it stands at each stamp, and how it moves within a scan.

#pragma once

#include <array>
#include <vector>

#include "judge/machine.hpp"

namespace pose_wall::judge {

constexpr double kPeriod_s = 0.1;

// From one stamp to the next, at constant speed and constant rates of turn. Share 0 is the first stamp.
class Passage {
 public:
  Passage(const Road& road, const Machine& machine, const Stance& from, const Stance& to);
  Pose at(double share) const;

 private:
  // Between two of these poses a machine turns by less than 0.01 degree: their mean is a pose to 1e-8.
  static constexpr int kSteps = 64;
  std::array<Pose, kSteps + 1> pose_;
};

enum class Going { kDrawn, kStands, kDrives };

// The quickest that the machine does anything on its drive.
struct Pace {
  double ahead_m_s = 0.0, across_m_s = 0.0, turn_rad_s = 0.0;
};

struct Drive {
  Pace pace() const;

  std::vector<Stance> stances;  // one more than there are frames
};

// 0 to 0.5 m a frame in a steady curve, nose and sides swaying a little; or at rest. A drive that would leave the road,
// reach its end, or meet what stands in its way is slower. `first` may be turned more to the road's direction.
Drive draw_drive(const Road& road, const Machine& machine, const Stance& first, Going going, int frames, Draw* draw);

}  // namespace pose_wall::judge
