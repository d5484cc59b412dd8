// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Packets of sensors made by hand from the makers' descriptions, captures of them, and what is read from these.

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "io/inputs/frame_sequence.hpp"
#include "io/packets/scan.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::test {

inline std::string big(std::uint16_t number) {
  return raw(number, true);
}

inline std::string capture_head() {
  return raw(0xA1B2C3D4U) + raw(std::uint16_t{2}) + raw(std::uint16_t{4}) + raw(0U) + raw(0U) + raw(65535U) + raw(1U);
}

// One IPv4 packet on Ethernet; `fragment` as its header has it.
inline std::string captured(const std::string& content, std::uint32_t microseconds, std::uint16_t fragment = 0) {
  const std::string packet = std::string(12, 'e') + big(0x0800) + "\x45" + std::string(1, '\0') +
                             big(static_cast<std::uint16_t>(20 + content.size())) + big(77) + big(fragment) +
                             "\x40\x11" + big(0) + "\x0A\x01\x01\x01" + "\x0A\x01\x01\x02" + content;
  const auto size = static_cast<std::uint32_t>(packet.size());
  return raw(1700000000U) + raw(microseconds) + raw(size) + raw(size) + packet;
}

inline std::string datagram(const std::string& payload) {
  return big(2368) + big(2368) + big(static_cast<std::uint16_t>(8 + payload.size())) + big(0) + payload;
}

// A packet each millisecond.
inline std::string capture_of(const std::vector<std::string>& payloads) {
  std::string file = capture_head();
  for (std::uint32_t i = 0; i < payloads.size(); ++i) file += captured(datagram(payloads[i]), 1000 * i);
  return file;
}

struct ReadCapture {
  std::vector<SourcedFrame> frames;
  std::vector<std::string> errors;
  std::size_t announced = 0;
  SourceAbout about;
};

inline ReadCapture read(const std::string& file, const SensorOptions& packets = {}) {
  InputOptions options;
  options.packets = packets;
  FrameSequence sequence({file}, options);
  ReadCapture capture;
  capture.errors = sequence.errors();
  capture.announced = sequence.frames();
  capture.about = sequence.about();
  while (std::optional<SourcedFrame> frame = sequence.next()) {
    if (!frame->frame) capture.errors.push_back(frame->error);
    if (frame->frame) capture.frames.push_back(std::move(*frame));
  }
  return capture;
}

// Where nothing is read: the one reason.
inline std::string refusal_of(const ReadCapture& capture) {
  return capture.frames.empty() && capture.errors.size() == 1 ? capture.errors.front() : "read";
}

// Distance of a laser in a block, in the unit of the packet.
using Distances = std::function<std::uint16_t(std::size_t block, std::size_t laser)>;

struct VelodynePacket {
  double first_deg = 0.0, step_deg = 30.0;  // step from block to block, or from pair to pair
  std::uint32_t clock_us = 0;
  std::uint8_t mode = 0x37, product = 0x22;
  Distances distance = [](std::size_t, std::size_t) { return std::uint16_t{5000}; };
};

inline std::string payload_of(const VelodynePacket& packet) {
  std::string payload;
  for (std::size_t block = 0; block < 12; ++block) {
    const std::size_t firing = packet.mode == 0x39 ? block / 2 : block;
    const double azimuth_deg = packet.first_deg + static_cast<double>(firing) * packet.step_deg;
    payload += "\xFF\xEE" + raw(static_cast<std::uint16_t>(std::lround(azimuth_deg * 100.0) % 36000));
    for (std::size_t laser = 0; laser < 32; ++laser) payload += raw(packet.distance(block, laser)) + "\x2A";
  }
  return payload + raw(packet.clock_us) + raw(packet.mode) + raw(packet.product);
}

// Twenty packets of 72 degrees: three quarters of a turn, three turns, and a quarter.
inline std::vector<std::string> velodyne_turns() {
  std::vector<std::string> payloads;
  for (int i = 0; i < 20; ++i) {
    VelodynePacket packet;
    packet.step_deg = 6.0;
    packet.first_deg = 72.0 * i + 90.0;
    payloads.push_back(payload_of(packet));
  }
  return payloads;
}

// What differs between the packets of Hesai's sensors.
struct HesaiPacket {
  std::size_t lasers = 32, blocks = 8;
  double first_deg = 0.0, step_deg = 45.0;  // step from block to block, or from pair to pair
  std::uint8_t mode = 0x37;
  Distances distance = [](std::size_t, std::size_t) { return std::uint16_t{2500}; };
  char unit_mm = 4;
};

