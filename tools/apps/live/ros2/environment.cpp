// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/ros2/environment.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace pose_wall::tools::live {
namespace {

// Ports of a domain begin at 7400 + 250 times its number (DDSI-RTPS 9.6.1), and 65535 is the last.
constexpr std::uint32_t kDomainIdMax = 232;
// The last one whose ports are below those of the next domain. A node that finds no free index does not start.
constexpr int kParticipantIndexMax = 119;

std::uint32_t read_domain_id(const std::string& text) {
  if (text.empty()) return 0;
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error == std::errc() && end == text.data() + text.size() && id <= kDomainIdMax) return id;
  throw std::runtime_error(fmt::format("ROS_DOMAIN_ID is '{}'; 0 to {} are allowed", text, kDomainIdMax));
}

bool read_localhost_only(const std::string& text) {
  if (text.empty() || text == "0") return false;
  if (text == "1") return true;
  throw std::runtime_error(fmt::format("ROS_LOCALHOST_ONLY is '{}'; 0 and 1 are allowed", text));
}

DiscoveryRange read_range(const std::string& text) {
  if (text.empty() || text == "SUBNET") return DiscoveryRange::kSubnet;
  if (text == "LOCALHOST") return DiscoveryRange::kLocalhost;
  if (text == "OFF") return DiscoveryRange::kOff;
  if (text == "SYSTEM_DEFAULT") return DiscoveryRange::kSystemDefault;
  throw std::runtime_error(fmt::format(
      "ROS_AUTOMATIC_DISCOVERY_RANGE is '{}'; SUBNET, LOCALHOST, OFF and SYSTEM_DEFAULT are allowed", text));
}

// Addresses and names go into a settings text: what could change its meaning is refused.
std::vector<std::string> read_peers(const std::string& text) {
  constexpr const char* kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:[]%";
  std::vector<std::string> peers;
  std::istringstream list(text);
  for (std::string peer; std::getline(list, peer, ';');) {
    if (peer.empty()) continue;
    if (peer.find_first_not_of(kAllowed) != std::string::npos) {
      throw std::runtime_error(
          fmt::format("ROS_STATIC_PEERS has '{}'; host names and addresses between semicolons are "
                      "allowed",
                      peer));
    }
    peers.push_back(peer);
  }
  return peers;
}

// Humble binds itself to loopback; later ones stay on the network's interface and are told to this machine alone. The
// two do not find each other, so that each distro needs its own way.
bool binds_to_loopback(const RosEnvironment& environment) {
  return environment.range == DiscoveryRange::kLocalhost && environment.distro == RosDistro::kHumble;
}

bool uses_peers(const RosEnvironment& environment) {
  return environment.range == DiscoveryRange::kLocalhost || environment.range == DiscoveryRange::kSubnet;
}

std::string discovery_settings(const RosEnvironment& environment) {
  if (environment.range == DiscoveryRange::kOff) {
    return fmt::format("<ParticipantIndex>none</ParticipantIndex><Tag>ros_discovery_off_{}</Tag>", getpid());
  }
  std::string peers;
  if (environment.range == DiscoveryRange::kLocalhost) peers += "<Peer address=\"localhost\"/>";
  if (uses_peers(environment)) {
    for (const std::string& peer : environment.static_peers) peers += fmt::format("<Peer address=\"{}\"/>", peer);
  }
  if (!peers.empty()) peers = "<Peers>" + peers + "</Peers>";
  return fmt::format("<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>{}",
                     kParticipantIndexMax, peers);
}

}  // namespace

RosDistro ros_distro_of(const std::string& name) {
  return name == "humble" ? RosDistro::kHumble : RosDistro::kIronOrLater;
}

std::optional<std::string> get_variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::nullopt : std::make_optional<std::string>(value);
}

RosEnvironment read_ros_environment(RosDistro distro, const GetVariable& get) {
  RosEnvironment environment;
  environment.distro = distro;
  environment.domain_id = read_domain_id(get("ROS_DOMAIN_ID").value_or(""));
  environment.range = read_range(get("ROS_AUTOMATIC_DISCOVERY_RANGE").value_or(""));
  // The older variable narrows what the newer one says, and never widens it.
  const bool localhost_only = read_localhost_only(get("ROS_LOCALHOST_ONLY").value_or(""));
  if (localhost_only && environment.range != DiscoveryRange::kOff) environment.range = DiscoveryRange::kLocalhost;
  environment.static_peers = read_peers(get("ROS_STATIC_PEERS").value_or(""));
  environment.cyclone_settings = get("CYCLONEDDS_URI").value_or("");
  return environment;
}

