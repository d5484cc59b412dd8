// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_walld as a whole: a source, the runtime and the sinks, from start to a clean stop.

#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "apps/live/edges.hpp"
#include "apps/live/host_clock.hpp"
#include "apps/live/images.hpp"
#include "apps/live/live_runtime.hpp"
#include "apps/live/log.hpp"
#include "apps/live/planar/stop_guard.hpp"
#include "apps/live/service_manager.hpp"
#include "apps/live/setting_changes.hpp"
#include "apps/live/sink_thread.hpp"
#include "apps/live/source.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

class Daemon final : public HealthBoard {
 public:
  // replay: instead of the config's source. Throws EdgeMissing, and std::runtime_error as LiveRuntime.
  Daemon(const LoadedConfig& loaded, const std::optional<ReplayPlan>& replay);
  ~Daemon() override { stop(); }

  // What is asked from outside.
  struct Wishes {
    const std::atomic<bool>& stop;
    // Become false as they are heeded. looked: somebody has looked around the machine (StopGuard::confirm). reload: the
    // settings are to be read again.
    std::atomic<bool>&looked, &reload;
    std::function<LoadedConfig()> read_settings;
    std::function<void()> is_through;  // called once before the parts end where nobody asked for it
  };

  // Until `stop` is true, or a recording is through. Throws what the starts of source and sinks throw, and
  // std::runtime_error for a recording that could not be played to its end or holds no cloud.
  void run(const Wishes& wishes);

  // Whether it ended to be started again with settings that were saved meanwhile.
  bool restarts() const { return restarts_; }

  std::vector<PartHealth> all() const override;
  std::vector<std::string> hung() const override;
  Newest newest() const override { return runtime_.newest(); }
  ResultSums sums() const override { return runtime_.sums(); }
  std::optional<pose_wall_runtime_statistics> statistics() const override { return runtime_.statistics(); }

 private:
  class Taker;

  void make_planar();
  void make_edges(const std::optional<ReplayPlan>& replay);
  void add(std::unique_ptr<Sink> sink);
  void add(RosEdge edge);
  void post(const std::shared_ptr<const LiveResult>& result);
  void log_start() const;
  void log_status() const;
  void start();
  void stop();
  void look_around(const Wishes& wishes);
  void take_settings(const std::function<LoadedConfig()>& read);

  LoadedConfig loaded_;
  LiveRuntime runtime_;
  std::unique_ptr<CommandBoard> commands_;  // where a key names a place that they come from
  std::unique_ptr<FrameTaker> taker_;
  std::unique_ptr<Source> source_;
  std::unique_ptr<StopGuard> guard_;  // where the key `planar` is on
  std::unique_ptr<SinkThread> roadway_;
  std::vector<std::unique_ptr<SinkThread>> sinks_;
  std::atomic<bool> restarts_{false};
  ServiceManager service_;
  HostClock host_clock_;
  HealthLog health_log_;
  SettingReadings readings_;
  std::atomic<std::int64_t> looked_ns_{0};  // when the daemon's own loop last went round; 0: not yet
};

}  // namespace pose_wall::tools::live
