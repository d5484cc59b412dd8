// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/runner.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stdexcept>

#include "campaign/event.hpp"
#include "campaign/folder.hpp"
#include "campaign/motion_runs.hpp"
#include "campaign/surfaces.hpp"
#include "config_file/key_table.hpp"
#include "motion/moving_engine.hpp"
#include "sim/run_files.hpp"
#include "sim/scenes.hpp"
#include "sim/simulator.hpp"

namespace pose_wall::tools::campaign {
namespace {

Phase phase_of(std::uint32_t frame, const Run& run, const std::optional<Event>& event) {
  if (frame < run.drive_in_frames) return Phase::kDriveIn;
  if (frame == 0) return Phase::kFirst;
  if (!event) return Phase::kNone;
  const std::uint32_t of_scene = frame - run.drive_in_frames;
  if (of_scene < event->first) return Phase::kBefore;
  return of_scene < event->after ? Phase::kEvent : Phase::kAfter;
}

void demand_ok(std::int32_t status, const Run& run) {
  if (status == POSE_WALL_OK) return;
  throw std::runtime_error(fmt::format("scene {}, sensor {}, draw {}: the engine: {}", run.scene, run.sensor, run.draw,
                                       pose_wall_status_text(status)));
}

FrameRecord record_of(const pose_wall_result& result, const TruthRow& truth, const TruthRow& surveyed) {
  FrameRecord record;
  record.stamp_ns = result.stamp_ns;
  record.reasons = result.frame_reasons;
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = result.quantity[q];
    record.quantity[q] = {
        truth.value[q], {v.value, v.raw, v.sigma, v.protection_level, v.state}, v.reasons, surveyed.value[q]};
  }
  return record;
}

sim::Simulator simulator_of(const Run& run) {
  if (run.surface.empty()) return {setup_of(run), run.seed};
  return {setup_of(run), run.seed, survey_of(run.surface)};
}

}  // namespace

LoadedConfig config_for(const sim::Setup& setup, const EngineChoice& choice) {
  std::vector<std::string> settings;
  for (const sim::EngineSetting& s : sim::engine_setting_list(setup)) settings.push_back(s.key + "=" + s.value);
  settings.insert(settings.end(), choice.settings.begin(), choice.settings.end());
  return load_config(choice.config_file, settings);
}

RunRecord measure(const Run& run, const EngineChoice& choice, const Instrument& instrument,
                  const std::function<void()>& on_frame) {
  const sim::Simulator simulator = simulator_of(run);
  const std::optional<Event> event = event_of(simulator.setup());
  EngineChoice chosen = choice;
  if (!run.surface.empty()) chosen.settings.insert(chosen.settings.begin(), "region=on");  // as of real rock
  const LoadedConfig loaded = config_for(simulator.setup(), chosen);
  demand_ok(instrument.open(loaded), run);
  // Where values are of what is really there. Of a surface the truth is already.
  const bool by_survey = scene_of(run.scene)->kind == sim::SceneKind::kMine ||
                         (run.surface.empty() && config_text(*loaded.config.get(), "region") == "on");
  RunRecord record{run, {}};
  for (std::uint32_t i = 0; i < frames_of(run); ++i) {
    const sim::Frame rendered = simulator.render(i);
    Frame frame = motion_frame(rendered, simulator.setup().sequence.scan_s > 0.0);
    frame.cloud.stamp_ns = rendered.stamp_ns;
    pose_wall_result result = api::make_result();
    demand_ok(instrument.process(frame.cloud, result), run);
    record.frames.push_back(record_of(result, run.surface.empty() ? simulator.truth(i) : TruthRow{},
                                      by_survey ? simulator.surveyed_truth(i) : TruthRow{}));
    record.frames.back().frame = i;
    record.frames.back().phase = phase_of(i, run, event);
    on_frame();
  }
  return record;
}

void run_all(const std::vector<Run>& runs, const Work& work) {
  work_on(runs, work.crew, [&work]() -> RunWork {
    const auto engine = std::make_shared<MovingEngine>();
    const Instrument instrument = {
        [engine](const LoadedConfig& loaded) { return engine->open(loaded.config, loaded.motion); },
        [engine](const pose_wall_cloud& cloud, pose_wall_result& result) { return engine->process(cloud, result); }};
    return [&work, instrument](const Run& run, const std::function<void()>& on_frame) {
      write_record(record_file(work.folder, run), measure(run, work.choice, instrument, on_frame), work.campaign);
    };
  });
}

}  // namespace pose_wall::tools::campaign
