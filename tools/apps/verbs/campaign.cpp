// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall campaign: scenes, sensors and random draws through the engine, and the integrity card of all of them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "apps/options/one_of.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/config_file/config_place.hpp"
#include "io/config_file/load_config.hpp"
#include "io/csv/csv_table.hpp"
#include "io/outputs/output_folder.hpp"
#include "io/terminal/counted.hpp"
#include "io/terminal/interrupt.hpp"
#include "lab/campaign/ablation.hpp"
#include "lab/campaign/card.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/campaign/gate.hpp"
#include "lab/campaign/manifest.hpp"
#include "lab/campaign/merge.hpp"
#include "lab/campaign/motion_card.hpp"
#include "lab/campaign/motion_record.hpp"
#include "lab/campaign/motion_trials.hpp"
#include "lab/campaign/part.hpp"
#include "lab/campaign/plan.hpp"
#include "lab/campaign/runner.hpp"
#include "lab/campaign/sweep.hpp"

namespace pose_wall::tools {
namespace {

constexpr int kExitGate = 3;

struct CampaignOptions {
  campaign::PlanRequest plan;
  campaign::EngineChoice engine;
  std::string output;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::size_t events = 30;
  std::string part;                // NUMBER/PARTS, or none
  std::vector<std::string> merge;  // folders of parts
  std::string scans;               // or none
  bool list = false;
  bool fresh = false;
  bool card_only = false;
  bool gate = false;
  bool quiet = false;
  std::string sweep;   // GATE=A,B,...
  std::string ablate;  // each, or GATE,GATE,...
  bool json = false;
};

// Of gates, and leaves no folder.
bool prints_table(const CampaignOptions& options) {
  return !options.sweep.empty() || !options.ablate.empty();
}

// Before any work: in the midst of thousands of runs a mistyped key would come late. Throws ConfigError.
void check_settings(const campaign::EngineChoice& engine, bool quiet) {
  std::error_code ignored;
  for (const ConfigPlace& place : find_configs(engine.config_file)) {
    if (!std::filesystem::exists(place.file, ignored) || std::filesystem::is_regular_file(place.file, ignored))
      continue;
    throw std::invalid_argument(fmt::format(
        "--config {}: not a regular file; every run reads it again, and a pipe can be read only once", place.file));
  }
  tell_notes(load_config(engine.config_file, engine.settings), quiet);
}

// Those of the plan, or of the part.
std::vector<campaign::Run> runs_of(const CampaignOptions& options) {
  const std::vector<campaign::Run> runs = campaign::make_plan(options.plan);
  return options.part.empty() ? runs : campaign::runs_of_part(runs, campaign::parse_part(options.part));
}

campaign::Manifest manifest_of(const CampaignOptions& options, const std::vector<campaign::Run>& runs) {
  campaign::Manifest manifest =
      campaign::make_manifest(options.plan, campaign::make_plan(options.plan), options.engine);
  if (options.part.empty()) return manifest;
  manifest.part = campaign::parse_part(options.part);
  manifest.part_runs = runs.size();
  return manifest;
}

campaign::Manifest run_campaign(const CampaignOptions& options) {
  check_settings(options.engine, options.quiet);
  const std::vector<campaign::Run> runs = runs_of(options);
  campaign::Manifest manifest = manifest_of(options, runs);
  make_output_folder(options.output);
  campaign::prepare_folder(options.output, manifest, options.fresh);
  const std::vector<campaign::Run> pending = campaign::pending_runs(options.output, runs);
  if (!options.quiet) {
    fmt::print(stderr, "{}, {}; done already: {}\n", counted(runs.size(), "run"),
               counted(campaign::frames_of(runs), "frame"), counted(runs.size() - pending.size(), "run"));
  }
  campaign::run_all(
      pending,
      {options.plan.motion, options.output, options.engine, manifest.fingerprint(), {options.jobs, !options.quiet}});
  return manifest;
}

int pass_gate(const std::vector<std::string>& faults) {
  for (const std::string& fault : faults) fmt::print(stderr, "gate: {}\n", fault);
  return faults.empty() ? kExitDone : kExitGate;
}

template <typename AnyCard>
int tell_card(const CampaignOptions& options, const AnyCard& card) {
  campaign::write_card(options.output, card);
  if (!options.quiet) fmt::print("{}\n{}/card.md\n", campaign::card_summary(card), options.output);
  return options.gate ? pass_gate(campaign::gate_faults(card)) : kExitDone;
}

int make_motion_card(const CampaignOptions& options, const campaign::Manifest& manifest) {
  campaign::MotionCard card{manifest, 0, {}, {}};
  campaign::for_each_record(options.output, manifest,
                            [&card](const CsvTable& table) { card.add(campaign::motion_record_of(table)); });
  campaign::keep_worst(options.events, &card.events);
  return tell_card(options, card);
}

// A card of a part would look like one of the whole.
int end_part(const CampaignOptions& options, const campaign::Manifest& manifest) {
  if (!options.quiet) {
    fmt::print("part {}: {} done in {}; pose_wall campaign --merge makes the card of all parts\n",
               campaign::part_text(*manifest.part), counted(manifest.part_runs, "run"), options.output);
  }
  return kExitDone;
}

int make_card(const CampaignOptions& options, const campaign::Manifest& manifest) {
  if (manifest.plan.motion) return make_motion_card(options, manifest);
  const std::vector<campaign::RunRecord> records = campaign::read_records(options.output, manifest);
  campaign::write_frames(options.output, records);
  return tell_card(options, campaign::make_card(manifest, records, options.events));
}

int tell_interrupted(const CampaignOptions& options) {
  const std::vector<campaign::Run> runs = runs_of(options);
  fmt::print(stderr, "interrupted: {} of {} done; the same command{} continues\n",
             runs.size() - campaign::pending_runs(options.output, runs).size(),
             counted(runs.size(), "run is", "runs are"), options.fresh ? " without --fresh" : "");
  return kExitInterrupted;
}

// Of runs by the engine alone: that of the gates has no motion library beside it.
campaign::Manifest manifest_of_gates(const CampaignOptions& options, const std::vector<campaign::Run>& runs) {
  campaign::Manifest manifest = campaign::make_manifest(options.plan, runs, options.engine);
  manifest.motion_is_on = false;
  return manifest;
}

// Nothing is kept: the table is all there is of it.
int run_sweep(const CampaignOptions& options) {
  check_settings(options.engine, options.quiet);
  const campaign::SweepRequest request = campaign::parse_sweep(options.sweep);
  const std::vector<campaign::Run> runs = campaign::make_plan(options.plan);
  const campaign::Manifest manifest = manifest_of_gates(options, runs);
  const campaign::Sweep sweep = campaign::run_sweep(request, manifest, runs, {options.jobs, !options.quiet});
  fmt::print("{}", options.json ? campaign::sweep_json(sweep) : campaign::sweep_text(sweep));
  return kExitDone;
}

int run_ablation(const CampaignOptions& options) {
  check_settings(options.engine, options.quiet);
  const std::vector<campaign::Run> runs = campaign::make_plan(options.plan);
  const campaign::Manifest manifest = manifest_of_gates(options, runs);
  const campaign::Ablation ablation =
      campaign::run_ablation(options.ablate, manifest, runs, {options.jobs, !options.quiet});
  fmt::print("{}", options.json ? campaign::ablation_json(ablation) : campaign::ablation_text(ablation));
  return kExitDone;
}

int run_motion_trials(const CampaignOptions& options) {
  const bool sweeps = !options.sweep.empty();
  const campaign::MotionTrialRequest request =
      sweeps ? campaign::motion_sweep(options.sweep) : campaign::motion_ablation(options.ablate);
  if (!request.fault.empty()) {
    throw std::invalid_argument(fmt::format("--motion {}: {}", sweeps ? "--sweep" : "--ablate", request.fault));
  }
  check_settings(options.engine, options.quiet);
  const std::vector<campaign::Run> runs = campaign::make_plan(options.plan);
  const campaign::MotionTrials trials = campaign::run_motion_trials(
      request, campaign::make_manifest(options.plan, runs, options.engine), runs, {options.jobs, !options.quiet});
  fmt::print("{}", options.json ? campaign::motion_trials_json(trials) : campaign::motion_trials_text(trials));
  return kExitDone;
}

int run_trials(const CampaignOptions& options) {
  if (options.plan.motion) return run_motion_trials(options);
  return options.sweep.empty() ? run_ablation(options) : run_sweep(options);
}

// Sweep or ablation.
int table_verb(const CampaignOptions& options) {
  try {
    return done_or_complaint("campaign", [&] { return run_trials(options); });
  } catch (const Interrupted&) {
    fmt::print(stderr, "interrupted: --sweep and --ablate keep nothing; start it again\n");
    return kExitInterrupted;
  }
}

// The same names in another order, or twice, ask for the same campaign.
void sort_names(std::vector<std::string>* names) {
  std::sort(names->begin(), names->end());
  names->erase(std::unique(names->begin(), names->end()), names->end());
}

// The records of a whole campaign that is there already.
campaign::Manifest finished_campaign(const CampaignOptions& options) {
  if (!options.merge.empty()) {
    make_output_folder(options.output);
    return campaign::merge_parts(options.merge, options.output, options.fresh);
  }
  campaign::Manifest manifest = campaign::read_manifest(options.output);
  if (manifest.part) {
    throw std::invalid_argument(fmt::format(
        "--card-only: {} holds part {} of a campaign; allowed is a whole one. --merge makes the card of all "
        "parts",
        options.output, campaign::part_text(*manifest.part)));
  }
  return manifest;
}

int run_verb(const CampaignOptions& options) {
  try {
    return done_or_complaint("campaign", [&] {
      if (options.card_only || !options.merge.empty()) return make_card(options, finished_campaign(options));
      const campaign::Manifest manifest = run_campaign(options);
      return manifest.part ? end_part(options, manifest) : make_card(options, manifest);
    });
  } catch (const Interrupted&) {
    return tell_interrupted(options);
  }
}

// Refuses all options but these. `because` says why.
void demand_only(const CLI::App& verb, const std::vector<std::string>& allowed, const char* because) {
  std::vector<std::string> refused;
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    const bool is_allowed = std::find(allowed.begin(), allowed.end(), name) != allowed.end();
    if (option->count() > 0 && !is_allowed) refused.push_back(name);
  }
  if (refused.empty()) return;
  const std::vector<std::string> others(allowed.begin() + 1, allowed.end());
  throw std::invalid_argument(fmt::format("{} {}: {} cannot go with it; allowed are {}", allowed.front(), because,
                                          fmt::join(refused, ", "), fmt::join(others, ", ")));
}

void demand_only_what_goes_along(const CLI::App& verb, const CampaignOptions& options) {
  if (options.card_only) {
    // The records say how they were made; nothing else can be asked of them.
    demand_only(verb, {"--card-only", "--output", "--events", "--gate", "--quiet"}, "takes the records as they are");
  }
  if (!options.merge.empty()) {
    demand_only(verb, {"--merge", "--output", "--events", "--gate", "--fresh", "--quiet"},
                "takes the records of the parts as they are");
  }
  if (prints_table(options)) {
    demand_only(verb,
                {options.sweep.empty() ? "--ablate" : "--sweep", "--motion", "--size", "--scenes", "--kind",
                 "--sensors", "--draws", "--first-draw", "--frames", "--scans", "--seed", "--jobs", "--config", "--set",
                 "--json", "--quiet"},
                "prints a table and leaves no records");
  }
}

// What an option is nothing without, or with.
void demand_words_go_together(const CLI::App& verb, const CampaignOptions& options) {
  if (options.plan.motion && verb.get_option("--kind")->count() > 0) {
    throw std::invalid_argument("--kind applies to scenes; --motion has classes: name them by --scenes");
  }
  if (options.plan.motion && verb.get_option("--drive-in")->count() > 0) {
    throw std::invalid_argument(
        "--drive-in applies to scenes; in the classes of --motion the machine drives by itself");
  }
  if (options.plan.motion && !options.plan.surfaces.empty()) {
    throw std::invalid_argument("--surface is a road for the engine; --motion has classes of its own");
  }
  if (options.plan.motion && !options.scans.empty()) {
    throw std::invalid_argument("--scans applies to scenes; each class of --motion has its own");
  }
  if (options.list && !options.plan.motion) {
    throw std::invalid_argument("--list needs --motion; `pose_wall sim --list` has the scenes");
  }
  for (const char* of_card : {"--gate", "--events"}) {
    if (!options.part.empty() && verb.get_option(of_card)->count() > 0) {
      throw std::invalid_argument(fmt::format("--part makes no card: {} goes with --merge", of_card));
    }
  }
  if (options.json && !prints_table(options)) {
    throw std::invalid_argument("--json needs --sweep or --ablate; a campaign writes card.json in its folder");
  }
  const bool leaves_records = !options.list && !prints_table(options);
  if (leaves_records && options.output.empty()) throw std::invalid_argument("--output is required: a folder");
}

// Without the motion library nothing takes a machine's motion out of a scan.
void take_scans(CampaignOptions& options) {
  const bool is_instant = prints_table(options) && options.scans.empty() && !options.plan.motion;
  if (!options.scans.empty()) options.plan.scans = campaign::scans_named(options.scans);
  if (is_instant) options.plan.scans = campaign::Scans::kInstant;
}

// "rough, props" is two names, and no blank in front of the second.
std::string trimmed(std::string name) {
  const char* const blanks = " \t\n";
  name.erase(0, name.find_first_not_of(blanks));
  name.erase(name.find_last_not_of(blanks) + 1);
  return name;
}

constexpr double kDriveInMost_m = 100.0;  // judgement, 2026-11-27: 1250 frames a run, a minute or more

void add_plan_options(CLI::App& verb, CampaignOptions& options) {
  campaign::PlanRequest& plan = options.plan;
  verb.add_option("--size", plan.size,
                  "small (each scene once, seconds), medium (minutes) or large (more than 30,000 frames)")
      ->type_name("SIZE")
      ->capture_default_str();
  verb.add_flag("--motion", plan.motion, "Measure the motion library, on classes of motion instead of scenes");
  verb.add_option("--scenes", plan.scenes, "Names, separated by commas; see pose_wall sim --list, and --motion --list")
      ->delimiter(',')
      ->transform(trimmed);
  verb.add_option("--kind", plan.kind, "Kind of scenes: mine, nominal, adversarial, unobservable or all")
      ->capture_default_str()
      ->check(one_of({"mine", "nominal", "adversarial", "unobservable", "all"}));
  verb.add_option("--surface", plan.surfaces,
                  "A real road besides the scenes: its scan as of `pose_wall sim --surface`; may come several times")
      ->type_name("FILE");
  verb.add_option("--sensors", plan.sensors, "Names, separated by commas")->delimiter(',')->transform(trimmed);
  verb.add_option("--draws", plan.draws, "Draws per scene and sensor; overrides --size")
      ->check(whole_number_within(1, 1000000));
  verb.add_option("--first-draw", plan.first_draw, "Number of the first draw; with --draws 1 this repeats one run")
      ->capture_default_str()
      ->check(whole_number());
  verb.add_option("-n,--frames", plan.frames, "Frames per draw; overrides size and scene")
      ->check(whole_number_within(1, 1000000));
  verb.add_option("--drive-in", plan.drive_in_m,
                  "Metres that the machine drives before each scene begins, so that the engine knows the road")
      ->type_name("METRES")
      ->check(number_within(0.0, kDriveInMost_m));
  verb.add_option("--scans", options.scans,
                  "turning: a scan takes the sensor's turn, points have times, and every second run drives (default); "
                  "instant: a scan is of one instant (default of --sweep and --ablate, which know no motion)")
      ->check(one_of(campaign::scans_names()));
  verb.add_option("--seed", plan.seed, "The same seed gives the same draws")
      ->capture_default_str()
      ->check(whole_number());
}

void add_part_options(CLI::App& verb, CampaignOptions& options) {
  verb.add_option("--part", options.part,
                  "NUMBER/PARTS: run only this part of the runs, 3/16 the third of sixteen; makes no card")
      ->type_name("NUMBER/PARTS");
  verb.add_option("--merge", options.merge,
                  "Bring the folders of all parts together in --output and make the card, the same as of one run")
      ->type_name("DIR");
}

// Behind --motion, which is known when these are checked.
void add_sweep_options(CLI::App& verb, CampaignOptions& options) {
  const bool& motion = options.plan.motion;
  verb.add_option("--sweep", options.sweep,
                  "GATE=A,B,...: print the results of the runs with the table's limit of a gate, and with each of "
                  "these limits; pose_wall explain --gates lists the gates. With --motion: of a gate of motion")
      ->check(
          [&motion](const std::string& words) {
            return motion ? campaign::motion_sweep(words).fault : campaign::sweep_fault(words);
          },
          "");
  verb.add_option("--ablate", options.ablate,
                  "each, or GATE,...: print what becomes valid, and what becomes wrong, without each gate alone, or "
                  "without these gates together")
      ->check(
          [&motion](const std::string& words) {
            return motion ? campaign::motion_ablation(words).fault : campaign::gate_rows(words).fault;
          },
          "");
  verb.add_flag("--json", options.json, "With --sweep or --ablate: the table as JSON");
}

void add_footer(CLI::App& verb) {
  verb.footer(
      "Examples:\n"
      "  pose_wall campaign --size small --gate --output /tmp/card\n"
      "  pose_wall campaign --scenes rough,props --sensors os1-64 --draws 50 --output /tmp/two\n"
      "  pose_wall campaign --drive-in 5 --scenes rough,props --sensors os1-64 --draws 20 --output /tmp/driven\n"
      "  pose_wall campaign --motion --size small --gate --output /tmp/motion\n"
      "  pose_wall campaign --size large --part 3/16 --output /tmp/parts/3\n"
      "  pose_wall campaign --merge /tmp/parts/* --gate --output /tmp/card\n"
      "  pose_wall campaign --sweep wall_length=1,3,4 --scenes rough,props --sensors os1-64 --draws 20\n"
      "  pose_wall campaign --ablate each --kind adversarial --draws 3\n"
      "  pose_wall campaign --motion --sweep matched=40,160 --size small\n"
      "Exit status: 0 done, 1 a record or card cannot be read or written, 2 bad usage or config, records of "
      "another\n"
      "campaign in the folder, or parts that are no whole campaign, 3 the gate failed, 130 interrupted by Ctrl-C (the "
      "same command continues).");
}

}  // namespace

