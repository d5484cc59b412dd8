// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: text as a CARMEN log. Each line is a scan or counts by its reason, and every scan is one that the planar
// library takes or refuses by its angles.

#include <cmath>
#include <string_view>
#include <vector>

#include "fuzz/fuzz_target.hpp"
#include "io/planar_files/carmen_log.hpp"

namespace {

using pose_wall::test::require;
using namespace pose_wall::tools;  // NOLINT(google-build-using-namespace): one target, one file

void take_log(const CarmenLog& log) {
  std::size_t lines = log.scans.size();
  for (const CarmenSkipped& skipped : log.skipped) {
    lines += skipped.lines;
    require((skipped.lines == 0) == (skipped.first_line == 0), "what was left out has a first line");
  }
  require(lines == log.lines, "each line counts once");
  const pose_wall_planar_pose sensor = carmen_sensor_pose(log);
  require(std::isfinite(sensor.x_m) && std::isfinite(sensor.y_m) && std::isfinite(sensor.yaw_rad), "a place");
  std::int64_t before_ns = INT64_MIN;
  std::vector<float> range_m;
  for (const CarmenScan& scan : log.scans) {
    require(scan.rising_ns > before_ns, "stamps rise");
    before_ns = scan.rising_ns;
    require(std::isfinite(scan.odometry.x_m) && std::isfinite(scan.laser.x_m), "poses are numbers");
    require(std::isfinite(scan.laser.yaw_rad) && scan.range_max_m > 0.0, "a heading, and how far it sees");
    const pose_wall_planar_scan planar = planar_scan_of(scan, sensor, 0.02, &range_m);
    require(planar.beams == scan.range_m.size() && planar.range_m == range_m.data(), "as many beams as ranges");
    for (const float range : range_m) {
      require(std::isnan(range) || (range > 0.0F && static_cast<double>(range) < scan.range_max_m), "a range or none");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    take_log(parse_carmen_log(std::string_view(reinterpret_cast<const char*>(data), size)));
  } catch (const CarmenError& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
