// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Whether the black box is written: who needs it after an incident must have known before that there is none.

#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "apps/live/edges.hpp"

namespace pose_wall::tools::live {

class BoxWatch {
 public:
  // A warning of the part where records fail or are lost, until they are written again, and the counts. From any
  // thread. now_ns: by the clock that nobody sets.
  void tell(const BlackBox& box, const pose_wall_runtime_statistics& now, std::int64_t now_ns, PartHealth* health);

 private:
  std::string trouble_of(const BlackBox& box, const pose_wall_runtime_statistics& now, std::int64_t now_ns);

  std::atomic<std::uint64_t> lost_{0};
  std::atomic<std::int64_t> lost_last_ns_{0};  // when one was last seen lost; 0: never
};

}  // namespace pose_wall::tools::live
