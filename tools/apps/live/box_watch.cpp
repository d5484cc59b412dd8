// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/box_watch.hpp"

#include <fmt/format.h>

#include <cstring>

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {
namespace {

// A disk that lost no record for so long keeps up: a hundred frames, of which it is given each.
constexpr std::int64_t kBehind_ns = 10'000'000'000;

}  // namespace

std::string BoxWatch::trouble_of(const BlackBox& box, const pose_wall_runtime_statistics& now, std::int64_t now_ns) {
  if (lost_.exchange(now.box_lost) < now.box_lost) lost_last_ns_ = now_ns;
  if (box.write == nullptr) return "the black box is not written: its file cannot be made";
  const int fault = box.state ? box.state->fault.load() : 0;
  if (fault != 0) return fmt::format("the black box is not written: {}", std::strerror(fault));
  const std::int64_t lost_ns = lost_last_ns_;
  return lost_ns != 0 && now_ns - lost_ns < kBehind_ns ? "the black box has gaps: its disk is slow" : "";
}

void BoxWatch::tell(const BlackBox& box, const pose_wall_runtime_statistics& now, std::int64_t now_ns,
                    PartHealth* health) {
  const std::string trouble = trouble_of(box, now, now_ns);
  if (!trouble.empty()) {
    if (health->grade == Grade::kGood) health->grade = Grade::kWarning;
    health->summary += "; " + trouble;
  }
  health->add("black box written", now.box_written);
  health->add("black box lost", now.box_lost);
  health->add("black box failed", now.box_failed);
  if (box.state) health->add("black box disk free MB", whole_mb(box.state->free_bytes));
}

}  // namespace pose_wall::tools::live
