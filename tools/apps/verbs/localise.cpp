// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall localise: a saved map and scans in, the place of each scan out.

#include <fmt/format.h>

#include <cmath>
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
#include "apps/options/pose_word.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/frames/text_cursor.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "io/outputs/output_file.hpp"
#include "io/outputs/output_folder.hpp"
#include "io/planar_files/map_files.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "io/terminal/text_table.hpp"
#include "study/info/wide_text.hpp"
#include "study/planar/localised_picture.hpp"
#include "study/planar/localised_rows.hpp"
#include "study/planar/map_localiser.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/relation_table.hpp"
#include "study/planar/scan_inputs.hpp"
#include "study/planar/true_places.hpp"

namespace pose_wall::tools {
namespace {

struct LocaliseOptions {
  std::string map;
  FrameOptions frames;
  std::string start;       // pose; empty: the place is searched for
  double restart_m = 0.0;  // 0: never
  std::string output;      // folder; empty: none
  std::string poses;       // file; empty: none
  std::string relations;   // file; empty: none
  std::string truth;       // file; empty: none
  bool no_odometry = false;
};

struct LocaliseWork {
  LocalisedWay way;
  std::vector<CandidateRow> candidates;
  std::string poses;  // TUM rows of scans with a pose
  std::size_t unreadable = 0;
  bool used_odometry = false;
};

// Metres of the input: by its odometry, and where two scans in a row have none, by the poses that are found.
class InputTravel {
 public:
  void add(const std::optional<pose_wall_planar_pose>& odometry, const LocalisedRow& row) {
    const Places now{odometry, row.has_pose() ? std::optional<pose_wall_planar_pose>(row.base) : std::nullopt};
    if (now.odometry && last_.odometry) {
      travelled_m_ += distance_m(*last_.odometry, *now.odometry);
    } else if (now.found && last_.found) {
      travelled_m_ += distance_m(*last_.found, *now.found);
    }
    last_ = now;
  }
  double m() const { return travelled_m_; }

 private:
  struct Places {
    std::optional<pose_wall_planar_pose> odometry, found;  // in frames of their own
  };
  Places last_;
  double travelled_m_ = 0.0;
};

// The answer to one scan, and what follows from it.
class PlaceRecorder {
 public:
  PlaceRecorder(const LocaliseOptions& options, TruePlaces* truth, MapLocaliser* localiser, LocaliseWork* work)
      : options_(options), truth_(truth), localiser_(localiser), work_(work) {}

  // Throws PlanarError for a scan that the library refuses.
  void add(const SourcedScan& scan, std::size_t number) {
    const bool is_due = options_.restart_m > 0.0 && travel_.m() - restarted_m_ >= options_.restart_m;
    if (is_due) localiser_->forget();
    const bool with_odometry = scan.odometry && !options_.no_odometry;
    LocalisedRow row = row_of(localiser_->process(scan.view(), with_odometry ? &*scan.odometry : nullptr));
    travel_.add(scan.odometry, row);
    if (is_due) restarted_m_ = travel_.m();
    work_->used_odometry = work_->used_odometry || with_odometry;
    row.scan = number;
    row.time = scan.time;
    row.travel_m = travel_.m();
    row.is_restart = is_due || (work_->way.rows.empty() && options_.start.empty());
    const pose_wall_planar_pose place = combined(row.base, scan.place);
    if (row.has_pose()) work_->poses += tum_line(scan.time, place);
    if (truth_ != nullptr) compare(place, &row);
    note_candidates(number, row);
    work_->way.rows.push_back(row);
    if (scan.odometry) work_->way.odometry.push_back(*scan.odometry);
  }

 private:
  void compare(const pose_wall_planar_pose& place, LocalisedRow* row) {
    const std::optional<pose_wall_planar_pose> truth = truth_->at(row->time);
    if (!truth || !row->has_pose()) return;
    const pose_wall_planar_pose off = seen_from(*truth, place);
    row->error_m = std::hypot(off.x_m, off.y_m);
    row->error_rad = std::abs(off.yaw_rad);
  }

  // Of each search, when it ends.
  void note_candidates(std::size_t number, const LocalisedRow& row) {
    if (row.searches == searches_) return;
    searches_ = row.searches;
    std::size_t rank = 1;
    for (const auto& candidate : localiser_->candidates()) work_->candidates.push_back({number, rank++, candidate});
  }

