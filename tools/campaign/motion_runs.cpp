// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/motion_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "campaign/folder.hpp"
#include "campaign/motion_classes.hpp"
#include "campaign/record_file.hpp"

namespace pose_wall::tools::campaign {
namespace {

const MotionClass& class_of_run(const Run& run) {
  const MotionClass* const one = find_motion_class(run.scene);
  if (one == nullptr) {
    throw std::runtime_error(fmt::format("a record of the class '{}', which does not exist", run.scene));
  }
  return *one;
}

void copy_point(const sim::Frame& rendered, std::size_t i, bool scan_takes_time, std::byte* to) {
  std::memcpy(to, &rendered.xyz_intensity[4 * i], 4 * sizeof(float));
  if (!scan_takes_time) return;
  std::memcpy(to + 16, &rendered.time_ns[i], sizeof(std::uint32_t));
  std::memcpy(to + 20, &rendered.ring[i], sizeof(std::uint16_t));
}

// Of a file as record_file names it.
auto rank_of(const std::filesystem::path& file) {
  const std::filesystem::path sensor = file.parent_path();
  const MotionClass* const one = find_motion_class(sensor.parent_path().filename().string());
  const std::ptrdiff_t rank = one == nullptr ? -1 : one - motion_classes().data();
  return std::tuple(rank, sensor_rank(sensor.filename().string()), file.filename().string());
}

}  // namespace

Frame motion_frame(const sim::Frame& rendered, bool scan_takes_time) {
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

std::string measure_motion(const Run& run, const EngineChoice& choice, const std::function<void()>& on_frame) {
  const sim::Simulator simulator(make_motion_setup(class_of_run(run), run.sensor, run.seed), run.seed);
  const sim::Sequence& sequence = simulator.setup().sequence;
  const LoadedConfig loaded = config_for(simulator.setup(), choice);
  MotionRunner runner(loaded.config, loaded.motion, sequence.rate_hz);
  std::string table = csv_line(motion_record_head());
  for (std::uint32_t i = 0; i < run.frames; ++i) {
    const sim::Frame rendered = simulator.render(i);
    SourcedFrame sourced;
    sourced.name = fmt::format("{}/{}/{}#{}", run.scene, run.sensor, run.draw, i);
    sourced.stamp_ns = rendered.stamp_ns;
    sourced.frame = motion_frame(rendered, sequence.scan_s > 0.0);
    const MotionOutcome outcome = runner.run(std::move(sourced));
    if (!outcome.result) throw std::runtime_error(fmt::format("{}: motion: {}", outcome.source, outcome.error));
    table += csv_line(motion_record_cells(run, outcome, simulator, i));
    on_frame();
  }
  return table;
}

void run_all_motion(const std::vector<Run>& runs, const Work& work) {
  work_on(runs, work.crew, [&work]() -> RunWork {
    return [&work](const Run& run, const std::function<void()>& on_frame) {
      write_record_file(record_file(work.folder, run), measure_motion(run, work.choice, on_frame), work.campaign);
    };
  });
}

void for_each_motion_record(const std::filesystem::path& folder, const Manifest& manifest,
                            const std::function<void(const MotionRecord&)>& take) {
  std::vector<std::filesystem::path> files = record_files(folder);
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return rank_of(a) < rank_of(b); });
  for (const std::filesystem::path& file : files) {
    std::optional<MotionRecord> record;
    read_record_file(file, manifest.fingerprint(), [&](const CsvTable& table) { record = motion_record_of(table); });
    take(*record);
  }
}

}  // namespace pose_wall::tools::campaign
