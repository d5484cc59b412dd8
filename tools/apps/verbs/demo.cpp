// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall demo: a simulated roadway, the engine on it, and a picture of how the machine stands.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/demo/demo_run.hpp"
#include "apps/demo/demo_setup.hpp"
#include "apps/demo/live_table.hpp"
#include "apps/options/one_of.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/frame_work.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/config_file/config_place.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_folder.hpp"
#include "io/terminal/colours.hpp"
#include "io/terminal/frames_text.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/results/result_output.hpp"

namespace pose_wall::tools {
namespace {

struct DemoVerb {
  DemoOptions demo;
  std::string output = "out";
  std::uint32_t frames = 100;
  bool quiet = false;
};

constexpr std::uint32_t kRowsShown = 12;

std::string scene_name(const DemoVerb& verb) {
  return verb.demo.scene.empty() ? "heading" : verb.demo.scene;
}

// Processes all frames, or those until Ctrl-C; the last one is returned for the picture.
DemoFrame process_frames(const DemoVerb& verb, DemoRun& run, ResultOutput& output, std::vector<TruthRow>& truth) {
  const LiveTable table(wants_colours(1));
  if (!verb.quiet) fmt::print("{}", table.head());
  const std::uint32_t stride = std::max(1u, verb.frames / kRowsShown);
  DemoFrame frame;
  for (std::uint32_t i = 0; i < verb.frames && !InterruptWatch::is_interrupted(); ++i) {
    frame = run.next();
    truth.push_back(frame.truth);
    if (!output.write(frame.outcome)) throw OutputError(say("{} could not be written to the end", output.name()));
    if (!verb.quiet && (i % stride == 0 || i + 1 == verb.frames)) {
      fmt::print("{}", table.rows(i, frame.time_s, *frame.outcome.result, frame.truth.value, frame.outcome.total_ms));
      std::fflush(stdout);
    }
  }
  if (!verb.quiet) fmt::print("{}\n", table.key());
  return frame;
}

void print_end(const DemoRun& run, const std::filesystem::path& folder) {
  fmt::print("{}\n", run.error_table());
  fmt::print("{}", say("median per frame: engine {:.1f} ms, simulator {:.1f} ms\n", run.median_engine_ms(),
                       run.median_render_ms()));
  fmt::print("{}", say("results: {}, truth: {}\n", (folder / "demo.csv").string(), (folder / "truth.csv").string()));
  fmt::print("{}", say("picture: {}\n", std::filesystem::absolute(folder / "demo.svg").string()));
}

int demo(const DemoVerb& verb) {
  const sim::Setup setup = demo_setup(verb.demo);
  const LoadedConfig loaded = demo_config(verb.demo, setup);
  tell_notes(loaded, verb.quiet);
  DemoRun run(setup, loaded.config, verb.demo.seed);
  make_output_folder(verb.output);
  const std::filesystem::path folder = verb.output;
  ResultOutput output((folder / "demo.csv").string(), {});

  if (!verb.quiet)
    fmt::print("{}", say("Simulated roadway '{}', sensor {}, {}\n\n", scene_name(verb), verb.demo.sensor,
                         frames_text(verb.frames)));
  std::vector<TruthRow> truth;
  const DemoFrame last = process_frames(verb, run, output, truth);
  write_truth_csv(folder / "truth.csv", truth);
  if (truth.empty()) return tell_interrupted(0);
  write_whole_file(folder / "demo.svg",
                   run.picture(last, say("simulated roadway '{}', sensor {}, frame {}, {:.1f} s", scene_name(verb),
                                         verb.demo.sensor, last.outcome.frame, last.time_s)));

  if (truth.size() < verb.frames) return tell_interrupted(truth.size());
  if (!verb.quiet) print_end(run, folder);
  return kExitDone;
}

}  // namespace

void add_demo(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<DemoVerb>();
  CLI::App* verb = app.add_subcommand("demo", tr("Simulate a roadway, measure in it, draw a picture"));
  verb->add_option("--scene", options->demo.scene,
                   tr("Scene of the simulator, see pose_wall sim --list; default: a heading with the machine at work"));
  verb->add_option("--sensor", options->demo.sensor, tr("Sensor model of the simulator, see the same list"))
      ->capture_default_str();
  verb->add_option("-n,--frames", options->frames, tr("Number of frames"))
      ->capture_default_str()
      ->check(whole_number_within(1, 100000));
  verb->add_option("--seed", options->demo.seed, tr("Seed of rock and noise"))
      ->capture_default_str()
      ->check(whole_number());
  verb->add_option("-c,--config", options->demo.config_file,
                   config_help(tr("Settings of the engine, as config/pose_wall.yaml")));
  verb->add_option("-s,--set", options->demo.settings, tr("Setting of the engine, KEY=VALUE; may be repeated"))
      ->allow_extra_args(false);
  verb->add_option("--simulate", options->demo.simulation, tr("Number of the simulator, KEY=VALUE; may be repeated"))
      ->allow_extra_args(false);
  verb->add_option("-o,--output", options->output, tr("Folder for demo.svg, demo.csv and truth.csv"))
      ->capture_default_str();
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors, nothing on stdout"));
  verb->footer(tr("Example:\n  pose_wall demo --sensor os0-128 --frames 200 --output out"));
  verb->callback([options, &exit_code] { exit_code = done_or_complaint("demo", [&] { return demo(*options); }); });
}

}  // namespace pose_wall::tools
