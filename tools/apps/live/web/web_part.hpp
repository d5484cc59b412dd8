// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

namespace pose_wall::tools::live {

class WebServer;

// What answers at paths of its own on the page's server.
class WebPart {
 public:
  WebPart() = default;
  WebPart(const WebPart&) = delete;
  WebPart& operator=(const WebPart&) = delete;
  virtual ~WebPart() = default;
  // Before the server starts. The part must outlive the server's thread.
  virtual void serve(WebServer& server) = 0;
};

}  // namespace pose_wall::tools::live
