// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Commands of the drive from one frame of CAN (can_frames.h). A frame whose counter stands commands nothing new.

#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "apps/live/can/can_port.hpp"
#include "apps/live/planar/command_board.hpp"
#include "apps/live/sink.hpp"

namespace pose_wall::tools::live {

// A part of the daemon that takes no results, as the Modbus server: it has a start, a stop and a health.
class CanCommands final : public Sink {
 public:
  // open: the reader of the frame.
  CanCommands(std::string interface_name, CommandBoard& commands, OpenCanPort open);
  ~CanCommands() override { stop(); }

  void start() override;
  void take(const LiveResult&) override {}
  void stop() override;
  PartHealth health() const override;

 private:
  void run();
  // Waits where the interface is gone.
  void open_again();
  void take_frame(const pose_wall_can_frame& frame);
  void fail(const std::string& why);

  const std::string interface_;
  CommandBoard& commands_;
  const OpenCanPort open_;
  CanPort port_;
  std::optional<std::uint32_t> counter_;  // of the newest command
  std::thread thread_;
  std::atomic<bool> ending_{false};
  std::atomic<std::uint64_t> frames_{0};
  mutable std::mutex lock_;
  std::string fault_;
};

}  // namespace pose_wall::tools::live
