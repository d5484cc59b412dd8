// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// truth.csv: one row per frame, `frame,stamp_ns,roll,pitch,yaw,d_lf,d_lb,d_rf,d_rb`, rad and m, empty where there is
// no truth (a wall that does not exist). Where the pose is known, `x,y,z,qx,qy,qz,qw` follow: base in a frame that
// stands still (the simulator's road frame), m and a unit quaternion.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

namespace pose_wall::tools {

inline constexpr std::size_t kTruthQuantities = 7;
inline constexpr double kNoTruth = std::numeric_limits<double>::quiet_NaN();

inline constexpr std::size_t kPoseNumbers = 7;  // x, y, z, qx, qy, qz, qw
using BasePose = std::array<double, kPoseNumbers>;

struct TruthRow {
  std::uint64_t frame = 0;
  std::int64_t stamp_ns = 0;
  // In the order of pose_wall_quantity: roll, pitch, yaw, d_lf, d_lb, d_rf, d_rb.
  std::array<double, kTruthQuantities> value{kNoTruth, kNoTruth, kNoTruth, kNoTruth, kNoTruth, kNoTruth, kNoTruth};
  std::optional<BasePose> pose;  // of all rows of a file, or of none
};

// Both throw std::runtime_error that names the file; the reader also the line or column.
void write_truth_csv(const std::filesystem::path& file, const std::vector<TruthRow>& rows);
std::vector<TruthRow> read_truth_csv(const std::filesystem::path& file);

}  // namespace pose_wall::tools
