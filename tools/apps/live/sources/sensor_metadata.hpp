// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a sensor says of itself, from a file or from the sensor's web server, and the assembler that it leads to. A
// sensor that is not up yet is asked again, in a thread of its own.

#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "io/packets/sensors.hpp"

namespace pose_wall::tools::live {

class SensorMetadata {
 public:
  // sensor: a name of known_sensors(). place: a file, http://HOST or http://HOST:PORT of an Ouster, or nothing. A file
  // is read at once: throws std::runtime_error for it, and for what never goes together.
  SensorMetadata(const std::string& sensor, const std::string& place);
  ~SensorMetadata();
  SensorMetadata(const SensorMetadata&) = delete;
  SensorMetadata& operator=(const SensorMetadata&) = delete;

  // Of its packets; nothing while the sensor has not told yet. Throws FrameError for metadata that does not fit.
  std::unique_ptr<ScanAssembler> assembler();
  // What an Ouster says of itself; "": another sensor, or not told yet.
  std::string of_ouster() const;
  // After the sensor was gone: it may tell something else now.
  void ask_again();

  // Asks no more, at once.
  void stop();

  std::uint16_t usual_port() const;
  // Of packets in which the sensor describes itself; 0: none, or not known.
  std::uint16_t usual_device_port() const;
  // Why it is not known, in words; empty when all is well. From any thread.
  std::string trouble() const;

 private:
  void ask_until_told();
  std::string ask(std::string* trouble);

  std::string place_;
  bool by_http_ = false;
  mutable std::mutex lock_;
  SensorChoice choice_;
  std::string trouble_;
  std::function<void()> cancel_;  // the question under way, if any
  std::thread thread_;
  std::atomic<bool> ending_{false}, asking_{false};
};

}  // namespace pose_wall::tools::live
