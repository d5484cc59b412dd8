// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Packets and metadata of an Ouster made by hand from its layouts: two rings, 16 columns a turn, four a packet. Beams
// leave level and straight down, 0.1 m out.

#pragma once

#include <fmt/format.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "test_files.hpp"

namespace pose_wall::tools::test {

// So few that a turn can be worked out by hand; sensors have 512 and more, 16 a packet.
inline constexpr std::uint32_t kOusterColumnsOfTurn = 16, kOusterColumnsOfPacket = 4;
// Of 12 digits, as theirs: with fewer nothing is compared.
inline constexpr std::uint64_t kOusterSerial = 122201000111, kOtherOusterSerial = 122201000222;
inline constexpr std::uint64_t kOusterColumn_ns = 1000;  // from column to column; any time that differs from 0

// How a pixel of a profile is made of its returns, in millimetres; the lowest byte first.
struct OusterLayout {
  const char* profile;
  std::function<std::string(std::uint32_t first_mm, std::uint32_t second_mm)> pixel;
  bool has_two = false;
};

inline std::string zero_bytes(std::size_t count) {
  return std::string(count, '\0');
}
inline std::string fifteen_bits(std::uint32_t range_mm, const char* reflectivity) {
  return raw(static_cast<std::uint16_t>(0x8000U | range_mm / 8)) + reflectivity;
}
// Flags above the range, so that they must be left out.
inline std::string nineteen_bits(std::uint32_t range_mm, std::uint32_t reflectivity) {
  return raw(reflectivity << 24U | 0xF80000U | range_mm);
}

inline std::vector<OusterLayout> ouster_layouts() {
  const auto dual = [](std::size_t rest) {
    return [rest](std::uint32_t first_mm, std::uint32_t second_mm) {
      return nineteen_bits(first_mm, 7) + nineteen_bits(second_mm, 9) + std::string(rest, '\x55');
    };
  };
  const auto apart = [](std::uint32_t first_mm, std::uint32_t) {
    return raw(0xFFF80000U | first_mm) + "\x07" + std::string(7, '\x55');
  };
  const auto dual_of_15 = [](std::uint32_t first_mm, std::uint32_t second_mm) {
    return fifteen_bits(first_mm, "\x07\x01") + fifteen_bits(second_mm, "\x09\x02");
  };
  return {{"LEGACY", [](std::uint32_t first_mm,
                        std::uint32_t) { return raw(0xF0000000U | first_mm) + "\x07" + std::string(7, '\x55'); }},
          {"RNG19_RFL8_SIG16_NIR16", apart},
          {"RNG19_RFL8_SIG16_NIR16_ZONE16", apart},
          {"RNG19_RFL8_SIG16_NIR16_DUAL", dual(8), true},
          {"RNG19_RFL8_SIG16_ZONE16_DUAL", dual(8), true},
          {"RNG19_RFL8_SIG16_NIR16_RGB16_DUAL", dual(12), true},
          {"FIVE_WORD_PIXEL", dual(12), true},
          {"RNG19_RFL8_SIG16_NIR16_RGB16",
           [](std::uint32_t first_mm, std::uint32_t) { return nineteen_bits(first_mm, 7) + std::string(12, '\x55'); }},
          {"RNG15_RFL8_NIR8", [](std::uint32_t first_mm, std::uint32_t) { return fifteen_bits(first_mm, "\x07\x01"); }},
          {"RNG15_RFL8_WIN8", [](std::uint32_t first_mm, std::uint32_t) { return fifteen_bits(first_mm, "\x07\x01"); }},
          {"RNG15_RFL8_NIR8_ZONE16",
           [](std::uint32_t first_mm, std::uint32_t) {
             return fifteen_bits(first_mm, "\x07\x01") + std::string(4, '\x55');
           }},
          {"RNG15_RFL8_NIR8_DUAL", dual_of_15, true},
          {"FUSA_RNG15_RFL8_NIR8_DUAL", dual_of_15, true}};
}

inline const OusterLayout& ouster_layout_of(const std::string& profile) {
  static const std::vector<OusterLayout> all = ouster_layouts();
  for (const OusterLayout& layout : all) {
    if (layout.profile == profile) return layout;
  }
  throw std::out_of_range(profile);
}

// Four columns of two rings: 5 m, and 8 m for the second return.
struct OusterPacket {
  std::string profile = "RNG15_RFL8_NIR8";
  bool is_fusa = false;
  std::uint32_t frame = 1, first_column = 0;
  std::uint64_t serial = 0;
  std::uint32_t session = 0x123456;
  std::function<bool(std::uint32_t column)> is_valid = [](std::uint32_t) { return true; };
  std::uint32_t first_mm = 5000, second_mm = 8000;
  std::uint64_t began_ns = 0;  // of frame 0
};

inline std::string low_bytes(std::uint64_t number, std::size_t count) {
  return raw(number).substr(0, count);
}

inline std::string ouster_head_of(const OusterPacket& packet) {
  if (packet.is_fusa) {
    return "\x01" + low_bytes(packet.session, 3) + raw(packet.frame) + zero_bytes(3) + low_bytes(packet.serial, 5) +
           zero_bytes(16);
  }
  return raw(std::uint16_t{1}) + low_bytes(packet.frame, 2) + low_bytes(packet.session, 3) +
         low_bytes(packet.serial, 5) + zero_bytes(20);
}

inline std::string payload_of(const OusterPacket& packet) {
  const bool is_legacy = packet.profile == "LEGACY";
  const std::string pixel = ouster_layout_of(packet.profile).pixel(packet.first_mm, packet.second_mm);
  std::string payload = is_legacy ? "" : ouster_head_of(packet);
  for (std::uint32_t column = packet.first_column; column < packet.first_column + kOusterColumnsOfPacket; ++column) {
    const bool is_valid = packet.is_valid(column);
    // Frames of 16 bits go on counting time where their number begins anew.
    payload += raw(packet.began_ns + kOusterColumn_ns * (std::uint64_t{packet.frame} * kOusterColumnsOfTurn + column));
    payload += raw(static_cast<std::uint16_t>(column));
    payload +=
        is_legacy ? low_bytes(packet.frame, 2) + zero_bytes(4) : raw(static_cast<std::uint16_t>(is_valid ? 1 : 0));
    payload += pixel + pixel;
    if (is_legacy) payload += raw(is_valid ? 0xFFFFFFFFU : 0U);
  }
  return is_legacy ? payload : payload + zero_bytes(32);
}

struct OusterDescription {
  OusterDescription(std::string of_profile = "RNG15_RFL8_NIR8", std::string in_format = "", std::string in_page = "")
      : profile(std::move(of_profile)), more_of_format(std::move(in_format)), more(std::move(in_page)) {}

