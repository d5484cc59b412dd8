// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sources/sensor_metadata.hpp"

#include <fmt/format.h>

#ifdef POSE_WALL_LIVE_HAS_HTTP
#include <httplib.h>
#endif

#include <chrono>
#include <stdexcept>
#include <utility>

#include "apps/live/thread_name.hpp"
#include "io/config_file/live_settings.hpp"
#include "io/packets/ouster.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr const char* kHttp = "http://";
constexpr int kHttpPort = 80;  // of http:// without a port (RFC 9110, 4.2.1)
// Ouster's HTTP API of firmware 2.1 and later.
constexpr const char* kPath = "/api/v1/sensor/metadata";
// Metadata of 128 beams has 20 kB.
constexpr std::size_t kMetadataMost = 1'000'000;
constexpr auto kAnswerWithin = std::chrono::seconds(3);
constexpr auto kAskEvery = std::chrono::milliseconds(1000);
// How long a stop may wait between two questions.
constexpr auto kLook = std::chrono::milliseconds(50);

// "http://192.168.1.201/" is what people copy from a browser. Files keep their names.
std::string without_slashes(std::string place) {
  const std::size_t head = std::string(kHttp).size();
  if (place.rfind(kHttp, 0) != 0) return place;
  while (place.size() > head && place.back() == '/') place.pop_back();
  return place;
}

#ifdef POSE_WALL_LIVE_HAS_HTTP
// What failed, and what to try.
std::string words_of(const httplib::Result& answer, bool is_cut) {
  if (is_cut)
    return fmt::format("its answer is longer than {} bytes or takes too long; is this the sensor?", kMetadataMost);
  if (answer) {
    return fmt::format("it answered with status {}; is this an Ouster with firmware 2.1 or later?", answer->status);
  }
  switch (answer.error()) {
    case httplib::Error::Connection:
    case httplib::Error::ConnectionTimeout:
      return "no connection; is the sensor on, its cable in and its address right?";
    case httplib::Error::Read:
      return "connected, but no answer came; is the sensor still starting, and is this its web server?";
    default:
      return fmt::format("failed ({}); is the address right?", httplib::to_string(answer.error()));
  }
}
#endif

// What can never work, in words; "" for what can.
std::string refusal(const std::string& sensor, const std::string& place, bool by_http) {
  const auto kind = sensor_by_name(sensor);
  if (place.rfind("https://", 0) == 0) return "an Ouster answers by http:// alone";
  if (by_http && place.find('/', std::string(kHttp).size()) != std::string::npos) {
    return fmt::format("http://HOST or http://HOST:PORT is expected; the path {} is added", kPath);
  }
  if (by_http && kind && *kind != SensorKind::kAutomatic && *kind != SensorKind::kOuster) {
    return fmt::format("an Ouster tells it by HTTP, a {} does not", known_sensor(*kind).title);
  }
  return "";
}

}  // namespace

// What is wrong stands in *trouble.
std::string SensorMetadata::ask(std::string* trouble) {
#ifdef POSE_WALL_LIVE_HAS_HTTP
  httplib::Client client(place_);
  client.set_connection_timeout(0, 500'000);
  client.set_read_timeout(1, 0);
  const auto set_cancel = [this](std::function<void()> cancel) {
    const std::lock_guard<std::mutex> locked(lock_);
    cancel_ = std::move(cancel);
  };
  set_cancel([&client] { client.stop(); });
  std::string body;
  const auto until = std::chrono::steady_clock::now() + kAnswerWithin;
  const auto answer = client.Get(kPath, [&](const char* bytes, std::size_t count) {
    body.append(bytes, count);
    return body.size() <= kMetadataMost && std::chrono::steady_clock::now() < until && !ending_;
  });
  set_cancel(nullptr);
  if (answer && answer->status == 200) return body;
  const std::string named = place_.substr(std::string(kHttp).size());
  const std::optional<HostPort> at = parse_host_port(named);
  const bool is_cut = !answer && answer.error() == httplib::Error::Canceled;
  *trouble =
      fmt::format("the sensor's metadata: host {}, port {}, path {}: {} It is asked again; try: curl {}{}",
                  at ? at->host : named, at ? at->port : kHttpPort, kPath, words_of(answer, is_cut), place_, kPath);
  return "";
#else
  *trouble = fmt::format(
      "the sensor's metadata: {}: this build has no HTTP: install libcpp-httplib-dev, configure and "
      "build again, or give the metadata as a file",
      place_);
  return "";
#endif
}

SensorMetadata::SensorMetadata(const std::string& sensor, const std::string& place)
    : place_(without_slashes(place)), by_http_(place.rfind(kHttp, 0) == 0) {
  const std::string refused = refusal(sensor, place_, by_http_);
  if (!refused.empty()) throw std::runtime_error(fmt::format("sensor_metadata: {}: {}", place, refused));
  try {
    choice_ = choose_sensor({sensor, by_http_ ? "" : place_});
  } catch (const FrameError& fault) {
    throw std::runtime_error(fault.what());
  }
  if (by_http_) ask_again();
}

SensorMetadata::~SensorMetadata() {
  stop();
}

void SensorMetadata::stop() {
  ending_ = true;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    if (cancel_) cancel_();
  }
  if (thread_.joinable()) thread_.join();
}

void SensorMetadata::ask_again() {
  if (!by_http_ || asking_) return;
  stop();
  ending_ = false;
  asking_ = true;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    choice_.metadata.clear();
  }
  thread_ = std::thread([this] { ask_until_told(); });
}

void SensorMetadata::ask_until_told() {
  name_this_thread("sensor-metadata");
  while (!ending_) {
    std::string trouble, text = ask(&trouble);
    if (!text.empty()) {
      try {
        parse_ouster_metadata(text);
      } catch (const FrameError& fault) {
        trouble = fmt::format("the sensor's metadata: {}: {}", place_, fault.what());
        text.clear();
      }
    }
    {
      const std::lock_guard<std::mutex> locked(lock_);
      choice_.metadata = text;
      trouble_ = trouble;
    }
    if (!text.empty()) break;
    for (auto waited = kLook; waited < kAskEvery && !ending_; waited += kLook) std::this_thread::sleep_for(kLook);
  }
  asking_ = false;
}

std::unique_ptr<ScanAssembler> SensorMetadata::assembler() {
  const std::lock_guard<std::mutex> locked(lock_);
  if (by_http_ && choice_.metadata.empty()) return nullptr;
  return make_assembler(choice_);
}

std::string SensorMetadata::of_ouster() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return is_ouster_metadata(choice_.metadata) ? choice_.metadata : "";
}

std::uint16_t SensorMetadata::usual_port() const {
  const std::lock_guard<std::mutex> locked(lock_);
  if (by_http_ || is_ouster_metadata(choice_.metadata)) return known_sensor(SensorKind::kOuster).port;
  const std::uint16_t port = known_sensor(choice_.kind).port;
  return port != 0 ? port : known_sensor(SensorKind::kVlp16).port;
}

std::uint16_t SensorMetadata::usual_device_port() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return known_sensor(choice_.kind).device_port;
}

std::string SensorMetadata::trouble() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return trouble_;
}

}  // namespace pose_wall::tools::live
