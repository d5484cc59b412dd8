// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// All that a report's page shows of a recording, frame by frame, as the page's script reads it. Angles in rad, lengths
// in m, times in s or ms; NaN where there is no number.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/config_file/sensor_mount.hpp"
#include "io/csv/truth_csv.hpp"
#include "io/json/json_words.hpp"
#include "io/picture/drawn_frame.hpp"
#include "study/report/cloud_choice.hpp"
#include "study/report/columns.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools::report {

class PageData {
 public:
  // frames: how many will come at most. points_max: of all clouds together.
  PageData(const api::Config& config, std::size_t frames, std::size_t points_max);

  // While the engine still has the frame's points: keeps them if the frame is one whose cloud is shown.
  void look(const pose_wall_cloud& cloud, const pose_wall_points& points, const pose_wall_result& result);
  void add(const FrameOutcome& outcome);
  // Once, after the last frame. Of each: nullptr where there is none.
  void add_truth(const std::vector<const TruthRow*>& truth);

  std::size_t frames() const { return sources_.size(); }
  std::size_t clouds() const { return cloud_frame_.size(); }
  std::size_t points() const { return point_label_.size(); }

  Json json() const;

 private:
  void add_values(const pose_wall_result& result);
  void add_planes(const pose_wall_result& result);
  void add_machine(const picture::DrawnFrame& frame);
  void add_point(const picture::Drawn& p, std::uint8_t label);
  void add_dropped(const pose_wall_cloud& cloud, const picture::DrawnFrame& frame, std::size_t most);

  const api::Config& config_;
  SensorMount mount_;
  CloudChoice choice_;
  std::vector<std::string> sources_, errors_;
  // Seven of a frame.
  Column<float> value_, raw_, sigma_, level_, raw_level_, age_s_, truth_;
  Column<std::uint8_t> state_, cause_, steer_;  // steer_: steer_cause
  Column<std::uint32_t> reasons_;
  // POSE_WALL_PARTS of each of the seven.
  Column<float> part_;
  // What positive angles mean: by the config, the same in all frames.
  std::array<std::uint32_t, 3> positive_means_{};
  // One of a frame.
  Column<double> stamp_s_;
  Column<float> engine_ms_, confidence_;
  Column<std::uint32_t> frame_reasons_;
  // Of a frame, in the frame that it is drawn in: kPlane numbers of left, right; floor; kMachine numbers.
  Column<float> planes_, floor_, machine_, stage_ms_;
  Column<std::uint32_t> counts_;
  // Of clouds and their points.
  Column<std::uint32_t> cloud_frame_, cloud_first_;
  Column<std::int16_t> point_cm_;
  Column<std::uint8_t> point_label_;
};

}  // namespace pose_wall::tools::report
