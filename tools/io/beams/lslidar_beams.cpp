// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The light of an LSLidar leaves beside the head's azimuth, and the lens turns with a laser's own offset. Lens, unit,
// order of lasers and angles: the maker's Lslidar_ROS1_driver, f29e947a, lslidar_cx_driver.{hpp,cpp}; of firmware 2 and
// 3 also its older drivers in tianb03/lslidar_c16, 5a86ad87, and LarryDong/lslidar, 26220e90. The head turns evenly
// over the 32 returns of a block. Accuracy 3 cm. The driver calls azimuth 0 its y; here it is x, as everywhere.

#include <array>

#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kReturnsOfBlock = 32, kBlocksOfPacket = 12;
// The older drivers: 20,000 firings a second of a C16, two in a block; 650,000 points a second of a C32. The others are
// taken to be like the one that has as many lasers.
constexpr double kBlockOfC16_ns = 100'000.0, kBlockOfC32_ns = 49'230.0;
constexpr double kTurn_ns = 1e8;                         // at 600 turns a minute
constexpr double kNearest_m = 0.3, kFarthest_m = 150.0;  // judgement, 2026-11-28: no sheet was at hand

constexpr Lens kLensC16V3 = {0.0431, -14.68, false, true}, kLensC32V3 = {0.0494, -12.98, false, true};
constexpr Lens kLensV4 = {0.0361, -20.25, false, true}, kLensV5 = {0.035, -21.80, false, true};
constexpr Lens kLensWide = {0.03416, -20.25, false, true}, kLensHemisphere = {0.0209, -27.76, false, true};
constexpr double kUnitV3_m = 0.0025, kUnitV4_m = 0.004;

BeamTable lslidar(const char* word, const char* title, const std::vector<double>& elevations_deg, const Lens& lens,
                  double unit_m) {
  const std::size_t lasers = elevations_deg.size(), firings = kReturnsOfBlock / lasers;
  const double cycle_ns = (firings == 1 ? kBlockOfC32_ns : kBlockOfC16_ns) / static_cast<double>(firings);
  const auto packets = static_cast<std::size_t>(kTurn_ns / cycle_ns) / (kBlocksOfPacket * firings);
  BeamTable table{SensorMaker::kLslidar,
                  word,
                  title,
                  "Lslidar_ROS1_driver f29e947a",
                  {},
                  static_cast<std::uint32_t>(packets * kBlocksOfPacket * firings),
                  cycle_ns,
                  true,
                  lens,
                  {unit_m, 0.015, kNearest_m, kFarthest_m, 0.0}};
  for (std::size_t k = 0; k < lasers; ++k) {
    const double after_ns = cycle_ns * static_cast<double>(k) / static_cast<double>(lasers);
    table.lasers.push_back({elevations_deg[k], 0.0, 0.0, after_ns, 0});
  }
  number_rings(&table.lasers);
  return table;
}

// Eight of its lasers look 3.89 degrees ahead of the others.
BeamTable with_eight_ahead(BeamTable table) {
  for (const std::size_t i : {6U, 7U, 14U, 15U, 22U, 23U, 29U, 30U}) table.lasers[i].azimuth_deg = 3.89;
  return table;
}

// A C32 of firmware 3. How far apart its columns are each sensor tells in its device packet. The drivers agree for 3 to
// 4.6 degrees of two; these angles are judgement, 2026-12-01.
BeamTable in_columns(BeamTable table) {
  const bool is_dense = table.word == "lslidar-c32-v3-dense";
  const std::vector<double> columns_deg =
      is_dense ? std::vector<double>{-4.5, -1.5, 1.5, 4.5} : std::vector<double>{2.0, -2.0};
  table.source = "lslidar 26220e90";
  for (std::size_t i = 0; i < table.lasers.size(); ++i) {
    table.lasers[i].azimuth_deg = columns_deg[lslidar_c32_column(is_dense, i)];
  }
  return table;
}

