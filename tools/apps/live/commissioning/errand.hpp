// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The command `pose_wall` as a child of the daemon, with a low priority: what it works out for minutes must not
// delay what is measured meanwhile.

#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace pose_wall::tools::live {

struct ErrandOutcome {
  int status = 0;              // as the command's --help tells it
  std::string output, errors;  // what it printed; the ends of it, where it was very much
};

// words: "doctor", "--json", ... Waits until it ends. Ends it as soon as `given_up` is true. Throws std::runtime_error
// where it cannot be started, is given up, or ends by a signal.
ErrandOutcome run_errand(const std::vector<std::string>& words, const std::atomic<bool>& given_up);

}  // namespace pose_wall::tools::live
