// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sensor_sim/metadata_server.hpp"

#include <stdexcept>
#ifdef POSE_WALL_LIVE_HAS_HTTP
#include <httplib.h>

#include <thread>
#endif

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

#ifdef POSE_WALL_LIVE_HAS_HTTP

struct MetadataServer::Server {
  httplib::Server http;
  std::thread thread;
};

MetadataServer::MetadataServer(const std::string& at, const std::string& metadata)
    : server_(std::make_unique<Server>()) {
  const std::optional<HostPort> place = parse_host_port(at);
  if (!place) throw std::invalid_argument("--http " + at + ": HOST:PORT is expected, as 127.0.0.1:8000");
  server_->http.Get("/api/v1/sensor/metadata", [metadata](const httplib::Request&, httplib::Response& answer) {
    answer.set_content(metadata, "application/json");
  });
  if (!server_->http.bind_to_port(place->host, place->port)) throw std::runtime_error(at + ": cannot listen there");
  server_->thread = std::thread([this] { server_->http.listen_after_bind(); });
}

MetadataServer::~MetadataServer() {
  server_->http.stop();
  server_->thread.join();
}

#else

struct MetadataServer::Server {};

MetadataServer::MetadataServer(const std::string& at, const std::string&) {
  throw std::runtime_error(at + ": this build has no HTTP: install libcpp-httplib-dev, configure and build again");
}

MetadataServer::~MetadataServer() = default;

#endif

}  // namespace pose_wall::tools::live
