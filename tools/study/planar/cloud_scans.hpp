// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frames of a LiDAR as planar scans: the engine measures the floor, and the points of the machine's height become a
// scan.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame_stamps.hpp"
#include "io/inputs/frame_options.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "pose_wall_planar_scan.h"
#include "study/motion/moving_engine.hpp"
#include "study/planar/part_block.hpp"
#include "study/planar/scan_source.hpp"
#include "study/planar/setting_words.hpp"

namespace pose_wall::tools {

const SettingRows& scanner_setting_rows();

// The defaults, with the settings that `words` holds; these are taken out of it. Throws std::invalid_argument.
pose_wall_planar_scanner_settings take_scanner_settings(std::vector<std::string>* words);

// x, y and yaw of base in the plane; none while the motion is lost.
std::optional<pose_wall_planar_pose> plane_odometry(const pose_wall_motion_result& moved);

class CloudScans : public ScanSource {
 public:
  // Settings of the engine are those of the options; its floor is all floor in view, whatever the key region. With the
  // key `motion` on, each scan has the motion's pose as its odometry. Throws ConfigError, std::invalid_argument,
  // PlanarError.
  CloudScans(const FrameOptions& options, const pose_wall_planar_scanner_settings& settings);

  std::optional<SourcedScan> next() override;
  std::size_t scans() const override { return inputs_.frames(); }
  bool has_odometry() const override { return has_motion_; }
  std::vector<std::string> notes() const override;
  std::vector<std::string> errors() const override { return inputs_.errors(); }
  std::vector<std::filesystem::path> files() const override { return files_; }

  // Of the last scan that next() gave without an error; its arrays live until the next one.
  const pose_wall_planar_scan_view& view() const { return view_; }

 private:
  CloudScans(const FrameOptions& options, const pose_wall_planar_scanner_settings& settings, LoadedConfig loaded);

  bool has_motion_;
  FrameSequence inputs_;
  std::vector<std::filesystem::path> files_;
  FrameStamps stamps_;
  MovingEngine engine_;
  PartBlock block_;
  pose_wall_planar_scanner* scanner_ = nullptr;
  pose_wall_planar_scan_view view_{};
  pose_wall_planar_scanner_settings settings_;
};

}  // namespace pose_wall::tools
