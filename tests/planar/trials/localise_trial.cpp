// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Restarts in simulated networks of roads: how often is the place unique, ambiguous or unknown, and is unique right?
// usage: pose_wall_planar_localise_trial [--places N] [--seed S] [--kind K] [--per-network N] [--verbose]
//        [--kidnap | --faulty-odometry | --cost]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "localise_world.hpp"

namespace {

using namespace pose_wall::planar;
using namespace pose_wall::planar::test;

struct Options {
  int places = 200, per_network = 25, kind = -1, network = -1, restart = -1;
  std::uint64_t seed = 1;
  bool verbose = false, kidnap = false, faulty = false, cost = false, slam = false, whole = false;
};

Options options_of(int argc, char** argv) {
  Options out;
  for (int k = 1; k < argc; ++k) {
    const std::string name = argv[k];
    const char* const value = k + 1 < argc ? argv[k + 1] : "0";
    if (name == "--places") out.places = std::atoi(value);
    if (name == "--seed") out.seed = std::strtoull(value, nullptr, 10);
    if (name == "--kind") out.kind = std::atoi(value);
    if (name == "--per-network") out.per_network = std::atoi(value);
    if (name == "--network") out.network = std::atoi(value);  // this one alone, and one restart in it
    if (name == "--restart") out.restart = std::atoi(value);
    if (name == "--cost") out.cost = true;
    if (name == "--whole") out.whole = true;
    if (name == "--slam") out.slam = true;
    if (name == "--kidnap") out.kidnap = true;
    if (name == "--faulty-odometry") out.faulty = true;
    if (name == "--verbose") out.verbose = true;
  }
  return out;
}

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Processor time of calls with the default share of work, in a kilometre of roads.
void cost(const Options& options) {
  const double begun = processor_s();
  const World world(std::max(0, options.kind), 2 * options.seed, 1000.0, 1024, false, false, localise_settings().work);
  std::printf("map of a kilometre: %u tiles, %u surfaces, block %.1f MB, made in %.2f s with its scans\n",
              world.localiser().map().tiles(), world.localiser().map().surfaces(),
              static_cast<double>(world.bytes()) * 1e-6, processor_s() - begun);
  Localiser& own = world.localiser();
  std::vector<double> searching_ms, tracking_ms;
  std::vector<float> ranges;
  int calls = 0, restarts = 0;
  for (; restarts < options.places; ++restarts) {
    const Restart restart = world.draw_restart(static_cast<std::uint64_t>(restarts));
    own.forget();
    for (int k = 0, tracked = 0; k < 600 && tracked < 20; ++k) {
      const auto at = world.pose_at(restart, std::min(5.0, 0.05 * k));
      const pose_wall_planar_scan scan =
          world.scan_at(at, restart.things, restart.seed * 1000 + static_cast<std::uint64_t>(k), &ranges);
      const BeamScan read = read_beams(scan, own.beams());
      const bool was_tracking = own.is_tracking();
      const double start = processor_s();
      own.process(read, nullptr);
      (was_tracking ? tracking_ms : searching_ms).push_back(1e3 * (processor_s() - start));
      tracked += was_tracking ? 1 : 0;
      calls += was_tracking ? 0 : 1;
    }
  }
  const auto show = [](const char* name, std::vector<double> ms) {
    if (ms.empty()) return;
    std::sort(ms.begin(), ms.end());
    double sum = 0.0;
    for (const double one : ms) sum += one;
    std::printf("%s: %zu calls, mean %.2f ms, median %.2f, 99 %% %.2f, worst %.2f\n", name, ms.size(),
                sum / static_cast<double>(ms.size()), ms[ms.size() / 2], ms[ms.size() * 99 / 100], ms.back());
  };
  std::printf("%d restarts, %.1f calls each until a place is tracked\n", restarts,
              static_cast<double>(calls) / restarts);
  show("searching", searching_ms);
  show("tracking", tracking_ms);
}

// Carried from place to place: after how many scans is it noticed?
void kidnap(const Options& options) {
  int tracked[kKinds] = {}, unnoticed[kKinds] = {}, found[kKinds] = {}, wrong[kKinds] = {}, after[kKinds][31] = {};
  int done = 0;
  for (std::uint64_t network = 0; done < options.places; ++network) {
    const int kind = options.kind >= 0 ? options.kind : static_cast<int>(network % kKinds);
    const World world(kind, options.seed * 100000 + network);
    for (int k = 0; k < options.per_network && done < options.places; ++k, ++done) {
      const auto number = static_cast<std::uint64_t>(2 * k);
      const auto outcome = world.kidnap(world.draw_restart(number), world.draw_restart(number + 1));
      if (!outcome.was_tracked) continue;
      ++tracked[kind];
      unnoticed[kind] += outcome.noticed ? 0 : 1;
      found[kind] += outcome.found ? 1 : 0;
      wrong[kind] += outcome.wrong ? 1 : 0;
      ++after[kind][outcome.scans];
    }
  }
  for (int kind = 0; kind < kKinds; ++kind) {
    if (tracked[kind] == 0) continue;
    std::printf(
        "%-14s %5d carried; noticed after 1 scan %d, 2 %d, 3 %d, 4 to 30 %d, never %d; found again %d; wrong after it "
        "%d\n",
        kind_name(kind), tracked[kind], after[kind][1], after[kind][2], after[kind][3],
        tracked[kind] - after[kind][1] - after[kind][2] - after[kind][3] - unnoticed[kind], unnoticed[kind],
        found[kind], wrong[kind]);
  }
}

// Drives from known places while odometry stalls and leaps: is a unique place right?
void faulty(const Options& options) {
  World::FaultyDrive of_kind[kKinds];
  int drives[kKinds] = {}, done = 0;
  for (std::uint64_t network = 0; done < options.places; ++network) {
    const int kind = options.kind >= 0 ? options.kind : static_cast<int>(network % kKinds);
    const std::uint64_t seed = options.seed * 100000 + network;
    const World world(kind, seed, World::lengths(seed), 768, options.slam, options.whole);
    for (int k = 0; k < options.per_network && done < options.places; ++k, ++done) {
      const Restart restart = world.draw_restart(static_cast<std::uint64_t>(k));
      if (!restart.is_mapped) continue;
      constexpr double kSteps_m[] = {0.05, 0.1, 0.25};
      const World::FaultyDrive one = world.drive_with_faulty_odometry(restart, kSteps_m[k % 3]);
      if (one.wrong > 0)
        std::printf("WRONG kind %s network %llu restart %d: %d of %d scans, %.2f m at worst\n", kind_name(kind),
                    static_cast<unsigned long long>(seed), k, one.wrong, one.scans, one.worst_m);
      World::FaultyDrive& sum = of_kind[kind];
      ++drives[kind];
      sum.scans += one.scans;
      sum.unique += one.unique;
      sum.wrong += one.wrong;
      sum.tracked += one.tracked;
      sum.beyond += one.beyond;
      sum.lost += one.lost;
      sum.worst_m = std::max(sum.worst_m, one.worst_m);
    }
  }
  for (int kind = 0; kind < kKinds; ++kind) {
    const World::FaultyDrive& sum = of_kind[kind];
    if (drives[kind] == 0) continue;
    std::printf(
        "%-14s %5d drives, %6d scans; unique %5.1f %%, of these wrong %d, worst %.2f m; beyond 3 sigma %ld of "
        "%ld; lost %u\n",
        kind_name(kind), drives[kind], sum.scans, 100.0 * sum.unique / sum.scans, sum.wrong, sum.worst_m, sum.beyond,
        sum.tracked, sum.lost);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = options_of(argc, argv);
  if (options.cost) {
    cost(options);
    return 0;
  }
  if (options.kidnap) {
    kidnap(options);
    return 0;
  }
  if (options.faulty) {
    faulty(options);
    return 0;
  }
  std::vector<Counts> inside(kKinds), outside(kKinds);
  const auto begun = std::chrono::steady_clock::now();
  int done = 0;
  if (options.network >= 0) {
    const World world(options.kind, static_cast<std::uint64_t>(options.network));
    const Restart restart = world.draw_restart(static_cast<std::uint64_t>(options.restart));
    const Outcome outcome = world.run(restart, true);
    std::printf("mapped %d odometry %d wrong %d error %.2f m\n", restart.is_mapped, restart.has_odometry, outcome.wrong,
                outcome.error_m);
    return outcome.wrong ? 1 : 0;
  }
  for (std::uint64_t network = 0; done < options.places; ++network) {
    const int kind = options.kind >= 0 ? options.kind : static_cast<int>(network % kKinds);
    const std::uint64_t seed = options.seed * 100000 + network;
    const World world(kind, seed, World::lengths(seed), 768, options.slam, options.whole);
    for (int k = 0; k < options.per_network && done < options.places; ++k, ++done) {
      const Restart restart = world.draw_restart(static_cast<std::uint64_t>(k));
      const Outcome outcome = world.run(restart, options.verbose);
      Counts& counts = (restart.is_mapped ? inside : outside)[static_cast<std::size_t>(kind)];
      counts.add(outcome);
      if (outcome.wrong) {
        std::printf(
            "WRONG kind %s network %llu restart %d mapped %d: %.2f m %.3f rad at %.2f m, evidence fits %.2f rival "
            "%.2f\n",
            kind_name(kind), static_cast<unsigned long long>(options.seed * 100000 + network), k, restart.is_mapped,
            outcome.error_m, outcome.error_rad, outcome.wrong_at_m, outcome.fits, outcome.rival);
      }
    }
    std::fflush(stdout);
  }
  for (int place = 0; place < 2; ++place) {
    std::printf("%s\n%-14s %7s %7s | %8s %8s %8s | %8s %8s %8s %8s | %s | %s\n",
                place == 0 ? "in the map" : "not in the map", "kind", "places", "wrong", "standing", "2 m", "5 m",
                "unique", "ambig.", "unknown", "search", "mean error m",
                "tracked scans, rms m, over sigma, beyond 3 sigma");
    for (int kind = 0; kind < kKinds; ++kind)
      (place == 0 ? inside : outside)[static_cast<std::size_t>(kind)].print(kind_name(kind));
  }
  std::printf("%d places, %.1f s\n", done,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
}
