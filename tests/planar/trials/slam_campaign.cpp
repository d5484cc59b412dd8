// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// SLAM in drawn networks of roads, against their truth: a row a run, and what they come to.
//
//     pose_wall_planar_slam_campaign [--runs N] [--seed S] [--metres M] [--kind all|rock|alike|twin|smooth|steel]
//
// A closure is wrong if the two places are further from what it says than the metres that it may slide, and 0.5 m.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "lab/sim/drive_route.hpp"
#include "pose_wall_planar_slam.h"

namespace {

namespace sim = pose_wall::tools::sim;

enum Kind { kRock, kAlike, kTwin, kSmooth, kSteel, kKinds };
constexpr const char* kNames[kKinds] = {"rock", "alike", "twin", "smooth", "steel"};

struct Options {
  int runs = 20;
  std::uint64_t seed = 1;
  double metres = 500.0;
  int kind = kKinds;  // all
};

sim::NetworkPlan plan_of(int kind, double metres) {
  sim::NetworkPlan plan;
  plan.length_m = 0.6 * metres;
  plan.roads = 3;
  plan.alike = kind != kRock;
  plan.twin_rock = kind == kTwin;
  if (kind == kSmooth || kind == kTwin) plan.lining = kind == kSmooth ? sim::Lining::kSmooth : sim::Lining::kRock;
  if (kind == kSteel) plan.steel_pitch_m = 1.0;
  return plan;
}

struct Outcome {
  double driven_m = 0.0, rmse_m = 0.0, worst_m = 0.0, odometry_m = 0.0;
  std::uint32_t closures = 0, wrong = 0, taken_back = 0, doubtful = 0, scans = 0;
  double mean_ms = 0.0, worst_ms = 0.0;
};

sim::PlanePose step_between(const sim::PlanePose& a, const sim::PlanePose& b) {
  const double c = std::cos(a.yaw_rad), s = std::sin(a.yaw_rad), dx = b.x_m - a.x_m, dy = b.y_m - a.y_m;
  return {c * dx + s * dy, c * dy - s * dx, std::remainder(b.yaw_rad - a.yaw_rad, 2.0 * M_PI)};
}

class Run {
 public:
  Run() {
    pose_wall_planar_slam_settings settings;
    if (pose_wall_planar_slam_settings_init(&settings) != POSE_WALL_OK) std::abort();
    settings.keyframes_most = 8192;
    std::uint64_t bytes = 0;
    if (pose_wall_planar_slam_memory_needed(&settings, &bytes) != POSE_WALL_OK) std::abort();
    block_.reset(std::aligned_alloc(64, (bytes + 63) / 64 * 64));
    if (pose_wall_planar_slam_open(&settings, block_.get(), bytes, &slam_) != POSE_WALL_OK) std::abort();
  }

  Outcome measure(const sim::NetworkRun& run) {
    Outcome out;
    if (pose_wall_planar_slam_clear(slam_) != POSE_WALL_OK) std::abort();
    struct Placed {
      std::uint32_t keyframe;
      pose_wall_planar_pose in_keyframe;
    };
    std::vector<Placed> placed;
    std::vector<std::size_t> scan_of_keyframe;
    for (std::size_t i = 0; i < run.scans(); ++i) {
      const sim::RunStep& at = run.at_scan(i);
      pose_wall_planar_scan scan{};
      scan.struct_size = sizeof(scan);
      scan.beams = static_cast<std::uint32_t>(run.sensor.beams);
      scan.stamp_ns = static_cast<std::int64_t>(at.time_s * 1e9);
      scan.angle_min_rad = run.sensor.angle_min_rad();
      scan.angle_step_rad = run.sensor.angle_step_rad();
      scan.range_min_m = run.sensor.range_min_m;
      scan.range_max_m = run.sensor.range_max_m;
      scan.sigma_m = run.sensor.noise_m;
      scan.range_m = run.ranges_of(i);
      const pose_wall_planar_pose odometry{at.odometry.x_m, at.odometry.y_m, at.odometry.yaw_rad};
      pose_wall_planar_slam_result result{};
      result.struct_size = sizeof(result);
      const auto begin = std::chrono::steady_clock::now();
      if (pose_wall_planar_slam_process(slam_, &scan, &odometry, &result) != POSE_WALL_OK) std::abort();
      const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      out.mean_ms += ms;
      out.worst_ms = std::max(out.worst_ms, ms);
      out.doubtful += result.state >= POSE_WALL_PLANAR_SLAM_DOUBTFUL ? 1 : 0;
      out.taken_back = result.taken_back;
      if (result.is_keyframe != 0) scan_of_keyframe.push_back(i);
      placed.push_back({result.keyframe, result.in_keyframe});
    }
    if (pose_wall_planar_slam_settle(slam_) != POSE_WALL_OK) std::abort();
    out.scans = static_cast<std::uint32_t>(run.scans());
    out.mean_ms /= std::max<double>(1.0, out.scans);
    out.driven_m = run.driven_m;
    judge_closures(run, scan_of_keyframe, &out);
    const sim::PlanePose first = run.at_scan(0).truth, first_odometry = run.at_scan(0).odometry;
    for (std::size_t i = 0; i < run.scans(); ++i) {
      pose_wall_planar_keyframe keyframe{};
      keyframe.struct_size = sizeof(keyframe);
      if (pose_wall_planar_slam_keyframe(slam_, placed[i].keyframe, &keyframe) != POSE_WALL_OK) std::abort();
      const double c = std::cos(keyframe.pose.yaw_rad), s = std::sin(keyframe.pose.yaw_rad);
      const pose_wall_planar_pose& in = placed[i].in_keyframe;
      const double x = keyframe.pose.x_m + c * in.x_m - s * in.y_m, y = keyframe.pose.y_m + s * in.x_m + c * in.y_m;
      const sim::PlanePose truth = step_between(first, run.at_scan(i).truth);
      const sim::PlanePose odometry = step_between(first_odometry, run.at_scan(i).odometry);
      const double error_m = std::hypot(x - truth.x_m, y - truth.y_m);
      out.rmse_m += error_m * error_m;
      out.worst_m = std::max(out.worst_m, error_m);
      out.odometry_m = std::max(out.odometry_m, std::hypot(odometry.x_m - truth.x_m, odometry.y_m - truth.y_m));
    }
    out.rmse_m = std::sqrt(out.rmse_m / std::max<double>(1.0, out.scans));
    return out;
  }

