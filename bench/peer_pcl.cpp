// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall and PCL on the same frames in the same run, turn by turn, so that both meet the same machine: time, ratio
// and errors.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include "bench_frames.hpp"
#include "peer_pcl_pipeline.hpp"

namespace pose_wall::bench {
namespace {

constexpr std::uint32_t kFrames = 30;
constexpr std::int64_t kPeriod_ns = 100'000'000;
constexpr double kDegPerRad = 57.29577951308232;

struct Contestant {
  std::string name;
  std::vector<double> times_ms;
  std::array<std::vector<double>, 7> errors;

  void add(double time_ms, const std::array<double, 7>& measured, const std::array<double, 7>& truth) {
    times_ms.push_back(time_ms);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (std::isfinite(measured[i])) errors[i].push_back(measured[i] - truth[i]);
    }
  }
};

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return values.empty() ? std::nan("") : std::sqrt(sum / static_cast<double>(values.size()));
}

// RMSE over a range of quantities, in degrees or millimetres.
std::string error_text(const Contestant& contestant, std::size_t first, std::size_t last, bool angles) {
  std::vector<double> all;
  for (std::size_t i = first; i <= last; ++i) {
    all.insert(all.end(), contestant.errors[i].begin(), contestant.errors[i].end());
  }
  return angles ? fmt::format("{:8.3f}°", rms(all) * kDegPerRad) : fmt::format("{:6.1f} mm", rms(all) * 1e3);
}

// Processor time, so that other work on the machine does not count; both sides use one thread.
template <typename Work>
double timed_ms(Work work) {
  const std::clock_t start = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void print_table(const std::vector<Contestant>& contestants) {
  fmt::print("{:12} {:>10} {:>8} {:>16} {:>9} {:>9}\n", "", "median", "ratio", "roll, pitch RMSE", "yaw", "distances");
  const double own_ms = median(contestants.front().times_ms);
  for (const Contestant& one : contestants) {
    fmt::print("{:12} {:7.1f} ms {:8.2f} {:>17} {:>10} {:>9}\n", one.name, median(one.times_ms),
               median(one.times_ms) / own_ms, error_text(one, 0, 1, true), error_text(one, 2, 2, true),
               error_text(one, 3, 6, false));
  }
}

int compare(const std::string& sensor) {
  const auto& recorded = frames(sensor, kFrames);
  const auto& truth = truths(sensor, kFrames);
  const api::Config settings = config(sensor);
  std::array<double, 6> body_box{};
  pose_wall_config_get_box(settings.get(), "body_box_1", body_box.data());
  api::Engine engine;
  if (engine.open(settings) != POSE_WALL_OK) return 1;

  std::vector<Contestant> contestants = {{"pose_wall", {}, {}}, {"PCL RANSAC", {}, {}}, {"PCL MLESAC", {}, {}}};
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    pose_wall_result result = api::make_result();
    const pose_wall_cloud cloud = cloud_of(recorded[i], (i + 1) * kPeriod_ns);
    const double own_ms = timed_ms([&] { engine.process(cloud, result); });
    std::array<double, 7> own{};
    for (std::size_t q = 0; q < own.size(); ++q) own[q] = result.quantity[q].raw;
    contestants[0].add(own_ms, own, truth[i].value);
    for (const std::size_t peer : {std::size_t{1}, std::size_t{2}}) {
      const PclMethod method = peer == 1 ? PclMethod::kRansac : PclMethod::kMlesac;
      PclMeasurement measured{};
      const double ms = timed_ms([&] { measured = measure_with_pcl(recorded[i].xyz_intensity, body_box, method); });
      contestants[peer].add(ms, measured, truth[i].value);
    }
  }
  fmt::print("{} frames of {}, {} points in the last one; processor time per frame; ratio: over pose_wall's\n", kFrames,
             sensor, recorded.back().count());
  print_table(contestants);
  return 0;
}

}  // namespace
}  // namespace pose_wall::bench

int main(int argc, char** argv) {
  return pose_wall::bench::compare(argc > 1 ? argv[1] : "os1-64");
}
