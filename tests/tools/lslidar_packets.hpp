// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Packets of LSLidar's sensors made by hand from the layout that the maker's drivers read.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "packet_files.hpp"

namespace pose_wall::tools::test {

struct LslidarPacket {
  bool is_first_kind = true;  // 1206 bytes, of firmware 2 and 3
  std::uint8_t model = 0x10, mode = 0x37;
  double first_deg = 0.0, step_deg = 0.36;  // step from block to block, or from pair to pair
  std::uint32_t clock = 0;
  Distances distance = [](std::size_t, std::size_t) { return std::uint16_t{4000}; };
};

inline std::string payload_of(const LslidarPacket& packet) {
  std::string payload;
  for (std::size_t block = 0; block < 12; ++block) {
    const std::size_t moment = packet.mode == 0x39 ? block / 2 : block;
    const double azimuth_deg = packet.first_deg + static_cast<double>(moment) * packet.step_deg;
    payload += "\xFF\xEE" + raw(static_cast<std::uint16_t>(std::lround(azimuth_deg * 100.0) % 36000));
    for (std::size_t laser = 0; laser < 32; ++laser) payload += raw(packet.distance(block, laser)) + "\x2A";
  }
  if (!packet.is_first_kind) payload += std::string("\x18\x05\x10\x08\x1E\x0A", 6);  // a date, of which none is read
  return payload + raw(packet.clock) + raw(packet.mode) + raw(packet.model);
}

// Turns without a gap.
inline std::vector<std::string> lslidar_turns(LslidarPacket packet, std::size_t packets, std::uint32_t clock_step) {
  std::vector<std::string> payloads;
  const double turn_deg = packet.step_deg * (packet.mode == 0x39 ? 6.0 : 12.0);
  for (std::size_t i = 0; i < packets; ++i) {
    payloads.push_back(payload_of(packet));
    packet.first_deg = std::fmod(packet.first_deg + turn_deg, 360.0);
    packet.clock += clock_step;
  }
  return payloads;
}

// What a sensor says of itself, with big-endian words at offsets.
struct LslidarDevice {
  std::string bytes = std::string("\xA5\xFF\x00\x5A", 4) + std::string(1202, '\0');

  LslidarDevice& set(std::size_t offset, int byte) {
    bytes[offset] = static_cast<char>(byte);
    return *this;
  }
  LslidarDevice& set_words(std::size_t offset, const std::vector<int>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      bytes.replace(offset + 2 * i, 2, big(static_cast<std::uint16_t>(words[i])));
    }
    return *this;
  }
};

inline std::vector<int> hundredths(std::initializer_list<double> degrees) {
  std::vector<int> words;
  for (const double angle : degrees) words.push_back(static_cast<int>(std::lround(100.0 * angle)));
  return words;
}

inline std::vector<int> c16_angles() {
  return hundredths({-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15});
}

inline std::vector<int> narrow_c16_angles() {
  return hundredths({-10, 0.67, -8.67, 2, -7.33, 3.33, -6, 4.67, -4.67, 6, -3.33, 7.33, -2, 8.67, -0.67, 10});
}

inline std::vector<int> c32_angles() {
  std::vector<int> words;
  for (int i = 0; i < 32; ++i) words.push_back(100 * (i % 2 == 0 ? i / 2 - 16 : i / 2));
  return words;
}

// A CH128X1's points of one return: line, azimuth in hundredths of a degree, distance in 1/25600 m. Zeros fill the
// rest.
struct HybridPoint {
  int line;
  int azimuth;
  std::uint32_t distance;
  std::uint32_t second = 0;
};
constexpr HybridPoint kHybridMark = {-1, 0, 0, 0};

inline std::string hybrid_payload(const std::vector<HybridPoint>& points, std::uint32_t clock_us, int returns = 1) {
  const auto three = [](std::uint32_t number) {
    return std::string{static_cast<char>(number >> 16U), static_cast<char>(number >> 8U), static_cast<char>(number)};
  };
  const std::size_t item = returns == 2 ? 11 : 7, count = returns == 2 ? 109 : 171;
  std::string payload;
  for (std::size_t i = 0; i < count; ++i) {
    const HybridPoint point = i < points.size() ? points[i] : HybridPoint{0, 9000, 0};
    std::string bytes = "\xFF\xAA\xBB\xCC\xDD\x11\x11";
    if (point.line >= 0) {
      bytes = std::string(1, static_cast<char>(point.line)) + big(static_cast<std::uint16_t>(point.azimuth)) +
              three(point.distance) + "\x09";
    }
    if (returns == 2) bytes += three(point.second) + "\x0A";
    payload += bytes.substr(0, item);
  }
  payload.resize(returns == 2 ? 1199 : 1197);
  payload += std::string(returns == 2 ? "\x2D" : "\x02\x11\x2D") + big(static_cast<std::uint16_t>(clock_us >> 16U)) +
             big(static_cast<std::uint16_t>(clock_us)) + "\x80" + static_cast<char>(returns);
  return payload;
}

}  // namespace pose_wall::tools::test
