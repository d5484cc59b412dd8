// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall sim: frames of a roadway that does not exist, with the truth of each.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/one_of.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/csv/truth_csv.hpp"
#include "io/frames/pcd_writer.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_folder.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/frames_text.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "io/terminal/text_table.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/run_files.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/simulator.hpp"
#include "lab/survey/survey_file.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::uint32_t kSceneFrames = 10;  // a second of most sensors

struct SimOptions {
  std::string scene = "clean";
  std::string surface, path;  // a real road in place of a scene
  std::optional<double> disc_radius_m;
  std::string sensor = "os1-64";
  std::optional<std::uint32_t> frames;  // kSceneFrames of a scene, all poses of a path
  std::optional<double> rate_hz;
  std::uint64_t seed = 1;
  std::vector<std::string> settings;
  bool random = false;
  bool list = false;
  bool quiet = false;
  std::string output;
};

void print_list() {
  TextTable scenes({"scene", "kind", "contents", "right behaviour"});
  for (const sim::SceneChoice& s : sim::scenes()) {
    scenes.add_row({s.name, sim::scene_kind_name(s.kind), s.help, s.expected});
  }
  TextTable sensors({"sensor", "description"});
  for (const std::string& name : sim::sensor_names()) sensors.add_row({name, sim::find_sensor(name)->help});
  TextTable keys({"key", "default", "unit", "allowed", "meaning"});
  sim::Setup defaults;
  for (const sim::Parameter& p : sim::parameters()) {
    const std::string allowed = *p.words != '\0' ? p.words : fmt::format("{:g} to {:g}", p.minimum, p.maximum);
    keys.add_row({p.name, sim::parameter_text(p, p.field(defaults)), p.unit, allowed, p.help});
  }
  fmt::print(
      "{}\n"
      "{}\n"
      "{}\n"
      "Sensor keys default to the chosen sensor's own; shown are those of os1-64.\n",
      scenes.text(5), sensors.text(2), keys.text(5));
}

sim::Setup resolve_setup(const SimOptions& options) {
  sim::Setup setup = sim::make_setup(options.scene, options.sensor, options.random, options.seed);
  if (options.rate_hz) sim::set_parameter(setup, "rate_hz", fmt::format("{}", *options.rate_hz));
  for (const std::string& assignment : options.settings) sim::set_parameter(setup, assignment);
  return setup;
}

// Of a real road: what is of the road, and how the machine stands and drives, is not for setting.
void refuse_keys_of_roads(const SimOptions& options) {
  for (const std::string& assignment : options.settings) {
    const std::string key = assignment.substr(0, assignment.find('='));
    const sim::Parameter* const parameter = sim::find_parameter(key);
    if (parameter == nullptr) continue;  // refused with what may have been meant
    const std::string group = parameter->group;
    constexpr const char* kOfMachine[] = {"forward_axis", "s_front_m", "s_back_m"};
    const bool is_told =
        std::any_of(std::begin(kOfMachine), std::end(kOfMachine), [&](const char* k) { return key == k; });
    const bool is_body = key.rfind("body", 0) == 0 || key.rfind("boom", 0) == 0;
    if (group == "mount" || group == "sensor" || group == "faults" || group == "sequence" || is_told || is_body)
      continue;
    throw std::invalid_argument(fmt::format(
        "--set {}: with --surface the road and the machine's way come from the files; keys of mount, sensor, faults "
        "and "
        "sequence can be set, and of the machine forward_axis, s_front_m, s_back_m and those of body and boom",
        key));
  }
}

// The poses of --path, or those that the tool proposes.
std::vector<sim::Placement> path_of(const SimOptions& options, const SurveyRock& rock) {
  if (options.path.empty()) return propose_survey_path(rock, options.surface);
  std::vector<sim::Placement> path = read_survey_path(options.path);
  const auto stands = [&](const sim::Placement& base) {
    constexpr double kHigh_m = 30.0;  // no base stands higher above its floor
    return rock.rock->trace({base.origin_road, -sim::Vector::UnitZ()}, kHigh_m).label != sim::Label::kNone;
  };
  if (std::none_of(path.begin(), path.end(), stands)) {
    throw std::invalid_argument(
        fmt::format("--path {}: no pose has the surface {} below it; both need one frame, in metres, z up",
                    options.path, options.surface));
  }
  return path;
}

