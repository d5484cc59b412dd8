// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/runner.hpp"

#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "campaign/event.hpp"
#include "campaign/folder.hpp"
#include "config_file/load_config.hpp"
#include "sim/run_files.hpp"
#include "sim/scenes.hpp"
#include "sim/simulator.hpp"
#include "terminal/counted.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress_bar.hpp"

namespace pose_wall::tools::campaign {
namespace {

// The file first, over it what scene and sensor ask for, over all KEY=VALUE.
api::Config config_for(const sim::Setup& setup, const EngineChoice& choice) {
  std::vector<std::string> settings;
  for (const sim::EngineSetting& s : sim::engine_setting_list(setup)) settings.push_back(s.key + "=" + s.value);
  settings.insert(settings.end(), choice.settings.begin(), choice.settings.end());
  return load_config(choice.config_file, settings).config;
}

Phase phase_of(std::uint32_t frame, const std::optional<Event>& event) {
  if (!event) return Phase::kNone;
  if (frame < event->first) return Phase::kBefore;
  return frame < event->after ? Phase::kEvent : Phase::kAfter;
}

void demand_ok(std::int32_t status, const Run& run) {
  if (status == POSE_WALL_OK) return;
  throw std::runtime_error(fmt::format("scene {}, sensor {}, draw {}: the engine: {}", run.scene, run.sensor, run.draw,
                                       pose_wall_status_text(status)));
}

FrameRecord record_of(const pose_wall_result& result, const TruthRow& truth) {
  FrameRecord record;
  record.stamp_ns = result.stamp_ns;
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = result.quantity[q];
    record.quantity[q] = {truth.value[q], {v.value, v.raw, v.sigma, v.protection_level, v.state}, v.reasons};
  }
  return record;
}

class Workers {
 public:
  Workers(const std::vector<Run>& runs, const Work& work)
      : runs_(runs), work_(work), frames_(frames_of(runs)), bar_(frames_, work.tell_progress && is_terminal(2)) {}

  void run() {
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < work_.jobs; ++i) threads.emplace_back([this] { take_runs(); });
    take_runs();
    for (std::thread& thread : threads) thread.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void take_runs() {
    try {
      api::Engine engine;
      for (std::size_t i = next_++; i < runs_.size() && !failed_; i = next_++) take(runs_[i], engine);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failed_ = true;
      if (!error_) error_ = std::current_exception();
    }
  }

  void take(const Run& run, api::Engine& engine) {
    const std::string note = run.scene + " " + run.sensor;
    const auto on_frame = [this, &note] { count_frame(note); };
    write_record(record_file(work_.folder, run), measure(run, work_.choice, engine, on_frame), work_.campaign);
  }

  void count_frame(const std::string& note) {
    if (InterruptWatch::is_interrupted()) throw Interrupted();
    const std::lock_guard lock(mutex_);
    ++done_;
    bar_.advance(note);
    const bool is_tenth = 10 * done_ / frames_ > 10 * (done_ - 1) / frames_;
    if (is_tenth && work_.tell_progress && !is_terminal(2)) {
      bar_.print_above(fmt::format("{} of {}", done_, counted(frames_, "frame")));
    }
  }

  const std::vector<Run>& runs_;
  const Work& work_;
  const std::size_t frames_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;  // of what follows
  std::size_t done_ = 0;
  ProgressBar bar_;
  std::exception_ptr error_;
};

}  // namespace

RunRecord measure(const Run& run, const EngineChoice& choice, api::Engine& engine,
                  const std::function<void()>& on_frame) {
  const sim::Simulator simulator(sim::make_setup(run.scene, run.sensor, true, run.seed), run.seed);
  const std::optional<Event> event = event_of(simulator.setup());
  demand_ok(engine.open(config_for(simulator.setup(), choice)), run);
  RunRecord record{run, {}};
  for (std::uint32_t i = 0; i < run.frames; ++i) {
    const sim::Frame frame = simulator.render(i);
    pose_wall_cloud cloud;
    constexpr std::uint32_t kPointStep = 4 * sizeof(float);
    demand_ok(pose_wall_cloud_xyz32(&cloud, frame.xyz_intensity.data(), static_cast<std::uint32_t>(frame.count()),
                                    kPointStep, frame.stamp_ns),
              run);
    pose_wall_result result = api::make_result();
    demand_ok(engine.process(cloud, result), run);
    record.frames.push_back(record_of(result, simulator.truth(i)));
    record.frames.back().frame = i;
    record.frames.back().phase = phase_of(i, event);
    on_frame();
  }
  return record;
}

void run_all(const std::vector<Run>& runs, const Work& work) {
  const InterruptWatch watch;
  Workers(runs, work).run();
}

}  // namespace pose_wall::tools::campaign
