// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Packets of RoboSense's sensors made by hand from the maker's descriptions. Numbers are big-endian.

#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "packet_files.hpp"

namespace pose_wall::tools::test {

inline std::string big_number(std::uint64_t number, std::size_t size) {
  std::string bytes;
  for (std::size_t i = size; i-- > 0;) bytes.push_back(static_cast<char>(number >> (8 * i) & 0xFF));
  return bytes;
}

inline void put_at(std::string* bytes, std::size_t offset, const std::string& what) {
  bytes->replace(offset, what.size(), what);
}

// A data packet. `group`: blocks that share an azimuth.
struct RoboSensePacket {
  bool is_first_kind = true;  // of head
  bool is_calendar = true;    // of time
  std::size_t blocks = 12, channels = 32, group = 1;
  std::vector<std::pair<std::size_t, int>> head;  // offset and byte
  double first_deg = 0.0, step_deg = 0.2;         // from group to group
  std::int64_t clock_us = 0;
  Distances distance = [](std::size_t, std::size_t) { return std::uint16_t{2000}; };
};

inline std::string robosense_time(std::int64_t clock_us, bool is_calendar) {
  const auto second = static_cast<std::uint64_t>(clock_us / 1'000'000);
  const auto us = static_cast<std::uint64_t>(clock_us % 1'000'000);
  if (!is_calendar) return big_number(1'764'000'000 + second, 6) + big_number(us, 4);
  return std::string("\x19\x0B\x1D\x08", 4) + big_number(second / 60, 1) + big_number(second % 60, 1) +
         big_number(us / 1000, 2) + big_number(us % 1000, 2);
}

inline std::string payload_of(const RoboSensePacket& packet) {
  std::string head(42, '\0');
  put_at(&head, 0, packet.is_first_kind ? "\x55\xAA\x05\x0A\x5A\xA5\x50\xA0" : "\x55\xAA\x05\x5A");
  put_at(&head, 20, robosense_time(packet.clock_us, packet.is_calendar));
  for (const auto& [offset, byte] : packet.head) head[offset] = static_cast<char>(byte);
  std::string payload = head;
  for (std::size_t block = 0; block < packet.blocks; ++block) {
    const double azimuth_deg = packet.first_deg + static_cast<double>(block / packet.group) * packet.step_deg;
    payload += "\xFF\xEE" + big_number(static_cast<std::uint64_t>(std::lround(100.0 * azimuth_deg)) % 36000, 2);
    for (std::size_t channel = 0; channel < packet.channels; ++channel) {
      payload += big_number(packet.distance(block, channel), 2) + "\x2A";
    }
  }
  payload.resize(1248, '\0');
  return payload;
}

struct RoboSenseAngle {
  double elevation_deg, azimuth_deg;
};

// A device packet.
struct RoboSenseDevice {
  std::uint16_t speed = 600;
  int returns = 1;
  std::string top_version = std::string("\x00\x06\x23\x09\x00", 5), bottom_version = "\x08\x03\x01\x01\x01";
  std::uint64_t serial = 0x1A2B3C4D5E6F;
  std::vector<RoboSenseAngle> angles;  // at 468, with signs
  double unit_deg = 0.01;
  std::size_t room = 32;
  std::vector<double> rs16_deg;  // at 1165, without
  std::vector<std::pair<std::size_t, int>> bytes;
};

inline std::string signed_angle_bytes(double angle_deg, double unit_deg) {
  return big_number(angle_deg < 0.0 ? 1 : 0, 1) +
         big_number(static_cast<std::uint64_t>(std::lround(std::abs(angle_deg) / unit_deg)), 2);
}

inline std::string payload_of(const RoboSenseDevice& device) {
  std::string payload(1248, '\0');
  put_at(&payload, 0, "\xA5\xFF" + std::string(1, '\0') + "\x5A\x11\x11\x55\x55");
  put_at(&payload, 8, big_number(device.speed, 2));
  put_at(&payload, 40, device.top_version);
  put_at(&payload, 45, device.bottom_version);
  put_at(&payload, 292, big_number(device.serial, 6));
  payload[300] = static_cast<char>(device.returns);
  for (std::size_t k = 0; k < device.angles.size(); ++k) {
    put_at(&payload, 468 + 3 * k, signed_angle_bytes(device.angles[k].elevation_deg, device.unit_deg));
    put_at(&payload, 468 + 3 * (device.room + k), signed_angle_bytes(device.angles[k].azimuth_deg, device.unit_deg));
  }
  for (std::size_t k = 0; k < device.rs16_deg.size(); ++k) {
    put_at(&payload, 1165 + 3 * k, big_number(static_cast<std::uint64_t>(std::lround(1e4 * device.rs16_deg[k])), 3));
  }
  for (const auto& [offset, byte] : device.bytes) payload[offset] = static_cast<char>(byte);
  return payload;
}

// One kind of sensor: its device packet and its data.
struct RoboSenseExample {
  std::string word;
  RoboSenseDevice device;
  RoboSensePacket packet;
  double packet_us;
  std::size_t steps;  // of azimuth in a packet
};

inline std::vector<RoboSenseAngle> evenly(double first_deg, double last_deg, std::size_t lasers, double azimuth_deg) {
  std::vector<RoboSenseAngle> angles;
  for (std::size_t k = 0; k < lasers; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(lasers - 1);
    angles.push_back({first_deg + share * (last_deg - first_deg), k % 2 == 0 ? azimuth_deg : -azimuth_deg});
  }
  return angles;
}

inline RoboSenseExample rs16_example() {
  RoboSenseExample example{"robosense_rs16", {}, {}, 1332.0, 12};
  example.device.rs16_deg = {15, 13, 11, 9, 7, 5, 3, 1, 15, 13, 11, 9, 7, 5, 3, 1};
  example.packet.head = {{30, 1}};
  example.packet.step_deg = 0.4;
  return example;
}

inline RoboSenseExample rs32_example() {
  RoboSenseExample example{"robosense_rs32", {}, {}, 666.24, 12};
  example.device.angles = evenly(15.0, -25.0, 32, 9.125);
  example.device.unit_deg = 0.001;
  example.packet.head = {{30, 2}};
  return example;
}

inline RoboSenseExample helios32_example() {
  RoboSenseExample example{"robosense_helios32", {}, {}, 666.72, 12};
  example.device.angles = evenly(15.0, -55.0, 32, 4.5);
  example.packet.is_first_kind = example.packet.is_calendar = false;
  example.packet.head = {{17, 1}, {31, 6}, {32, 1}};
  return example;
}

inline RoboSenseExample helios16p_example() {
  RoboSenseExample example{"robosense_helios16p", {}, {}, 1333.44, 12};
  example.device.angles = evenly(15.0, -15.0, 16, 4.5);
  example.packet.is_first_kind = example.packet.is_calendar = false;
  example.packet.head = {{17, 1}, {31, 6}, {32, 3}};
  example.packet.step_deg = 0.4;
  return example;
}

inline RoboSenseExample bpearl_example() {
  RoboSenseExample example{"robosense_bpearl", {}, {}, 666.24, 12};
  example.device.angles = evenly(89.5, 2.3125, 32, 0.1);
  example.packet.head = {{30, 3}};
  return example;
}

inline RoboSenseExample bpearl4_example() {
  RoboSenseExample example = bpearl_example();
  example.word = "robosense_bpearl4";
  example.packet_us = 666.72;
  example.packet.is_calendar = false;
  example.packet.head = {{31, 3}, {32, 4}};
  return example;
}

inline RoboSenseExample airy_example() {
  RoboSenseExample example{"robosense_airy", {}, {}, 444.32, 4};
  example.device.angles = evenly(0.81, 89.39, 96, 1.63);
  example.device.room = 96;
  example.packet = {false, false, 8, 48, 2, {{17, 1}, {32, 2}}, 0.0, 0.4, 0, example.packet.distance};
  return example;
}

inline std::vector<RoboSenseExample> robosense_examples() {
  return {rs16_example(),   rs32_example(),    helios32_example(), helios16p_example(),
          bpearl_example(), bpearl4_example(), airy_example()};
}

// Two returns of each firing.
inline RoboSenseExample with_two_returns(RoboSenseExample example) {
  example.device.returns = 0;
  example.packet_us /= 2.0;
  if (example.device.angles.size() == 16 || !example.device.rs16_deg.empty()) {
    example.packet.step_deg /= 2.0;
    return example;
  }
  example.packet.group *= 2;
  example.steps /= 2;
  if (example.device.room == 96) example.packet.head = {{17, 3}, {32, 2}};
  return example;
}

// Data packets one after another.
inline std::vector<std::string> robosense_data(const RoboSenseExample& example, std::size_t count,
                                               double first_deg = 0.0) {
  std::vector<std::string> payloads;
  RoboSensePacket packet = example.packet;
  for (std::size_t i = 0; i < count; ++i) {
    const auto so_far = static_cast<double>(i);
    packet.first_deg =
        std::fmod(first_deg + so_far * static_cast<double>(example.steps) * example.packet.step_deg, 360.0);
    packet.clock_us = 1'000'000 + std::llround(so_far * example.packet_us);
    payloads.push_back(payload_of(packet));
  }
  return payloads;
}

}  // namespace pose_wall::tools::test
