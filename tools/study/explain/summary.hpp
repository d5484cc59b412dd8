// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A whole recording in short: states and levels of the seven quantities, reasons, stretches of frames alike, and the
// frames that are worth a look. Memory is bounded, whatever the length of the recording.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pose_wall.h"
#include "pose_wall_trace.h"
#include "study/explain/story.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools::explain {

// Numbers for a median. Of long rows every 2nd, 4th, ... is kept, so that at most 65,536 are stored.
class ThinnedRow {
 public:
  void add(double value);
  double median() const;  // NaN where there is none

 private:
  std::vector<double> kept_;
  std::size_t seen_ = 0, stride_ = 1;
};

struct QuantitySummary {
  std::array<std::size_t, 4> states{};                 // by pose_wall_state
  ThinnedRow levels;                                   // of frames in which the value is not invalid
  std::array<std::size_t, POSE_WALL_PARTS> largest{};  // how often each part was the level's largest

  std::size_t with_cause() const;
  std::uint32_t cause() const;  // the part that was largest most often; POSE_WALL_PARTS where there is none
};

struct ReasonSummary {
  std::size_t frames = 0;
  std::vector<std::uint32_t> gates;  // that failed with it in the frames that were traced, in the order of the pipeline
};

// Frames alike, wherever they stand.
struct StorySummary {
  Story story;
  std::size_t frames = 0;
  std::uint64_t first = 0;
};

// Frames alike in a row, with a reason in common.
struct Stretch {
  std::uint64_t first, last;
  Story story;
  std::uint64_t frames() const { return last - first + 1; }
};

// How bad a frame is: the sum of the seven states, where less is worse; then the largest level over its alert limit.
struct Badness {
  std::uint64_t frame = 0;
  std::uint32_t states = 0;
  double ratio = 0.0;                           // level over limit; 0 where no value has a level
  std::uint32_t widest = POSE_WALL_QUANTITIES;  // whose level that is
  bool is_worse_than(const Badness& other) const;
};

class RecordingSummary {
 public:
  explicit RecordingSummary(const pose_wall_config& config);

  // Both before the frame is added. is_new: it is the first of its story or has a reason without notes so far, so that
  // its notes are worth their time. is_worst: it is worse than all before. Few frames are either.
  bool is_new(const pose_wall_result& result) const;
  bool is_worst(const pose_wall_result& result) const;
  // Notes of such a frame: its gates will stand beside the reasons.
  void add_notes(const pose_wall_result& result, const pose_wall_trace& trace);

  // Frames in their order.
  void add(const FrameOutcome& outcome);

  std::size_t frames() const { return frames_; }
  std::size_t unreadable() const { return unreadable_; }
  const std::array<QuantitySummary, POSE_WALL_QUANTITIES>& quantities() const { return quantities_; }
  const std::array<ReasonSummary, POSE_WALL_REASON_COUNT>& reasons() const { return reasons_; }
  std::vector<StorySummary> stories() const;  // most frequent first
  std::size_t stretch_count() const { return stretch_count_; }
  std::vector<Stretch> longest_stretches(std::size_t most) const;  // in the order of the recording

  // Nothing where no frame could be read.
  const std::optional<Badness>& worst() const { return worst_; }
  const std::optional<Badness>& widest() const { return widest_; }

 private:
  Badness badness_of(const pose_wall_result& result) const;
  void add_story(const Story& story);

  std::array<double, POSE_WALL_QUANTITIES> alert_limit_;  // rad or m
  std::size_t frames_ = 0, unreadable_ = 0, traced_ = 0, stretch_count_ = 0;
  std::array<QuantitySummary, POSE_WALL_QUANTITIES> quantities_;
  std::array<ReasonSummary, POSE_WALL_REASON_COUNT> reasons_;
  std::map<std::pair<StoryKind, std::uint32_t>, StorySummary> stories_;  // by kind and subjects: some dozens at most
  std::uint32_t traced_reasons_ = 0;
  std::vector<Stretch> stretches_;
  std::optional<Badness> worst_, widest_;
};

// A frame worth a look, and why.
struct FrameToSee {
  std::uint64_t frame;
  std::vector<std::string> why;
};
// The worst frame first, then the widest level, then the first frames of the most frequent stories.
std::vector<FrameToSee> frames_to_see(const RecordingSummary& summary);

}  // namespace pose_wall::tools::explain