// Where base stands in a real road at each frame.
sim::Survey resolve_survey(SimOptions* options) {
  refuse_keys_of_roads(*options);
  const SurveyRock rock = read_survey_rock(options->surface, options->disc_radius_m);
  sim::Survey survey{rock.rock, path_of(*options, rock)};
  const auto poses = static_cast<std::uint32_t>(survey.path.size());
  if (options->frames && *options->frames > poses) {
    throw std::invalid_argument(fmt::format("--frames {}: {} holds {}", *options->frames,
                                            options->path.empty() ? "the proposed path" : options->path,
                                            counted(poses, "pose")));
  }
  if (!options->frames) options->frames = poses;
  if (!options->quiet) fmt::print(stderr, "{}: {}\n", options->surface, rock.about);
  return survey;
}

// What the folder's settings begin with: the scene, and each size by which it differs from the scene's own, so that it
// can be made again, or a little otherwise.
std::string about_scene(const SimOptions& options, const sim::Setup& setup) {
  const std::string road = options.surface.empty() ? "scene " + options.scene : "surface " + options.surface;
  std::string text = fmt::format("{}, sensor {}, seed {}{}", road, options.sensor, options.seed,
                                 options.random ? ", random sizes" : "");
  sim::Setup of_scene = sim::make_setup(options.scene, options.sensor, false, options.seed), as_is = setup;
  for (const sim::Parameter& p : sim::parameters()) {
    const double value = p.field(as_is);
    if (value == p.field(of_scene)) continue;
    const std::string in_full = *p.words != '\0' ? sim::parameter_text(p, value) : fmt::format("{}", value);
    text += fmt::format("\n#   --set {}={}", p.name, in_full);
  }
  return text;
}

// A longer run into the same folder left frames that this run's truth knows nothing of.
std::uint32_t remove_later_frames(const SimOptions& options, std::uint32_t first) {
  std::uint32_t i = first;
  while (std::filesystem::remove(sim::frame_file(options.output, i))) ++i;
  return i - first;
}

// How many frames there are, and how many of a longer run there were.
struct Written {
  std::uint32_t frames = 0;
  std::uint32_t removed = 0;
};

// Ctrl-C ends it after the frame at work. Those that are there have their truth.
Written write_frames(const SimOptions& options, const sim::Simulator& simulator) {
  const std::uint32_t frames = *options.frames;
  ProgressBar bar(frames, !options.quiet && is_terminal(2));
  std::vector<TruthRow> truth, surveyed;
  std::uint32_t i = 0;
  for (; i < frames && !InterruptWatch::is_interrupted(); ++i) {
    const sim::Frame frame = simulator.render(i);
    const std::filesystem::path file = sim::frame_file(options.output, i);
    if (simulator.setup().sequence.scan_s > 0.0) {
      write_timed_pcd_binary(file, frame.xyz_intensity.data(), frame.time_ns.data(), frame.ring.data(), frame.count(),
                             frame.stamp_ns);
    } else {
      write_pcd_binary(file, frame.xyz_intensity.data(), frame.count(), frame.stamp_ns);
    }
    truth.push_back(simulator.truth(i));
    if (options.surface.empty()) surveyed.push_back(simulator.surveyed_truth(i));
    bar.advance(file.filename().string());
  }
  const std::uint32_t removed = remove_later_frames(options, i);
  const std::filesystem::path folder(options.output);
  write_truth_csv(folder / "truth.csv", truth);
  if (options.surface.empty()) {
    write_truth_csv(folder / "surveyed_truth.csv", surveyed);
  } else {
    std::filesystem::remove(folder / "surveyed_truth.csv");  // of a scene that was here before
  }
  return {i, removed};
}

// Frames and settings that others made are not for overwriting. Those of an earlier run are.
void refuse_folder_of_others(const SimOptions& options) {
  const std::filesystem::path folder(options.output), settings = folder / "pose_wall.yaml", frames = folder / "frames";
  std::error_code ignored;
  const bool has_frames = std::filesystem::is_directory(frames, ignored) && !std::filesystem::is_empty(frames, ignored);
  if (!std::filesystem::exists(settings, ignored) && !has_frames) return;
  std::string first_line;
  std::getline(std::ifstream(settings), first_line);
  if (first_line.rfind("# scene ", 0) == 0 || first_line.rfind("# surface ", 0) == 0) return;
  throw std::invalid_argument(
      say("--output {}: it holds frames or settings that pose_wall sim did not write; choose another folder, it is "
          "created if needed",
          options.output));
}

// Fills in the number of frames, too.
sim::Simulator simulator_of(SimOptions* options) {
  if (options->surface.empty()) {
    if (!options->frames) options->frames = kSceneFrames;
    return sim::Simulator(resolve_setup(*options), options->seed);
  }
  sim::Survey survey = resolve_survey(options);
  return sim::Simulator(resolve_setup(*options), options->seed, std::move(survey));
}

