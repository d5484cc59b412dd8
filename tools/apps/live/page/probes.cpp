// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"

namespace pose_wall::tools::live {

Probe live_probe(const Moment& moment) {
  return {moment.hung.empty(), moment.hung};
}

Probe ready_probe(const Moment& moment) {
  Probe probe;
  if (!moment.newest.is_there()) {
    probe.why.emplace_back("nothing was published yet");
  } else if (!moment.newest.is_fresh()) {
    probe.why.emplace_back("the newest result is stale");
  } else if (moment.newest.result.publication.cause != POSE_WALL_RUNTIME_FRAME) {
    probe.why.emplace_back("no frame comes");
  }
  probe.is_well = probe.why.empty();
  if (probe.is_well) return probe;
  // What the runtime and the source know of it.
  for (std::size_t k = 0; k < std::min<std::size_t>(2, moment.parts.size()); ++k) {
    const PartHealth& part = moment.parts[k];
    if (part.grade != Grade::kGood) probe.why.push_back(fmt::format("{}: {}", part.part, part.summary));
  }
  return probe;
}

std::string probe_json(const char* name, const Probe& probe) {
  return json_text({{"schema", 1}, {name, probe.is_well}, {"why", probe.why}});
}

}  // namespace pose_wall::tools::live
