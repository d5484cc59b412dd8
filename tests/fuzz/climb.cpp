// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Searches for halls whose frames cost most, by steps: halls drawn at random, and from the dearest of them uphill, one
// number or a few at a time. The same numbers give the same search. Prints each hall that costs more than all before,
// as roads of as many points, in the words of support/dear_clouds.hpp; at the end the bounds of sensors.
//
//   pose_wall_climb [SEED [HALLS [POINTS]]]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "fuzz/fuzz_target.hpp"
#include "support/dear_clouds.hpp"
#include "support/work_bound.hpp"

namespace pose_wall::test {
namespace {

// The first frame finds all anew, the second has what is remembered, the third tells what a steady frame costs.
constexpr int kFrames = 3;

struct Costs {
  std::uint64_t most = 0, settled = 0;
  bool limited = false;
};

Costs costs_of(DearCloud* cloud) {
  static KeptBlock block;
  pose_wall_config config;
  pose_wall_config_init(&config);
  pose_wall_engine* const engine = open_engine(config, &block, 0xA5);
  Costs costs;
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame > 0) cloud->nudge();
    pose_wall_result result = empty_result();
    const pose_wall_cloud described = cloud->at(1 + 100'000'000LL * frame);
    require_ok(pose_wall_process(engine, &described, &result), "process");
    costs.most = std::max<std::uint64_t>(costs.most, result.work);
    costs.settled = result.work;
    costs.limited = costs.limited || (result.frame_reasons & POSE_WALL_R_WORK_LIMIT) != 0;
  }
  return costs;
}

Costs costs_of(const Hall& hall, std::uint32_t points, DearCloud* cloud) {
  cloud->clear();
  hall.fill(points, cloud);
  return costs_of(cloud);
}

Hall changed(const Hall& hall, PlainRandom* random) {
  Hall out = hall;
  const int numbers = 1 + static_cast<int>(3 * random->uniform());
  for (int k = 0; k < numbers; ++k) {
    double& number = out.v[static_cast<std::size_t>(Hall::kNumbers * random->uniform())];
    number = std::min(1.0, std::max(0.0, number + 0.2 * random->normal()));
  }
  return out;
}

void print(const Hall& hall, const Costs& costs, const Costs& road) {
  std::printf("%.3f roads, %llu steps%s: {{", static_cast<double>(costs.most) / static_cast<double>(road.most),
              static_cast<unsigned long long>(costs.most), costs.limited ? ", limited" : "");
  for (const double number : hall.v) std::printf("%.4f, ", number);
  std::printf("}, %u}\n", hall.seed);
  std::fflush(stdout);
}

void print_bounds() {
  struct Sensor {
    const char* name;
    std::uint32_t points;
  };
  pose_wall_config config;
  pose_wall_config_init(&config);
  for (const Sensor& sensor : {Sensor{"vlp16", 28800}, {"mid360", 20000}, {"os1-64", 65536}, {"os0-128", 131072}}) {
    std::printf("%s, %u points: no frame takes more than %llu steps\n", sensor.name, sensor.points,
                static_cast<unsigned long long>(most_of_a_frame(read_settings(config), sensor.points)));
  }
}

int climb(std::uint32_t seed, std::uint32_t halls, std::uint32_t points) {
  auto cloud = std::make_unique<DearCloud>();
  fill_road(points, cloud.get());
  const Costs road = costs_of(cloud.get());
  std::printf("a road of %u points: %llu steps\n", cloud->size(), static_cast<unsigned long long>(road.most));
  PlainRandom random(seed);
  Hall dearest = Hall::drawn(seed);
  Costs most = costs_of(dearest, points, cloud.get());
  std::uint32_t limited = 0;
  for (std::uint32_t k = 1; k < halls; ++k) {
    const Hall hall = k < halls / 3 ? Hall::drawn(seed + k) : changed(dearest, &random);
    const Costs costs = costs_of(hall, points, cloud.get());
    limited += costs.limited ? 1U : 0U;
    if (costs.most <= most.most) continue;
    most = costs;
    dearest = hall;
    print(dearest, most, road);
  }
  std::printf("%u of %u halls met the limit\n", limited, halls);
  print_bounds();
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace pose_wall::test

int main(int argc, char** argv) {
  const auto number = [&](int i, std::uint32_t otherwise) {
    return argc > i ? static_cast<std::uint32_t>(std::strtoul(argv[i], nullptr, 10)) : otherwise;
  };
  return pose_wall::test::climb(number(1, 1), number(2, 300), number(3, 65536));
}
