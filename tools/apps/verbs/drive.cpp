// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall drive: the machine follows its own map in the simulator, people step in, walls are lost.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/one_of.hpp"
#include "apps/options/pose_word.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_folder.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "lab/drive/drive_files.hpp"
#include "lab/drive/drive_run.hpp"
#include "lab/sim/network_kinds.hpp"

namespace pose_wall::tools {
namespace {

struct DriveOptions {
  std::uint64_t seed = 1;
  std::string network = "rock", sensor = "mid360";
  int people = 3;
  std::string goal;    // empty: where the map begins
  std::string output;  // folder; empty: none
  bool people_stay = false;
  bool no_lost_wall = false;
  bool quiet = false;
};

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const sim::NetworkKind& kind : sim::network_kinds()) names.emplace_back(kind.name);
  return names;
}

DriveRunSettings settings_of(const DriveOptions& options) {
  DriveRunSettings settings;
  settings.seed = options.seed;
  settings.people = options.people;
  settings.people_stay = options.people_stay;
  settings.loses_walls = !options.no_lost_wall;
  if (!options.goal.empty()) settings.goal = pose_of_word(options.goal, "--goal");
  return settings;
}

// A bar of a hundred steps for a share that grows.
class ShareBar {
 public:
  explicit ShareBar(bool enabled) : bar_(kSteps, enabled, translatable("per cent")) {}
  void show(double share, const std::string& note) {
    for (; shown_ < kSteps && static_cast<double>(shown_) < share * kSteps; ++shown_) bar_.advance(note);
  }

 private:
  static constexpr std::size_t kSteps = 100;
  ProgressBar bar_;
  std::size_t shown_ = 0;
};

DriveEnd run_drive(DriveRun* drive, bool is_shown) {
  ShareBar bar(is_shown);
  double whole_m = 0.0;
  return drive->run([&](const DriveFrame& frame) {
    if (whole_m <= 0.0 && !drive->first_route().poses.empty()) whole_m = drive->first_route().result.length_m;
    const double left_m = std::hypot(frame.truth.x_m - drive->goal().x_m, frame.truth.y_m - drive->goal().y_m);
    if (whole_m > 0.0) bar.show(1.0 - left_m / whole_m, pilot_phase_text(frame.phase));
    return !InterruptWatch::is_interrupted();
  });
}

void write_drive(const DriveOptions& options, const DriveRun& drive, const DriveEnd& end, const TaughtRoads& roads) {
  const std::filesystem::path folder = options.output;
  const std::string title = say("drive, seed {}, network {}, sensor {}", options.seed, options.network, options.sensor);
  write_whole_file(folder / "drive.csv", drive_as_csv(drive.frames()));
  write_whole_file(folder / "drive.svg", drive_picture(drive, end, roads, title));
  write_map_files(folder / "map.yaml", roads.map.grid());
  write_whole_file(folder / "trail.pwt", roads.trail);
}

int drive_through(const DriveOptions& options) {
  const DriveRunSettings settings = settings_of(options);
  if (!options.output.empty()) make_output_folder(options.output);
  const sim::SensorModel& model = drive_sensor(options.sensor);
  const sim::Network network(sim::find_network_kind(options.network)->plan, options.seed);
  const bool is_shown = !options.quiet && is_terminal(2);
  TaughtRoads roads;
  {
    ShareBar bar(is_shown);
    roads = teach_roads(network, model, options.seed, [&bar](double share) {
      bar.show(share, tr("teaching drive"));
      return !InterruptWatch::is_interrupted();
    });
  }
  if (InterruptWatch::is_interrupted()) {
    fmt::print(stderr, "{}", tr("interrupted on the teaching drive; nothing is written\n"));
    return kExitInterrupted;
  }
  DriveRun drive(network, model, roads, settings);
  const DriveEnd end = run_drive(&drive, is_shown);
  if (!options.output.empty()) write_drive(options, drive, end, roads);
  if (!options.quiet) fmt::print("{}", drive_table(drive, end, roads));
  if (InterruptWatch::is_interrupted()) return kExitInterrupted;
  if (!end.has_arrived) fmt::print(stderr, "{}", say("pose_wall drive: the goal was not reached: {}\n", end.reason));
  if (end.contacts > 0) {
    fmt::print(stderr, "{}", say("pose_wall drive: the machine touched something {} times\n", end.contacts));
  }
  return end.has_arrived && end.contacts == 0 ? kExitDone : kExitNotUsable;
}

}  // namespace

void add_drive(CLI::App& app, int& exit_code) {
  constexpr std::uint64_t kPeopleMost = 20;
  const auto options = std::make_shared<DriveOptions>();
  CLI::App* verb =
      app.add_subcommand("drive", tr("Let a simulated machine follow its own map past people and lost walls"));
  verb->add_option("--seed", options->seed, tr("Of everything that is drawn; the same seed gives the same drive"))
      ->capture_default_str()
      ->check(whole_number());
  verb->add_option("--network", options->network, tr("Kind of the roads"))
      ->capture_default_str()
      ->check(one_of(kind_names()));
  verb->add_option("--sensor", options->sensor, tr("LiDAR on the machine's mast"))
      ->capture_default_str()
      ->check(one_of(drive_sensors()));
  verb->add_option("--people", options->people, tr("People who step into the way"))
      ->capture_default_str()
      ->check(whole_number_within(0, kPeopleMost));
  verb->add_flag("--people-stay", options->people_stay, tr("They stay there"));
  verb->add_option("--goal", options->goal,
                   tr("Goal in the map: x,y,yaw; m, m, degrees. Without it: where the map begins, facing either way"))
      ->type_name("X,Y,YAW");
  verb->add_flag("--no-lost-wall", options->no_lost_wall, tr("The sensor loses nothing"));
  verb->add_option("-o,--output", options->output,
                   tr("Folder for drive.csv (one row a frame), drive.svg (map, route, way driven, people, stops), "
                      "map.yaml, map.pgm and trail.pwt"));
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
  verb->footer(tr(
      "Examples:\n"
      "  pose_wall drive --seed 2 -o story\n"
      "  pose_wall drive --network twin --people 0 --no-lost-wall\n"
      "1. A driver takes the machine through the roads. SLAM makes the map.\n"
      "2. The machine is restarted somewhere. It looks for its place. Until the place is unique it creeps along the\n"
      "   road by its scan alone.\n"
      "3. It plans a route to the goal and follows it. People step into its way. For some seconds the returns of a\n"
      "   wall, most returns, or all returns are lost.\n"
      "4. Where the stop holds it for 15 s it goes back some metres, if another way leads on from there; else it "
      "waits.\n"
      "Each command passes the obstacle stop, which reads the raw cloud. All poses are in the map.\n"
      "Networks: rock; alike (two roads of one shape); twin (and of the same rock); smooth; steel; corridor.\n"
      "A sensor that does not see the floor round the machine is blind there: the stop then holds the machine.\n"
      "Exit status: 0 the goal was reached without a contact, 1 a file was not written, 2 bad usage,\n"
      "3 the goal was not reached (stderr has the reason) or something was touched, 130 interrupted by Ctrl-C."));
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("drive", [&] { return drive_through(*options); }); });
}

}  // namespace pose_wall::tools
