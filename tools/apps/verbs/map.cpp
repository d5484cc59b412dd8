// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall map: planar scans in, a map and the poses that they were taken from out.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/options/frame_arguments.hpp"
#include "apps/options/one_of.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/outputs/output_file.hpp"
#include "io/outputs/output_folder.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "io/terminal/text_table.hpp"
#include "study/planar/built_map.hpp"
#include "study/planar/map_fit.hpp"
#include "study/planar/map_picture.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/relation_table.hpp"
#include "study/planar/scan_inputs.hpp"
#include "study/planar/scan_trail.hpp"
#include "study/planar/slam_settings.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kMBPerByte = 1e-6;
constexpr std::size_t kKeyframesLeast = 16, kKeyframesMost = 65536;  // of pose_wall_planar_slam_settings

struct MapOptions {
  FrameOptions frames;
  std::string output;     // folder; empty: none
  std::string poses;      // file; empty: none
  std::string relations;  // file; empty: none
  bool no_odometry = false;
  double cell_m = 0.05;
};

struct MapWork {
  ScanTrail trail;
  std::size_t unreadable = 0;
};

// Every scan may become a keyframe, and few do.
pose_wall_planar_slam_settings settings_for(pose_wall_planar_slam_settings settings, std::size_t scans) {
  settings.keyframes_most = static_cast<std::uint32_t>(std::clamp(scans + 1, kKeyframesLeast, kKeyframesMost));
  return settings;
}

// Forty lines of one reason say no more than three.
constexpr std::size_t kToldAlike = 3;

// Ctrl-C ends it after the scan at work.
void add_scans(const MapOptions& options, ScanSource& source, MapWork* work) {
  ProgressBar bar(source.scans(), !options.frames.quiet && is_terminal(2), translatable("scans"));
  std::map<std::string, std::size_t> refused;  // scans, by the reason
  while (!InterruptWatch::is_interrupted()) {
    std::optional<SourcedScan> scan = source.next();
    if (!scan) break;
    const auto refuse = [&](const std::string& why) {
      ++work->unreadable;
      if (++refused[why] > kToldAlike) return;
      bar.print_above(fmt::format("pose_wall map: {}: {}", scan->name, why));
    };
    if (!scan->error.empty()) {
      refuse(scan->error);
      continue;
    }
    const bool with_odometry = scan->odometry && !options.no_odometry;
    try {
      work->trail.add(scan->view(), with_odometry ? &*scan->odometry : nullptr, scan->place, scan->time);
    } catch (const PlanarError& error) {
      refuse(error.what());
    }
    const pose_wall_planar_slam_result& last = work->trail.last();
    bar.advance(say("{} keyframes, {} closures", last.keyframes, last.closures));
  }
  for (const auto& [why, scans] : refused) {
    if (scans > kToldAlike) bar.print_above(say("pose_wall map: {} more: {}", scans - kToldAlike, why));
  }
}

std::string summary_text(const ScanTrail& trail, const BuiltMap& built, bool with_odometry) {
  const MapFit fit = fit_of(trail);
  const pose_wall_planar_slam_result& last = trail.last();
  const MapFile& map = built.map;
  TextTable table({tr("map of scans"), ""});
  table.add_row({tr("scans"), std::to_string(fit.scans)});
  table.add_row({tr("odometry"), with_odometry ? tr("used") : tr("none")});
  table.add_row({tr("keyframes"), std::to_string(last.keyframes)});
  table.add_row({tr("travel"), fmt::format("{:.1f} m", trail.travel_m())});
  table.add_row({tr("loop closures"), std::to_string(last.closures)});
  table.add_row({tr("loop closures taken back"), std::to_string(last.taken_back)});
  table.add_row({tr("scans that fit badly"), part_of_scans(fit.badly, fit.scans)});
  table.add_row({tr("scans with too few points"), part_of_scans(fit.blind, fit.scans)});
  table.add_row({tr("points on surfaces seen before"), fmt::format("{:.1f} %", 100.0 * trail.explained_mean())});
  table.add_row({tr("processor time a scan, mean"), fmt::format("{:.2f} ms", trail.mean_ms())});
  table.add_row({tr("processor time a scan, worst"), fmt::format("{:.2f} ms", trail.worst_ms())});
  table.add_row(
      {tr("memory of the SLAM"), fmt::format("{:.1f} MB", kMBPerByte * static_cast<double>(trail.block_bytes()))});
  table.add_row({tr("size of the map"), say("{:.1f} x {:.1f} m in cells of {:.2f} m", map.width * map.resolution_m,
                                            map.height * map.resolution_m, map.resolution_m)});
  table.add_row(
      {tr("memory of the map"), fmt::format("{:.1f} MB", kMBPerByte * static_cast<double>(built.block_bytes))});
  return say("verdict: {}\n", fit.verdict()) + "\n" + table.text();
}

