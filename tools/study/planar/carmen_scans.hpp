// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A log of CARMEN as a source of scans.

#pragma once

#include <string>

#include "io/planar_files/carmen_log.hpp"
#include "io/planar_files/planar_input.hpp"
#include "study/planar/scan_source.hpp"

namespace pose_wall::tools {

class CarmenScans : public ScanSource {
 public:
  // Throws CarmenError.
  explicit CarmenScans(const std::string& file);

  std::optional<SourcedScan> next() override;
  std::size_t scans() const override { return log_.scans.size(); }
  bool has_odometry() const override { return true; }
  std::vector<std::string> notes() const override;
  std::vector<std::filesystem::path> files() const override { return {file_}; }

 private:
  std::string file_;
  CarmenLog log_;
  pose_wall_planar_pose sensor_;
  std::size_t at_ = 0;
};

}  // namespace pose_wall::tools
