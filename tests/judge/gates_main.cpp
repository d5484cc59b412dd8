// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// usage: pose_wall_judge_gates [--seed FIRST] [--roads N] [--without GATE,GATE,...]
//
// Prints what each gate is good for on N roads from the seed FIRST on: how many values become valid without it, and how
// many become wrong. Each road is measured with all gates, then once without each gate that failed there; with
// --without only once, without all of these gates.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "judge/court.hpp"
#include "lab/campaign/gates_left_out.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/traced_frame.hpp"

namespace pose_wall::judge {
namespace {

using namespace tools::campaign;

constexpr const char* kEach = "each";

struct Options {
  std::uint64_t seed = 0;
  long roads = 100;
  std::string without = kEach;  // as gate_rows takes it
};

Options read_options(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t k = 0; k < words.size(); k += 2) {
    const std::string next = k + 1 < words.size() ? words[k + 1] : "";
    if (words[k] == "--seed") {
      options.seed = std::strtoull(next.c_str(), nullptr, 10);
    } else if (words[k] == "--roads") {
      options.roads = std::strtol(next.c_str(), nullptr, 10);
    } else if (words[k] == "--without") {
      options.without = next;
    } else {
      throw std::runtime_error(words[k] + ": no such option");
    }
  }
  return options;
}

// Adds the gates that failed.
Verdict hear_traced(const Case& tried, GateFailures* failed) {
  const Open open = [failed](const Setup& setup) -> Process {
    const auto engine = std::make_shared<tools::TracedEngine>();
    api::Config loaded;
    *loaded.get() = setup.config;
    if (engine->open(loaded) != POSE_WALL_OK) throw std::runtime_error("the traced engine refuses the config");
    return [engine, failed](const pose_wall_cloud& cloud) {
      pose_wall_result result = api::make_result();
      const std::int32_t status = engine->process(cloud, result);
      if (status != POSE_WALL_OK) throw std::runtime_error(pose_wall_status_text(status));
      failed->add(engine->trace());
      return result;
    };
  };
  return hear(tried, std::vector<Open>{open}).front();
}

struct Worth {
  int roads_failed = 0, values_changed = 0;
  StandingChanges values;
  std::string first_wrong;

  void add(const Finding& before, const Finding& now, std::uint64_t seed) {
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    if (before.state != now.state || !same(before.error, now.error) || !same(before.level, now.level)) ++values_changed;
    const std::size_t wrong_before = values.wrong_more();
    values.add(standing_of(before), standing_of(now));
    if (values.wrong_more() > wrong_before && first_wrong.empty()) first_wrong = "road " + std::to_string(seed);
  }

 private:
  static tools::campaign::Standing standing_of(const Finding& f) {
    return {f.state == POSE_WALL_VALID, f.misleading(), f.beyond() || f.raw_beyond()};
  }
};

void judge_without(const Gates& gates, const Case& tried, const Verdict& before, Worth* worth) {
  const tools::LimitsRestored afterwards;
  tools::campaign::leave_out(gates);
  GateFailures ignored;
  const Verdict now = hear_traced(tried, &ignored);
  ++worth->roads_failed;
  for (std::size_t k = 0; k < before.findings.size(); ++k) worth->add(before.findings[k], now.findings[k], tried.seed);
}

void print(const char* name, const Worth& w) {
  const auto& [valid, misleading, beyond] = w.values;
  std::printf("%-20s %6d %8d  +%zu -%zu  misleading +%zu -%zu  beyond +%zu -%zu  %s\n", name, w.roads_failed,
              w.values_changed, valid.more, valid.fewer, misleading.more, misleading.fewer, beyond.more, beyond.fewer,
              w.first_wrong.c_str());
}

void run(const Options& options) {
  const auto [rows, fault] = tools::campaign::gate_rows(options.without);
  if (!fault.empty()) throw std::runtime_error(fault);
  std::vector<Worth> worth(rows.size());
  for (long k = 0; k < options.roads; ++k) {
    Case tried;
    tried.seed = options.seed + static_cast<std::uint64_t>(k);
    GateFailures failed;
    const Verdict before = hear_traced(tried, &failed);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (failed.most_of(rows[row]) > 0) judge_without(rows[row], tried, before, &worth[row]);
    }
  }
  std::printf("without              roads   values  valid\n");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    print(options.without == kEach ? tools::explain::gate_list()[rows[row].front()].name : "these gates", worth[row]);
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
