// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Who may ask a web server: under which names it answers, and who must log in. A page of somebody else's whose name is
// pointed at this machine could read it otherwise (DNS rebinding).

#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

class WebAccess {
 public:
  using Clock = std::chrono::steady_clock;

  // Reads `http_login` and looks at `http_certificate`. Throws std::runtime_error that names the file and the line.
  WebAccess(const LiveSettings& live, const HostPort& place);

  // By the header `Host`. On loopback names of loopback are good. Elsewhere an address in numbers is, as nobody can
  // point one anywhere, and so are this machine's own name and those of `http_names`.
  bool is_own_name(const std::string& host_header) const;

  enum class Login { kGood, kMissing, kWrong, kTooOften };
  // By the header `Authorization`. A hash takes milliseconds of everybody's time: one try is looked at in kTryEvery,
  // and what was once right is not looked at again.
  Login login(const std::string& authorization, Clock::time_point now = Clock::now());
  static constexpr auto kTryEvery = std::chrono::milliseconds(200);

  // A file with certificate and key, PEM; empty: plain HTTP.
  const std::string& certificate_file() const { return certificate_file_; }
  // "http" or "https".
  const char* scheme() const { return certificate_file_.empty() ? "http" : "https"; }
  bool asks_for_login() const { return !hashes_.empty(); }

 private:
  bool is_loopback_ = true;
  std::string certificate_file_;
  std::set<std::string> names_;
  std::map<std::string, std::string> hashes_;  // of passwords, by name
  std::set<std::string> known_;                // headers that were right
  Clock::time_point tried_{};
};

}  // namespace pose_wall::tools::live