std::vector<std::string> warnings_of(const MapWork& work, const BuiltMap& built) {
  std::vector<std::string> warnings;
  const MapFit fit = fit_of(work.trail);
  if (work.trail.last().is_full != 0) {
    warnings.push_back(
        say("the trail is full after {} keyframes; later scans changed nothing in the map. A larger "
            "--set keyframe_m takes a longer way",
            work.trail.last().keyframes));
  }
  if (fit.new_trails > 0) {
    warnings.push_back(say("{} scans began a new trail; between them the way is unknown", fit.new_trails));
  }
  if (fit.grade() != MapGrade::kGood) {
    warnings.push_back(
        tr("many scans fit badly: is the sensor's place right, do people fill the view, are scans "
           "missing?"));
  }
  if (built.beams_not_stored > 0) {
    warnings.push_back(
        say("{} beams found no room in the map: its file is not whole. Larger cells: --cell", built.beams_not_stored));
  }
  return warnings;
}

std::string poses_text(const ScanTrail& trail) {
  const std::vector<pose_wall_planar_pose> poses = trail.scan_poses();
  std::string text;
  for (std::size_t k = 0; k < poses.size(); ++k) text += tum_line(trail.scans()[k].time, poses[k]);
  return text;
}

MapScene scene_of(const MapOptions& options, const ScanTrail& trail, const BuiltMap& built) {
  MapScene scene;
  scene.grid = built.map.grid();
  scene.title = std::filesystem::path(options.frames.inputs.front()).filename().string();
  scene.subtitle = say("{} scans, {:.1f} m of travel, {} keyframes, {} closures", trail.scans().size(),
                       trail.travel_m(), trail.last().keyframes, trail.last().closures);
  const MapFit fit = fit_of(trail);
  if (fit.grade() != MapGrade::kGood) scene.warning = fit.verdict();
  const std::vector<pose_wall_planar_pose> keyframes = trail.keyframe_poses();
  const auto place = [&keyframes](std::uint32_t k) { return MapPlace{keyframes.at(k).x_m, keyframes.at(k).y_m}; };
  MapLine way{{}, kTrailColour, 1.6};
  for (std::uint32_t k = 0; k < keyframes.size(); ++k) way.places.push_back(place(k));
  scene.lines.push_back(way);
  for (const Closure& closure : trail.closures()) {
    scene.lines.push_back({{place(closure.from), place(closure.to)}, kClosureColour, 1.2});
  }
  if (!keyframes.empty()) {
    scene.machines.push_back({keyframes.front(), {}, kPathColour, tr("start")});
    scene.machines.push_back({keyframes.back(), {}, kBadColour, tr("end")});
  }
  scene.legend = {{kTrailColour, tr("trail")}, {kClosureColour, tr("closures")}};
  return scene;
}

void write_folder(const MapOptions& options, const ScanTrail& trail, const BuiltMap& built) {
  const std::filesystem::path folder = options.output;
  write_map_files(folder / "map.yaml", built.map.grid());
  write_whole_file(folder / "map.svg", map_picture(scene_of(options, trail, built)));
  write_lasting_file(folder / "trail.pwt", trail.saved());
  write_fit(folder, fit_of(trail));
}

RelationReport relations_of(const ScanTrail& trail, const std::vector<Relation>& relations) {
  return judge_relations(parse_tum(poses_text(trail)), relations);
}

std::vector<Relation> read_relations_of(const MapOptions& options) {
  return options.relations.empty() ? std::vector<Relation>{} : read_relations(options.relations);
}

// Opens the file of the poses and makes the folder, so that what cannot be written is known before the work.
std::unique_ptr<OutputFile> open_outputs(const MapOptions& options, const ScanSource& source) {
  std::vector<std::filesystem::path> read = source.files();
  if (!options.relations.empty()) read.emplace_back(options.relations);
  std::unique_ptr<OutputFile> poses;
  if (!options.poses.empty()) poses = std::make_unique<OutputFile>(options.poses, read, "--poses");
  if (!options.output.empty()) make_output_folder(options.output);
  return poses;
}

void print_start(const MapOptions& options, const ScanSource& source) {
  for (const std::string& error : source.errors()) fmt::print(stderr, "pose_wall map: {}\n", error);
  if (options.frames.quiet) return;
  for (const std::string& note : source.notes()) fmt::print(stderr, "{}\n", note);
}

