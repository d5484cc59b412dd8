// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_soak: frames through the runtime for a long time, and whether anything leaked, was lost or was late.
//
// Frames are files: pose_wall sim --scene nominal --sensor os0-128 --frames 8 --output road

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/soak/soak_run.hpp"
#include "io/config_file/load_config.hpp"
#include "io/frames/input_list.hpp"
#include "io/frames/load_frame.hpp"
#include "io/frames/point_position.hpp"
#include "io/terminal/text_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr int kExitFailed = 1, kExitUsage = 2, kExitUnknown = 3;

struct SoakOptions {
  std::vector<std::string> inputs;
  std::string config_file;
  std::vector<std::string> settings;
  std::uint64_t points = 0;
  SoakPlan plan;
};

// Every so many, that at most `most` are left.
SoakPoints points_of(const pose_wall_cloud& cloud, std::uint64_t most) {
  const std::uint64_t count = std::uint64_t{cloud.width} * cloud.height;
  const std::uint64_t step = most > 0 && count > most ? (count + most - 1) / most : 1;
  SoakPoints points;
  for (std::uint64_t i = 0; i < count; i += step) {
    const auto row = static_cast<std::uint32_t>(i / cloud.width), column = static_cast<std::uint32_t>(i % cloud.width);
    const Eigen::Vector3f p = point_position(cloud, row, column).cast<float>();
    points.push_back({p.x(), p.y(), p.z()});
  }
  return points;
}

std::string milliseconds(std::int64_t ns) {
  return fmt::format("{:.3f}", static_cast<double>(ns) * 1e-6);
}

void print_times(const pose_wall_runtime_statistics& s) {
  TextTable table({"ms", "count", "p50", "p99", "p99.9", "worst"});
  const auto row = [&](const std::string& name, const pose_wall_runtime_times& t) {
    table.add_row({name, fmt::format("{}", t.count), milliseconds(t.p50_ns), milliseconds(t.p99_ns),
                   milliseconds(t.p999_ns), milliseconds(t.worst_ns)});
  };
  row("push", s.push);
  row("wait", s.wait);
  row("work", s.work);
  for (std::uint32_t i = 0; i < POSE_WALL_STAGES; ++i) row(fmt::format("  {}", pose_wall_stage_name(i)), s.stage[i]);
  row("latency", s.latency);
  if (s.sink.count > 0) row("sink", s.sink);
  fmt::print("{}", table.text(5));
}

void print_counts(const SoakOutcome& o) {
  const pose_wall_runtime_statistics& s = o.statistics;
  fmt::print("pushed {} = processed {}", s.pushed, s.processed);
  for (std::uint32_t d = 0; d < POSE_WALL_RUNTIME_DROPS; ++d) {
    if (s.dropped[d] > 0) fmt::print(" + {} {}", pose_wall_runtime_drop_name(d), s.dropped[d]);
  }
  fmt::print("; {} looks at the counters, {} of them at work, {} did not add up\n", o.looks, o.looks_at_work,
             o.unbalanced);
  fmt::print("published {}, of them {} silences; thinned {}, at most {}; deepest queue {}\n", s.published, s.silences,
             s.thinned, s.thinning_worst, s.waiting_worst);
  fmt::print("yaw by look: {} valid, {} degraded, {} held, {} invalid, {} refused as stale\n",
             o.states[POSE_WALL_VALID], o.states[POSE_WALL_DEGRADED], o.states[POSE_WALL_HELD],
             o.states[POSE_WALL_INVALID], o.stale);
  if (s.box_written + s.box_lost + s.box_failed > 0) {
    fmt::print("black box: {} written, {} lost, {} failed, {:.1f} MB\n", s.box_written, s.box_lost, s.box_failed,
               static_cast<double>(s.box_bytes_written) * 1e-6);
  }
  const auto kilobytes = [](std::int64_t kb) { return kb > 0 ? fmt::format("{} kB", kb) : std::string("unknown"); };
  fmt::print("block {:.1f} MB; heap calls after start {}; resident {} at a tenth, {} at the end\n",
             static_cast<double>(o.bytes) * 1e-6, o.heap_calls, kilobytes(o.resident_begin_kb),
             kilobytes(o.resident_end_kb));
}

int tell(SoakVerdict verdict) {
  switch (verdict) {
    case SoakVerdict::kGood:
      fmt::print("nothing leaked, nothing lost unaccounted for\n");
      return 0;
    case SoakVerdict::kUnknown:
      fmt::print("UNKNOWN: nothing is wrong of what was looked at, but not everything could be: see above\n");
      return kExitUnknown;
    case SoakVerdict::kFailed:
      break;
  }
  fmt::print("FAILED: see above\n");
  return kExitFailed;
}

int run(SoakOptions* options) {
  const LoadedConfig loaded = load_config(options->config_file, options->settings);
  tell_notes(loaded, false);
  options->plan.config = *loaded.config.get();
  for (const std::filesystem::path& path : collect_inputs(options->inputs).files) {
    options->plan.frames.push_back(points_of(load_frame(path).cloud, options->points));
  }
  if (options->plan.frames.empty()) throw std::runtime_error("no frames");
  const SoakOutcome outcome = soak(options->plan);
  print_counts(outcome);
  print_times(outcome.statistics);
  return tell(outcome.verdict());
}

}  // namespace
}  // namespace pose_wall::tools

int main(int argc, char** argv) {
  pose_wall::tools::SoakOptions options;
  pose_wall::tools::SoakPlan& plan = options.plan;
  CLI::App app("Frames through the runtime for a long time: times, drops, leaks", "pose_wall_soak");
  app.footer(
      "Exit status: 0 nothing is wrong, 1 something is, 2 it could not run, 3 not everything could be looked at");
  app.add_option("INPUT", options.inputs, "Frame files, or folders of them; played forth and back")->required();
  app.add_option("-c,--config", options.config_file, "Settings, as config/pose_wall.yaml");
  app.add_option("-s,--set", options.settings, "KEY=VALUE over the config; may be repeated")->allow_extra_args(false);
  app.add_option("-r,--rate", plan.rate_hz, "Frames per second")->capture_default_str()->check(CLI::Range(0.1, 1e6));
  app.add_option("-t,--seconds", plan.seconds, "How long")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("-a,--accelerated", plan.accelerated, "So many frames as fast as they go, instead");
  app.add_option("--burst", plan.burst, "Frames pushed at once before waiting, when accelerated")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("-p,--points", options.points, "At most so many points of a frame, evenly taken; 0: all");
  app.add_option("--thinning", plan.thinning_max, "The runtime may thin up to this")->capture_default_str();
  app.add_option("--load", plan.load, "Threads that only burn time beside it")->capture_default_str();
  app.add_option("--box", plan.box, "Write a black box into this file, which must be new or empty");
  app.add_option("--box-mb", plan.box_mb, "Its size at most")->capture_default_str();
  try {
    app.parse(argc, argv);
    return pose_wall::tools::run(&options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : pose_wall::tools::kExitUsage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "pose_wall_soak: {}\n", error.what());
    return pose_wall::tools::kExitUsage;
  }
}
