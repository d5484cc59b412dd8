// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "live/sources/sensor_metadata.hpp"

#include <fmt/format.h>

#ifdef POSE_WALL_LIVE_HAS_HTTP
#include <httplib.h>
#endif

#include <chrono>
#include <stdexcept>

#include "config_file/live_settings.hpp"
#include "packets/ouster.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr const char* kHttp = "http://";
constexpr int kHttpPort = 80;
// Ouster's HTTP API of firmware 2.1 and later.
constexpr const char* kPath = "/api/v1/sensor/metadata";
// Metadata of 128 beams has 20 kB.
constexpr std::size_t kMetadataMost = 1'000'000;
constexpr auto kAnswerWithin = std::chrono::seconds(3);
constexpr auto kAskEvery = std::chrono::milliseconds(1000);
// How long a stop may wait between two questions.
constexpr auto kLook = std::chrono::milliseconds(50);

// "http://192.168.1.201/" is what people copy from a browser.
std::string without_slashes(std::string place) {
  while (place.size() > std::string(kHttp).size() && place.back() == '/') place.pop_back();
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
      return "no connection; is the sensor on, its cable in and its address right?";
    case httplib::Error::Read:
      return "connected, but no answer came; is the sensor still starting, and is this its web server?";
    default:
      return fmt::format("failed ({}); is the address right?", httplib::to_string(answer.error()));
  }
}
#endif

// What is wrong stands in *trouble.
std::string ask(const std::string& host, std::string* trouble) {
#ifdef POSE_WALL_LIVE_HAS_HTTP
  httplib::Client client(host);
  client.set_connection_timeout(0, 500'000);
  client.set_read_timeout(1, 0);
  std::string body;
  const auto until = std::chrono::steady_clock::now() + kAnswerWithin;
  const auto answer = client.Get(kPath, [&](const char* bytes, std::size_t count) {
    body.append(bytes, count);
    return body.size() <= kMetadataMost && std::chrono::steady_clock::now() < until;
  });
  if (answer && answer->status == 200) return body;
  const std::string named = host.substr(std::string(kHttp).size());
  const std::optional<HostPort> at = parse_host_port(named);
  const bool is_cut = !answer && answer.error() == httplib::Error::Canceled;
  *trouble =
      fmt::format("the sensor's metadata: host {}, port {}, path {}: {} It is asked again; try: curl {}{}",
                  at ? at->host : named, at ? at->port : kHttpPort, kPath, words_of(answer, is_cut), host, kPath);
  return "";
#else
  *trouble = fmt::format(
      "the sensor's metadata: {}: this build has no HTTP: install libcpp-httplib-dev, configure and "
      "build again, or give the metadata as a file",
      host);
  return "";
#endif
}

}  // namespace

SensorMetadata::SensorMetadata(const std::string& sensor, const std::string& place)
    : place_(without_slashes(place)), by_http_(place.rfind(kHttp, 0) == 0) {
  try {
    choice_ = choose_sensor({sensor, by_http_ ? "" : place_});
  } catch (const FrameError& fault) {
    throw std::runtime_error(fault.what());
  }
  if (by_http_) ask_again();
}

SensorMetadata::~SensorMetadata() {
  end();
}

void SensorMetadata::end() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
}

void SensorMetadata::ask_again() {
  if (!by_http_ || asking_) return;
  end();
  ending_ = false;
  asking_ = true;
  {
    const std::lock_guard<std::mutex> locked(lock_);
    choice_.metadata.clear();
  }
  thread_ = std::thread([this] { ask_until_told(); });
}

void SensorMetadata::ask_until_told() {
  while (!ending_) {
    std::string trouble, text = ask(place_, &trouble);
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

std::uint16_t SensorMetadata::usual_port() const {
  const std::lock_guard<std::mutex> locked(lock_);
  if (by_http_ || is_ouster_metadata(choice_.metadata)) return known_sensor(SensorKind::kOuster).port;
  const std::uint16_t port = known_sensor(choice_.kind).port;
  return port != 0 ? port : known_sensor(SensorKind::kVlp16).port;
}

std::string SensorMetadata::trouble() const {
  const std::lock_guard<std::mutex> locked(lock_);
  return trouble_;
}

}  // namespace pose_wall::tools::live