// False: no relation is of these scans.
bool print_end(const MapOptions& options, const MapWork& work, const BuiltMap& built, const ScanSource& source,
               const std::vector<Relation>& relations) {
  if (!options.frames.quiet) {
    fmt::print("{}", summary_text(work.trail, built, !options.no_odometry && source.has_odometry()));
    for (const std::string& warning : warnings_of(work, built)) fmt::print(stderr, "pose_wall map: {}\n", warning);
  }
  if (options.relations.empty()) return true;
  const RelationReport report = relations_of(work.trail, relations);
  fmt::print("{}{}", options.frames.quiet ? "" : "\n", relation_table(report));
  if (report.all.relations > 0) return true;
  fmt::print(stderr, "{}",
             say("pose_wall map: --relations {}: no relation has the times of two scans. Are these of another log?\n",
                 options.relations));
  return false;
}

int map_scans(MapOptions options) {
  const pose_wall_planar_slam_settings settings = take_slam_settings(&options.frames.settings);
  const std::unique_ptr<ScanSource> source = open_scans(options.frames, names_of(slam_setting_rows()));
  const std::vector<Relation> relations = read_relations_of(options);
  const std::unique_ptr<OutputFile> poses = open_outputs(options, *source);
  print_start(options, *source);

  MapWork work{ScanTrail(settings_for(settings, source->scans()))};
  add_scans(options, *source, &work);
  if (work.trail.scans().empty()) {
    throw std::runtime_error(InterruptWatch::is_interrupted()
                                 ? tr("interrupted before the first scan")
                                 : tr("no scan could be made of these frames, as told above; nothing is written"));
  }
  work.trail.settle();
  const BuiltMap built = build_map(work.trail.kept_scans(), work.trail.kept_poses(), options.cell_m);
  if (poses) poses->write(poses_text(work.trail));
  if (!options.output.empty()) write_folder(options, work.trail, built);
  const bool are_judged = print_end(options, work, built, *source, relations);
  if (InterruptWatch::is_interrupted()) {
    fmt::print(stderr, "{}",
               say("interrupted after {} of {} scans; what is written shows these\n", work.trail.scans().size(),
                   source->scans()));
    return kExitInterrupted;
  }
  if (!source->errors().empty() || work.unreadable > 0 || !are_judged) return kExitUnreadable;
  return fit_of(work.trail).grade() == MapGrade::kNotUsable ? kExitNotUsable : kExitDone;
}

}  // namespace

void add_map(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* verb = app.add_subcommand("map", tr("Make a map of planar scans, with the pose of every scan"));
  add_frame_options(verb, &options->frames, kScanInputHelp);
  verb->add_option("-o,--output", options->output,
                   tr("Folder for map.pgm and map.yaml (as Nav2 and map_server read them), map.svg (map, trail, "
                      "closures) and trail.pwt (the graph)"));
  verb->add_option("--poses", options->poses,
                   tr("File for the final pose of every scan in TUM format: rows `t x y z qx qy qz qw`, t as the input "
                      "writes it"));
  verb->add_option(
          "--relations", options->relations,
          tr("True relations between poses (`t1 t2 x y z roll pitch yaw`): the errors against them are printed"))
      ->check(existing_file());
  verb->add_flag("--no-odometry", options->no_odometry, tr("Leave out the odometry of a log"));
  verb->add_option("--cell", options->cell_m, tr("Side of a cell of the map, m"))
      ->capture_default_str()
      ->check(number_within(0.02, 0.5));
  const std::string text = tr(
      "Examples:\n"
      "  pose_wall map aces.clf.gz -o aces --poses aces.tum --relations aces.relations\n"
      "  pose_wall map -c road/pose_wall.yaml -o map road/frames\n"
      "One log of CARMEN alone, or frames. Of frames, each becomes a planar scan about the measured floor.\n"
      "The pose of a log's scan is that of its scanner, as FLASER has it, else that of base.\n"
      "Every scan is matched with the last metres. Where the machine comes back to a place, the closure is believed\n"
      "after several looks agree, and taken back where later looks contradict it.\n"
      "Of frames, --set also takes what `scan` takes.\n"
      "The folder of -o is the MAP of `localise` and `plan`, and `report` shows it.\n"
      "Exit status: 0 done, 1 an input could not be read (the others are mapped), a file not written, or no relation\n"
      "is of these scans, 2 bad usage or config, 3 most scans fit badly (the files show it), 130 interrupted by "
      "Ctrl-C:\n"
      "files show the scans so far.");
  verb->footer(text + settings_help(slam_setting_rows()));
  verb->callback([options, &exit_code] { exit_code = done_or_complaint("map", [&] { return map_scans(*options); }); });
}

}  // namespace pose_wall::tools
