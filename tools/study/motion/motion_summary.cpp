// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/motion_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/frames/frame_stamps.hpp"
#include "io/language/language.hpp"
#include "io/terminal/frames_text.hpp"
#include "io/terminal/share_text.hpp"
#include "io/terminal/text_table.hpp"
#include "study/motion/directions.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kMotionReasonsShown = 5;

}  // namespace

void MotionSummary::add(const MotionOutcome& outcome) {
  ++frames_;
  if (!outcome.result) {
    ++unreadable_;
    return;
  }
  const pose_wall_motion_result& result = *outcome.result;
  if (processed() == 1) first_stamp_ns_ = outcome.stamp_ns;
  last_stamp_ns_ = outcome.stamp_ns;
  const std::size_t state = std::min<std::size_t>(result.along_state, kStates - 1);
  if (states_[state]++ == 0) first_of_state_[state] = say("frame {} ({})", outcome.frame, outcome.source);
  for (std::uint32_t bit = 0; bit < POSE_WALL_MOTION_REASON_COUNT; ++bit) reasons_[bit] += result.reasons >> bit & 1U;
  sum_ms_ += outcome.total_ms;
  if (outcome.total_ms > worst_ms_) {
    worst_ms_ = outcome.total_ms;
    worst_frame_ = outcome.frame;
  }
  if (result.along_state != POSE_WALL_ALONG_LOST) {
    has_along_ = true;
    along_m_ = result.along_m;
    along_level_m_ = result.protection_level[POSE_WALL_MOTION_ALONG];
    for (std::size_t d = 0; d < level_max_.size(); ++d) {
      if (!(result.protection_level[d] > level_max_[d])) continue;
      level_max_[d] = result.protection_level[d];
      level_max_frame_[d] = outcome.frame;
    }
  }
}

std::string MotionSummary::text(double wall_s) const {
  std::string text = states_text() + travel_text() + levels_text() + times_text(wall_s) + reasons_text();
  if (unreadable_ > 0) text += say("unreadable: {} of {}\n", unreadable_, frames_text(frames_));
  return text + advice();
}

std::string MotionSummary::states_text() const {
  TextTable table({tr("along the road"), tr("frames"), tr("share"), tr("first time")});
  for (std::size_t state = kStates; state-- > 0;) {
    table.add_row({tr(pose_wall_motion_along_state_name(static_cast<std::uint32_t>(state))),
                   std::to_string(states_[state]), share_text(states_[state], processed()), first_of_state_[state]});
  }
  return table.text() + '\n';
}

std::string MotionSummary::travel_text() const {
  if (!has_along_) return tr("travel along the road: unknown\n");
  const std::string level =
      std::isfinite(along_level_m_) ? say("within {:.3f} m", along_level_m_) : tr("without a level");
  return say("travel along the road: {:.3f} m, {}, in {:.1f} s\n", along_m_, level,
             seconds_between(first_stamp_ns_, last_stamp_ns_));
}

std::string MotionSummary::levels_text() const {
  if (!has_along_) return "";
  TextTable table({tr("largest level"), "", tr("at frame")});
  for (std::uint32_t d = 0; d < POSE_WALL_MOTION_DIRECTIONS; ++d) {
    table.add_row({tr(pose_wall_motion_direction_name(d)), direction_amount(d, level_max_[d]),
                   std::to_string(level_max_frame_[d])});
  }
  return '\n' + table.text() + '\n';
}

std::string MotionSummary::times_text(double wall_s) const {
  if (processed() == 0) return say("{}, none processed\n", frames_text(frames_));
  return say("motion, per frame: mean {:.2f} ms, worst {:.2f} ms (frame {}); {} in {:.1f} s with reading\n",
             sum_ms_ / static_cast<double>(processed()), worst_ms_, worst_frame_, frames_text(frames_), wall_s);
}

std::string MotionSummary::reasons_text() const {
  std::vector<std::uint32_t> order(reasons_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [this](std::uint32_t a, std::uint32_t b) { return reasons_[a] > reasons_[b]; });
  order.resize(std::min(order.size(), kMotionReasonsShown));
  std::string text;
  for (const std::uint32_t bit : order) {
    if (reasons_[bit] == 0) break;
    text += reasons_[bit] == 1 ? say("{:>6} frame:  {} ({})\n", reasons_[bit], pose_wall_motion_reason_name(bit),
                                     tr(pose_wall_motion_reason_text(bit)))
                               : say("{:>6} frames: {} ({})\n", reasons_[bit], pose_wall_motion_reason_name(bit),
                                     tr(pose_wall_motion_reason_text(bit)));
  }
  return text.empty() ? text : tr("most frequent reasons:\n") + text;
}

std::string MotionSummary::advice() const {
  if (processed() == 0) return "";
  if (states_[POSE_WALL_ALONG_LOST] > 0) {
    return say(
        "To look at next: where it was lost, first at {}. Is the mounting right (check-config), are frames missing, is "
        "something close before the sensor?\n",
        first_of_state_[POSE_WALL_ALONG_LOST]);
  }
  if (2 * states_[POSE_WALL_ALONG_UNOBSERVABLE] > processed()) {
    return say(
        "To look at next: nothing told the way along in {}. On a smooth lining only a speed of the machine's own "
        "bounds "
        "it; else see the column reason.\n",
        share_text(states_[POSE_WALL_ALONG_UNOBSERVABLE], processed()));
  }
  if (2 * states_[POSE_WALL_ALONG_AMBIGUOUS] > processed()) {
    return tr(
        "To look at next: two places fitted alike in most frames, as sets of one pitch do: see second_m; a lower "
        "motion_speed_max narrows the search.\n");
  }
  return tr(
      "To look at next: pose_wall report on the table draws path, states and travel; pose_wall eval compares it with "
      "a truth.\n");
}

}  // namespace pose_wall::tools
