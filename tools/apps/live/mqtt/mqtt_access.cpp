// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/mqtt/mqtt_access.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "apps/live/key_file.hpp"

namespace pose_wall::tools::live {
namespace {

// A password of MQTT has two bytes of length (3.1.3.5).
constexpr std::size_t kPasswordMost = 65535;

std::ifstream opened(const char* key, const std::string& file) {
  std::ifstream stream = open_key_file(key, file);
  if (stream.peek() == std::ifstream::traits_type::eof()) {
    throw std::runtime_error(fmt::format("{}: {}: cannot be read: it is empty", key, file));
  }
  return stream;
}

}  // namespace

MqttAccess mqtt_access(const LiveSettings& live) {
  MqttAccess access = {*parse_host_port(live.mqtt), live.mqtt_user,      live.mqtt_password_file, live.mqtt_tls,
                       live.mqtt_ca_file,           live.mqtt_cert_file, live.mqtt_key_file};
  const std::pair<const char*, const std::string&> files[] = {
      {"mqtt_ca_file", access.ca_file}, {"mqtt_cert_file", access.cert_file}, {"mqtt_key_file", access.key_file}};
  for (const auto& [key, file] : files) {
    if (!file.empty()) opened(key, file);
  }
  // The library takes the key from a file of its own.
  if (access.key_file.empty()) access.key_file = access.cert_file;
  static_cast<void>(password_of(access));
  return access;
}

std::string password_of(const MqttAccess& access) {
  if (access.password_file.empty()) return "";
  std::ifstream stream = opened("mqtt_password_file", access.password_file);
  std::string password;
  std::getline(stream, password);
  if (!password.empty() && password.back() == '\r') password.pop_back();
  if (password.empty() || password.size() > kPasswordMost || password.find('\0') != std::string::npos) {
    throw std::runtime_error(
        fmt::format("mqtt_password_file: {}: its first line is no password; allowed: 1 to {} bytes",
                    access.password_file, kPasswordMost));
  }
  return password;
}

std::string connect_fault(const HostPort& broker) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;  // a name server may take its time
  wanted.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(broker.host.c_str(), std::to_string(broker.port).c_str(), &wanted, &found) != 0) return "";
  const int file = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  int fault = file >= 0 && connect(file, found->ai_addr, found->ai_addrlen) == 0 ? 0 : errno;
  freeaddrinfo(found);
  if (fault == EINPROGRESS) {
    fault = 0;
    pollfd waits{file, POLLOUT, 0};
    socklen_t bytes = sizeof fault;
    if (poll(&waits, 1, static_cast<int>(kConnectFaultMost.count())) > 0) {
      static_cast<void>(getsockopt(file, SOL_SOCKET, SO_ERROR, &fault, &bytes));
    }
  }
  if (file >= 0) close(file);
  return fault == 0 ? "" : std::strerror(fault);
}

std::string access_text(const MqttAccess& access) {
  const bool has_password = !access.password_file.empty(), is_near = is_loopback(access.broker.host);
  std::string text = "telemetry";
  if (access.tls) {
    text += has_password || !access.cert_file.empty() ? ", encrypted and with a login" : ", encrypted, without a login";
  } else if (has_password) {
    text += is_near ? " with a password" : " with a password that others on the network can read: mqtt_tls encrypts it";
  } else {
    text += " without password or encryption";
  }
  return text + "; never control a machine by it";
}

std::string tls_reason(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char letter : line) {
    if (letter == ':') {
      fields.emplace_back();
    } else if (letter != '\n') {
      fields.back() += letter;
    }
  }
  // As ERR_error_string_n(3) has them: thread, "error", number, library, function, reason; the thread may be missing.
  for (std::size_t k = 0; k + 4 < fields.size(); ++k) {
    if (fields[k] == "error") return fields[k + 4];
  }
  return fields.size() == 1 ? fields[0] : line.substr(0, line.find('\n'));
}

}  // namespace pose_wall::tools::live