const std::vector<BeamTable>& of_firmware_3() {
  static const std::vector<BeamTable> tables = {
      lslidar("lslidar-c16-v3", "LSLidar C16, firmware 2 or 3",
              {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15}, kLensC16V3, kUnitV3_m),
      // Two thirds of the other kind's angles, to a hundredth of a degree.
      lslidar(
          "lslidar-c16-v3-narrow", "LSLidar C16, firmware 2 or 3, of 10 degrees",
          {-10.0, 0.665, -8.665, 2.0, -7.33, 3.33, -6.0, 4.665, -4.665, 6.0, -3.33, 7.33, -2.0, 8.665, -0.665, 10.0},
          kLensC16V3, kUnitV3_m),
      in_columns(lslidar("lslidar-c32-v3", "LSLidar C32, firmware 2 or 3",
                         {-16, 0, -15, 1, -14, 2,  -13, 3,  -12, 4,  -11, 5,  -10, 6,  -9, 7,
                          -8,  8, -7,  9, -6,  10, -5,  11, -4,  12, -3,  13, -2,  14, -1, 15},
                         kLensC32V3, kUnitV4_m)),
      in_columns(lslidar("lslidar-c32-v3-dense", "LSLidar C32, firmware 2 or 3, dense in the middle",
                         {-18, -1,   -15,   -0.66, -12, -0.33, -10,   0, -8,    0.33, -7, 0.66, -6,    1,  -5,    1.33,
                          -4,  1.66, -3.33, 2,     -3,  3,     -2.66, 4, -2.33, 6,    -2, 8,    -1.66, 11, -1.33, 14},
                         kLensC32V3, kUnitV4_m))};
  return tables;
}

const std::vector<BeamTable>& of_firmware_4_and_5() {
  static const std::vector<BeamTable> tables = {
      lslidar("lslidar-c16-v4", "LSLidar C16, firmware 4",
              {-16, 0, -14, 2, -12, 4, -10, 6, -8, 8, -6, 10, -4, 12, -2, 14}, kLensV4, kUnitV4_m),
      lslidar("lslidar-c16-v4b", "LSLidar C16, firmware 4, of the second kind",
              {-16, -8, 0, 8, -14, -6, 2, 10, -12, -4, 4, 12, -10, -2, 6, 14}, kLensV4, kUnitV4_m),
      lslidar("lslidar-c16-v5", "LSLidar C16, firmware 5",
              {-16, 0, -8, 8, -14, 2, -6, 10, -12, 4, -4, 12, -10, 6, -2, 14}, kLensV5, kUnitV4_m),
      lslidar("lslidar-c32-v4", "LSLidar C32, firmware 4",
              {-16, -8, 0, 8,  -15, -7, 1, 9,  -14, -6, 2, 10, -13, -5, 3, 11,
               -12, -4, 4, 12, -11, -3, 5, 13, -10, -2, 6, 14, -9,  -1, 7, 15},
              kLensV4, kUnitV4_m),
      lslidar("lslidar-c32-v5", "LSLidar C32, firmware 5",
              {-20.8, 0.0, -10.4, 10.4, -15.6, 5.2, -5.2, 15.6, -19.5, 1.3, -9.1, 11.7, -14.3, 6.5, -3.9, 16.9,
               -18.2, 2.6, -7.8,  13.0, -13.0, 7.8, -2.6, 18.2, -16.9, 3.9, -6.5, 14.3, -11.7, 9.1, -1.3, 19.5},
              kLensV5, kUnitV4_m),
      lslidar("lslidar-c8", "LSLidar C8", {-10, 4, -8, 8, -4, 10, 0, 12}, kLensV4, kUnitV4_m),
      lslidar("lslidar-c8f", "LSLidar C8F", {-2, 6, 0, 8, 2, 10, 4, 12}, kLensV4, kUnitV4_m),
      lslidar("lslidar-ckm8", "LSLidar CKM8", {-12, 4, -8, 8, -4, 10, 0, 12}, kLensV4, kUnitV4_m)};
  return tables;
}

