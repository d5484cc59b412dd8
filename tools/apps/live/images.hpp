// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What controllers and pages ask for between frames: the images and the counters of this very moment.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/live/health.hpp"
#include "apps/live/result_counts.hpp"
#include "apps/live/sink.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::tools::live {

// From any thread, without waiting for a frame.
class Images {
 public:
  Images() = default;
  Images(const Images&) = delete;
  Images& operator=(const Images&) = delete;
  virtual ~Images() = default;

  // Always a sound image with a true CRC: what is stale or missing is told invalid (pose_wall_runtime_image).
  virtual pose_wall_image image() const = 0;
  virtual pose_wall_image2 image2() const = 0;
  // Nothing: the key `motion` is off.
  virtual std::optional<pose_wall_motion_image> motion_image() const = 0;
};

// The newest result as pose_wall_runtime_latest tells it at the moment of asking: the one place that says what is
// stale. Where it is not fresh, all of its values are invalid, and nothing of it may steer.
struct Newest {
  std::int32_t status = POSE_WALL_RUNTIME_E_NOTHING;  // of pose_wall_runtime_latest
  LiveResult result{};                                // without cloud and points

  bool is_fresh() const { return status == POSE_WALL_OK; }
  // Whether there is one, fresh or stale.
  bool is_there() const { return is_fresh() || status == POSE_WALL_RUNTIME_E_STALE; }
  // From the frame that the value was measured in until now, by the clock of published_ns. In s.
  double value_age_s(std::uint32_t quantity, std::int64_t now_ns) const {
    const pose_wall_publication& told = result.publication;
    const std::int64_t since_ns = told.cause == POSE_WALL_RUNTIME_FRAME ? told.received_ns : told.published_ns;
    return told.result.quantity[quantity].age_s + static_cast<double>(now_ns - since_ns) * 1e-9;
  }
};

// The health of all parts, the runtime first.
class HealthBoard {
 public:
  HealthBoard() = default;
  HealthBoard(const HealthBoard&) = delete;
  HealthBoard& operator=(const HealthBoard&) = delete;
  virtual ~HealthBoard() = default;

  virtual std::vector<PartHealth> all() const = 0;
  // Threads that hang, in words: what a new start may mend.
  virtual std::vector<std::string> hung() const { return {}; }
  virtual Newest newest() const { return {}; }
  virtual ResultSums sums() const { return {}; }
  // Of the runtime; nothing where there is none.
  virtual std::optional<pose_wall_runtime_statistics> statistics() const { return std::nullopt; }
};

}  // namespace pose_wall::tools::live
