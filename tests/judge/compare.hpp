// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The same clouds under several treatments, side by side: with motion and without, with the default budget and without.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "judge/tally.hpp"

namespace pose_wall::judge {

struct NamedTreatment {
  const char* name;
  Treatment treatment;
};
// The first is the one that users have; the second lacks the motion alone; the third has no budget, either.
const std::vector<NamedTreatment>& compared_treatments();

// Each value's level with motion over its level without, frame by frame.
struct LevelRatios {
  // The verdicts are of the same road.
  void add(const Verdict& with, const Verdict& without);

  std::array<std::vector<double>, POSE_WALL_QUANTITIES> first, later;
  std::array<int, POSE_WALL_QUANTITIES> lost{}, gained{};  // told without motion alone, and with it alone
};

class Comparison {
 public:
  // Hears the road under all treatments, and prints what is beyond.
  void add(const Case& tried);
  std::string text() const;
  // A valid value of the treatment that users have was beyond its level or misleading.
  bool wrong() const { return wrong_; }

 private:
  std::string shares_text() const;
  std::string ratios_text() const;

  std::vector<Tallies> tallies_ = std::vector<Tallies>(compared_treatments().size());
  std::vector<WorkTally> work_ = std::vector<WorkTally>(compared_treatments().size());
  LevelRatios ratios_;
  bool wrong_ = false;
};

}  // namespace pose_wall::judge
