// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frames of a LiDAR in a roadway, with the truth of each. The same setup and seed give the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/sim/rock_surface.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/truth.hpp"

namespace pose_wall::tools::sim {

struct Frame {
  std::vector<float> xyz_intensity;    // lidar frame, four floats per point; no-returns are left out
  std::vector<Label> labels;           // one per point
  std::vector<std::uint32_t> time_ns;  // likewise: when its beam fired, from the stamp on; all 0 without scan_s
  std::vector<std::uint16_t> ring;     // likewise: counted from the lowest; all 0 for a pattern
  std::vector<std::uint16_t> column;   // likewise: which firing of the turn; of a pattern, which part
  std::int64_t stamp_ns = 0;
  std::size_t count() const { return labels.size(); }
};

class Simulator {
 public:
  // Throws std::invalid_argument where parts of the setup contradict each other (see check_setup).
  Simulator(const Setup& setup, std::uint64_t seed);
  // A real road. Of the setup count sensor, mount, faults, sequence, and the machine's axes and body; its road and all
  // in it, and how the machine moves, come from the survey.
  Simulator(const Setup& setup, std::uint64_t seed, Survey survey);

  const Setup& setup() const { return setup_; }
  const Survey& survey() const { return survey_; }
  // Of a road that is no survey.
  MachinePose pose(std::uint32_t frame_index) const;
  // May be called from several threads at once.
  Frame render(std::uint32_t frame_index) const;
  // By the ideal road; of a real one, surveyed.
  TruthRow truth(std::uint32_t frame_index, StepRule rule = StepRule::kSquare) const;
  // By planes of the ground that is really there (survey_truth.hpp), steel sets, heaps and benches with it, bodies
  // without.
  TruthRow surveyed_truth(std::uint32_t frame_index) const;

 private:
  std::int64_t stamp_ns(std::uint32_t frame_index) const;
  Moment truth_moment(std::uint32_t frame_index) const;
  TruthRow with_pose(TruthRow row, std::uint32_t frame_index, const Placement& at) const;
  Moment moment_at(double time_s) const;

  Setup setup_;
  std::uint64_t seed_;
  Survey survey_;  // or none
  World world_;
  World mean_rock_;
  std::vector<Beam> beams_;  // of the first frame; all frames' for rotating sensors
};

}  // namespace pose_wall::tools::sim
