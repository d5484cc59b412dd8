// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The folder behind --annotate: one cloud per frame, named by the frame's number.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/frames/annotated_cloud.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools {

class AnnotatedFolder {
 public:
  // Makes the folder and takes away what an earlier run annotated there. Throws std::invalid_argument where it is one
  // of the inputs or holds one, or holds clouds of another origin; std::runtime_error where the system refuses.
  AnnotatedFolder(const std::string& folder, CloudFormat format, const std::vector<std::string>& inputs);

  // What FrameRunner shows of a processed frame; keeps its points.
  void look(const pose_wall_points& points, const pose_wall_result& result);

  // The frame that was looked at last, as a file; nothing for a frame that could not be read. Throws
  // std::runtime_error that names the file.
  void write(const FrameOutcome& outcome);

  std::size_t written() const { return written_; }

 private:
  void take_away_earlier() const;

  std::filesystem::path folder_;
  CloudFormat format_;
  std::vector<AnnotatedPoint> points_;
  std::size_t written_ = 0;
};

}  // namespace pose_wall::tools
