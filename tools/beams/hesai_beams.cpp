// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Elevations and azimuths are those of the design: each sensor is a little off, and tells by how much. Its azimuths are
// beside that of the block, for whatever moment a laser fires: so the manuals count, and the drivers.

#include <algorithm>
#include <array>
#include <cmath>

#include "beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kHesaiUnit_m = 0.004;

// Times since the block's; here from the first laser on.
template <std::size_t N>
void set_times(const std::array<std::int32_t, N>& times_ns, BeamTable* table) {
  const std::int32_t first_ns = *std::min_element(times_ns.begin(), times_ns.end());
  for (std::size_t i = 0; i < N; ++i) table->lasers[i].after_ns = times_ns[i] - first_ns;
}

// PandarXT-32 user manual: appendix I (design values) and II (times). Accuracy 1 cm.
BeamTable xt32() {
  BeamTable table{SensorMaker::kHesai,
                  "hesai-xt32",
                  "Hesai PandarXT-32",
                  "PandarXT-32 user manual, appendices I and II",
                  {},
                  2000,
                  50'000.0,
                  false,
                  {},
                  {kHesaiUnit_m, 0.01, 0.05, 120.0, 0.0}};
  for (int i = 0; i < 32; ++i) table.lasers.push_back({15.0 - i, 0.0, 0.0, 1'512.0 * i, 0});
  number_rings(&table.lasers);
  return table;
}

// PandarXT-16 user manual: appendix I (design values; PandarXT-16_Angle Correction File.csv of HesaiLidar_SDK_2.0) and
// II (times; PandarXT-16_Firetime Correction File.csv of the same). Accuracy 1 cm.
BeamTable xt16() {
  BeamTable table{SensorMaker::kHesai,
                  "hesai-xt16",
                  "Hesai PandarXT-16",
                  "HesaiLidar_SDK_2.0, angle and firetime correction files of PandarXT-16",
                  {},
                  2000,
                  50'000.0,
                  false,
                  {},
                  {kHesaiUnit_m, 0.01, 0.05, 120.0, 0.0}};
  for (int i = 0; i < 16; ++i) table.lasers.push_back({15.0 - 2.0 * i, 0.0, 0.0, 3'024.0 * i, 0});
  number_rings(&table.lasers);
  return table;
}

// The design from the field of view and its steps (tier4/nebula 606ac41f, pandar_xt32m.hpp; two sensors' tables are
// within 0.1 degrees); times of PandarXT-32M2X_Firetime Correction File.csv of HesaiLidar_SDK_2.0 (ea7f86f): laser 17
// fires with the first. The unit is that of the packets of Nebula's bag. Noise is taken from the XT32.
BeamTable xt32m() {
  BeamTable table{SensorMaker::kHesai,
                  "hesai-xt32m",
                  "Hesai PandarXT-32M2X",
                  "HesaiLidar_SDK_2.0, firetime correction file of PandarXT-32M2X; tier4/nebula",
                  {},
                  1998,
                  50'000.0,
                  false,
                  {},
                  {0.005, 0.01, 0.5, 300.0, 0.0}};
  for (int i = 0; i < 32; ++i) table.lasers.push_back({19.5 - 1.3 * i, 0.0, 0.0, 2'888.0 * (i % 16), 0});
  number_rings(&table.lasers);
  return table;
}

constexpr std::array<std::int32_t, 40> kPandar40pTimes_ns = {
    -42220, -28470, -16040, -3620,  -45490, -31740, -47460, -54670, -20620, -33710, -40910, -8190,  -20620, -27160,
    -50730, -8190,  -14740, -36980, -45490, -52700, -23890, -31740, -38950, -11470, -18650, -25190, -48760, -6230,
    -12770, -35010, -21920, -9500,  -43520, -29770, -17350, -4920,  -42220, -28470, -16040, -3620};

// Pandar40P user manual: appendix I (design values; the same table as of the Pandar40) and II (times). Accuracy 2 cm.
BeamTable pandar40p() {
  BeamTable table{SensorMaker::kHesai,
                  "hesai-pandar40p",
                  "Hesai Pandar40P",
                  "Pandar40P user manual, appendices I and II",
                  {},
                  1800,
                  55'560.0,
                  false,
                  {},
                  {kHesaiUnit_m, 0.01, 0.3, 200.0, 0.0}};
  for (const double top_deg : {15.0, 11.0, 8.0, 5.0, 3.0, 2.0}) table.lasers.push_back({top_deg, -1.042, 0.0, 0.0, 0});
  // A third of a degree apart, three columns of lasers in turn.
  constexpr std::array<double, 3> kColumns_deg = {3.125, -5.208, -1.042};
  for (int i = 0; i < 24; ++i) {
    const double elevation_deg = std::round(100.0 * (5 - i) / 3.0) / 100.0;
    table.lasers.push_back({elevation_deg, kColumns_deg[static_cast<std::size_t>(i % 3)], 0.0, 0.0, 0});
  }
  for (const double low_deg : {-7.0, -8.0, -9.0, -10.0, -11.0, -12.0, -13.0, -14.0, -19.0, -25.0}) {
    table.lasers.push_back({low_deg, -1.042, 0.0, 0.0, 0});
  }
  set_times(kPandar40pTimes_ns, &table);
  number_rings(&table.lasers);
  return table;
}

constexpr std::array<std::int32_t, 64> kQt64Times_ns = {
    12310,  14370,  16430,  18490,  20540,  22600,  24660,  26710,  29160,  31220,  33280,  35340,  37390,
    39450,  41500,  43560,  46610,  48670,  50730,  52780,  54840,  56900,  58950,  61010,  63450,  65520,
    67580,  69630,  71690,  73740,  75800,  77860,  80900,  82970,  85020,  87080,  89140,  91190,  93250,
    95300,  97750,  99820,  101870, 103930, 105980, 108040, 110100, 112150, 115200, 117260, 119320, 121380,
    123430, 125490, 127540, 129600, 132050, 134110, 136170, 138220, 140280, 142340, 144390, 146450};
constexpr std::array<std::array<double, 2>, 64> kQt64_deg = {
    {{-52.121, 8.736},  {-49.785, 8.314},  {-47.577, 7.964},  {-45.477, 7.669},  {-43.465, 7.417},  {-41.528, 7.198},
     {-39.653, 7.007},  {-37.831, 6.838},  {-36.055, 6.688},  {-34.320, 6.554},  {-32.619, 6.434},  {-30.950, 6.326},
     {-29.308, 6.228},  {-27.690, 6.140},  {-26.094, 6.059},  {-24.517, 5.987},  {-22.964, -5.270}, {-21.420, -5.216},
     {-19.889, -5.167}, {-18.372, -5.123}, {-16.865, -5.083}, {-15.368, -5.047}, {-13.880, -5.016}, {-12.399, -4.988},
     {-10.925, -4.963}, {-9.457, -4.942},  {-7.994, -4.924},  {-6.535, -4.910},  {-5.079, -4.898},  {-3.626, -4.889},
     {-2.175, -4.884},  {-0.725, -4.881},  {0.725, 5.493},    {2.175, 5.496},    {3.626, 5.502},    {5.079, 5.512},
     {6.534, 5.525},    {7.993, 5.541},    {9.456, 5.561},    {10.923, 5.584},   {12.397, 5.611},   {13.877, 5.642},
     {15.365, 5.676},   {16.861, 5.716},   {18.368, 5.759},   {19.885, 5.808},   {21.415, 5.862},   {22.959, 5.921},
     {24.524, -5.330},  {26.101, -5.396},  {27.697, -5.469},  {29.315, -5.550},  {30.957, -5.640},  {32.627, -5.740},
     {34.328, -5.850},  {36.064, -5.974},  {37.840, -6.113},  {39.662, -6.269},  {41.537, -6.447},  {43.475, -6.651},
     {45.487, -6.887},  {47.587, -7.163},  {49.795, -7.493},  {52.133, -7.892}}};

// PandarQT user manual: appendix I (design values) and II (times). The maker's table of angles is also PandarQT64.csv
// of tier4/nebula. Accuracy 3 cm.
BeamTable qt64() {
  BeamTable table{SensorMaker::kHesai,
                  "hesai-qt64",
                  "Hesai PandarQT",
                  "PandarQT user manual, appendices I and II",
                  {},
                  600,
                  500'000.0 / 3.0,
                  false,
                  {},
                  {kHesaiUnit_m, 0.015, 0.1, 60.0, 0.0}};
  for (const auto& [elevation_deg, azimuth_deg] : kQt64_deg) {
    table.lasers.push_back({elevation_deg, azimuth_deg, 0.0, 0.0, 0});
  }
  set_times(kQt64Times_ns, &table);
  number_rings(&table.lasers);
  return table;
}

}  // namespace

const BeamTable& hesai_xt32() {
  static const BeamTable table = xt32();
  return table;
}

const BeamTable& hesai_xt16() {
  static const BeamTable table = xt16();
  return table;
}

const BeamTable& hesai_xt32m() {
  static const BeamTable table = xt32m();
  return table;
}

const BeamTable& hesai_pandar40p() {
  static const BeamTable table = pandar40p();
  return table;
}

const BeamTable& hesai_qt64() {
  static const BeamTable table = qt64();
  return table;
}

}  // namespace pose_wall::tools
