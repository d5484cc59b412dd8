// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// usage: pose_wall_judge [--seed FIRST] [--roads N] [--frames N] [--sensor NAME] [--quiet] [--no-bias] [--all]
//                        [--write FOLDER]
//
// Judges the engine on N roads from the seed FIRST on, and prints tables: of all, by sensor and by feature, before them
// every value that was beyond its level. One road is replayed by its seed; --all then prints each of its values, and
// --write its frames. Exit status 1: a valid value was beyond its level or misleading.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <string>

#include "judge/court.hpp"

namespace pose_wall::judge {
namespace {

struct Options {
  Case first;
  long roads = 100;
  bool all = false;
  std::string folder;
};

int sensor_of(const std::string& name) {
  for (std::size_t k = 0; k < kSensorTable.size(); ++k) {
    if (name == kSensorTable.at(k).name) return static_cast<int>(k);
  }
  std::fprintf(stderr, "%s: no such sensor\n", name.c_str());
  std::exit(2);
}

Options read_options(int count, char** words) {
  Options options;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k], next = k + 1 < count ? words[k + 1] : "";
    if (word == "--quiet" || word == "--no-bias" || word == "--all") {
      (word == "--quiet" ? options.first.quiet : word == "--all" ? options.all : options.first.no_bias) = true;
      continue;
    }
    ++k;
    if (word == "--seed") {
      options.first.seed = std::strtoull(next.c_str(), nullptr, 10);
    } else if (word == "--roads") {
      options.roads = std::strtol(next.c_str(), nullptr, 10);
    } else if (word == "--frames") {
      options.first.frames = static_cast<int>(std::strtol(next.c_str(), nullptr, 10));
    } else if (word == "--sensor") {
      options.first.sensor = sensor_of(next);
    } else if (word == "--write") {
      options.folder = next;
    } else {
      std::fprintf(stderr, "%s: no such option\n", word.c_str());
      std::exit(2);
    }
  }
  return options;
}

struct Totals {
  void add(const Verdict& verdict) {
    judge::add(&all, verdict);
    judge::add(&groups[std::string("sensor ") + kSensorTable.at(static_cast<std::size_t>(verdict.sensor)).name],
               verdict);
    if (verdict.features == 0) judge::add(&groups["feature none"], verdict);
    for (std::uint32_t k = 0; k < kFeatures; ++k) {
      if ((verdict.features >> k & 1U) != 0) judge::add(&groups[std::string("feature ") + feature_name(k)], verdict);
    }
  }

  void print() const {
    std::printf("\nAll roads\n%s\n%s", table(all).c_str(), reasons_table(all).c_str());
    for (const auto& [name, tallies] : groups) std::printf("\n%s\n%s", name.c_str(), table(tallies).c_str());
  }

  Tallies all;
  std::map<std::string, Tallies> groups;
};

int run(const Options& options) {
  Totals totals;
  bool wrong = false;
  for (long k = 0; k < options.roads; ++k) {
    Case tried = options.first;
    tried.seed += static_cast<std::uint64_t>(k);
    const Verdict verdict = hear(tried);
    totals.add(verdict);
    for (const Finding& finding : verdict.findings) {
      const bool bad = finding.beyond() || finding.raw_beyond() || finding.misleading();
      if (bad || options.all) std::printf("%s%s\n", bad ? "BEYOND " : "", verdict.text(finding).c_str());
      wrong = wrong || (finding.state == POSE_WALL_VALID && bad);
    }
    std::fflush(stdout);
  }
  totals.print();
  return wrong ? 1 : 0;
}

}  // namespace
}  // namespace pose_wall::judge

int main(int count, char** words) {
  try {
    const pose_wall::judge::Options options = pose_wall::judge::read_options(count, words);
    if (!options.folder.empty()) {
      pose_wall::judge::write_frames(options.first, options.folder);
      return 0;
    }
    return pose_wall::judge::run(options);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
}
