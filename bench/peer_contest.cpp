// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "peer_contest.hpp"

#include <cmath>
#include <stdexcept>

#include "bench_frames.hpp"
#include "cpu_time.hpp"
#include "least_time.hpp"
#include "peer_pcl_pipeline.hpp"
#include "quantiles.hpp"

namespace pose_wall::bench {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;

using Values = std::array<double, POSE_WALL_QUANTITIES>;

template <typename StageTimes>
Turn turn_of(double total_ms, const StageTimes& stage_ns, const Values& measured, const Values& truth) {
  Turn turn{total_ms, {}, {}};
  for (std::size_t i = 0; i < turn.stage_ms.size(); ++i) turn.stage_ms[i] = static_cast<double>(stage_ns[i]) * 1e-6;
  for (std::size_t i = 0; i < turn.error.size(); ++i) turn.error[i] = measured[i] - truth[i];
  return turn;
}

Turn own_turn(api::Engine* engine, const pose_wall_cloud& cloud, const Values& truth, pose_wall_result* result) {
  std::int32_t status = POSE_WALL_OK;
  const double total_ms = cpu_time_ms([&] { status = engine->process(cloud, *result); });
  if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
  Values measured{};
  for (std::size_t i = 0; i < measured.size(); ++i) measured[i] = result->quantity[i].raw;
  return turn_of(total_ms, result->stage_ns, measured, truth);
}

Turn pcl_turn(const tools::sim::Frame& frame, const PclSettings& settings, PclMethod method, const Values& truth) {
  PclReading reading;
  const double total_ms = cpu_time_ms([&] { reading = measure_with_pcl(frame.xyz_intensity, settings, method); });
  return turn_of(total_ms, reading.stage_ns, reading.value, truth);
}

void run_on_road(std::uint32_t road, Contest* contest) {
  const std::string& sensor = contest->sensor;
  const ContestPlan& plan = contest->plan;
  const Recording recorded = record(sensor, plan.frames, road);
  const api::Config settings = config(sensor, road);
  api::Engine engine;
  if (engine.open(settings) != POSE_WALL_OK) throw std::runtime_error("the engine refused its config");
  engine.set_clock(cpu_clock);
  LeastPass least;
  for (std::uint32_t i = 0; i < plan.frames; ++i) {
    pose_wall_result result = api::make_result();
    const pose_wall_cloud cloud = cloud_of(recorded.frames[i], (i + 1) * kPeriod_ns);
    contest->contestants[0].turns.push_back(own_turn(&engine, cloud, recorded.truths[i].value, &result));
    for (const PclMethod method : {PclMethod::kRansac, PclMethod::kMlesac}) {
      const float radius_m =
          plan.pcl_ground_radius_m > 0.0F ? plan.pcl_ground_radius_m : best_ground_radius_m(sensor, method);
      contest->contestants[method == PclMethod::kRansac ? 1 : 2].turns.push_back(
          pcl_turn(recorded.frames[i], pcl_settings(settings, radius_m), method, recorded.truths[i].value));
    }
    contest->least_ms.push_back(least_time_ms(&least, recorded.frames[i]));
    contest->points.push_back(result.points_in);
    contest->voxels.push_back(result.voxels);
  }
}

template <typename Visit>
void for_each_error(const Contestant& one, std::size_t first, std::size_t last, const Visit& visit) {
  for (const Turn& turn : one.turns) {
    for (std::size_t i = first; i <= last; ++i) {
      if (std::isfinite(turn.error[i])) visit(turn.error[i]);
    }
  }
}

}  // namespace

double Contestant::median_total_ms() const {
  std::vector<double> all;
  for (const Turn& turn : turns) all.push_back(turn.total_ms);
  return median(all);
}

double Contestant::median_stage_ms(std::size_t stage) const {
  std::vector<double> all;
  for (const Turn& turn : turns) all.push_back(turn.stage_ms[stage]);
  return median(all);
}

double Contestant::values_per_frame() const {
  double count = 0.0;
  for (const Turn& turn : turns) {
    for (const double error : turn.error) count += std::isfinite(error) ? 1.0 : 0.0;
  }
  return count / static_cast<double>(turns.size());
}

double Contestant::rmse(std::size_t first, std::size_t last) const {
  double sum = 0.0, count = 0.0;
  for_each_error(*this, first, last, [&](double error) {
    sum += error * error;
    count += 1.0;
  });
  return std::sqrt(sum / count);
}

double Contestant::median_error(std::size_t first, std::size_t last) const {
  std::vector<double> all;
  for_each_error(*this, first, last, [&](double error) { all.push_back(std::fabs(error)); });
  return median(all);
}

Contest hold_contest(const std::string& sensor, const ContestPlan& plan) {
  Contest contest{sensor, plan, {}, {}, {}, {{"pose_wall", {}}, {"PCL RANSAC", {}}, {"PCL MLESAC", {}}}};
  for (std::uint32_t road = 1; road <= plan.roads; ++road) run_on_road(road, &contest);
  return contest;
}

}  // namespace pose_wall::bench