// 70 degrees, four kinds by their model byte.
const std::vector<BeamTable>& of_wide_kinds() {
  static const std::vector<BeamTable> tables = {
      lslidar("lslidar-c32w-45", "LSLidar C32W (0x45)",
              {-51.0, -31.0, -9.0, 3.0, -48.5, -28.0, -7.5, 4.5,  -46.0, -25.0, -6.0, 6.0,  -43.5, -22.0, -4.5, 7.5,
               -41.0, -18.5, -3.0, 9.0, -38.5, -15.0, -1.5, 11.0, -36.0, -12.0, 0.0,  13.0, -33.5, -10.5, 1.5,  15.0},
              kLensWide, kUnitV4_m),
      with_eight_ahead(lslidar(
          "lslidar-c32w-46", "LSLidar C32W (0x46)",
          {-54.0, -31.0, -8.0,  2.66, -51.5, -28.0, -6.66, 4.0,  -49.0, -25.0, -5.33, 5.5,  -46.0, -22.0, -4.0, 7.0,
           -43.0, -18.5, -2.66, 9.0,  -40.0, -15.0, -1.33, 11.0, -37.0, -12.0, 0.0,   13.0, -34.0, -10.0, 1.33, 15.0},
          kLensWide, kUnitV4_m)),
      lslidar("lslidar-c32w-47", "LSLidar C32W (0x47)",
              {-54.7, -31.0, -9.0, 3.0, -51.5, -28.0, -7.5, 4.5,  -49.0, -25.0, -6.0, 6.0,  -46.0, -22.0, -4.5, 7.5,
               -43.0, -18.5, -3.0, 9.0, -40.0, -15.0, -1.5, 11.0, -37.0, -12.0, 0.0,  13.0, -34.0, -10.5, 1.5,  15.0},
              kLensWide, kUnitV4_m),
      lslidar("lslidar-c32w-48", "LSLidar C32W (0x48)",
              {-54.7, -9.0, -31.0, 3.0, -51.5, -7.5, -28.0, 4.5,  -49.0, -6.0, -25.0, 6.0,  -46.0, -4.5, -22.0, 7.5,
               -43.0, -3.0, -18.5, 9.0, -40.0, -1.5, -15.0, 11.0, -37.0, 0.0,  -12.0, 13.0, -34.0, 1.5,  -10.5, 15.0},
              kLensWide, kUnitV4_m)};
  return tables;
}

// 90 degrees, two kinds.
const std::vector<BeamTable>& of_hemispheres() {
  static const std::vector<BeamTable> tables = {
      lslidar("lslidar-ch32r-5a", "LSLidar CH32R (0x5a)",
              {2.487,  25.174, 47.201, 68.819, 5.596,  27.811, 49.999, 71.525, 8.591,  30.429, 52.798,
               74.274, 11.494, 33.191, 55.596, 77.074, 14.324, 36.008, 58.26,  79.938, 17.096, 38.808,
               60.87,  82.884, 19.824, 41.603, 63.498, 85.933, 22.513, 44.404, 66.144, 89.105},
              kLensHemisphere, kUnitV4_m),
      lslidar("lslidar-ch32r-5d", "LSLidar CH32R (0x5d)",
              {2.487,  47.201, 25.174, 68.819, 5.596,  49.999, 27.811, 71.525, 8.591,  52.798, 30.429,
               74.274, 11.494, 55.596, 33.191, 77.074, 14.324, 58.26,  36.008, 79.938, 17.096, 60.87,
               38.808, 82.884, 19.824, 63.498, 41.603, 85.933, 22.513, 66.144, 44.404, 89.105},
              kLensHemisphere, kUnitV4_m)};
  return tables;
}

}  // namespace

std::size_t lslidar_c32_column(bool is_dense, std::size_t laser) {
  // The older driver's four lists for firmware 3. Two columns stand by turns of elevation, which are two and two in the
  // order of firing.
  constexpr std::array<std::size_t, kReturnsOfBlock> dense = {3, 3, 2, 2, 3, 1, 2, 0, 3, 3, 2, 2, 3, 1, 2, 0,
                                                              3, 3, 2, 2, 1, 3, 0, 2, 3, 3, 2, 2, 1, 3, 0, 2};
  return is_dense ? dense.at(laser) : laser / 2 % 2;
}

std::vector<const BeamTable*> lslidar_tables() {
  std::vector<const BeamTable*> all;
  for (const auto* const tables : {&of_firmware_3(), &of_firmware_4_and_5(), &of_wide_kinds(), &of_hemispheres()}) {
    for (const BeamTable& table : *tables) all.push_back(&table);
  }
  return all;
}

}  // namespace pose_wall::tools