void add_campaign(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CampaignOptions>();
  CLI::App* verb = app.add_subcommand("campaign", "Measure many random scenes; write the integrity card");
  verb->add_option("-o,--output", options->output,
                   "Folder for records and card; an interrupted campaign continues there");
  add_plan_options(*verb, *options);
  verb->add_option("-j,--jobs", options->jobs, "Runs at a time")
      ->capture_default_str()
      ->check(whole_number_within(1, 1024));
  verb->add_option("-c,--config", options->engine.config_file,
                   config_help("Settings; those of scene and sensor override them"));
  verb->add_option("-s,--set", options->engine.settings, "KEY=VALUE, overrides all settings; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("--events", options->events, "Number of worst events on the card")
      ->capture_default_str()
      ->check(whole_number());
  verb->add_flag("--list", options->list,
                 "With --motion: print its classes with the right behaviour of each, and run nothing");
  verb->add_flag("--fresh", options->fresh, "Remove the folder's records first");
  verb->add_flag("--card-only", options->card_only, "Make the card again from the folder's records, and run nothing");
  verb->add_flag("--gate", options->gate, "Exit with 3 unless the card meets all requirements");
  add_part_options(*verb, *options);
  add_sweep_options(*verb, *options);
  verb->add_flag("-q,--quiet", options->quiet,
                 "Nothing on stderr but errors, nothing on stdout but the table of --sweep or --ablate");
  add_footer(*verb);
  verb->callback([options, verb, &exit_code] {
    demand_only_what_goes_along(*verb, *options);
    demand_words_go_together(*verb, *options);
    if (options->list) {
      fmt::print("{}", campaign::motion_class_list());
      return;
    }
    take_scans(*options);
    sort_names(&options->plan.scenes);
    sort_names(&options->plan.sensors);
    exit_code = prints_table(*options) ? table_verb(*options) : run_verb(*options);
  });
}

}  // namespace pose_wall::tools
