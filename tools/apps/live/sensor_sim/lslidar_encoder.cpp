// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sensor_sim/lslidar_encoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace pose_wall::tools::live {
namespace {

constexpr std::uint32_t kReturnsOfBlock = 32, kBlocksOfPacket = 12;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

void put_low_first(std::string* bytes, std::int64_t number, int size) {
  for (int i = 0; i < size; ++i) bytes->push_back(static_cast<char>(number >> (8 * i)));
}

void set_high_first(std::string* bytes, std::size_t offset, std::int64_t number) {
  bytes->at(offset) = static_cast<char>(number >> 8);
  bytes->at(offset + 1) = static_cast<char>(number);
}

// How each names itself.
struct Name {
  const char* word;
  int firmware;
  char model;
};
constexpr std::array<Name, 18> kNames = {{{"lslidar-c16-v3", 3, '\x10'},
                                          {"lslidar-c16-v3-narrow", 3, '\x10'},
                                          {"lslidar-c32-v3", 3, '\x20'},
                                          {"lslidar-c32-v3-dense", 3, '\x20'},
                                          {"lslidar-c16-v4", 4, '\x10'},
                                          {"lslidar-c16-v4b", 4, '\x12'},
                                          {"lslidar-c16-v5", 5, '\x65'},
                                          {"lslidar-c32-v4", 4, '\x20'},
                                          {"lslidar-c32-v5", 5, '\x64'},
                                          {"lslidar-c8", 4, '\x08'},
                                          {"lslidar-c8f", 4, '\x07'},
                                          {"lslidar-ckm8", 4, '\x09'},
                                          {"lslidar-c32w-45", 4, '\x45'},
                                          {"lslidar-c32w-46", 4, '\x46'},
                                          {"lslidar-c32w-47", 4, '\x47'},
                                          {"lslidar-c32w-48", 4, '\x48'},
                                          {"lslidar-ch32r-5a", 4, '\x5A'},
                                          {"lslidar-ch32r-5d", 4, '\x5D'}}};

const Name& name_of(const BeamTable& beams) {
  for (const Name& name : kNames) {
    if (beams.word == name.word) return name;
  }
  throw std::invalid_argument(beams.title + ": no packets of such a sensor are known");
}

// The columns of a C32 of firmware 3, where each is written.
struct Column {
  std::size_t offset, laser;  // one that stands in it
};

void put_columns(std::string* device, const BeamTable& beams) {
  const bool is_dense = beams.word == "lslidar-c32-v3-dense";
  const std::vector<Column> columns =
      is_dense ? std::vector<Column>{{186, 7}, {190, 5}, {188, 2}, {192, 0}} : std::vector<Column>{{190, 0}, {186, 2}};
  for (const auto& [offset, laser] : columns) {
    set_high_first(device, offset, std::lround(100.0 * beams.lasers[laser].azimuth_deg));
  }
  if (is_dense) device->at(1195) = '\x21';
  device->at(1203) = '\x50';  // 4 mm
}

}  // namespace

LslidarEncoder::LslidarEncoder(const BeamTable& beams)
    : beams_(beams), firmware_(name_of(beams).firmware), model_(name_of(beams).model) {}

std::vector<std::string> LslidarEncoder::packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) {
  if (image.rings != beams_.lasers.size()) {
    throw std::invalid_argument(beams_.title + ": another number of rings");
  }
  const auto of_block = static_cast<std::uint32_t>(kReturnsOfBlock / beams_.lasers.size()),
             of_packet = kBlocksOfPacket * of_block;
  std::vector<std::string> packets;
  for (std::uint32_t first = 0; first + of_packet <= image.columns; first += of_packet) {
    std::string packet;
    for (std::uint32_t firing = first; firing < first + of_packet; ++firing) {
      if (firing % of_block == 0) {
        packet += "\xFF\xEE";
        put_low_first(&packet, std::lround(36'000.0 * firing / image.columns) % 36'000, 2);
      }
      for (const Laser& laser : beams_.lasers) {
        const std::size_t at = image.at(laser.ring, firing);
        put_low_first(&packet, std::lround(image.range_m[at] / beams_.ranges.unit_m), 2);
        put_low_first(&packet, std::lround(std::clamp(image.intensity[at], 0.0F, 255.0F)), 1);
      }
    }
    const std::int64_t end_ns = (began_ns + turn_ns * (first + of_packet) / image.columns) % kSecond_ns;
    if (firmware_ == 3) {
      put_low_first(&packet, end_ns / 1000, 4);
    } else {
      packet += std::string("\x1A\x0B\x1C\x0C\x1E\x0F", 6);  // 2026-11-28 12:30:15
      put_low_first(&packet, end_ns, 4);
    }
    packet += '\x37';  // one return
    packet += model_;
    packets.push_back(std::move(packet));
  }
  return packets;
}

std::string LslidarEncoder::device_packet(std::int64_t turn_ns) const {
  std::string device = std::string("\xA5\xFF\x00\x5A", 4) + std::string(1202, '\0');
  set_high_first(&device, 8, 60 * kSecond_ns / turn_ns);
  set_high_first(&device, 24, 2368);
  set_high_first(&device, 26, 2369);
  if (firmware_ == 3) {
    for (std::size_t i = 0; i < beams_.lasers.size(); ++i) {
      set_high_first(&device, 245 + 2 * i, std::lround(100.0 * beams_.lasers[i].elevation_deg));
    }
    device[1196] = device[1202] = 3;
    if (beams_.lasers.size() == kReturnsOfBlock) put_columns(&device, beams_);
  } else if (firmware_ == 4) {
    device[1198] = device[1202] = 0x14;
  } else {
    device[1202] = '\x64';
    device[1203] = '\x50';
  }
  return device;
}

}  // namespace pose_wall::tools::live