inline HesaiPacket qt128_packet() {
  return {128, 2};
}

inline HesaiPacket pandar64_packet() {
  return {64, 6};
}

inline HesaiPacket xt32m_packet() {
  HesaiPacket packet{32, 6};
  packet.unit_mm = 5;
  return packet;
}

inline std::string payload_of(const HesaiPacket& packet) {
  const bool is_40p = packet.lasers == 40, is_64 = packet.lasers == 64 && packet.blocks == 6;
  const bool is_qt128 = packet.lasers == 128;
  std::string payload;
  if (is_64) {
    payload = std::string("\xEE\xFF\x40\x06\0", 5) + packet.unit_mm + std::string(2, '\0');
  } else if (is_qt128) {
    payload = "\xEE\xFF\x03\x02" + std::string(2, '\0') + "\x80\x02\x01" + packet.unit_mm + "\x02\x1D";
  } else if (!is_40p) {
    payload = (packet.lasers == 64 ? "\xEE\xFF\x03\x01" : "\xEE\xFF\x06\x01") + std::string(2, '\0') +
              static_cast<char>(packet.lasers) + static_cast<char>(packet.blocks) + '\0' + packet.unit_mm + "\x02\x01";
  }
  for (std::size_t block = 0; block < packet.blocks; ++block) {
    const std::size_t firing = block / (packet.mode == 0x3D ? 3 : packet.mode >= 0x39 ? 2 : 1);
    const double azimuth_deg = packet.first_deg + static_cast<double>(firing) * packet.step_deg;
    if (is_40p) payload += "\xFF\xEE";
    payload += raw(static_cast<std::uint16_t>(std::lround(azimuth_deg * 100.0) % 36000));
    for (std::size_t laser = 0; laser < packet.lasers; ++laser) {
      payload += raw(packet.distance(block, laser)) + (is_40p || is_64 ? "\x2A" : "\x2A\x01");
    }
  }
  const std::string mode(1, static_cast<char>(packet.mode)), date("\x17\x0B\x0E\x01\x02\x03", 6);
  const std::string speed = raw(std::uint16_t{600}), clock = raw(std::uint32_t{123456});
  if (is_40p || is_64) return payload + std::string(8, '\0') + speed + clock + mode + '\x42' + date;
  const std::string sequence = raw(std::uint32_t{7});
  if (is_qt128) {
    const std::string checksum_and_safety(4 + 17, '\x11');
    return payload + checksum_and_safety + std::string(12, '\0') + mode + speed + date + clock + '\x42' + sequence +
           std::string(4 + 32, '\x22');
  }
  if (packet.lasers == 64) return payload + std::string(10, '\0') + speed + clock + mode + '\x42' + date + sequence;
  return payload + std::string(10, '\0') + mode + speed + date + clock + '\x42' + sequence;
}

// Livox's head of 36 bytes, then the points as they are given.
inline std::string mid360_payload(std::uint8_t type, std::uint64_t time_ns, const std::vector<std::string>& points,
                                  std::uint16_t tenths_us = 4800) {
  std::string body;
  for (const std::string& point : points) body += point;
  std::string head = std::string(1, '\0') + raw(static_cast<std::uint16_t>(36 + body.size())) + raw(tenths_us) +
                     raw(static_cast<std::uint16_t>(points.size())) + raw(std::uint16_t{9}) + std::string(1, '\0') +
                     raw(type) + std::string(1, '\0') + std::string(12, '\0') + raw(0U) + raw(time_ns);
  return head + body;
}

inline ByteView view_of(const std::string& bytes) {
  return {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
}

inline bool add(ScanAssembler& assembler, const std::string& payload, std::int64_t captured_ns = 0) {
  return assembler.add({captured_ns, {}, view_of(payload)});
}

inline void expect_at(const ScanPoint& point, double x_m, double y_m, double z_m) {
  EXPECT_NEAR(point.x_m, x_m, 1e-5);
  EXPECT_NEAR(point.y_m, y_m, 1e-5);
  EXPECT_NEAR(point.z_m, z_m, 1e-5);
}

inline const ScanPoint& point_at(const Scan& scan, std::size_t ring, std::size_t column) {
  return scan.points.at(ring * (scan.points.size() / scan.rings) + column);
}

}  // namespace pose_wall::tools::test
