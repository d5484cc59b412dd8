// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/gates_left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lab/campaign/limit_words.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/traced_frame.hpp"

namespace pose_wall::tools::campaign {
namespace {

// The fit takes a plane as given: without it there is nothing to begin with.
bool is_indispensable(std::uint32_t gate) {
  return gate == POSE_WALL_TRACE_FLOOR_PLANES;
}

}  // namespace

GateRows gate_rows(const std::string& words) {
  GateRows asked;
  if (words == "each") {
    for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES; ++gate) {
      if (!is_indispensable(gate)) asked.rows.push_back({gate});
    }
    return asked;
  }
  asked.rows.emplace_back();
  for (const std::string& name : words_between_commas(words)) {
    const std::optional<std::uint32_t> gate = explain::find_gate(name);
    if (!gate) {
      constexpr const char* kAllowed = "; 'each' and the names of `pose_wall explain --gates` are allowed";
      return {{}, explain::no_gate_text(name, kAllowed)};
    }
    if (is_indispensable(*gate)) return {{}, fmt::format("{} cannot go: the fit needs a plane", name)};
    asked.rows.back().push_back(*gate);
  }
  return asked;
}

void leave_out(const Gates& gates) {
  for (const std::uint32_t gate : gates) pose_wall_trace_let_pass(gate);
}

void GateFailures::add(const pose_wall_trace& trace) {
  for (std::uint32_t gate = 0; gate < frames_.size(); ++gate) {
    if (has_failed(trace, gate)) ++frames_[gate];
  }
}

std::size_t GateFailures::most_of(const Gates& gates) const {
  std::size_t most = 0;
  for (const std::uint32_t gate : gates) most = std::max(most, frames_.at(gate));
  return most;
}

void MoreAndFewer::add(bool with_all, bool without) {
  if (without && !with_all) ++more;
  if (with_all && !without) ++fewer;
}

void StandingChanges::add(const Standing& with_all, const Standing& without) {
  valid.add(with_all.valid, without.valid);
  misleading.add(with_all.misleading, without.misleading);
  beyond.add(with_all.beyond, without.beyond);
}

}  // namespace pose_wall::tools::campaign
