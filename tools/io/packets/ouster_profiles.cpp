// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/ouster_profiles.hpp"

#include <algorithm>

namespace pose_wall::tools {
namespace {

constexpr double kUnit_m = 1e-3;
constexpr double kShortUnit_m = 8e-3;  // of the profiles of 15 bits
constexpr std::size_t kTailBytes = 32;
constexpr std::size_t kColumnHeadBytes = 12, kLegacyColumnHeadBytes = 16, kLegacyColumnTailBytes = 4;
constexpr std::uint32_t kLidarPacket = 1;
// Alike in both heads; of firmware that does not know them they are 0.
constexpr std::size_t kShuttingDownAt = 18, kLimitingAt = 19;
constexpr std::uint32_t kLowHalf = 0x0F;

std::uint64_t serial_at(ByteView packet, std::size_t offset) {
  return little_endian_at(packet, offset, 4) | std::uint64_t{little_endian_at(packet, offset + 4, 1)} << 32U;
}

OusterReturn return_at(const OusterProfile& profile, ByteView pixel, std::size_t offset) {
  const std::uint32_t word = little_endian_at(pixel, offset, profile.range_bits > 16 ? 4 : 2);
  const std::uint32_t range = word & ((1U << profile.range_bits) - 1U);
  return {(profile.range_bits == 15 ? kShortUnit_m : kUnit_m) * range,
          static_cast<float>(little_endian_at(pixel, offset + profile.reflectivity_at, 1))};
}

}  // namespace

const std::vector<OusterProfile>& ouster_profiles() {
  static const std::vector<OusterProfile> profiles = {{"LEGACY", 12, 20, 4, 0},
                                                      {"RNG19_RFL8_SIG16_NIR16", 12, 19, 4, 0},
                                                      {"RNG19_RFL8_SIG16_NIR16_DUAL", 16, 19, 3, 4},
                                                      {"RNG19_RFL8_SIG16_NIR16_ZONE16", 12, 19, 4, 0},
                                                      {"RNG19_RFL8_SIG16_ZONE16_DUAL", 16, 19, 3, 4},
                                                      {"RNG19_RFL8_SIG16_NIR16_RGB16", 16, 19, 3, 0},
                                                      {"RNG19_RFL8_SIG16_NIR16_RGB16_DUAL", 20, 19, 3, 4},
                                                      {"RNG15_RFL8_NIR8", 4, 15, 2, 0},
                                                      {"RNG15_RFL8_NIR8_DUAL", 8, 15, 2, 4},
                                                      {"RNG15_RFL8_NIR8_ZONE16", 8, 15, 2, 0},
                                                      {"RNG15_RFL8_WIN8", 4, 15, 2, 0},
                                                      {"FUSA_RNG15_RFL8_NIR8_DUAL", 8, 15, 2, 4},
                                                      {"FIVE_WORD_PIXEL", 20, 19, 3, 4}};
  return profiles;
}

const OusterProfile* ouster_profile(std::string_view name) {
  for (const OusterProfile& profile : ouster_profiles()) {
    if (profile.name == name) return &profile;
  }
  return nullptr;
}

OusterReturn ouster_return(const OusterProfile& profile, ByteView pixel, bool takes_farther) {
  const OusterReturn first = return_at(profile, pixel, 0);
  if (!takes_farther || profile.second_at == 0) return first;
  const OusterReturn second = return_at(profile, pixel, profile.second_at);
  return second.range_m > first.range_m ? second : first;
}

OusterHead ouster_head(OusterHeader header, ByteView packet) {
  const auto byte = [&](std::size_t offset) { return little_endian_at(packet, offset, 1); };
  if (header == OusterHeader::kNone) return {true};
  const bool is_shutting_down = (byte(kShuttingDownAt) & kLowHalf) != 0;
  const std::uint32_t limiting = byte(kLimitingAt) & kLowHalf;
  if (header == OusterHeader::kStandard) {
    return {little_endian_at(packet, 0, 2) == kLidarPacket,
            little_endian_at(packet, 2, 2),
            little_endian_at(packet, 4, 3),
            serial_at(packet, 7),
            is_shutting_down,
            limiting};
  }
  // Its kind is one byte, so that a standard head passes for one; there bytes 9 and 10 are of the serial number, here
  // they are reserved.
  const bool is_standard = byte(1) == 0 && (byte(9) | byte(10)) != 0;
  return {byte(0) == kLidarPacket && !is_standard,
          little_endian_at(packet, 4, 4),
          little_endian_at(packet, 1, 3),
          serial_at(packet, 11),
          is_shutting_down,
          limiting};
}

const char* ouster_header_name(OusterHeader header) {
  return header == OusterHeader::kNone ? "LEGACY" : header == OusterHeader::kFusa ? "FUSA" : "STANDARD";
}

std::size_t ouster_column_bytes(const OusterProfile& profile, std::uint32_t rings) {
  const std::size_t around = profile.is_legacy() ? kLegacyColumnHeadBytes + kLegacyColumnTailBytes : kColumnHeadBytes;
  return around + std::size_t{rings} * profile.pixel_bytes;
}

std::size_t ouster_packet_bytes(const OusterProfile& profile, std::uint32_t rings, std::uint32_t columns) {
  const std::size_t around = profile.is_legacy() ? 0 : kOusterHeadBytes + kTailBytes;
  return around + columns * ouster_column_bytes(profile, rings);
}

bool may_be_ouster_packet(std::size_t bytes) {
  constexpr std::uint32_t kColumns = 16;  // as it leaves the factory
  for (const OusterProfile& profile : ouster_profiles()) {
    for (const std::uint32_t rings : {16U, 32U, 64U, 128U}) {
      if (ouster_packet_bytes(profile, rings, kColumns) == bytes) return true;
    }
  }
  return false;
}

}  // namespace pose_wall::tools
