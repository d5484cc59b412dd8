// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How a broker is reached, and by whom.

#pragma once

#include <chrono>
#include <string>

#include "io/config_file/live_settings.hpp"

namespace pose_wall::tools::live {

struct MqttAccess {
  HostPort broker;
  std::string user, password_file;  // empty: none
  bool tls = false;
  std::string ca_file, cert_file, key_file;  // PEM; empty: those of the system, none, in cert_file
};

// Throws std::runtime_error, which names key and file, for a file that cannot be read or has no password.
MqttAccess mqtt_access(const LiveSettings& live);

// The first line of the file; empty where none is set. Read anew for each connection, so that a password can be
// changed. Throws as above.
std::string password_of(const MqttAccess& access);

// Why nobody can connect to it: "Connection refused", "No route to host". Empty where one can, where nobody answers
// within kConnectFaultMost, and for a host by name. The library says "TCP/TLS connect failure" of them all.
std::string connect_fault(const HostPort& broker);
constexpr std::chrono::milliseconds kConnectFaultMost{200};  // a refusal comes within the way there and back

// What of the way is open to others: "telemetry without password or encryption; ...". In one sentence, for the log.
std::string access_text(const MqttAccess& access);

// "certificate verify failed" of "error:0A000086:SSL routines::certificate verify failed:file.c:1889:..."
std::string tls_reason(const std::string& line);

}  // namespace pose_wall::tools::live
