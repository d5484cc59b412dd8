// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The frames of a machine that stands, as the doctor looks at them: a note of each, and the points of some that are
// spread evenly over all. The one place where the doctor reads its inputs.

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/inputs/frame_sequence.hpp"
#include "pose_wall.h"
#include "study/info/scan_times.hpp"
#include "study/info/sensor_look.hpp"

namespace pose_wall::tools::doctor {

struct FrameNote {
  std::string source;
  std::string error;  // not empty: it could not be read, and the members below stand at zero
  std::int64_t stamp_ns = 0;
  bool has_own_stamp = false;  // else it was made from --rate
  std::uint32_t points = 0;
  std::uint32_t returns = 0;  // finite and not zero
  std::uint64_t digest = 0;   // of the returns: equal for a repeated cloud
  ToldRings rings;            // by the frame itself
};

// The returns of one frame, in the lidar frame.
struct KeptFrame {
  std::vector<float> xyz_lidar_m;

  std::size_t count() const { return xyz_lidar_m.size() / 3; }
  Eigen::Vector3d point(std::size_t i) const {
    return Eigen::Vector3f(xyz_lidar_m[3 * i], xyz_lidar_m[3 * i + 1], xyz_lidar_m[3 * i + 2]).cast<double>();
  }
  // Valid as long as this frame.
  pose_wall_cloud cloud() const;
};

struct Recording {
  std::vector<FrameNote> notes;
  std::vector<KeptFrame> kept;
  SensorLook sensor;                // by all readable frames
  ScanTimeLook times;               // likewise
  std::vector<std::string> errors;  // inputs that gave nothing, and frames that could not be read
  bool interrupted = false;

  void add(FrameNote note, KeptFrame frame);

 private:
  std::size_t stride_ = 1;  // every so many frames are kept; doubles as the recording grows
  std::size_t readable_ = 0;
};

// The note of a cloud (source, stamp and error are the caller's) and its returns.
FrameNote note_of(const pose_wall_cloud& cloud, KeptFrame& frame);

// To the end, or to Ctrl-C. `progress` is told the name of every frame.
Recording read_recording(FrameSequence& inputs, double rate_hz,
                         const std::function<void(const std::string&)>& progress);

}  // namespace pose_wall::tools::doctor
