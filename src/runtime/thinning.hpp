// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Clouds of which points are left out: when and how many, which ones, and what becomes of the results.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall::runtime {

// When points are left out, and how many. Frames go first: points only when frames were dropped while those that were
// worked took, several in a row, longer than the longest period that is wanted between them.
class Overload {
 public:
  Overload(std::uint32_t thinning_max, std::int64_t frame_period_max_ns)
      : thinning_max_(thinning_max), period_max_ns_(frame_period_max_ns) {}

  // Call after each worked frame, with its thinning, its time, and whether a frame was dropped since the last one. A
  // frame of another thinning than the present one was queued before and does not count.
  void note(std::uint32_t thinning, std::int64_t work_ns, bool dropped) {
    if (thinning != thinning_) return;
    const bool too_slow = work_ns > period_max_ns_;
    // Twice the points take at most twice the time; a quarter of the period stays free, so that it does not swing.
    const bool has_room = thinning_ > 1 && work_ns < period_max_ns_ / 8 * 3;
    slow_ = too_slow ? slow_ + 1 : 0;
    dropped_ = too_slow && (dropped_ || dropped);
    roomy_ = has_room ? roomy_ + 1 : 0;
    if (slow_ >= kSlowFrames && dropped_ && thinning_ * 2 <= thinning_max_) {
      set(thinning_ * 2);
    } else if (roomy_ >= kRoomyFrames) {
      set(thinning_ / 2);
    }
  }

  std::uint32_t thinning() const { return thinning_; }

  // One slow frame may be the machine's, so thinner clouds take more than one, and three are 0.15 to 0.3 s of data that
  // are lost. Full clouds come back after one or two seconds: sooner, a load that swings would change them in turn.
  static constexpr std::uint32_t kSlowFrames = 3;
  static constexpr std::uint32_t kRoomyFrames = 20;  // likewise: see above

 private:
  void set(std::uint32_t thinning) {
    thinning_ = thinning;
    slow_ = roomy_ = 0;
    dropped_ = false;
  }

  std::uint32_t thinning_max_;
  std::int64_t period_max_ns_;
  std::uint32_t thinning_ = 1, slow_ = 0, roomy_ = 0;
  bool dropped_ = false;  // while it was slow
};

// Chooses the returns that stay, by a hash of their number. Every n-th would take away whole lines of a sensor that
// delivers column by column, and any fixed step does so for some number of lines. A hash thins the returns of a
// direction as if by chance, which the engine's test for silent directions allows for (Poisson's law). The same cloud
// is always thinned the same way.
class EvenChoice {
 public:
  explicit EvenChoice(std::uint32_t thinning) : limit_(thinning > 1 ? 0xFFFFFFFFU / thinning : 0xFFFFFFFFU) {}

  bool takes_next() { return mixed(number_++) <= limit_; }

 private:
  // The finalizer of MurmurHash3 (Appleby), which every bit of the number passes to every bit of the hash.
  static std::uint32_t mixed(std::uint32_t h) {
    h = (h ^ h >> 16) * 0x85EBCA6BU;
    h = (h ^ h >> 13) * 0xC2B2AE35U;
    return h ^ h >> 16;
  }

  std::uint32_t limit_;
  std::uint32_t number_ = 0;
};

// Held values may come from a thinned frame: the engine does not know that returns are missing, and holds its
// measurements. This keeps the thinning of the cloud behind each of them. A value that became invalid may be held
// again: the engine still has the good one beside an unconfirmed jump.
class HeldThinning {
 public:
  // Call after each result, with the engine's states. Returns the largest thinning behind its held values; 1: none.
  // thinning: of the frame; 1 for silence.
  std::uint32_t note(const pose_wall_result& result, std::uint32_t thinning) {
    std::uint32_t held = 1;
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const std::uint32_t state = result.quantity[q].state;
      std::uint32_t& past = past_[q];
      if (state == POSE_WALL_HELD && past > held) held = past;
      if (state == POSE_WALL_VALID) past = thinning;
      // A degraded value replaces no good one: either may be held later.
      if (state == POSE_WALL_DEGRADED && past < thinning) past = thinning;
    }
    return held;
  }

  void forget() { *this = HeldThinning(); }
  // For an unknown past, the worst.
  void assume(std::uint32_t thinning) {
    for (std::uint32_t& past : past_) past = thinning;
  }

 private:
  std::uint32_t past_[POSE_WALL_QUANTITIES] = {1, 1, 1, 1, 1, 1, 1};
};

// From the engine's result on its frame to the published result on the frame that came.
inline void finish_result(std::uint32_t left_out_not_finite, std::uint32_t left_out_zero, std::uint32_t thinning,
                          pose_wall_result* result) {
  result->points_in += left_out_not_finite + left_out_zero;
  result->dropped_not_finite += left_out_not_finite;
  result->dropped_zero += left_out_zero;
  if (thinning <= 1) return;
  // The engine cannot know that returns were left out; a gap in a wall may have gone unnoticed.
  for (pose_wall_value& v : result->quantity) {
    if (v.state == POSE_WALL_VALID) v.state = POSE_WALL_DEGRADED;
    if (v.raw_state == POSE_WALL_VALID) v.raw_state = POSE_WALL_DEGRADED;
  }
}

}  // namespace pose_wall::runtime
