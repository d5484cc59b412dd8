// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Facts of packets: the maker's drivers, as in beams/lslidar_beams.cpp.

#include "io/packets/lslidar_models.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace pose_wall::tools {
namespace {

// Of a packet: of firmware 2 and 3, and of 4 and 5, as the maker's driver takes them.
constexpr std::size_t kFirstKindBytes = 1206, kLaterBytes = 1212;
constexpr std::uint16_t kLslidarBlockFlag = 0xEEFF;
constexpr std::uint8_t kOneReturn = 0x37, kLastReturn = 0x38, kTwoReturns = 0x39;

// By model, as the enumeration has them.
std::vector<LslidarTraits> make_traits() {
  using Model = LslidarModel;
  return {
      {Model::kC16V3, 0x10, beam_table("lslidar-c16-v3")},     {Model::kC32V3, 0x20, beam_table("lslidar-c32-v3")},
      {Model::kC16V4, 0x10, beam_table("lslidar-c16-v4")},     {Model::kC16V4B, 0x12, beam_table("lslidar-c16-v4b")},
      {Model::kC16V5, 0x65, beam_table("lslidar-c16-v5")},     {Model::kC32V4, 0x20, beam_table("lslidar-c32-v4")},
      {Model::kC32V5, 0x64, beam_table("lslidar-c32-v5")},     {Model::kC32W45, 0x45, beam_table("lslidar-c32w-45")},
      {Model::kC32W46, 0x46, beam_table("lslidar-c32w-46")},   {Model::kC32W47, 0x47, beam_table("lslidar-c32w-47")},
      {Model::kC32W48, 0x48, beam_table("lslidar-c32w-48")},   {Model::kCh32r5a, 0x5A, beam_table("lslidar-ch32r-5a")},
      {Model::kCh32r5d, 0x5D, beam_table("lslidar-ch32r-5d")}, {Model::kC8, 0x08, beam_table("lslidar-c8")},
      {Model::kC8f, 0x07, beam_table("lslidar-c8f")},          {Model::kCkm8, 0x09, beam_table("lslidar-ckm8")}};
}

const std::vector<LslidarTraits>& all_lslidars() {
  static const std::vector<LslidarTraits> traits = make_traits();
  return traits;
}

std::uint8_t lslidar_byte(ByteView payload, std::size_t offset) {
  return std::to_integer<std::uint8_t>(payload.data[offset]);
}

bool has_blocks(ByteView packet) {
  if (packet.size != kFirstKindBytes && packet.size != kLaterBytes) return false;
  for (std::size_t block = 0; block < kLslidarBlocks; ++block) {
    if (little_endian_at(packet, block * kLslidarBlockBytes, 2) != kLslidarBlockFlag) return false;
    if (little_endian_at(packet, block * kLslidarBlockBytes + 2, 2) >= 36000) return false;
  }
  return true;
}

}  // namespace

const LslidarTraits& lslidar_traits(LslidarModel model) {
  return all_lslidars()[static_cast<std::size_t>(model)];
}

ByteView lslidar_packet(ByteView payload) {
  if (payload.size != kLaterBytes) return payload;
  for (std::size_t i = kFirstKindBytes; i < kLaterBytes; ++i) {
    if (lslidar_byte(payload, i) != 0) return payload;
  }
  return {payload.data, kFirstKindBytes};
}

std::optional<LslidarModel> lslidar_model_of(ByteView payload) {
  const ByteView packet = lslidar_packet(payload);
  if (!has_blocks(packet)) return std::nullopt;
  const bool is_first_kind = packet.size == kFirstKindBytes;
  for (const LslidarTraits& traits : all_lslidars()) {
    if (traits.is_first_kind() == is_first_kind && traits.byte == lslidar_byte(packet, packet.size - 1))
      return traits.model;
  }
  return std::nullopt;
}

bool is_lslidar_dual(ByteView packet, const LslidarTraits& traits) {
  const std::uint8_t mode = lslidar_byte(packet, (traits.is_first_kind() ? kFirstKindBytes : kLaterBytes) - 2);
  if (mode == kTwoReturns || mode == kOneReturn || mode == kLastReturn) return mode == kTwoReturns;
  for (std::size_t block = 0; block < kLslidarBlocks; block += 2) {
    const double azimuth_deg = lslidar_azimuth_deg(packet, block);
    if (azimuth_deg != lslidar_azimuth_deg(packet, block + 1)) return false;
    if (block > 0 && azimuth_deg == lslidar_azimuth_deg(packet, block - 1)) return false;
  }
  return true;
}

double lslidar_azimuth_deg(ByteView packet, std::size_t block) {
  return 0.01 * little_endian_at(packet, block * kLslidarBlockBytes + 2, 2);
}

std::uint32_t lslidar_clock(ByteView packet, const LslidarTraits& traits) {
  return little_endian_at(packet, traits.is_first_kind() ? 1200 : 1206, 4);
}

std::int64_t lslidar_clock_unit_ns(std::int64_t gap, std::int64_t least_us) {
  const auto is_within = [gap](std::int64_t least) { return gap >= least && gap <= 100 * least; };
  if (is_within(least_us)) return 1000;
  return is_within(1000 * least_us) ? 1 : 0;
}

std::string unread_lslidar(ByteView payload) {
  const ByteView packet = lslidar_packet(payload);
  if (packet.size != kLaterBytes || !has_blocks(packet) || lslidar_model_of(packet)) return "";
  switch (lslidar_byte(packet, kLaterBytes - 1)) {
    case 0x01:
    case 0x03:
      return "an LSLidar C1 of one line";
    case 0x06:
      return "an LSLidar N301 of one line";
    case 0x11:
      return "an LSLidar MS-C16";
    default:
      return fmt::format("an LSLidar of a kind that is not known (0x{:02x})", lslidar_byte(packet, kLaterBytes - 1));
  }
}

}  // namespace pose_wall::tools
