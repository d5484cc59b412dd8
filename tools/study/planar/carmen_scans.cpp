// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/carmen_scans.hpp"

#include <fmt/format.h>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

// Of the scanners of public logs: their data sheets promise 5 mm (LMS-291) to 30 mm (URG).
constexpr double kSigma_m = 0.02;

std::string lines_note(const CarmenLog& log) {
  std::string text;
  for (const CarmenSkip reason : {CarmenSkip::kBadLine, CarmenSkip::kNotFinite}) {
    const CarmenSkipped& skipped = log.skip(reason);
    if (skipped.lines == 0) continue;
    text += say("{} lines cannot be read, the first is line {}: {}", skipped.lines, skipped.first_line,
                skipped.first_fault);
  }
  return text;
}

}  // namespace

CarmenScans::CarmenScans(const std::string& file)
    : file_(file), log_(read_carmen_log(file)), sensor_(carmen_sensor_pose(log_)) {}

std::optional<SourcedScan> CarmenScans::next() {
  if (at_ == log_.scans.size()) return std::nullopt;
  const CarmenScan& from = log_.scans[at_++];
  SourcedScan scan;
  scan.name = fmt::format("{}:{}", file_, from.line);
  scan.time = from.stamp;
  scan.scan = planar_scan_of(from, sensor_, kSigma_m, &scan.range_m);
  scan.odometry = from.odometry;
  scan.place = sensor_;
  return scan;
}

std::vector<std::string> CarmenScans::notes() const {
  const CarmenScan& first = log_.scans.front();
  std::vector<std::string> notes = {
      say("{}: {} scans, {} beams from {:.1f}° by {:.2f}°, range {:.2f} m, scanner at x {:.3f} m, y {:.3f} m", file_,
          log_.scans.size(), first.range_m.size(), first.angle_min_rad * kDegPerRad, first.angle_step_rad * kDegPerRad,
          first.range_max_m, sensor_.x_m, sensor_.y_m)};
  if (log_.stamps_back > 0) {
    notes.push_back(say("{} scans have a stamp that is not later than the one before; scans keep the order of the log",
                        log_.stamps_back));
  }
  if (const std::string bad = lines_note(log_); !bad.empty()) notes.push_back(bad);
  return notes;
}

}  // namespace pose_wall::tools
