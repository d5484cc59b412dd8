// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sensor_sim/lslidar_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pose_wall::tools::live {
namespace {

constexpr std::uint32_t kFiringsOfBlock = 2, kFiringsOfPacket = 24;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

void put_low_first(std::string* bytes, std::int64_t number, int size) {
  for (int i = 0; i < size; ++i) bytes->push_back(static_cast<char>(number >> (8 * i)));
}

void set_high_first(std::string* bytes, std::size_t offset, std::int64_t number) {
  bytes->at(offset) = static_cast<char>(number >> 8);
  bytes->at(offset + 1) = static_cast<char>(number);
}

}  // namespace

std::vector<std::string> LslidarEncoder::packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) {
  if (image.rings != beams_.lasers.size()) throw std::invalid_argument("a " + beams_.title + " has 16 rings");
  std::vector<std::string> packets;
  for (std::uint32_t first = 0; first + kFiringsOfPacket <= image.columns; first += kFiringsOfPacket) {
    std::string packet;
    for (std::uint32_t firing = first; firing < first + kFiringsOfPacket; ++firing) {
      if (firing % kFiringsOfBlock == 0) {
        packet += "\xFF\xEE";
        put_low_first(&packet, std::lround(36'000.0 * firing / image.columns) % 36'000, 2);
      }
      for (const Laser& laser : beams_.lasers) {
        const std::size_t at = image.at(laser.ring, firing);
        put_low_first(&packet, std::lround(image.range_m[at] / beams_.ranges.unit_m), 2);
        put_low_first(&packet, std::lround(std::clamp(image.intensity[at], 0.0F, 255.0F)), 1);
      }
    }
    const std::int64_t end_ns = (began_ns + turn_ns * (first + kFiringsOfPacket) / image.columns) % kSecond_ns;
    if (is_v3()) {
      put_low_first(&packet, end_ns / 1000, 4);
    } else {
      packet += std::string("\x1A\x0B\x1C\x0C\x1E\x0F", 6);  // 2026-11-28 12:30:15
      put_low_first(&packet, end_ns, 4);
    }
    packet += "\x37\x10";  // one return; a C16
    packets.push_back(std::move(packet));
  }
  return packets;
}

std::string LslidarEncoder::device_packet(std::int64_t turn_ns) const {
  std::string device = std::string("\xA5\xFF\x00\x5A", 4) + std::string(1202, '\0');
  set_high_first(&device, 8, 60 * kSecond_ns / turn_ns);
  set_high_first(&device, 24, 2368);
  set_high_first(&device, 26, 2369);
  if (is_v3()) {
    for (std::size_t i = 0; i < beams_.lasers.size(); ++i) {
      set_high_first(&device, 245 + 2 * i, std::lround(100.0 * beams_.lasers[i].elevation_deg));
    }
    device[1196] = device[1202] = 3;
  } else {
    device[1198] = device[1202] = 0x14;  // a C16, firmware 4
  }
  return device;
}

}  // namespace pose_wall::tools::live