  const LocaliseOptions& options_;
  TruePlaces* truth_;
  MapLocaliser* localiser_;
  LocaliseWork* work_;
  InputTravel travel_;
  double restarted_m_ = 0.0;
  std::uint32_t searches_ = 0;
};

// Ctrl-C ends it after the scan at work.
void follow_scans(const LocaliseOptions& options, ScanSource& source, PlaceRecorder follower, LocaliseWork* work) {
  ProgressBar bar(source.scans(), !options.frames.quiet && is_terminal(2), translatable("scans"));
  for (std::size_t number = 0; !InterruptWatch::is_interrupted(); ++number) {
    std::optional<SourcedScan> scan = source.next();
    if (!scan) break;
    std::string error = scan->error;
    try {
      if (error.empty()) follower.add(*scan, number);
    } catch (const PlanarError& refused) {
      error = refused.what();
    }
    if (!error.empty()) {
      ++work->unreadable;
      bar.print_above(fmt::format("pose_wall localise: {}: {}", scan->name, error));
    }
    bar.advance(work->way.rows.empty() ? "" : place_state_words(work->way.rows.back().state));
  }
}

std::string table_of(const std::string& title, const std::vector<NamedFigure>& figures) {
  TextTable table({title, ""});
  for (const auto& [name, value] : figures) table.add_row({name, value});
  return table.text();
}

std::string candidate_table(const std::vector<pose_wall_planar_candidate>& candidates) {
  TextTable table({tr("candidates of the last answer"), "x", "y", tr("yaw"), tr("weight"), tr("worse by"), tr("fits"),
                   tr("along the road")});
  std::size_t number = 1;
  for (const pose_wall_planar_candidate& one : candidates) {
    table.add_row({std::to_string(number++), fmt::format("{:.2f} m", one.pose.x_m),
                   fmt::format("{:.2f} m", one.pose.y_m), fmt::format("{:.1f}°", one.pose.yaw_rad * kDegPerRad),
                   fmt::format("{:.0f} %", 100.0 * one.weight), fmt::format("{:.1f} σ", one.worse_by),
                   fmt::format("{:.0f} %", 100.0 * one.fits), fmt::format("± {:.1f} m", one.spread_m)});
  }
  return table.text();
}

std::string last_place_text(const LocalisedRow& row) {
  if (!row.has_pose()) return fmt::format("{}: {}", place_state_words(row.state), place_reason_words(row.reason));
  return say("x {:.2f} m, y {:.2f} m, {:.1f}°, by ± {:.2f} m: {}", row.base.x_m, row.base.y_m,
             row.base.yaw_rad * kDegPerRad, row.position_sigma_m(), place_state_words(row.state));
}

std::string summary_text(const KnownMap& map, const MapLocaliser& localiser, const LocaliseWork& work,
                         const LocaliseFigures& figures) {
  std::vector<NamedFigure> rows = named_figures(figures);
  rows.insert(rows.begin(), {tr("map"), map.trail ? say("{} keyframes, {:.1f} m of travel", map.trail->keyframes(),
                                                        map.trail->travel_m())
                                                  : tr("cells alone")});
  rows.emplace_back(tr("last place"), last_place_text(work.way.rows.back()));
  rows.emplace_back(tr("odometry"), work.used_odometry ? tr("used") : tr("none"));
  rows.emplace_back(tr("processor time a scan, mean"), fmt::format("{:.2f} ms", localiser.mean_ms()));
  rows.emplace_back(tr("processor time a scan, worst"), fmt::format("{:.2f} ms", localiser.worst_ms()));
  rows.emplace_back(tr("memory"), fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(localiser.block_bytes())));
  std::string text = wrapped_table({tr("state"), tr("scans"), tr("share"), tr("mostly because")}, state_table(figures));
  text += "\n" + table_of(tr("localisation"), rows);
  if (!work.way.candidates.empty()) text += "\n" + candidate_table(work.way.candidates);
  return text;
}

std::vector<std::string> hints_of(const LocaliseFigures& figures, const KnownMap& map, const LocaliseWork& work,
                                  const pose_wall_planar_localise_settings& settings) {
  std::vector<std::string> hints;
  const bool is_ambiguous = work.way.rows.back().state == POSE_WALL_PLANAR_LOCALISE_AMBIGUOUS;
  if (is_ambiguous && work.way.candidates.size() == 1) {
    const pose_wall_planar_pose& place = work.way.candidates.front().pose;
    hints.push_back(
        say("one candidate is left, and nothing proves it: {}. If you know that the machine stands there, "
            "go on from it with --start={:.2f},{:.2f},{:.0f}",
            place_reason_words(work.way.rows.back().reason), place.x_m, place.y_m, place.yaw_rad * kDegPerRad));
  }
  if (figures.of_state[POSE_WALL_PLANAR_LOCALISE_AMBIGUOUS] > 0 && settings.map_is_whole == 0 &&
      figures.mostly[POSE_WALL_PLANAR_LOCALISE_AMBIGUOUS] == POSE_WALL_PLANAR_LOCALISE_SMOOTH) {
    hints.push_back(
        tr("smooth walls alone prove no place, for the map may lack one like it. If the machine can only be where the "
           "map is: --set map_is_whole=1"));
  }
  if (!map.trail) {
    hints.push_back(tr("cells hold less of the rock's relief than the trail.pwt of pose_wall map -o"));
  }
  return hints;
}

void write_folder(const LocaliseOptions& options, const KnownMap& map, const LocaliseWork& work) {
  const std::filesystem::path folder = options.output;
  const std::string title = std::filesystem::path(options.frames.inputs.front()).filename().string();
  write_whole_file(folder / "localise.csv", localised_csv(work.way.rows));
  write_whole_file(folder / "candidates.csv", candidates_csv(work.candidates));
  write_whole_file(folder / "localise.svg", localised_picture(map, work.way, title));
}

void print_end(const LocaliseOptions& options, const KnownMap& map, const MapLocaliser& localiser,
               const LocaliseWork& work, const std::vector<Relation>& relations,
               const pose_wall_planar_localise_settings& settings) {
  const LocaliseFigures figures = figures_of(work.way.rows);
  const std::string between = options.frames.quiet ? "" : "\n";
  if (!options.frames.quiet) {
    fmt::print("{}", summary_text(map, localiser, work, figures));
    for (const std::string& hint : hints_of(figures, map, work, settings)) {
      fmt::print(stderr, "pose_wall localise: {}\n", hint);
    }
  }
  if (figures.compared > 0) {
    fmt::print("{}{}", between, table_of(tr("against the truth"), truth_figures(figures)));
  } else if (!options.truth.empty()) {
    fmt::print(stderr, "{}", tr("pose_wall localise: no unique scan has a row in --truth\n"));
  }
  if (!options.relations.empty()) {
    const RelationReport report = judge_relations(parse_tum(work.poses), relations);
    fmt::print("{}{}", between, relation_table(report));
    if (report.all.relations == 0) {
      fmt::print(stderr, "{}",
                 say("pose_wall localise: --relations {}: no relation has the times of two scans with a pose\n",
                     options.relations));
    }
  }
}

// What is written is opened first, so that what cannot be written is known before the work.
std::unique_ptr<OutputFile> open_outputs(const LocaliseOptions& options, const KnownMap& map,
                                         const ScanSource& source) {
  std::vector<std::filesystem::path> read = source.files();
  read.insert(read.end(), map.files.begin(), map.files.end());
  for (const std::string& file : {options.relations, options.truth}) {
    if (!file.empty()) read.emplace_back(file);
  }
  std::unique_ptr<OutputFile> poses;
  if (!options.poses.empty()) poses = std::make_unique<OutputFile>(options.poses, read, "--poses");
  if (!options.output.empty()) make_output_folder(options.output);
  return poses;
}

int exit_status(const LocaliseWork& work, const ScanSource& source) {
  if (InterruptWatch::is_interrupted()) {
    fmt::print(
        stderr, "{}",
        say("interrupted after {} of {} scans; what is written shows these\n", work.way.rows.size(), source.scans()));
    return kExitInterrupted;
  }
  if (work.unreadable > 0 || !source.errors().empty()) return kExitUnreadable;
  return work.way.rows.back().is_unique() ? kExitDone : kExitNotUsable;
}

int localise_scans(LocaliseOptions options) {
  const pose_wall_planar_localise_settings settings = take_localise_settings(&options.frames.settings);
  std::optional<pose_wall_planar_pose> start;
  if (!options.start.empty()) start = pose_of_word(options.start, "--start");
  const std::unique_ptr<ScanSource> source = open_scans(options.frames, names_of(localise_setting_rows()));
  const KnownMap map = read_known_map(options.map);
  if (start && !is_inside(map.cells.grid(), start->x_m, start->y_m)) {  // of another map, or in millimetres
    throw std::invalid_argument(
        say("{} lies outside the map. {}", "--start " + options.start, extent_text(map.cells.grid())));
  }
  std::vector<Relation> relations;
  if (!options.relations.empty()) relations = read_relations(options.relations);
  std::optional<TruePlaces> truth;
  if (!options.truth.empty()) truth.emplace(options.truth);
  const std::unique_ptr<OutputFile> poses = open_outputs(options, map, *source);
  for (const std::string& error : source->errors()) fmt::print(stderr, "pose_wall localise: {}\n", error);
  for (const std::string& note : source->notes()) {
    if (!options.frames.quiet) fmt::print(stderr, "{}\n", note);
  }

  MapLocaliser localiser(map, settings);
  if (start) localiser.place(*start);
  LocaliseWork work;
  follow_scans(options, *source, PlaceRecorder(options, truth ? &*truth : nullptr, &localiser, &work), &work);
  if (work.way.rows.empty()) {
    throw std::runtime_error(InterruptWatch::is_interrupted()
                                 ? tr("interrupted before the first scan")
                                 : tr("no scan could be made of these frames, as told above; nothing is written"));
  }
  if (work.way.odometry.size() != work.way.rows.size()) work.way.odometry.clear();
  work.way.candidates = localiser.candidates();
  if (poses) poses->write(work.poses);
  if (!options.output.empty()) write_folder(options, map, work);
  print_end(options, map, localiser, work, relations, settings);
  return exit_status(work, *source);
}

}  // namespace

