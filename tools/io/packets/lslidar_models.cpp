// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Facts of packets, angles and lenses: the maker's Lslidar_ROS1_driver, f29e947a, lslidar_cx_driver.{hpp,cpp}; of
// firmware 2 and 3 also its older drivers in tianb03/lslidar_c16, 5a86ad87, and LarryDong/lslidar, 26220e90.

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
constexpr Lens kLensV4 = {0.0361, -20.25, false}, kLensV5 = {0.035, -21.80, false};
constexpr Lens kLensWide = {0.03416, -20.25, false}, kLensHemisphere = {0.0209, -27.76, false};
constexpr Lens kLensC16V3 = {0.0431, -14.68, false}, kLensC32V3 = {0.0494, -12.98, false};
constexpr double kUnitV3_m = 0.0025, kUnitV4_m = 0.004;
// What a block takes where the sensor's clock stands still. The older drivers: 20,000 firings a second of a C16, two in
// a block; 650,000 points a second of a C32.
constexpr double kBlockOfC16_ns = 100'000.0, kBlockOfC32_ns = 49'230.0;

BeamTable table(const char* title, const std::vector<double>& elevations_deg, const Lens& lens, double unit_m) {
  BeamTable beams;
  beams.maker = SensorMaker::kLslidar;
  beams.title = title;
  beams.source = "Lslidar_ROS1_driver f29e947a";
  const bool has_32 = elevations_deg.size() == kLslidarReturns;
  const double firings = static_cast<double>(kLslidarReturns) / static_cast<double>(elevations_deg.size());
  beams.cycle_ns = has_32 ? kBlockOfC32_ns : kBlockOfC16_ns / firings;
  beams.columns = 0;
  beams.turns_meanwhile = true;
  beams.lens = lens;
  beams.ranges = {unit_m, 0.015, 0.3, 150.0, 0.0};
  for (std::size_t i = 0; i < elevations_deg.size(); ++i) {
    const double after_ns = beams.cycle_ns * static_cast<double>(i) / static_cast<double>(elevations_deg.size());
    beams.lasers.push_back({elevations_deg[i], 0.0, 0.0, after_ns, 0});
  }
  number_rings(&beams.lasers);
  return beams;
}

// Eight of its lasers look 3.89 degrees ahead of the others.
BeamTable with_eight_ahead(BeamTable beams) {
  for (const std::size_t i : {6U, 7U, 14U, 15U, 22U, 23U, 29U, 30U}) beams.lasers[i].azimuth_deg = 3.89;
  return beams;
}