 private:
  void judge_closures(const sim::NetworkRun& run, const std::vector<std::size_t>& scans, Outcome* out) const {
    pose_wall_planar_edge edge{};
    edge.struct_size = sizeof(edge);
    for (std::uint32_t k = 0; pose_wall_planar_slam_edge(slam_, k, &edge) == POSE_WALL_OK; ++k) {
      if (edge.is_closure == 0 || edge.information[0] + edge.information[4] == 0.0) continue;
      ++out->closures;
      const sim::PlanePose truth = step_between(run.at_scan(scans[edge.from]).truth, run.at_scan(scans[edge.to]).truth);
      const double dx = edge.step.x_m - truth.x_m, dy = edge.step.y_m - truth.y_m;
      // What the closure holds across its weak direction, and how far it says it may slide along that.
      const double xx = edge.information[0], xy = edge.information[1], yy = edge.information[4];
      const double least = 0.5 * (xx + yy) - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
      const double slide_m = least > 0.0 ? 1.0 / std::sqrt(least) : 10.0;
      if (std::hypot(dx, dy) > 0.5 + 3.0 * slide_m) ++out->wrong;
    }
  }

  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  std::unique_ptr<void, Free> block_;
  pose_wall_planar_slam* slam_ = nullptr;
};

bool read_options(int argc, char** argv, Options* options) {
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    const char* value = argv[i + 1];
    if (name == "--runs") {
      options->runs = std::atoi(value);
    } else if (name == "--seed") {
      options->seed = std::strtoull(value, nullptr, 10);
    } else if (name == "--metres") {
      options->metres = std::atof(value);
    } else if (name == "--kind") {
      options->kind = static_cast<int>(
          std::find_if(kNames, kNames + kKinds, [&](const char* own) { return std::strcmp(own, value) == 0; }) -
          kNames);
    } else {
      return false;
    }
  }
  return argc % 2 == 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!read_options(argc, argv, &options)) {
    std::fprintf(stderr, "usage: %s [--runs N] [--seed S] [--metres M] [--kind all|rock|alike|twin|smooth|steel]\n",
                 argv[0]);
    return 2;
  }
  Run slam;
  Outcome sum[kKinds];
  int runs[kKinds] = {}, wrong_runs[kKinds] = {};
  std::printf("kind    seed      driven  odometry  slam rmse  worst  closures  wrong  back  doubtful   ms  worst\n");
  for (int i = 0; i < options.runs; ++i) {
    const int kind = options.kind < kKinds ? options.kind : i % kKinds;
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const sim::Network network(plan_of(kind, options.metres), seed);
    const sim::Route route = network.graph().tour(0, options.metres, seed);
    sim::RunSettings settings;
    const sim::NetworkRun run = sim::drive(network, route, settings, seed);
    const Outcome out = slam.measure(run);
    std::printf("%-6s %6llu  %7.0f m  %6.1f m  %7.3f m %5.2f m  %8u %6u %5u  %8u %4.1f %6.1f%s\n", kNames[kind],
                static_cast<unsigned long long>(seed), out.driven_m, out.odometry_m, out.rmse_m, out.worst_m,
                out.closures, out.wrong, out.taken_back, out.doubtful, out.mean_ms, out.worst_ms,
                out.wrong > 0 ? "  WRONG" : "");
    std::fflush(stdout);
    Outcome& of = sum[kind];
    ++runs[kind];
    wrong_runs[kind] += out.wrong > 0 ? 1 : 0;
    of.driven_m += out.driven_m;
    of.rmse_m += out.rmse_m;
    of.worst_m = std::max(of.worst_m, out.worst_m);
    of.closures += out.closures;
    of.wrong += out.wrong;
    of.mean_ms += out.mean_ms;
    of.worst_ms = std::max(of.worst_ms, out.worst_ms);
  }
  std::printf("\nkind     runs  driven km  mean rmse  worst  closures  wrong  runs with wrong ones   ms  worst\n");
  int all_wrong = 0;
  for (int kind = 0; kind < kKinds; ++kind) {
    if (runs[kind] == 0) continue;
    const Outcome& of = sum[kind];
    std::printf("%-6s %6d %10.1f %8.3f m %5.2f m %9u %6u %21d %4.1f %6.1f\n", kNames[kind], runs[kind],
                of.driven_m / 1000.0, of.rmse_m / runs[kind], of.worst_m, of.closures, of.wrong, wrong_runs[kind],
                of.mean_ms / runs[kind], of.worst_ms);
    all_wrong += wrong_runs[kind];
  }
  return all_wrong > 0 ? 1 : 0;
}
