// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_planar_stop_cost [FRAMES]: processor time of a frame of the obstacle stop on a drive with an OS1-64, whole
// turns of 65,536 points. Beside each frame a pass that no program can do without (bench/least_pass.hpp), so that the
// load of the machine shows. Clouds come ring by ring, as drivers give them, and column by column.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "cpu_time.hpp"
#include "least_pass.hpp"
#include "planar/encounter/plans.hpp"

namespace {

using pose_wall::bench::cpu_time_ms;
using pose_wall::test::Draw;

constexpr std::uint32_t kRings = 64, kColumns = 1024, kPoints = kRings * kColumns;
constexpr double kFrame_s = 0.1, kSpeed_m_s = 0.9;
constexpr int kWarm = 40;  // frames until the walls have stood for long enough

pose_wall::test::World rough_road() {
  pose_wall::test::World world;
  world.half_width_m = 2.4, world.wall_wave_m = 0.1, world.face_m = 1000.0;
  return world;
}

// Columns of rings become rows of columns.
void turn(std::vector<float>* points) {
  std::vector<float> rows(points->size());
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      std::copy_n(points->begin() + 4 * (column * kRings + ring), 4, rows.begin() + 4 * (ring * kColumns + column));
    }
  }
  points->swap(rows);
}

struct Costs {
  std::vector<double> stop_ms, least_ms;
};

Costs drive(int frames, bool by_ring) {
  const pose_wall::test::World world = rough_road();
  pose_wall::test::Sensor sensor(pose_wall::test::Pattern::os1_64, 2.0, 1.5, 0.0, 0.28, 3.2, kColumns);
  pose_wall::test::StopUnderTest stop;
  stop.open(sensor, pose_wall::test::encounter_settings());
  (void)pose_wall_planar_stop_confirm(stop.get());
  pose_wall::bench::LeastPass least;
  pose_wall::tools::sim::Frame same;
  same.labels.resize(kPoints);
  pose_wall::test::Scan scan;
  Draw draw(1);
  pose_wall_planar_stop_motion motion{};
  motion.struct_size = sizeof(motion);
  motion.given = POSE_WALL_PLANAR_STOP_MEASURED | POSE_WALL_PLANAR_STOP_COMMANDED;
  motion.speed_m_s = motion.command_speed_m_s = kSpeed_m_s;
  Costs costs;
  for (int k = 0; k < kWarm + frames; ++k) {
    scan.take(sensor, world, kSpeed_m_s * kFrame_s * k, 0.0, 0.0, 0.0, 0.0, &draw);
    if (by_ring) turn(&scan.points());
    same.xyz_intensity = scan.points();
    const pose_wall_cloud cloud = scan.cloud(static_cast<std::int64_t>((k + 1) * kFrame_s * 1e9));
    const double least_ms = cpu_time_ms([&] { (void)least.run(same); });
    const double stop_ms = cpu_time_ms([&] {
      if (pose_wall_planar_stop_process(stop.get(), &cloud, &motion, cloud.stamp_ns, &stop.result()) != POSE_WALL_OK) {
        std::abort();
      }
    });
    if (k < kWarm) continue;
    costs.least_ms.push_back(least_ms), costs.stop_ms.push_back(stop_ms);
  }
  return costs;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 200;
  for (const bool by_ring : {true, false}) {
    Costs costs = drive(frames > 0 ? frames : 1, by_ring);
    std::sort(costs.stop_ms.begin(), costs.stop_ms.end());
    std::printf(
        "%u points %s: mean %.3f ms, median %.3f, least %.3f, worst %.3f; the least pass: mean %.3f ms; ratio %.2f\n",
        kPoints, by_ring ? "by ring  " : "by column", mean(costs.stop_ms), costs.stop_ms[costs.stop_ms.size() / 2],
        costs.stop_ms.front(), costs.stop_ms.back(), mean(costs.least_ms), mean(costs.stop_ms) / mean(costs.least_ms));
  }
  return 0;
}
