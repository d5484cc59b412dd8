// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The web server of an Ouster, as far as its metadata goes.

#pragma once

#include <memory>
#include <string>

namespace pose_wall::tools::live {

class MetadataServer {
 public:
  // Throws std::invalid_argument where `at` is no HOST:PORT, std::runtime_error where it cannot listen there and where
  // this build has no HTTP.
  MetadataServer(const std::string& at, const std::string& metadata);
  MetadataServer(const MetadataServer&) = delete;
  MetadataServer& operator=(const MetadataServer&) = delete;
  ~MetadataServer();

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace pose_wall::tools::live
