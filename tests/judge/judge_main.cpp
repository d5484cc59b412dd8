// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// usage: pose_wall_judge [--seed FIRST] [--roads N] [--frames N] [--from FRAME] [--sensor NAME] [--quiet | --rich]
//                        [--no-bias] [--times on|off] [--motion on|off] [--work-max N] [--going drawn|stands|drives]
//                        [--all]
//                        [--compare | --furnished | --near-walls | --write FOLDER]
//
// Judges the engine on N roads from the seed FIRST on, and prints tables: of all, by sensor and by feature, before them
// every value that was beyond its level. One road is replayed by its seed; --all then prints each of its values, and
// --write its frames. --times off: all rays of a scan at one instant, by sensors with even rings. --motion on: the
// motion library runs beside the engine. --compare hears the same clouds with motion, without, and without a budget.
// --furnished does so on the roads of the furnished class.
// --near-walls tries sensors near walls, with the offsets of their light and without. Exit status 1: a valid value was
// beyond its level or misleading; --near-walls: a value was lost by the offsets.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "judge/compare.hpp"
#include "judge/furnished.hpp"
#include "judge/near_walls.hpp"
#include "judge/tally.hpp"

namespace pose_wall::judge {
namespace {

struct Options {
  Case first;
  Treatment treatment = {true, 0};
  long roads = 100;
  bool all = false, compare = false, furnished = false, near_walls = false;
  std::string folder;
};

[[noreturn]] void refuse(const std::string& word, const char* why) {
  std::fprintf(stderr, "%s: %s\n", word.c_str(), why);
  std::exit(2);
}

int sensor_of(const std::string& name) {
  const int row = sensor_row(name);
  if (row < 0) refuse(name, "no such sensor");
  return row;
}

long number_of(const std::string& word) {
  char* end = nullptr;
  const long number = std::strtol(word.c_str(), &end, 10);
  if (word.empty() || *end != 0 || number < 0) refuse(word, "no number");
  return number;
}

bool on_of(const std::string& word) {
  if (word != "on" && word != "off") refuse(word, "neither on nor off");
  return word == "on";
}

Going going_of(const std::string& word) {
  if (word != "drawn" && word != "stands" && word != "drives") refuse(word, "neither drawn, stands nor drives");
  return word == "drawn" ? Going::kDrawn : word == "stands" ? Going::kStands : Going::kDrives;
}

using Setter = std::function<void(const std::string&)>;

// What follows no word, and what follows one.
Options read_options(const std::vector<std::string>& words) {
  Options options;
  options.first.times = true;
  bool quiet = false, rich = false;
  const std::map<std::string, bool*> switches = {{"--quiet", &quiet},
                                                 {"--rich", &rich},
                                                 {"--no-bias", &options.first.no_bias},
                                                 {"--all", &options.all},
                                                 {"--compare", &options.compare},
                                                 {"--furnished", &options.furnished},
                                                 {"--near-walls", &options.near_walls}};
  const std::map<std::string, Setter> settings = {
      {"--seed", [&](const std::string& word) { options.first.seed = std::strtoull(word.c_str(), nullptr, 10); }},
      {"--roads", [&](const std::string& word) { options.roads = number_of(word); }},
      {"--frames", [&](const std::string& word) { options.first.frames = static_cast<int>(number_of(word)); }},
      {"--from", [&](const std::string& word) { options.first.from_frame = static_cast<int>(number_of(word)); }},
      {"--sensor", [&](const std::string& word) { options.first.sensor = sensor_of(word); }},
      {"--times", [&](const std::string& word) { options.first.times = on_of(word); }},
      {"--motion", [&](const std::string& word) { options.treatment.motion = on_of(word); }},
      {"--work-max",
       [&](const std::string& word) { options.treatment.work_max = static_cast<std::uint32_t>(number_of(word)); }},
      {"--going", [&](const std::string& word) { options.first.going = going_of(word); }},
      {"--write", [&](const std::string& word) { options.folder = word; }}};
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (const auto it = switches.find(words[k]); it != switches.end()) {
      *it->second = true;
    } else if (const auto setting = settings.find(words[k]); setting != settings.end() && k + 1 < words.size()) {
      setting->second(words[++k]);
    } else {
      refuse(words[k], "no such option, or nothing behind it");
    }
  }
  if (quiet) options.first.furnishing = Furnishing::kQuiet;
  if (rich) options.first.furnishing = Furnishing::kRich;
  return options;
}

struct Totals {
  void add(const Verdict& verdict) {
    judge::add(&all, verdict);
    work.add(verdict);
    judge::add(&groups[std::string("sensor ") + sensor_at(verdict.sensor).name], verdict);
    if (verdict.features == 0) judge::add(&groups["feature none"], verdict);
    for (std::uint32_t k = 0; k < kFeatures; ++k) {
      if ((verdict.features >> k & 1U) != 0) judge::add(&groups[std::string("feature ") + feature_name(k)], verdict);
    }
  }

  void print() const {
    std::printf("\nAll roads\n%s\n%s\n%s", table(all).c_str(), reasons_table(all).c_str(), work.text().c_str());
    for (const auto& [name, tallies] : groups) std::printf("\n%s\n%s", name.c_str(), table(tallies).c_str());
  }

  Tallies all;
  WorkTally work;
  std::map<std::string, Tallies> groups;
};

int run(const Options& options) {
  Totals totals;
  bool wrong = false;
  for (long k = 0; k < options.roads; ++k) {
    Case tried = options.first;
    tried.seed += static_cast<std::uint64_t>(k);
    const Verdict verdict = hear(tried, options.treatment);
    totals.add(verdict);
    for (const Finding& finding : verdict.findings) {
      const bool bad = finding.beyond() || finding.raw_beyond() || finding.misleading();
      if (bad || options.all) std::printf("%s%s\n", bad ? "BEYOND " : "", verdict.text(finding).c_str());
      wrong = wrong || (finding.state == POSE_WALL_VALID && bad);
    }
    std::fflush(stdout);
  }
  totals.print();
  std::printf("\nTwo truths\n%s", truths_table(totals.all).c_str());
  return wrong ? 1 : 0;
}

int compare(const Options& options) {
  Comparison comparison;
  for (long k = 0; k < options.roads; ++k) {
    Case tried = options.first;
    tried.seed += static_cast<std::uint64_t>(k);
    comparison.add(tried);
    std::fflush(stdout);
  }
  std::printf("%s", comparison.text().c_str());
  return comparison.wrong() ? 1 : 0;
}

int furnished() {
  Comparison comparison;
  for (int k = 0; k < kFurnishedRoads; ++k) comparison.add(furnished_road(k));
  std::printf("%s", comparison.text().c_str());
  return comparison.wrong() ? 1 : 0;
}

int near_walls() {
  const NearWalls found = try_near_walls(every_near_wall());
  std::printf("%s", found.text().c_str());
  return found.lost.empty() ? 0 : 1;
}

int obey(const Options& options) {
  if (options.near_walls) return near_walls();
  if (options.furnished) return furnished();
  if (options.compare) return compare(options);
  if (options.folder.empty()) return run(options);
  write_frames(options.first, options.folder);
  return 0;
}

}  // namespace
}  // namespace pose_wall::judge

int main(int count, char** words) {
  try {
    return pose_wall::judge::obey(pose_wall::judge::read_options({std::next(words), std::next(words, count)}));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
}