int simulate(SimOptions options) {
  if (options.list) {
    print_list();
    return kExitDone;
  }
  if (options.output.empty()) throw std::invalid_argument(tr("--output FOLDER is needed"));
  const sim::Simulator simulator = simulator_of(&options);
  refuse_folder_of_others(options);
  make_output_folder(options.output);
  std::filesystem::create_directory(std::filesystem::path(options.output) / "frames");
  write_whole_file(std::filesystem::path(options.output) / "pose_wall.yaml",
                   sim::engine_settings(simulator.setup(), about_scene(options, simulator.setup())));
  if (!options.surface.empty() && options.path.empty()) {
    write_whole_file(std::filesystem::path(options.output) / "path.tum", survey_path_text(simulator.survey().path));
  }
  const auto [written, removed] = write_frames(options, simulator);
  if (!options.quiet) fmt::print(stderr, "{}: {}, truth.csv, pose_wall.yaml\n", options.output, frames_text(written));
  if (!options.quiet && removed > 0)
    fmt::print(stderr, "{}", say("{}: {} of an earlier, longer run removed\n", options.output, frames_text(removed)));
  if (written == *options.frames) return kExitDone;
  fmt::print(stderr, "{}",
             say("interrupted: of {} {} were written, with their truth\n", frames_text(*options.frames), written));
  return kExitInterrupted;
}

// A real road in place of a scene.
CLI::Option* add_surface(CLI::App* verb, CLI::Option* scene, SimOptions* options) {
  auto* const surface = verb->add_option(
      "--surface", options->surface,
      tr("A real road in place of a scene: a mesh (PLY, OBJ, glTF), or a cloud with normals (PLY); m, z up"));
  surface->excludes(scene);
  verb->add_option("--path", options->path,
                   tr("With --surface: poses of base in it, `t x y z qx qy qz qw`, a line a frame; default: a way "
                      "along the road's middle, a pose a metre, which --output then holds as path.tum"))
      ->needs(surface);
  verb->add_option(
          "--disc-radius", options->disc_radius_m,
          tr("With --surface, m: each point of a cloud is a disc of this radius; default: twice their spacing"))
      ->needs(surface)
      ->check(CLI::Range(0.001, 5.0));
  return surface;
}

}  // namespace

void add_sim(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<SimOptions>();
  CLI::App* verb = app.add_subcommand("sim", tr("Simulate LiDAR frames of a roadway, with the truth of each"));
  auto* const scene =
      verb->add_option("--scene", options->scene, tr("Scene of the road; see --list"))->capture_default_str();
  verb->add_option("--sensor", options->sensor, tr("Sensor model; see --list"))->capture_default_str();
  CLI::Option* const surface = add_surface(verb, scene, options.get());
  verb->add_option("-n,--frames", options->frames, tr("Number of frames; default: 10, or all poses of --path"))
      ->check(whole_number_within(1, 1000000));
  verb->add_option("-r,--rate", options->rate_hz, tr("Frames per second; the same as --set rate_hz"));
  verb->add_option("--seed", options->seed, tr("Seed of rock, noise and --random; the same seed gives the same bits"))
      ->capture_default_str()
      ->check(whole_number());
  verb->add_option("-s,--set", options->settings, tr("KEY=VALUE over the scene; may be repeated"))
      ->allow_extra_args(false);
  verb->add_flag("--random", options->random, tr("Draw the sizes from the scene's ranges, by the seed"))
      ->excludes(surface);
  verb->add_flag("--list", options->list, tr("Print scenes, sensors and keys"));
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
  verb->add_option("-o,--output", options->output, tr("Folder for frames/*.pcd, truth.csv and pose_wall.yaml"));
  verb->footer(
      tr("Example:\n"
         "  pose_wall sim --scene steel_sets --frames 50 --set speed_mps=0.2 --output /tmp/road\n"
         "  pose_wall run --config /tmp/road/pose_wall.yaml --output out.csv /tmp/road/frames\n"
         "  pose_wall eval out.csv /tmp/road/truth.csv\n"
         "  pose_wall sim --surface gallery.ply --sensor vlp16 --output /tmp/gallery\n"
         "Exit status: 0 done, 1 a file cannot be written, 2 bad usage, 130 interrupted by Ctrl-C: written\n"
         "frames are whole and have their truth."));
  verb->callback([options, &exit_code] { exit_code = done_or_complaint("sim", [&] { return simulate(*options); }); });
}

}  // namespace pose_wall::tools
