// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Runs by the engine that takes notes, with other limits than the table's where these are set before.

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "lab/campaign/runner.hpp"
#include "pose_wall_trace.h"
#include "study/explain/traced_frame.hpp"

namespace pose_wall::tools::campaign {

template <typename Seen>
struct TracedRun {
  RunRecord record;
  Seen seen;
};

// visit(trace, &seen) sees the notes on each frame. Throws as work_on does.
template <typename Seen, typename Visit>
std::vector<TracedRun<Seen>> traced_runs(const EngineChoice& choice, const std::vector<Run>& runs, const Crew& crew,
                                         const Visit& visit) {
  std::vector<TracedRun<Seen>> done(runs.size());
  work_on(runs, crew, [&]() -> RunWork {
    const auto engine = std::make_shared<TracedEngine>();
    return [&, engine](const Run& run, const std::function<void()>& on_frame) {
      TracedRun<Seen>& out = done.at(static_cast<std::size_t>(&run - runs.data()));
      const Instrument instrument = {[&](const LoadedConfig& loaded) { return engine->open(loaded.config); },
                                     [&](const pose_wall_cloud& cloud, pose_wall_result& result) {
                                       const std::int32_t status = engine->process(cloud, result);
                                       if (status == POSE_WALL_OK) visit(engine->trace(), &out.seen);
                                       return status;
                                     }};
      out.record = measure(run, choice, instrument, on_frame);
    };
  });
  return done;
}

}  // namespace pose_wall::tools::campaign
