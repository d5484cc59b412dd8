// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The process images on CAN: with each publication all frames of each image, of a frame or of silence. The frames of
// the obstacle stop go first, and by themselves with its news: each sensor frame, each change, ten times a second.

#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "apps/live/can/can_port.hpp"
#include "apps/live/images.hpp"
#include "apps/live/sink.hpp"
#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

// On which identifiers the settings put frames. Throws std::runtime_error where they leave no room for all of them.
pose_wall_can_bus can_bus_of(const LiveSettings& settings);

class CanSink final : public Sink {
 public:
  // stop: none where the planar part is off.
  CanSink(std::string interface_name, const pose_wall_can_bus& bus, const Images& images, const StopBoard* stop,
          OpenCanPort open = open_can_port);

  void start() override;
  void take(const LiveResult& result) override;
  bool wants_planar() const override { return stop_ != nullptr; }
  void take_stop(const StopNews& news) override;
  void stop() override;
  PartHealth health() const override;

 private:
  void add_stop(std::vector<pose_wall_can_frame>* frames) const;
  void add_images(std::vector<pose_wall_can_frame>* frames) const;
  void send(const std::vector<pose_wall_can_frame>& frames);
  // 0, or why not all were sent.
  int send_all(const std::vector<pose_wall_can_frame>& frames);
  void fail(const std::string& why);

  const std::string interface_;
  const pose_wall_can_bus bus_;
  const Images& images_;
  const StopBoard* const stop_;
  const OpenCanPort open_;
  CanPort port_;
  std::atomic<std::uint64_t> sent_{0}, lost_{0}, waited_{0};
  mutable std::mutex lock_;
  std::string fault_;
};

}  // namespace pose_wall::tools::live