  std::string profile;
  std::string more_of_format;  // ", \"column_window\": [0, 7]"
  std::string more;
  std::string altitudes = "[0, -90]";
};

inline std::string ouster_json(const OusterDescription& told) {
  return fmt::format(
      "{{\"prod_line\": \"OS-test\", \"beam_altitude_angles\": {}, \"beam_azimuth_angles\": [0, 0], "
      "\"lidar_origin_to_beam_origin_mm\": 100, "
      "\"lidar_to_sensor_transform\": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36, 0, 0, 0, 1], \"data_format\": "
      "{{\"columns_per_frame\": {}, \"columns_per_packet\": {}, \"pixels_per_column\": 2, \"udp_profile_lidar\": "
      "\"{}\"{}}}{}}}",
      told.altitudes, kOusterColumnsOfTurn, kOusterColumnsOfPacket, told.profile, told.more_of_format, told.more);
}

inline std::string ouster_serial_told(std::uint64_t serial) {
  return fmt::format(", \"prod_sn\": \"{}\"", serial);
}

// Frames from `first` on, all their packets.
inline std::vector<OusterPacket> turns_of(const OusterPacket& packet, std::uint32_t count) {
  std::vector<OusterPacket> packets;
  for (std::uint32_t turn = 0; turn < count; ++turn) {
    for (std::uint32_t column = 0; column < kOusterColumnsOfTurn; column += kOusterColumnsOfPacket) {
      packets.push_back(packet);
      packets.back().frame = packet.frame + turn;
      packets.back().first_column = column;
    }
  }
  return packets;
}

}  // namespace pose_wall::tools::test
