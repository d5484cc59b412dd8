// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What ROS's environment variables ask of a node: domain, range of discovery, peers; and the interface that follows.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pose_wall::tools::live {

// Of ros_distro: what changed between them on the wire.
enum class RosDistro { kHumble, kIronOrLater };
RosDistro ros_distro_of(const std::string& name);

enum class DiscoveryRange { kOff, kLocalhost, kSubnet, kSystemDefault };

struct RosEnvironment {
  RosDistro distro = RosDistro::kHumble;
  std::uint32_t domain_id = 0;
  DiscoveryRange range = DiscoveryRange::kSubnet;
  std::vector<std::string> static_peers;
  std::string cyclone_settings;  // CYCLONEDDS_URI: overrules all else
};

// As std::getenv; nothing: not set.
using GetVariable = std::function<std::optional<std::string>(const char*)>;
std::optional<std::string> get_variable(const char* name);

// Throws std::runtime_error that names the variable, its value and what is allowed.
RosEnvironment read_ros_environment(RosDistro distro, const GetVariable& get);

struct NetworkInterface {
  std::string name, address;
  bool is_loopback = false, has_multicast = false;
};
// Those that are up and have an IPv4 address, in the kernel's order.
std::vector<NetworkInterface> network_interfaces();

// The one to talk on: the first that reaches others, or loopback where only this machine is asked for or nothing else
// is up. Nothing where CYCLONEDDS_URI or the system's defaults decide.
std::optional<NetworkInterface> choose_interface(const RosEnvironment& environment,
                                                 const std::vector<NetworkInterface>& all);

struct CycloneLimits {
  std::uint64_t receive_buffer_bytes = 0;  // asked of the kernel, which may grant less
  std::uint64_t sample_bytes_max = 0;      // larger samples of others are not put together
};
// For dds_create_domain: ours first, CYCLONEDDS_URI behind it.
std::string cyclone_settings(const RosEnvironment& environment, const std::optional<NetworkInterface>& interface,
                             const CycloneLimits& limits);

// For the log at the start: "domain 0, talks on eth0 (192.0.2.2), found by multicast: ...".
std::string environment_text(const RosEnvironment& environment, const std::optional<NetworkInterface>& interface);

}  // namespace pose_wall::tools::live
