// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where results go. Each sink has a thread and a mailbox of its own (sink_thread.hpp), so that a slow one loses results
// of its own and holds up nobody.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apps/live/health.hpp"
#include "apps/live/live_frame.hpp"
#include "apps/live/planar/planar_news.hpp"
#include "pose_wall_runtime.h"

namespace pose_wall::tools::live {

// The voxels of a frame, in base, with what became of each.
struct LabelledPoints {
  std::vector<float> x_base_m, y_base_m, z_base_m;
  std::vector<std::uint8_t> label;  // pose_wall_label
};

// One publication of the runtime with what it came from. Nobody changes it; all sinks share it.
struct LiveResult {
  pose_wall_publication publication{};
  std::string frame_id;                          // of the cloud that was measured; empty for silence
  std::shared_ptr<const LiveFrame> frame;        // that cloud, where the sink wants clouds; none for silence
  std::shared_ptr<const LabelledPoints> points;  // where a sink wanted them
  std::int64_t header_stamp_ns = 0;              // of that cloud; of silence: of the last one that was measured
  pose_wall_config config{};                     // with which it was measured: the extrinsic may come from tf
};

class Sink {
 public:
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  virtual ~Sink() = default;

  // Before the first result, in the daemon's thread. Throws std::runtime_error for what no waiting mends: an address
  // that this machine does not have, a port that is taken, a folder that cannot be written.
  virtual void start() = 0;

  // One result after the other, in the sink's own thread. May be slow. Throws nothing: what goes wrong shows in health.
  virtual void take(const LiveResult& result) = 0;

  // News of the obstacle stop and of the map, between results and like them, where it wants them: of each kind the
  // newest.
  virtual void take_stop(const StopNews& /*news*/) {}
  virtual void take_roadway(const RoadwayNews& /*news*/) {}
  virtual bool wants_planar() const { return false; }

  // After the last take, in the daemon's thread.
  virtual void stop() = 0;

  // From any thread.
  virtual PartHealth health() const = 0;

  // How many results may wait for a slow sink; then the oldest is lost, and counted. 1: only the newest matters.
  virtual std::size_t backlog() const { return 1; }

  // Whether it reads the clouds of results. One that does not is given results without them, so that its backlog holds
  // none. From any thread.
  virtual bool wants_clouds() const { return false; }

  // Whether somebody looks at labelled points just now; they cost a millisecond a frame. Else it is given none. From
  // any thread.
  virtual bool wants_points() const { return false; }
};

}  // namespace pose_wall::tools::live
