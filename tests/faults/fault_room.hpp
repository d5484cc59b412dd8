// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A road with known truth and an engine in it that is followed by the contract: what the fault campaigns share.

#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>

#include "support/contract.hpp"
#include "support/engine_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {

constexpr std::int64_t kPeriod_ns = 100000000;

// What is promised of the time after a fault: a good frame is measured at once, and where it lies further from the last
// good value than the machine can have moved, it is valid when it has come three times more
// (src/engine/output/README.md).
constexpr int kBackWithin = 4;

// The room of room.hpp: the machine stands straight and level in its middle.
constexpr double kRoomTruth[POSE_WALL_QUANTITIES] = {0.0, 0.0, 0.0, 2.5, 2.5, 2.5, 2.5};

inline const Points& room_frame(std::uint32_t seed) {
  static std::map<std::uint32_t, Points> frames;
  Points& points = frames[seed];
  if (points.empty()) points = room_points(seed + 1);
  return points;
}

// The same with steel sets along both walls.
inline const Points& ribbed_room_frame(std::uint32_t seed) {
  static std::map<std::uint32_t, Points> frames;
  Points& points = frames[seed];
  if (points.empty()) points = ribbed_room_points(seed + 1);
  return points;
}

using FramesOf = const Points& (*)(std::uint32_t seed);

inline bool same(const pose_wall_result& a, const pose_wall_result& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// One letter for each of the seven: V valid, D degraded, H held, I invalid.
inline std::string states_of(const pose_wall_result& r) {
  std::string states;
  for (const pose_wall_value& v : r.quantity) states += v.state <= POSE_WALL_VALID ? "IHDV"[v.state] : '?';
  return states;
}

// In a pattern also L (valid or degraded), h (held or invalid), x (not valid), . (any); one letter stands for seven.
inline bool matches(const std::string& states, std::string pattern) {
  if (pattern.size() == 1) pattern.assign(POSE_WALL_QUANTITIES, pattern[0]);
  if (states.size() != pattern.size()) return false;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const char s = states[i], p = pattern[i];
    const bool live = s == 'V' || s == 'D',
               fits = s == p || p == '.' || (p == 'L' && live) || (p == 'h' && !live) || (p == 'x' && s != 'V');
    if (!fits) return false;
  }
  return true;
}

// Empty where every value that is told keeps what its level promises, and none is valid and beyond its alert limit.
inline std::string misleading(const pose_wall_result& r, const double (&truth)[POSE_WALL_QUANTITIES]) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& v = r.quantity[q];
    if (v.state == POSE_WALL_INVALID || std::isnan(truth[q])) continue;
    if (!(std::fabs(v.value - truth[q]) <= v.protection_level)) {
      return std::string(pose_wall_quantity_name(q)) + ": " + pose_wall_state_name(v.state) + ", and wrong";
    }
  }
  return "";
}

class FaultRoom {
 public:
  explicit FaultRoom(const pose_wall_config& config = small_config(), FramesOf frames_of = room_frame)
      : engine_(config), watch_(config), frames_of_(frames_of) {}

  // Whatever the cloud is: processed, and the contract kept.
  pose_wall_result process(const pose_wall_cloud& cloud) {
    const pose_wall_result r = engine_.process(cloud);
    EXPECT_EQ(watch_.processed(r), "") << states_of(r) << " at " << r.stamp_ns;
    return r;
  }
  // A good frame; nothing it tells is wrong.
  pose_wall_result good(std::int64_t stamp_ns) {
    const pose_wall_result r = process(cloud_of(frames_of_(frames_), stamp_ns));
    frames_ += 2;  // never the last one again, nor what a case made of frame 1
    EXPECT_EQ(misleading(r, kRoomTruth), "") << states_of(r) << " at " << stamp_ns;
    return r;
  }
  // Good frames behind `after_ns` until all are valid. How many it took.
  int frames_until_valid(std::int64_t after_ns) {
    for (int frame = 1; frame <= 2 * kBackWithin; ++frame) {
      if (states_of(good(after_ns + frame * kPeriod_ns)) == "VVVVVVV") return frame;
    }
    return 1000;
  }
  pose_wall_engine* engine() { return engine_.get(); }
  ContractWatch& watch() { return watch_; }

 private:
  EngineUnderTest engine_;
  ContractWatch watch_;
  FramesOf frames_of_;
  std::uint32_t frames_ = 0;
};

inline std::string name_of(const char* name) {
  std::string out = name;
  for (char& c : out) {
    if (std::strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789", c) == nullptr) c = '_';
  }
  return out;
}

}  // namespace pose_wall::test
