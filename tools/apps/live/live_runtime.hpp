// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The runtime (pose_wall_runtime.h) between sources and sinks: it takes frames from any thread, measures them in its
// own and posts each result to all sinks. A new extrinsic opens it anew.

#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <vector>

#include "apps/live/box_watch.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/images.hpp"
#include "apps/live/result_counts.hpp"
#include "apps/live/sink.hpp"
#include "apps/live/source.hpp"
#include "apps/live/times_watch.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

class LiveRuntime final : public FrameTaker, public Images {
 public:
  // On the runtime's thread, for each publication; it must not wait.
  using Post = std::function<void(const std::shared_ptr<const LiveResult>&)>;

  // open_box: a file of its own for each opening. wants_points: asked before each result. Throws std::runtime_error
  // where the runtime refuses options or config.
  LiveRuntime(const LoadedConfig& loaded, std::function<BlackBox()> open_box, Post post,
              std::function<bool()> wants_points);
  ~LiveRuntime() override;

  // Sees each frame before the engine does, with the config that holds for it, in the source's thread; it must not
  // wait.
  using Watch = std::function<void(const std::shared_ptr<const LiveFrame>&, const pose_wall_config&)>;
  // Before start.
  void watch_frames(Watch watch) { watch_ = std::move(watch); }

  void start();
  void stop();

  void take(LiveFrame frame) override;
  void set_extrinsic(const std::optional<Extrinsic>& extrinsic) override;
  void wait_idle() override;

  pose_wall_image image() const override;
  pose_wall_image2 image2() const override;
  std::optional<pose_wall_motion_image> motion_image() const override;
  Newest newest() const;
  ResultSums sums() const;
  // False when the worker has been at one thing for so long that it hangs.
  bool is_alive() const;
  PartHealth health() const;
  pose_wall_runtime_statistics statistics() const;

 private:
  void take_extrinsic(const std::optional<Extrinsic>& extrinsic);
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  struct Settings {
    std::string lidar_frame;
    bool extrinsic_by_tf = false, has_box = false;
    std::uint32_t frame_points_max = 0;
    std::int32_t worker_priority = 0;
    pose_wall_motion_settings motion{};
  };

  static void called_back(void* user, const pose_wall_publication* publication);
  void publish(const pose_wall_publication& publication);
  void open();
  void prepare_box();
  void close();
  std::optional<api::Config> with_extrinsic(const Extrinsic& extrinsic) const;
  void reopen(const api::Config& config);
  std::shared_ptr<const LiveFrame> note_publication(LiveResult* result);
  std::shared_ptr<const LabelledPoints> points() const;
  std::int32_t latest(pose_wall_publication* newest) const;
  void add_runtime_facts(PartHealth* health) const;
  void add_box_facts(PartHealth* health) const;

  api::Config config_;
  Settings settings_;
  std::function<BlackBox()> open_box_;
  BlackBox box_, spare_box_;  // spare: opened before the runtime that will write it
  Post post_;
  std::function<bool()> wants_points_;
  Watch watch_;

  mutable std::shared_mutex handle_lock_;  // unique: opens and closes; shared: calls
  std::vector<Line> block_;
  pose_wall_runtime* runtime_ = nullptr;
  bool started_ = false;

  std::mutex take_lock_;  // frames come in one row, and each knows its number before it is pushed
  std::uint64_t next_number_ = 0;
  std::optional<Extrinsic> extrinsic_, refused_extrinsic_;
  std::int64_t reopened_ns_ = 0;

  mutable std::mutex frames_lock_;
  std::map<std::uint64_t, std::shared_ptr<const LiveFrame>> frames_;
  LiveResult last_;  // the last publication, without cloud and points

  TimesWatch times_;
  mutable BoxWatch box_watch_;
  std::optional<ResultCounts> counts_;  // from the first opening on

  std::atomic<bool> has_extrinsic_{false};
  std::atomic<std::uint64_t> without_extrinsic_{0}, opened_{0};
  std::atomic<std::int32_t> last_refusal_{POSE_WALL_OK};
};

}  // namespace pose_wall::tools::live
