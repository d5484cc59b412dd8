// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The keys of pose_wall.yaml that pose_walld reads and the engine does not: sources, sinks, ports.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/config_file/outside_key.hpp"

namespace pose_wall::tools {

// Of recording_mb and black_box_mb, and of what the health tells.
inline constexpr double kBytesPerMb = 1e6;
inline std::uint64_t whole_mb(std::uint64_t bytes) {
  return static_cast<std::uint64_t>(static_cast<double>(bytes) / kBytesPerMb);
}

struct LiveSettings {
  std::string source = "udp";
  std::string extrinsic_from = "config";
  std::string sensor = "auto";
  std::string sensor_metadata;
  std::string udp_address = "127.0.0.1";
  double udp_port = 0, udp_device_port = 0;
  std::string udp_sender;
  std::string ros_source;
  double frame_points_max = 262144;
  double worker_priority = 0;
  bool ros1 = false, ros2 = false;
  std::string ros_distro = "humble";
  std::string http, modbus, mqtt;  // HOST:PORT; empty: off
  std::string http_names;          // with blanks between
  std::string http_login, http_certificate;
  bool commissioning = false;
  std::string commissioned;  // a folder
  std::string foxglove;      // HOST:PORT; empty: off
  std::string foxglove_origin;
  std::string can;  // interface; empty: off
  std::string can_frames = "11bit";
  double can_first = 0, can_address = 128;
  std::string mqtt_topic = "pose_wall";
  std::string mqtt_user, mqtt_password_file;
  bool mqtt_tls = false;
  std::string mqtt_ca_file, mqtt_cert_file, mqtt_key_file;
  std::string black_box;
  double black_box_mb = 2048;
  std::string recording;
  double recording_mb = 4096;
  bool recording_clouds = false;
  double status_every_s = 60;
  std::string log_level = "info";
};

// All rows, in the table's order.
const std::vector<OutsideKey>& live_keys();
const OutsideKey* find_live_key(const std::string& name);

// As it would be written in pose_wall.yaml.
std::string live_value_text(const LiveSettings& settings, const OutsideKey& key);

// False where the value is not allowed; the settings are then as before.
bool set_live_value(LiveSettings* settings, const OutsideKey& key, const std::string& value);

// What is wrong between keys of this table; empty: nothing.
std::string broken_live_rule(const LiveSettings& settings);

// "HOST:PORT" in its parts; nothing where it is none. [::1]:502 is one.
struct HostPort {
  std::string host;
  int port = 0;
};
std::optional<HostPort> parse_host_port(const std::string& text);

// "192.168.1.201" as captures number it (Sender::address); nothing where it is no IPv4 address.
std::optional<std::uint32_t> parse_ipv4(const std::string& text);

// The rule over the keys of the page that is broken; empty: none.
std::string broken_page_rule(const LiveSettings& settings);

// "localhost" and addresses of 127.0.0.0/8 and ::1. A name that begins as such an address is none.
bool is_loopback(const std::string& host);

}  // namespace pose_wall::tools
