// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/can/can_commands.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "apps/live/clocks.hpp"
#include "apps/live/edges.hpp"
#include "apps/live/thread_name.hpp"

namespace pose_wall::tools::live {
namespace {

// How long a stop may wait for the thread.
constexpr int kLook_ms = 100;
constexpr double kPerThousand = 1e-3;  // the frame holds mm/s and mrad/s

}  // namespace

CanCommands::CanCommands(std::string interface_name, CommandBoard& commands, OpenCanPort open)
    : interface_(std::move(interface_name)), commands_(commands), open_(std::move(open)) {}

void CanCommands::start() {
  port_ = open_(interface_);
  ending_ = false;
  thread_ = std::thread([this] { run(); });
}

void CanCommands::stop() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
  port_ = CanPort();
}

void CanCommands::run() {
  name_this_thread("commands-can");
  while (!ending_) {
    if (!port_.is_open()) {
      open_again();
      continue;
    }
    pose_wall_can_frame frame{};
    const int status = port_.receive(kLook_ms, &frame);
    if (status == 0) {
      take_frame(frame);
    } else if (status == EBADMSG) {
      commands_.refuse("a frame of another length than 8 bytes");
    } else if (status != EAGAIN) {
      fail(std::strerror(status));
      port_ = CanPort();
    }
  }
}

void CanCommands::open_again() {
  std::this_thread::sleep_for(std::chrono::milliseconds(kLook_ms));
  try {
    port_ = open_(interface_);
    fail("");
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
}

void CanCommands::take_frame(const pose_wall_can_frame& frame) {
  ++frames_;
  pose_wall_can_command command{};
  if (pose_wall_can_read_command(frame.data, &command) == 0) {
    return commands_.refuse("a frame with a wrong CRC, or bytes 6 and 7 are not 0");
  }
  if (counter_ == command.counter) return;
  counter_ = command.counter;
  const DriveMotion motion{command.speed_mm_s * kPerThousand, command.turn_mrad_s * kPerThousand};
  static_cast<void>(commands_.take(motion, monotonic_ns()));
}

void CanCommands::fail(const std::string& why) {
  const std::lock_guard<std::mutex> locked(lock_);
  fault_ = why;
}

PartHealth CanCommands::health() const {
  PartHealth health;
  health.part = "commands can " + interface_;
  const std::lock_guard<std::mutex> locked(lock_);
  health.grade = fault_.empty() ? Grade::kGood : Grade::kBad;
  health.summary = "receives";
  if (!fault_.empty()) health.summary = fault_;
  health.add("frames", frames_.load());
  return health;
}

std::unique_ptr<Sink> make_can_commands(const LoadedConfig& loaded, CommandBoard& commands) {
  const auto id = static_cast<std::uint32_t>(loaded.planar.command_can);
  const bool is_long = loaded.live.can_frames == "j1939";
  return std::make_unique<CanCommands>(loaded.live.can, commands, [id, is_long](const std::string& interface_name) {
    return open_can_reader(interface_name, id, is_long);
  });
}

}  // namespace pose_wall::tools::live
