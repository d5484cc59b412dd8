// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/can/can_sink.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

#include "apps/live/edges.hpp"
#include "apps/live/log.hpp"
#include "can_images.h"

namespace pose_wall::tools::live {
namespace {

using Clock = std::chrono::steady_clock;

// All frames of a publication, 33 of at most 0.64 ms at 250 kbit/s, pass in 22 ms. The next one comes after 100 ms or
// sooner, and its values are newer.
constexpr auto kPatience = std::chrono::milliseconds(40);
// Linux gives an interface a queue of 10 frames, so it is full in each publication; one frame leaves in half of this.
constexpr auto kRest = std::chrono::milliseconds(1);

// Room for the frames of an image, which then shrinks to those that were written.
template <std::uint32_t kFrames, typename Fill>
void add_frames(std::vector<pose_wall_can_frame>* frames, const Fill& fill) {
  const std::size_t before = frames->size();
  frames->resize(before + kFrames);
  frames->resize(before + fill(frames->data() + before));
}

}  // namespace

pose_wall_can_bus can_bus_of(const LiveSettings& settings) {
  pose_wall_can_bus bus{};
  bus.is_j1939 = settings.can_frames == "j1939" ? 1 : 0;
  bus.first = static_cast<std::uint32_t>(settings.can_first);
  if (bus.first == 0) bus.first = bus.is_j1939 != 0 ? POSE_WALL_CAN_FIRST_PGN : POSE_WALL_CAN_FIRST_ID;
  bus.address = static_cast<std::uint32_t>(settings.can_address);
  if (pose_wall_can_bus_is_sound(&bus) == 0) {
    throw std::runtime_error(fmt::format("can: can_first {} leaves no room for {} frames; {}", bus.first,
                                         POSE_WALL_CAN_NUMBERS,
                                         bus.is_j1939 != 0 ? "PGNs from 65280 to 65472 do" : "1 to 1984 do"));
  }
  return bus;
}

CanSink::CanSink(std::string interface_name, const pose_wall_can_bus& bus, const Images& images, const StopBoard* stop,
                 OpenCanPort open)
    : interface_(std::move(interface_name)), bus_(bus), images_(images), stop_(stop), open_(std::move(open)) {}

void CanSink::start() {
  port_ = open_(interface_);
  log_line(Grade::kGood, health().part,
           fmt::format("sends {} frames from {:#x} on", bus_.is_j1939 != 0 ? "J1939" : "11-bit", bus_.first));
}

// As it is now: news may have waited behind the frames of a publication.
void CanSink::add_stop(std::vector<pose_wall_can_frame>* frames) const {
  if (stop_ == nullptr) return;
  const pose_wall_planar_stop_image image = stop_->image_now();
  add_frames<POSE_WALL_CAN_STOP_IMAGE_FRAMES>(
      frames, [&](pose_wall_can_frame* to) { return pose_wall_can_of_stop_image(&image, &bus_, to); });
}

// Another image is another call here.
void CanSink::add_images(std::vector<pose_wall_can_frame>* frames) const {
  const pose_wall_image2 image = images_.image2();
  add_frames<POSE_WALL_CAN_IMAGE2_FRAMES>(
      frames, [&](pose_wall_can_frame* to) { return pose_wall_can_of_image2(&image, &bus_, to); });
  const std::optional<pose_wall_motion_image> motion = images_.motion_image();
  if (!motion) return;
  add_frames<POSE_WALL_CAN_MOTION_IMAGE_FRAMES>(
      frames, [&](pose_wall_can_frame* to) { return pose_wall_can_of_motion_image(&*motion, &bus_, to); });
}

int CanSink::send_all(const std::vector<pose_wall_can_frame>& frames) {
  const Clock::time_point until = Clock::now() + kPatience;
  for (std::size_t i = 0; i < frames.size();) {
    const int status = port_.send(frames[i]);
    if (status == 0) {
      ++sent_;
      ++i;
    } else if (status == EAGAIN && Clock::now() < until) {
      ++waited_;
      std::this_thread::sleep_for(kRest);
    } else {
      lost_ += frames.size() - i;
      return status;
    }
  }
  return 0;
}

void CanSink::fail(const std::string& why) {
  const std::lock_guard<std::mutex> locked(lock_);
  fault_ = why;
}

void CanSink::take(const LiveResult&) {
  std::vector<pose_wall_can_frame> frames;
  add_stop(&frames);
  add_images(&frames);
  send(frames);
}

void CanSink::take_stop(const StopNews&) {
  std::vector<pose_wall_can_frame> frames;
  add_stop(&frames);
  send(frames);
}

// An interface that was taken away, or set up anew, is opened again.
void CanSink::send(const std::vector<pose_wall_can_frame>& frames) {
  try {
    if (!port_.is_open()) port_ = open_(interface_);
  } catch (const std::runtime_error& error) {
    lost_ += frames.size();
    return fail(error.what());
  }
  const int status = send_all(frames);
  if (status == 0) return fail("");
  fail(status == EAGAIN ? "frames do not leave: is another node there that acknowledges them, at this bit rate?"
                        : std::strerror(status));
  if (status != EAGAIN) port_ = CanPort();
}

void CanSink::stop() {
  port_ = CanPort();
}

PartHealth CanSink::health() const {
  PartHealth health;
  health.part = "sink can " + interface_;
  const std::lock_guard<std::mutex> locked(lock_);
  health.grade = fault_.empty() ? Grade::kGood : Grade::kBad;
  health.summary = fault_.empty() ? "sends" : fault_;
  health.add("frames", sent_.load());
  health.add("lost", lost_.load());
  health.add("waits", waited_.load());
  return health;
}

std::unique_ptr<Sink> make_can_sink(const LoadedConfig& loaded, const Images& images, const StopBoard* stop) {
  return std::make_unique<CanSink>(loaded.live.can, can_bus_of(loaded.live), images, stop);
}

}  // namespace pose_wall::tools::live