void add_localise(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<LocaliseOptions>();
  CLI::App* verb = app.add_subcommand("localise", tr("Find the machine in a saved map, also after a restart"));
  verb->add_option("MAP", options->map,
                   tr("Folder of pose_wall map -o, its trail.pwt, or a map's YAML file (cells hold less)"))
      ->required();
  add_frame_options(verb, &options->frames, kScanInputHelp);
  verb->add_option("--start", options->start,
                   tr("Where base stands at first, to half a metre and 10 degrees: x,y,yaw in m, m, degrees. "
                      "Default: the whole map is searched"))
      ->type_name("X,Y,YAW");
  verb->add_option("--restart", options->restart_m,
                   tr("Forget the place after every so many metres, and find it again: a trial of restarts"))
      ->check(number_within(0.5, 1e6));
  verb->add_flag("--no-odometry", options->no_odometry, tr("Match scans alone, without the odometry of the input"));
  verb->add_option("--poses", options->poses,
                   tr("File for the poses that were found (unique and doubtful): rows t x y z qx qy qz qw of TUM, "
                      "t as in the input"));
  verb->add_option("-o,--output", options->output,
                   tr("Folder for localise.csv (a row a scan), candidates.csv and localise.svg"));
  verb->add_option("--truth", options->truth,
                   tr("True poses, or those of `pose_wall map --poses` from the same input: counts what is unique and "
                      "wrong"))
      ->check(existing_file());
  verb->add_option("--relations", options->relations,
                   tr("File of relations between poses (t1 t2 x y z roll pitch yaw): errors against these"))
      ->check(existing_file());
  const std::string text = tr(
      "Examples:\n"
      "  pose_wall map -o aces --poses aces.tum aces.clf\n"
      "  pose_wall localise aces aces.clf --restart 60 --truth aces.tum -o found -s map_is_whole=1\n"
      "  pose_wall localise map -c road/pose_wall.yaml --start 12,3,90 road/frames\n"
      "INPUT is as for `map`.\n"
      "The answer to a scan is a state, a reason, and a pose only where there is one.\n"
      "  Unique     Every other place of the map is excluded; pose and covariance hold.\n"
      "  Doubtful   A place is tracked, but this scan does not prove it. The covariance says how far it may be off.\n"
      "  Ambiguous  Several places fit, or one that is not certain: the candidates.\n"
      "  Unknown    No place of the map fits.\n"
      "  Searching  The first search since the restart goes on.\n"
      "Smooth walls alone are never unique, for the map may lack a place like this one.\n"
      "--set map_is_whole=1 says that the machine can only be where the map is.\n"
      "localise.csv holds base's pose; --poses that of the scanner for a log, as `map` does.\n"
      "Exit status: 0 done, 1 map or input unreadable or a file not written, 2 bad usage or config,\n"
      "3 the place of the last scan is not unique, 130 interrupted by Ctrl-C: files show the scans so far.");
  verb->footer(text + settings_help(localise_setting_rows()));
  verb->callback(
      [options, &exit_code] { exit_code = done_or_complaint("localise", [&] { return localise_scans(*options); }); });
}

}  // namespace pose_wall::tools
