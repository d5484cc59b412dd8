// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// usage: pose_wall_judge_gates [--seed FIRST] [--roads N] [--without GATE,GATE,...]
//
// Prints what each gate is good for on N roads from the seed FIRST on: how many values become valid without it, and how
// many become wrong. Each road is measured with all gates, then once without each gate that failed there; with
// --without only once, without all of these gates.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "explain/gate_list.hpp"
#include "explain/traced_frame.hpp"
#include "judge/court.hpp"

namespace pose_wall::judge {
namespace {

using Gates = std::vector<std::uint32_t>;
using FailedGates = std::array<bool, POSE_WALL_TRACE_GATES>;

struct Options {
  std::uint64_t seed = 0;
  long roads = 100;
  Gates without;  // empty: each alone
};

Gates gates_named(const std::string& list) {
  const std::vector<std::string> names = tools::explain::gate_names();
  Gates gates;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    std::uint32_t gate = 0;
    while (gate < names.size() && names[gate] != word) ++gate;
    if (gate == names.size()) throw std::runtime_error(word + ": no such gate");
    gates.push_back(gate);
  }
  return gates;
}

Options read_options(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t k = 0; k < words.size(); k += 2) {
    const std::string next = k + 1 < words.size() ? words[k + 1] : "";
    if (words[k] == "--seed") {
      options.seed = std::strtoull(next.c_str(), nullptr, 10);
    } else if (words[k] == "--roads") {
      options.roads = std::strtol(next.c_str(), nullptr, 10);
    } else if (words[k] == "--without") {
      options.without = gates_named(next);
    } else {
      throw std::runtime_error(words[k] + ": no such option");
    }
  }
  return options;
}

// Adds the gates that failed.
Verdict hear_traced(const Case& tried, FailedGates* failed) {
  return hear(tried, [failed](const pose_wall_config& config) -> Process {
    const auto engine = std::make_shared<tools::TracedEngine>();
    api::Config loaded;
    *loaded.get() = config;
    if (engine->open(loaded) != POSE_WALL_OK) throw std::runtime_error("the traced engine refuses the config");
    return [engine, failed](const pose_wall_cloud& cloud) {
      pose_wall_result result = api::make_result();
      const std::int32_t status = engine->process(cloud, result);
      if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
      for (std::uint32_t gate = 0; gate < failed->size(); ++gate) {
        (*failed)[gate] = (*failed)[gate] || tools::has_failed(engine->trace(), gate);
      }
      return result;
    };
  });
}

struct Worth {
  int roads_failed = 0, values_changed = 0, valid_gained = 0, valid_lost = 0;
  int misleading_more = 0, misleading_fewer = 0, beyond_more = 0, beyond_fewer = 0;
  std::string first_wrong;

  void add(const Finding& before, const Finding& now, std::uint64_t seed) {
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    if (before.state != now.state || !same(before.error, now.error) || !same(before.level, now.level)) ++values_changed;
    const auto count = [](bool was, bool is, int* more, int* fewer) {
      if (is && !was) ++*more;
      if (was && !is) ++*fewer;
      return is && !was;
    };
    count(before.state == POSE_WALL_VALID, now.state == POSE_WALL_VALID, &valid_gained, &valid_lost);
    const bool misleads = count(before.misleading(), now.misleading(), &misleading_more, &misleading_fewer);
    const auto is_beyond = [](const Finding& f) { return f.beyond() || f.raw_beyond(); };
    const bool errs = count(is_beyond(before), is_beyond(now), &beyond_more, &beyond_fewer);
    if ((misleads || errs) && first_wrong.empty()) first_wrong = "road " + std::to_string(seed);
  }
};

void judge_without(const Gates& gates, const Case& tried, const Verdict& before, Worth* worth) {
  ++worth->roads_failed;
  for (const std::uint32_t gate : gates) {
    if (pose_wall_trace_let_pass(gate) != POSE_WALL_OK) throw std::runtime_error("floor_planes cannot be left out");
  }
  FailedGates ignored{};
  const Verdict now = hear_traced(tried, &ignored);
  pose_wall_trace_forget_limits();
  for (std::size_t k = 0; k < before.findings.size(); ++k) worth->add(before.findings[k], now.findings[k], tried.seed);
}

bool any_of(const Gates& gates, const FailedGates& failed) {
  bool any = false;
  for (const std::uint32_t gate : gates) any = any || failed[gate];
  return any;
}

void print(const char* name, const Worth& w) {
  std::printf("%-20s %6d %8d  +%d -%d  misleading +%d -%d  beyond +%d -%d  %s\n", name, w.roads_failed,
              w.values_changed, w.valid_gained, w.valid_lost, w.misleading_more, w.misleading_fewer, w.beyond_more,
              w.beyond_fewer, w.first_wrong.c_str());
}

void run(const Options& options) {
  std::vector<Gates> rows;
  for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES && options.without.empty(); ++gate) {
    if (gate != POSE_WALL_TRACE_FLOOR_PLANES) rows.push_back({gate});  // the fit needs a plane
  }
  if (!options.without.empty()) rows.push_back(options.without);
  std::vector<Worth> worth(rows.size());
  for (long k = 0; k < options.roads; ++k) {
    Case tried;
    tried.seed = options.seed + static_cast<std::uint64_t>(k);
    FailedGates failed{};
    const Verdict before = hear_traced(tried, &failed);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (any_of(rows[row], failed)) judge_without(rows[row], tried, before, &worth[row]);
    }
  }
  std::printf("without              roads   values  valid\n");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    print(options.without.empty() ? tools::explain::gate_list()[rows[row].front()].name : "these gates", worth[row]);
  }
}

}  // namespace
}  // namespace pose_wall::judge

int main(int count, char** words) {
  try {
    pose_wall::judge::run(pose_wall::judge::read_options({std::next(words), std::next(words, count)}));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
}
