// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
// usage: zcat LOG | slam_trial > poses.tum
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "planar/slam/slam.hpp"

using namespace pose_wall;
using namespace pose_wall::planar;

int main(int argc, char** argv) {
  SlamSettings settings;
  settings.keyframes_most = 8192;
  Slam slam;
  Arena measure(nullptr);
  slam.lay_out(measure, settings);
  std::vector<unsigned char> block(measure.bytes() + 64);
  void* place = reinterpret_cast<void*>((reinterpret_cast<std::uintptr_t>(block.data()) + 63) & ~std::uintptr_t{63});
  Arena arena(place);
  slam.lay_out(arena, settings);
  slam.open(settings);
  std::vector<Beam> beams(POSE_WALL_PLANAR_BEAMS_MAX);
  std::string line;
  struct Row {
    double t;
    std::uint32_t keyframe;
    Pose2 in;
  };
  std::vector<Row> rows;
  double worst = 0, sum = 0, explained = 0;
  int n = 0, closures = 0, keyframes = 0;
  const double max_range = argc > 1 ? std::atof(argv[1]) : 40.0;
  while (std::getline(std::cin, line)) {
    if (line.rfind("FLASER ", 0) != 0) continue;
    std::istringstream in(line.substr(7));
    std::uint32_t count = 0;
    in >> count;
    std::vector<float> ranges(count);
    for (float& r : ranges) in >> r;
    double x, y, th;
    Pose2 odo;
    double t;
    std::string host;
    in >> x >> y >> th >> odo.x_m >> odo.y_m >> odo.yaw_rad >> t;
    pose_wall_planar_scan scan{};
    scan.struct_size = sizeof(scan);
    scan.beams = count;
    scan.stamp_ns = static_cast<std::int64_t>(t * 1e9);
    scan.angle_min_rad = -kPi / 2.0;
    scan.angle_step_rad = kPi / (count == 181 || count == 361 ? count - 1 : count);
    scan.range_min_m = 0.1;
    scan.range_max_m = max_range;
    scan.sigma_m = 0.02;
    scan.range_m = ranges.data();
    const auto begin = std::chrono::steady_clock::now();
    const BeamScan read = read_beams(scan, Span<Beam>(beams.data(), POSE_WALL_PLANAR_BEAMS_MAX));
    const SlamStep step = slam.process(read, &odo);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    sum += ms;
    worst = std::max(worst, ms);
    ++n;
    closures += step.closures;
    keyframes += step.is_keyframe;
    explained += step.explained;
    if (argc > 2 && step.is_keyframe && slam.loops().looked) {
      const Candidate& c = slam.loops().last_candidate;
      std::fprintf(
          stderr,
          "L %d kf %u old %u now %u reach %.1f ex %.2f thr %.2f slide %.1f sec %.2f rms %.3f off %.2f tied %u conf "
          "%.2f %.2f %.1f %.2f\n",
          n, step.keyframe, c.edge.from, c.edge.to, c.reach_m, c.explained, c.seen_through, c.slide_m, c.second,
          c.rms_m,
          (compose(slam.trail().pose(c.edge.from), c.edge.step).place() - slam.trail().pose(c.edge.to).place()).norm(),
          step.closures, slam.loops().last_whole.explained, slam.loops().last_whole.seen_through,
          slam.loops().last_whole.slide_m, slam.loops().last_whole.second);
    }
    if (argc > 2 && (step.explained < 0.85 || argv[2][0] == 0x77))
      std::fprintf(stderr, "E %d %.3f rms %.3f pose %.2f %.2f %.3f\n", n, step.explained, step.rms_m, step.pose.x_m,
                   step.pose.y_m, step.pose.yaw_rad);
    rows.push_back({t, step.keyframe, step.in_keyframe});
  }
  slam.settle();
  if (argc > 2)
    for (const Edge& e : slam.trail().edges())
      if (e.is_closure) {
        const Eigen::Vector3d err = error_of(e, slam.trail().pose(e.from), slam.trail().pose(e.to));
        int a = 0, b = 0;
        for (std::size_t q = 0; q < rows.size(); ++q) {
          if (rows[q].keyframe == e.from && !a) a = (int)q;
          if (rows[q].keyframe == e.to && !b) b = (int)q;
        }
        std::fprintf(stderr, "C %u %u scan %d %d step %.2f %.2f %.3f err %.2f %.2f %.3f chi %.1f\n", e.from, e.to, a, b,
                     e.step.x_m, e.step.y_m, e.step.yaw_rad, err.x(), err.y(), err.z(), err.dot(e.information * err));
      }
  for (const Row& row : rows) {
    const Pose2 p = compose(slam.trail().pose(row.keyframe), row.in);
    std::printf("%.6f %.6f %.6f 0 0 0 %.9f %.9f\n", row.t, p.x_m, p.y_m, std::sin(p.yaw_rad / 2),
                std::cos(p.yaw_rad / 2));
  }
  std::fprintf(stderr,
               "%d scans, %d keyframes, %u closures, %u taken back, explained %.3f, mean %.2f ms, worst %.2f ms, block "
               "%.1f MiB\n",
               n, keyframes, slam.loops().believed(), slam.loops().taken_back(), explained / n, sum / n, worst,
               measure.bytes() / 1048576.0);
}