std::vector<LslidarTraits> make_traits() {
  using Model = LslidarModel;
  const auto named = [](BeamTable beams, const char* title) {
    beams.title = title;
    return beams;
  };
  return {
      {Model::kC16V3, 0x10, named(lslidar_c16_v3(), "LSLidar C16, firmware 2 or 3")},
      {Model::kC32V3, 0x20,
       table("LSLidar C32, firmware 2 or 3", {-16, 0, -15, 1, -14, 2,  -13, 3,  -12, 4,  -11, 5,  -10, 6,  -9, 7,
                                              -8,  8, -7,  9, -6,  10, -5,  11, -4,  12, -3,  13, -2,  14, -1, 15},
             kLensC32V3, kUnitV4_m)},
      {Model::kC16V4, 0x10, lslidar_c16_v4()},
      {Model::kC16V4B, 0x12,
       table("LSLidar C16, firmware 4, of the second kind",
             {-16, -8, 0, 8, -14, -6, 2, 10, -12, -4, 4, 12, -10, -2, 6, 14}, kLensV4, kUnitV4_m)},
      {Model::kC16V5, 0x65,
       table("LSLidar C16, firmware 5", {-16, 0, -8, 8, -14, 2, -6, 10, -12, 4, -4, 12, -10, 6, -2, 14}, kLensV5,
             kUnitV4_m)},
      {Model::kC32V4, 0x20,
       table("LSLidar C32, firmware 4", {-16, -8, 0, 8,  -15, -7, 1, 9,  -14, -6, 2, 10, -13, -5, 3, 11,
                                         -12, -4, 4, 12, -11, -3, 5, 13, -10, -2, 6, 14, -9,  -1, 7, 15},
             kLensV4, kUnitV4_m)},
      {Model::kC32V5, 0x64,
       table("LSLidar C32, firmware 5",
             {-20.8, 0.0, -10.4, 10.4, -15.6, 5.2, -5.2, 15.6, -19.5, 1.3, -9.1, 11.7, -14.3, 6.5, -3.9, 16.9,
              -18.2, 2.6, -7.8,  13.0, -13.0, 7.8, -2.6, 18.2, -16.9, 3.9, -6.5, 14.3, -11.7, 9.1, -1.3, 19.5},
             kLensV5, kUnitV4_m)},
      {Model::kC32W45, 0x45,
       table("LSLidar C32W (0x45)",
             {-51.0, -31.0, -9.0, 3.0, -48.5, -28.0, -7.5, 4.5,  -46.0, -25.0, -6.0, 6.0,  -43.5, -22.0, -4.5, 7.5,
              -41.0, -18.5, -3.0, 9.0, -38.5, -15.0, -1.5, 11.0, -36.0, -12.0, 0.0,  13.0, -33.5, -10.5, 1.5,  15.0},
             kLensWide, kUnitV4_m)},
      {Model::kC32W46, 0x46,
       with_eight_ahead(table(
           "LSLidar C32W (0x46)",
           {-54.0, -31.0, -8.0,  2.66, -51.5, -28.0, -6.66, 4.0,  -49.0, -25.0, -5.33, 5.5,  -46.0, -22.0, -4.0, 7.0,
            -43.0, -18.5, -2.66, 9.0,  -40.0, -15.0, -1.33, 11.0, -37.0, -12.0, 0.0,   13.0, -34.0, -10.0, 1.33, 15.0},
           kLensWide, kUnitV4_m))},
      {Model::kC32W47, 0x47,
       table("LSLidar C32W (0x47)",
             {-54.7, -31.0, -9.0, 3.0, -51.5, -28.0, -7.5, 4.5,  -49.0, -25.0, -6.0, 6.0,  -46.0, -22.0, -4.5, 7.5,
              -43.0, -18.5, -3.0, 9.0, -40.0, -15.0, -1.5, 11.0, -37.0, -12.0, 0.0,  13.0, -34.0, -10.5, 1.5,  15.0},
             kLensWide, kUnitV4_m)},
      {Model::kC32W48, 0x48,
       table("LSLidar C32W (0x48)",
             {-54.7, -9.0, -31.0, 3.0, -51.5, -7.5, -28.0, 4.5,  -49.0, -6.0, -25.0, 6.0,  -46.0, -4.5, -22.0, 7.5,
              -43.0, -3.0, -18.5, 9.0, -40.0, -1.5, -15.0, 11.0, -37.0, 0.0,  -12.0, 13.0, -34.0, 1.5,  -10.5, 15.0},
             kLensWide, kUnitV4_m)},
      {Model::kCh32r5a, 0x5A,
       table("LSLidar CH32R (0x5a)",
             {2.487,  25.174, 47.201, 68.819, 5.596,  27.811, 49.999, 71.525, 8.591,  30.429, 52.798,
              74.274, 11.494, 33.191, 55.596, 77.074, 14.324, 36.008, 58.26,  79.938, 17.096, 38.808,
              60.87,  82.884, 19.824, 41.603, 63.498, 85.933, 22.513, 44.404, 66.144, 89.105},
             kLensHemisphere, kUnitV4_m)},
      {Model::kCh32r5d, 0x5D,
       table("LSLidar CH32R (0x5d)",
             {2.487,  47.201, 25.174, 68.819, 5.596,  49.999, 27.811, 71.525, 8.591,  52.798, 30.429,
              74.274, 11.494, 55.596, 33.191, 77.074, 14.324, 58.26,  36.008, 79.938, 17.096, 60.87,
              38.808, 82.884, 19.824, 63.498, 41.603, 85.933, 22.513, 66.144, 44.404, 89.105},
             kLensHemisphere, kUnitV4_m)},
      {Model::kC8, 0x08, table("LSLidar C8", {-10, 4, -8, 8, -4, 10, 0, 12}, kLensV4, kUnitV4_m)},
      {Model::kC8f, 0x07, table("LSLidar C8F", {-2, 6, 0, 8, 2, 10, 4, 12}, kLensV4, kUnitV4_m)},
      {Model::kCkm8, 0x09, table("LSLidar CKM8", {-12, 4, -8, 8, -4, 10, 0, 12}, kLensV4, kUnitV4_m)}};
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

const BeamTable& lslidar_c16_v3_narrow() {
  // Two thirds of the other kind's angles, to a hundredth of a degree.
  static const BeamTable beams =
      table("LSLidar C16, firmware 2 or 3",
            {-10.0, 0.665, -8.665, 2.0, -7.33, 3.33, -6.0, 4.665, -4.665, 6.0, -3.33, 7.33, -2.0, 8.665, -0.665, 10.0},
            kLensC16V3, kUnitV3_m);
  return beams;
}

const BeamTable& lslidar_c32_v3_dense() {
  static const BeamTable beams =
      table("LSLidar C32, firmware 2 or 3",
            {-18, -1,   -15,   -0.66, -12, -0.33, -10,   0, -8,    0.33, -7, 0.66, -6,    1,  -5,    1.33,
             -4,  1.66, -3.33, 2,     -3,  3,     -2.66, 4, -2.33, 6,    -2, 8,    -1.66, 11, -1.33, 14},
            kLensC32V3, kUnitV4_m);
  return beams;
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
