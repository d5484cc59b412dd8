// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frame_run.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "cpu_time.hpp"
#include "least_time.hpp"
#include "quantiles.hpp"

namespace pose_wall::bench {
namespace {

using Counter = benchmark::Counter;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kPeriod_ns = 100'000'000;

std::int64_t steady_ns(void* /*user*/) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

// An engine fed with one frame after the other, round and round.
class Feeder {
 public:
  explicit Feeder(const FrameInput& input) : input_(input) {
    is_open_ = engine_.open(input.config) == POSE_WALL_OK && !input.frames.empty();
    if (is_open_) engine_.set_clock(steady_ns);
    prepare();
  }

  bool is_open() const { return is_open_; }
  const InputFrame& frame() const { return input_.frames[next_]; }
  bool process() { return engine_.process(cloud_, result_) == POSE_WALL_OK; }
  const pose_wall_result& result() const { return result_; }

  void advance() {
    next_ = (next_ + 1) % input_.frames.size();
    prepare();
  }

  // What the first frames cost once, page faults and cold tables, no later one does.
  bool warm_up() {
    for (std::size_t i = 0; i < input_.frames.size(); ++i, advance()) {
      if (!process()) return false;
    }
    return true;
  }

 private:
  void prepare() {
    if (!is_open_) return;
    cloud_ = frame().cloud;
    cloud_.stamp_ns = stamp_ns_ += kPeriod_ns;
    if (!input_.in_sequence) engine_.reset();
  }

  const FrameInput& input_;
  api::Engine engine_;
  bool is_open_ = false;
  std::size_t next_ = 0;
  std::int64_t stamp_ns_ = 0;
  pose_wall_cloud cloud_{};
  pose_wall_result result_ = api::make_result();
};

class Figures {
 public:
  void add(const pose_wall_result& result) {
    points_ += result.points_in;
    voxels_ += result.voxels;
    for (std::size_t i = 0; i < stage_ms_.size(); ++i) stage_ms_[i] += static_cast<double>(result.stage_ns[i]) * 1e-6;
    for (const pose_wall_value& value : result.quantity) measured_ += value.state >= POSE_WALL_DEGRADED ? 1.0 : 0.0;
  }

  void report(benchmark::State& state) const {
    for (std::uint32_t i = 0; i < POSE_WALL_STAGES; ++i) {
      state.counters[std::string("ms_") + pose_wall_stage_name(i)] = Counter(stage_ms_[i], Counter::kAvgIterations);
    }
    state.counters["points"] = Counter(points_, Counter::kAvgIterations);
    state.counters["voxels"] = Counter(voxels_, Counter::kAvgIterations);
    state.counters["points_per_s"] = Counter(points_, Counter::kIsRate);
    // A fast frame that measures nothing is no achievement.
    state.counters["measured_of_7"] = Counter(measured_, Counter::kAvgIterations);
    state.counters["median_ms"] = median(wall_ms);
    state.counters["p99_ms"] = at_share(wall_ms, 0.99);
    state.counters["worst_ms"] = at_share(wall_ms, 1.0);
    state.counters["x_least"] = median(cpu_ms) / median(least_ms);
  }

  // Of each frame.
  std::vector<double> wall_ms, cpu_ms, least_ms;

 private:
  double points_ = 0.0, voxels_ = 0.0, measured_ = 0.0;
  std::array<double, POSE_WALL_STAGES> stage_ms_{};
};

}  // namespace

void run_frames(benchmark::State& state, const FrameInput& input) {
  Feeder feeder(input);
  if (!feeder.is_open()) return state.SkipWithError("no frames, or the engine refused its config");
  if (!feeder.warm_up()) return state.SkipWithError("the engine refused a cloud");
  LeastPass least;
  Figures figures;
  for (auto _ : state) {
    const Clock::time_point start = Clock::now();
    figures.cpu_ms.push_back(cpu_time_ms([&] { feeder.process(); }));
    const std::chrono::duration<double, std::milli> took = Clock::now() - start;
    // Paused rather than timed by hand: then the column "CPU" is the engine's alone, too.
    state.PauseTiming();
    figures.wall_ms.push_back(took.count());
    figures.add(feeder.result());
    figures.least_ms.push_back(least_time_ms(&least, *feeder.frame().packed));
    feeder.advance();
    state.ResumeTiming();
  }
  figures.report(state);
}

}  // namespace pose_wall::bench