std::vector<NetworkInterface> network_interfaces() {
  std::vector<NetworkInterface> interfaces;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return interfaces;
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    const bool is_up = (entry->ifa_flags & IFF_UP) != 0 && (entry->ifa_flags & IFF_RUNNING) != 0;
    if (!is_up || entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr, text, sizeof text);
    interfaces.push_back(
        {entry->ifa_name, text, (entry->ifa_flags & IFF_LOOPBACK) != 0, (entry->ifa_flags & IFF_MULTICAST) != 0});
  }
  freeifaddrs(list);
  return interfaces;
}

std::optional<NetworkInterface> choose_interface(const RosEnvironment& environment,
                                                 const std::vector<NetworkInterface>& all) {
  if (!environment.cyclone_settings.empty() || environment.range == DiscoveryRange::kSystemDefault) return std::nullopt;
  const auto reaches_others = [](const NetworkInterface& one) { return !one.is_loopback && one.has_multicast; };
  const auto is_loopback = [](const NetworkInterface& one) { return one.is_loopback; };
  auto chosen = binds_to_loopback(environment) ? all.end() : std::find_if(all.begin(), all.end(), reaches_others);
  if (chosen == all.end()) chosen = std::find_if(all.begin(), all.end(), is_loopback);
  if (chosen == all.end()) throw std::runtime_error("no network interface is up, not even loopback");
  return *chosen;
}

std::string cyclone_settings(const RosEnvironment& environment, const std::optional<NetworkInterface>& interface,
                             const CycloneLimits& limits) {
  std::string general;
  if (interface) {
    // Loopback carries multicast, though it does not say so; Fast DDS announces itself that way there, too.
    general += fmt::format("<Interfaces><NetworkInterface name=\"{}\"{}/></Interfaces>", interface->name,
                           interface->is_loopback ? " multicast=\"true\"" : "");
  }
  const bool is_quiet = environment.range == DiscoveryRange::kLocalhost || environment.range == DiscoveryRange::kOff;
  if (interface && interface->is_loopback && environment.range != DiscoveryRange::kOff) {
    general += "<AllowMulticast>spdp</AllowMulticast>";
  } else if (is_quiet) {
    general += "<AllowMulticast>false</AllowMulticast>";
  }
  const std::string discovery =
      environment.range == DiscoveryRange::kSystemDefault ? "" : discovery_settings(environment);
  // Only max: with min, a kernel that grants less would end the participant. A stop does not wait for slow readers.
  return fmt::format(
      "<CycloneDDS><Domain><General>{}</General><Discovery>{}</Discovery>"
      "<Internal><SocketReceiveBufferSize max=\"{} B\"/><MaxSampleSize>{} B</MaxSampleSize>"
      "<WriterLingerDuration>100 ms</WriterLingerDuration></Internal>"
      "</Domain></CycloneDDS>,{}",
      general, discovery, limits.receive_buffer_bytes, limits.sample_bytes_max, environment.cyclone_settings);
}

std::string environment_text(const RosEnvironment& environment, const std::optional<NetworkInterface>& interface) {
  std::string text = fmt::format("domain {}, ", environment.domain_id);
  if (interface) {
    text += fmt::format("talks on {} ({})", interface->name, interface->address);
  } else {
    text += "talks where CYCLONEDDS_URI or Cyclone's defaults say";
  }
  switch (environment.range) {
    case DiscoveryRange::kOff:
      return text + "; discovery is off: no node finds this one";
    case DiscoveryRange::kLocalhost:
      return text +
             "; found by nodes of this machine alone (the ports listen on all addresses: a firewall closes them)";
    default:
      return text +
             "; whoever is on that network can publish clouds to it and read results: "
             "ROS_LOCALHOST_ONLY=1 or ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST keep it to this machine";
  }
}

}  // namespace pose_wall::tools::live
