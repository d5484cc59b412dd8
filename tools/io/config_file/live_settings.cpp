// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/live_settings.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <variant>

#include "io/language/language.hpp"
#include "io/packets/sensors.hpp"

namespace pose_wall::tools {
namespace {

using Type = OutsideKey::Type;
using Member = std::variant<std::string LiveSettings::*, double LiveSettings::*, bool LiveSettings::*>;

struct Row {
  OutsideKey info;
  Member member;
};

constexpr const char* kSources = translatable("Live: where pose_walld takes clouds from");
constexpr const char* kSinks = translatable("Live: where pose_walld puts results");

const std::vector<Row>& rows() {
  static const std::string sensors = fmt::format("{}", fmt::join(sensor_names(), ", "));
  static const std::vector<Row> table = {
      {{"source", kSources, Type::kChoice, "", 0, 0, "udp, ros1, ros2",
        translatable("source of clouds: a sensor's packets by UDP, or pointcloud_topic of ROS 1 or ROS 2")},
       &LiveSettings::source},
      {{"extrinsic_from", kSources, Type::kChoice, "", 0, 0, "config, tf",
        translatable("config: extrinsic_x to extrinsic_yaw. tf (ROS only): the transform from lidar_frame to "
                     "base_frame; no frame "
                     "is measured until it is known")},
       &LiveSettings::extrinsic_from},
      {{"sensor", kSources, Type::kChoice, "", 0, 0, sensors.c_str(),
        translatable(
            "sensor that sends the packets; auto: identified by its packets. A name that contradicts the packets is "
            "refused")},
       &LiveSettings::sensor},
      {{"sensor_metadata", kSources, Type::kText, "", 0, 0, "",
        translatable("metadata of the sensor: a file (JSON of an Ouster, table of angles of a Hesai, device packet of "
                     "a RoboSense), "
                     "or http://SENSOR for an Ouster; empty: not needed")},
       &LiveSettings::sensor_metadata},
      {{"udp_address", kSources, Type::kIpv4, "", 0, 0, "",
        translatable("this machine's address on the sensor's network. 0.0.0.0 listens on all networks, and anybody "
                     "there can send "
                     "packets")},
       &LiveSettings::udp_address},
      {{"udp_port", kSources, Type::kInteger, "1", 0, 65535, "",
        translatable("destination port of the sensor's packets; 0: its usual port")},
       &LiveSettings::udp_port},
      {{"udp_device_port", kSources, Type::kInteger, "1", 0, 65535, "",
        translatable(
            "destination port of the packets in which a RoboSense or an LSLidar describes itself; 0: its usual "
            "port, where 'sensor' names it")},
       &LiveSettings::udp_device_port},
      {{"udp_sender", kSources, Type::kIpv4OrNone, "", 0, 0, "",
        translatable("address of the sensor; packets from others are counted and dropped. Empty: the first sender")},
       &LiveSettings::udp_sender},
      {{"ros_source", kSources, Type::kText, "", 0, 0, "",
        translatable("sensor of pointcloud_topic where several send on it: its frame_id or lidar_id, as frame_id "
                     "front; the others are counted and dropped. Empty: the first")},
       &LiveSettings::ros_source},
      {{"frame_points_max", kSources, Type::kInteger, "points", 1, 67108864, "",
        translatable("most points of one cloud; decides the memory. Larger clouds are refused")},
       &LiveSettings::frame_points_max},
      {{"worker_priority", kSources, Type::kInteger, "1", 0, 99, "",
        translatable("priority of the thread that measures, before all other work of this machine: 1 to 99, as "
                     "SCHED_FIFO has it; 0: as other programs. The system must allow it (LimitRTPRIO)")},
       &LiveSettings::worker_priority},
      {{"ros1", kSinks, Type::kSwitch, "1", 0, 0, "", translatable("1: publish results as a node of ROS 1")},
       &LiveSettings::ros1},
      {{"ros2", kSinks, Type::kSwitch, "1", 0, 0, "", translatable("1: publish results as a node of ROS 2")},
       &LiveSettings::ros2},
      {{"ros_distro", kSinks, Type::kChoice, "", 0, 0, "humble, iron",
        translatable("ROS 2 version of the other nodes; iron stands for all later ones, too")},
       &LiveSettings::ros_distro},
      {{"http", kSinks, Type::kHostPort, "", 0, 0, "",
        translatable(
            "address of the page, HOST:PORT; empty: no page. Everybody who reaches it can read, unless http_login is "
            "set. Nobody can change anything, unless commissioning is on")},
       &LiveSettings::http},
      {{"http_names", kSinks, Type::kText, "", 0, 0, "",
        translatable("more names under which the page may be asked for, with blanks between, as roadheader7.mine. "
                     "This machine's own name and addresses are known")},
       &LiveSettings::http_names},
      {{"http_login", kSinks, Type::kText, "", 0, 0, "",
        translatable("file of those who may look: NAME:HASH in each line, the hash by `openssl passwd -6`. Empty: "
                     "everybody. Beyond loopback it needs http_certificate")},
       &LiveSettings::http_login},
      {{"http_certificate", kSinks, Type::kText, "", 0, 0, "",
        translatable("file with certificate and key (PEM): the page is then served by HTTPS. Empty: by HTTP")},
       &LiveSettings::http_certificate},
      {{"commissioning", kSinks, Type::kSwitch, "1", 0, 0, "",
        translatable("1: who knows the code in the log may commission the machine from the page. It needs "
                     "commissioned, and beyond loopback http_certificate")},
       &LiveSettings::commissioning},
      {{"commissioned", kSinks, Type::kText, "", 0, 0, "",
        translatable("folder of what was commissioned from the page. Its settings.yaml stands over this file; empty: "
                     "none. A key site.pem in it (Ed25519) signs the evidence")},
       &LiveSettings::commissioned},
      {{"foxglove", kSinks, Type::kHostPort, "", 0, 0, "",
        translatable(
            "address for the viewers Foxglove and Lichtblick, HOST:PORT, their usual port is 8765; empty: none. "
            "Everybody who reaches it can read; nobody can change anything")},
       &LiveSettings::foxglove},
      {{"foxglove_origin", kSinks, Type::kText, "", 0, 0, "",
        translatable("page from which browsers may connect to the address of foxglove, too, as "
                     "http://lichtblick.mine:8080; empty: only app.foxglove.dev and pages of this machine")},
       &LiveSettings::foxglove_origin},
      {{"modbus", kSinks, Type::kHostPort, "", 0, 0, "",
        translatable(
            "address of the Modbus TCP server, HOST:PORT; empty: none. It serves reads of input registers, and writes "
            "as planar_command_modbus allows")},
       &LiveSettings::modbus},
      {{"can", kSinks, Type::kText, "", 0, 0, "",
        translatable("interface of SocketCAN on which the process images are sent, as can0; empty: none")},
       &LiveSettings::can},
      {{"can_frames", kSinks, Type::kChoice, "", 0, 0, "11bit, j1939",
        translatable("frames of CAN. 11bit: plain identifiers, as beside CANopen. j1939: PGNs of SAE J1939, 29 bits")},
       &LiveSettings::can_frames},
      {{"can_first", kSinks, Type::kInteger, "1", 0, 65472, "",
        translatable("first of 64 identifiers (11bit) or PGNs (j1939); 0: 1664 (680h) or 65280 (FF00h)")},
       &LiveSettings::can_first},
      {{"can_address", kSinks, Type::kInteger, "1", 0, 253, "",
        translatable("j1939: the daemon's source address. It is not claimed on the bus: keep it free in its plan")},
       &LiveSettings::can_address},
      {{"mqtt", kSinks, Type::kHostPort, "", 0, 0, "",
        translatable("broker for telemetry, HOST:PORT; empty: none. Never control a machine by MQTT")},
       &LiveSettings::mqtt},
      {{"mqtt_topic", kSinks, Type::kText, "", 0, 0, "", translatable("topic under which MQTT telemetry is published")},
       &LiveSettings::mqtt_topic},
      {{"mqtt_user", kSinks, Type::kText, "", 0, 0, "", translatable("user of the broker; empty: none")},
       &LiveSettings::mqtt_user},
      {{"mqtt_password_file", kSinks, Type::kText, "", 0, 0, "",
        translatable("file whose first line is the password of mqtt_user, read at each connection; empty: none")},
       &LiveSettings::mqtt_password_file},
      {{"mqtt_tls", kSinks, Type::kSwitch, "1", 0, 0, "",
        translatable("1: encrypted (TLS); the broker must prove its name or address by a certificate")},
       &LiveSettings::mqtt_tls},
      {{"mqtt_ca_file", kSinks, Type::kText, "", 0, 0, "",
        translatable("certificates that the broker's is checked by (PEM); empty: those of this machine")},
       &LiveSettings::mqtt_ca_file},
      {{"mqtt_cert_file", kSinks, Type::kText, "", 0, 0, "",
        translatable("certificate by which the broker knows this machine (PEM); empty: none")},
       &LiveSettings::mqtt_cert_file},
      {{"mqtt_key_file", kSinks, Type::kText, "", 0, 0, "",
        translatable("private key of mqtt_cert_file (PEM); empty: in that file")},
       &LiveSettings::mqtt_key_file},
      {{"black_box", kSinks, Type::kText, "", 0, 0, "",
        translatable(
            "folder of the black box, one ring file per start; empty: none. `pose_wall replay-box` computes it again")},
       &LiveSettings::black_box},
      {{"black_box_mb", kSinks, Type::kNumber, "MB", 1, 1000000, "",
        translatable(
            "space for all black boxes together, a quarter for each start; the oldest is deleted first. 2048 holds a "
            "minute of clouds of 65,536 points")},
       &LiveSettings::black_box_mb},
      {{"recording", kSinks, Type::kText, "", 0, 0, "", translatable("folder of recordings as MCAP; empty: none")},
       &LiveSettings::recording},
      {{"recording_mb", kSinks, Type::kNumber, "MB", 1, 10000000, "",
        translatable("space for all recordings together; the oldest is deleted first")},
       &LiveSettings::recording_mb},
      {{"recording_clouds", kSinks, Type::kSwitch, "1", 0, 0, "", translatable("1: recordings also hold the clouds")},
       &LiveSettings::recording_clouds},
      {{"status_every_s", kSinks, Type::kNumber, "s", 1, 86400, "",
        translatable("period of the status line in the log")},
       &LiveSettings::status_every_s},
      {{"log_level", kSinks, Type::kChoice, "", 0, 0, "info, warning, error",
        translatable("least grave lines of the log that are written")},
       &LiveSettings::log_level},
  };
  return table;
}

const Row* find_row(const std::string& name) {
  for (const Row& row : rows()) {
    if (name == row.info.name) return &row;
  }
  return nullptr;
}

// Of what is written as a text.
bool is_text_allowed(const OutsideKey& key, const std::string& value) {
  switch (key.type) {
    case Type::kChoice: {
      const std::vector<std::string> choices = choices_of(key);
      return std::find(choices.begin(), choices.end(), value) != choices.end();
    }
    case Type::kHostPort:
      return value.empty() || parse_host_port(value);
    case Type::kIpv4:
      return parse_ipv4(value).has_value();
    case Type::kIpv4OrNone:
      return value.empty() || parse_ipv4(value);
    default:
      return true;
  }
}

}  // namespace

const std::vector<OutsideKey>& live_keys() {
  static const std::vector<OutsideKey> keys = [] {
    std::vector<OutsideKey> infos;
    for (const Row& row : rows()) infos.push_back(row.info);
    return infos;
  }();
  return keys;
}

const OutsideKey* find_live_key(const std::string& name) {
  const Row* row = find_row(name);
  return row != nullptr ? &row->info : nullptr;
}

std::string live_value_text(const LiveSettings& settings, const OutsideKey& key) {
  const Member member = find_row(key.name)->member;
  if (const auto text = std::get_if<std::string LiveSettings::*>(&member)) return settings.**text;
  if (const auto number = std::get_if<double LiveSettings::*>(&member)) return fmt::format("{:.9g}", settings.**number);
  return settings.*std::get<bool LiveSettings::*>(member) ? "1" : "0";
}

bool set_live_value(LiveSettings* settings, const OutsideKey& key, const std::string& value) {
  if (!is_text_allowed(key, value)) return false;
  const Member member = find_row(key.name)->member;
  if (const auto text = std::get_if<std::string LiveSettings::*>(&member)) {
    settings->** text = value;
    return true;
  }
  if (const auto number = std::get_if<double LiveSettings::*>(&member)) {
    const std::optional<double> read = number_of(key, value);
    if (read) settings->** number = *read;
    return read.has_value();
  }
  if (value != "0" && value != "1") return false;
  settings->*std::get<bool LiveSettings::*>(member) = value == "1";
  return true;
}

std::string broken_page_rule(const LiveSettings& settings) {
  if (settings.commissioning && settings.commissioned.empty()) {
    return tr("commissioning needs commissioned, a folder for what is saved");
  }
  if (settings.commissioning && settings.http.empty()) return tr("commissioning needs http, the address of the page");
  const std::optional<HostPort> place = parse_host_port(settings.http);
  if (!place || is_loopback(place->host) || !settings.http_certificate.empty()) return "";
  // Whoever listens on the way would know the code or the password.
  if (settings.commissioning) return tr("commissioning beyond loopback needs http_certificate");
  if (!settings.http_login.empty()) return tr("http_login beyond loopback needs http_certificate");
  return "";
}

std::string broken_live_rule(const LiveSettings& settings) {
  // MQTT 3.1.1 knows no password without a user (3.1.2.9).
  if (!settings.mqtt_password_file.empty() && settings.mqtt_user.empty()) {
    return tr("mqtt_password_file needs mqtt_user");
  }
  const bool has_certificates = !settings.mqtt_ca_file.empty() || !settings.mqtt_cert_file.empty();
  if (has_certificates && !settings.mqtt_tls) return tr("mqtt_ca_file and mqtt_cert_file need mqtt_tls: 1");
  if (!settings.mqtt_key_file.empty() && settings.mqtt_cert_file.empty()) {
    return tr("mqtt_key_file needs mqtt_cert_file");
  }
  return "";
}

std::optional<HostPort> parse_host_port(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  HostPort parts;
  parts.host = text.substr(0, colon);
  if (parts.host.front() == '[') {
    if (parts.host.size() < 3 || parts.host.back() != ']') return std::nullopt;
    parts.host = parts.host.substr(1, parts.host.size() - 2);
  } else if (parts.host.find(':') != std::string::npos) {
    return std::nullopt;
  }
  const char* begin = text.data() + colon + 1;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, parts.port);
  if (error != std::errc() || stop != end || parts.port < 1 || parts.port > 65535) return std::nullopt;
  return parts;
}

std::optional<std::uint32_t> parse_ipv4(const std::string& text) {
  in_addr address{};
  // A text may hold a zero byte, at which C's ends.
  if (text.size() != std::strlen(text.c_str()) || inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

bool is_loopback(const std::string& host) {
  in_addr four{};
  in6_addr six{};
  if (inet_pton(AF_INET, host.c_str(), &four) == 1) return ntohl(four.s_addr) >> 24U == 127;
  if (inet_pton(AF_INET6, host.c_str(), &six) == 1) return IN6_IS_ADDR_LOOPBACK(&six) != 0;
  return host == "localhost";
}

}  // namespace pose_wall::tools
