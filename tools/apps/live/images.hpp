// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What controllers and pages ask for between frames: the images and the counters of this very moment.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/live/health.hpp"
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
  // Of the runtime; nothing where there is none.
  virtual std::optional<pose_wall_runtime_statistics> statistics() const { return std::nullopt; }
};

}  // namespace pose_wall::tools::live
