// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where frames come from: a sensor by UDP, a topic of ROS, a recording.

#pragma once

#include <optional>
#include <string>

#include "apps/live/health.hpp"
#include "apps/live/live_frame.hpp"

namespace pose_wall::tools::live {

// What a source hands its frames to. Any thread, one or several at once; returns before the frame is worked.
class FrameTaker {
 public:
  FrameTaker() = default;
  FrameTaker(const FrameTaker&) = delete;
  FrameTaker& operator=(const FrameTaker&) = delete;
  virtual ~FrameTaker() = default;

  virtual void take(LiveFrame frame) = 0;

  // With extrinsic_from: tf. Nothing: not known (yet, or any more); nothing is measured until it is.
  virtual void set_extrinsic(const std::optional<Extrinsic>& extrinsic) = 0;

  // For a recording: waits until the frames taken so far are worked, so that none is dropped.
  virtual void wait_idle() = 0;
  // Waits a moment for those who keep the results. False: they have no room yet.
  virtual bool wait_for_room() { return true; }
};

class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;

  // Begins to deliver, in a thread of its own. A sensor or master that is not there yet is waited for. Throws
  // std::runtime_error for what no waiting mends: a port that is taken.
  virtual void start(FrameTaker& taker) = 0;

  // Ends within a fraction of a second; after it nothing is delivered. May be called twice, and without start.
  virtual void stop() = 0;

  // From any thread, also before start and after stop.
  virtual PartHealth health() const = 0;

  // A recording that is through.
  virtual bool is_finished() const { return false; }

  // Why it was for nothing, once it is finished; empty when all is well.
  virtual std::string failure() const { return ""; }
};

}  // namespace pose_wall::tools::live
