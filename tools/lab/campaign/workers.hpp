// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Works on the runs of a campaign, several at a time.

#pragma once

#include <functional>
#include <vector>

#include "lab/campaign/plan.hpp"

namespace pose_wall::tools::campaign {

struct Crew {
  unsigned jobs = 1;
  bool tell_progress = false;  // a bar on a terminal, else a line for every tenth
};

// One run; `on_frame` is to be called after each of its frames.
using RunWork = std::function<void(const Run&, const std::function<void()>& on_frame)>;

// `make_worker` is called once a thread. What goes wrong in one run ends them all; the first such error is thrown.
// Ctrl-C ends them with the frame they are at: Interrupted. The records of the runs that were done by then are there.
void work_on(const std::vector<Run>& runs, const Crew& crew, const std::function<RunWork()>& make_worker);

}  // namespace pose_wall::tools::campaign
