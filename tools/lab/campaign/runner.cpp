// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/runner.hpp"

#include <fmt/format.h>

#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/config_file/key_table.hpp"
#include "lab/campaign/event.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/campaign/motion_classes.hpp"
#include "lab/campaign/motion_record.hpp"
#include "lab/campaign/record_file.hpp"
#include "lab/campaign/surfaces.hpp"
#include "lab/sim/run_files.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "study/motion/moving_engine.hpp"

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

void copy_point(const sim::Frame& rendered, std::size_t i, bool scan_takes_time, std::byte* to) {
  std::memcpy(to, &rendered.xyz_intensity[4 * i], 4 * sizeof(float));
  if (!scan_takes_time) return;
  std::memcpy(to + 16, &rendered.time_ns[i], sizeof(std::uint32_t));
  std::memcpy(to + 20, &rendered.ring[i], sizeof(std::uint16_t));
}

sim::Simulator simulator_of(const Run& run) {
  if (run.surface.empty()) return {setup_of(run), run.seed};
  return {setup_of(run), run.seed, survey_of(run.surface)};
}

// One run as the table in its file.
using Measure = std::function<std::string(const Run&, const EngineChoice&, const std::function<void()>& on_frame)>;

Measure motion_measure() {
  return [](const Run& run, const EngineChoice& choice, const std::function<void()>& on_frame) {
    return measure_motion(run, choice, {}, on_frame);
  };
}

Measure engine_measure() {
  const auto engine = std::make_shared<MovingEngine>();
  const Instrument instrument = {
      [engine](const LoadedConfig& loaded) { return engine->open(loaded.config, loaded.motion); },
      [engine](const pose_wall_cloud& cloud, pose_wall_result& result) { return engine->process(cloud, result); }};
  return [instrument](const Run& run, const EngineChoice& choice, const std::function<void()>& on_frame) {
    return record_table(measure(run, choice, instrument, on_frame));
  };
}

}  // namespace

Frame rendered_frame(const sim::Frame& rendered, bool scan_takes_time) {
  PointLayout layout;
  layout.count = static_cast<std::uint32_t>(rendered.count());
  layout.point_step = scan_takes_time ? 22 : 16;
  layout.big_endian = host_is_big_endian();
  layout.fields = {{"x", {0, POSE_WALL_FIELD_FLOAT32}},
                   {"y", {4, POSE_WALL_FIELD_FLOAT32}},
                   {"z", {8, POSE_WALL_FIELD_FLOAT32}},
                   {"intensity", {12, POSE_WALL_FIELD_FLOAT32}}};
  if (scan_takes_time) {
    layout.fields.push_back({"t", {16, POSE_WALL_FIELD_UINT32}});
    layout.fields.push_back({"ring", {20, POSE_WALL_FIELD_UINT16}});
  }
  Bytes bytes(rendered.count() * layout.point_step);
  for (std::size_t i = 0; i < rendered.count(); ++i) {
    copy_point(rendered, i, scan_takes_time, bytes.data() + i * layout.point_step);
  }
  return describe_frame(std::move(bytes), layout);
}

std::string measure_motion(const Run& run, const EngineChoice& choice, const MotionLibrary& library,
                           const std::function<void()>& on_frame) {
  const sim::Simulator simulator(make_motion_setup(motion_class_of_record(run.scene), run.sensor, run.seed), run.seed);
  const sim::Sequence& sequence = simulator.setup().sequence;
  const LoadedConfig loaded = config_for(simulator.setup(), choice);
  MotionRunner runner(loaded.config, loaded.motion, sequence.rate_hz, library);
  std::string table = csv_line(motion_record_head());
  for (std::uint32_t i = 0; i < run.frames; ++i) {
    const sim::Frame rendered = simulator.render(i);
    SourcedFrame sourced;
    sourced.name = fmt::format("{}/{}/{}#{}", run.scene, run.sensor, run.draw, i);
    sourced.stamp_ns = rendered.stamp_ns;
    sourced.frame = rendered_frame(rendered, sequence.scan_s > 0.0);
    const MotionOutcome outcome = runner.run(std::move(sourced));
    if (!outcome.result) throw std::runtime_error(fmt::format("{}: motion: {}", outcome.source, outcome.error));
    table += csv_line(motion_record_cells(run, outcome, simulator, i));
    on_frame();
  }
  return table;
}

LoadedConfig config_for(const sim::Setup& setup, const EngineChoice& choice) {
  std::vector<std::string> settings;
  for (const EngineSetting& s : sim::engine_setting_list(setup)) settings.push_back(s.key + "=" + s.value);
  settings.insert(settings.end(), choice.settings.begin(), choice.settings.end());
  return load_config(choice.config_file, settings);
}

RunRecord measure(const Run& run, const EngineChoice& choice, const Instrument& instrument,
                  const std::function<void()>& on_frame) {
  const sim::Simulator simulator = simulator_of(run);
  const std::optional<Event> event = event_of(simulator.setup());
  const LoadedConfig loaded = config_for(simulator.setup(), choice);
  demand_ok(instrument.open(loaded), run);
  // Where values are of what is really there. Of a surface the truth is already.
  const bool by_survey = scene_of(run.scene)->kind == sim::SceneKind::kMine ||
                         (run.surface.empty() && config_text(*loaded.config.get(), "region") == "on");
  RunRecord record{run, {}};
  for (std::uint32_t i = 0; i < frames_of(run); ++i) {
    const sim::Frame rendered = simulator.render(i);
    Frame frame = rendered_frame(rendered, simulator.setup().sequence.scan_s > 0.0);
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
    const Measure table_of = work.motion ? motion_measure() : engine_measure();
    return [&work, table_of](const Run& run, const std::function<void()>& on_frame) {
      write_record_file(record_file(work.folder, run), table_of(run, work.choice, on_frame), work.campaign);
    };
  });
}

}  // namespace pose_wall::tools::campaign
