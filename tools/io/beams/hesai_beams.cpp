// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Elevations and azimuths are those of the design: each sensor is a little off, and tells by how much. Its azimuths are
// beside that of the block, for whatever moment a laser fires: so the manuals count, and the drivers.

#include <algorithm>
#include <array>
#include <cmath>

#include "io/beams/beam_table.hpp"

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

// A QT128C2X fires lasers 1 to 32 at one azimuth, 33 to 64 at the next, and the others at both: those 0.86 us earlier
// or later. Here they have the middle of the two.
constexpr std::array<std::int32_t, 128> kQt128Times_ns = {
    2312,  78344, 27656, 53000, 56168, 30824, 81512, 5480,  8648,  84680, 33992, 59336, 62504,  37160, 87848,  11816,
    14984, 91016, 40328, 65672, 68840, 43496, 94184, 18152, 21320, 97352, 46664, 72008, 75176,  49832, 100520, 24488,
    27656, 53000, 2312,  78344, 81512, 5480,  56168, 30824, 33992, 59336, 8648,  84680, 87848,  11816, 62504,  37160,
    40328, 65672, 14984, 91016, 94184, 18152, 68840, 43496, 46664, 72008, 21320, 97352, 100520, 24488, 75176,  49832,
    1028,  77060, 26372, 51716, 54884, 29540, 80228, 4196,  7364,  83396, 32708, 58052, 61220,  35876, 86564,  10532,
    13700, 89732, 39044, 64388, 67556, 42212, 92900, 16868, 20036, 96068, 45380, 70724, 73892,  48548, 99236,  23204,
    26372, 51716, 1028,  77060, 80228, 4196,  54884, 29540, 32708, 58052, 7364,  83396, 86564,  10532, 61220,  35876,
    39044, 64388, 13700, 89732, 92900, 16868, 67556, 42212, 45380, 70724, 20036, 96068, 99236,  23204, 73892,  48548};
constexpr std::array<std::array<double, 2>, 128> kQt128_deg = {
    {{-52.6268, 10.1083}, {-51.0281, 9.7195},  {-49.5150, 9.3843},  {-48.0739, 9.0914},  {-46.6947, 8.8329},
     {-45.3688, 8.6026},  {-44.0897, 8.3959},  {-42.8519, 8.2092},  {-41.6507, 8.0396},  {-40.4823, 7.8848},
     {-39.3433, 7.7429},  {-38.2309, 7.6123},  {-37.1426, 7.4918},  {-36.0764, 7.3802},  {-35.0302, 7.2766},
     {-34.0024, 7.1802},  {-32.9916, 7.0903},  {-31.9963, 7.0064},  {-31.0154, 6.9278},  {-30.0479, 6.8543},
     {-29.0926, 6.7853},  {-28.1488, 6.7205},  {-27.2157, 6.6597},  {-26.2924, 6.6024},  {-25.3784, 6.5486},
     {-24.4729, 6.4979},  {-23.5754, 6.4501},  {-22.6854, 6.4052},  {-21.8024, 6.3628},  {-20.9259, 6.3230},
     {-20.0555, 6.2855},  {-19.1908, 6.2502},  {-18.3314, -6.2170}, {-17.4769, -6.1858}, {-16.6271, -6.1566},
     {-15.7815, -6.1292}, {-14.9399, -6.1036}, {-14.1021, -6.0797}, {-13.2677, -6.0574}, {-12.4365, -6.0367},
     {-11.6082, -6.0175}, {-10.7826, -5.9998}, {-9.9595, -5.9836},  {-9.1387, -5.9688},  {-8.3199, -5.9553},
     {-7.5030, -5.9432},  {-6.6878, -5.9267},  {-5.8739, -5.9229},  {-5.0614, -5.9146},  {-4.2499, -5.9076},
     {-3.4394, -5.9019},  {-2.6296, -5.8974},  {-1.8204, -5.8940},  {-1.0115, -5.8919},  {-0.2029, -5.8910},
     {0.6057, -5.8913},   {1.4144, -5.8928},   {2.2235, -5.8955},   {3.0330, -5.8995},   {3.8431, -5.9046},
     {4.6541, -5.9110},   {5.4660, -5.9186},   {6.2792, -5.9275},   {7.0937, -5.9376},   {7.9098, 5.9491},
     {8.7276, 5.9618},    {9.5474, 5.9760},    {10.3693, 5.9915},   {11.1936, 6.0085},   {12.0205, 6.0269},
     {12.8502, 6.0468},   {13.6829, 6.0683},   {14.5190, 6.0914},   {15.3587, 6.1161},   {16.2022, 6.1426},
     {17.0499, 6.1709},   {17.9020, 6.2011},   {18.7589, 6.2333},   {19.6209, 6.2675},   {20.4884, 6.3039},
     {21.3618, 6.3425},   {22.2415, 6.3836},   {23.1279, 6.4272},   {24.0216, 6.4736},   {24.9229, 6.5227},
     {25.8326, 6.5750},   {26.7512, 6.6305},   {27.6793, 6.6895},   {28.6176, 6.7523},   {29.5670, 6.8191},
     {30.5283, 6.8903},   {31.5024, 6.9663},   {32.4903, 7.0475},   {33.4931, 7.1343},   {34.5122, 7.2273},
     {35.5490, 7.3272},   {19.1908, -6.2502},  {20.0555, -6.2855},  {20.9259, -6.3230},  {21.8024, -6.3628},
     {22.6854, -6.4052},  {23.5754, -6.4501},  {24.4729, -6.4979},  {25.3784, -6.5486},  {26.2924, -6.6024},
     {27.2157, -6.6597},  {28.1488, -6.7205},  {29.0926, -6.7853},  {30.0479, -6.8543},  {31.0154, -6.9278},
     {31.9963, -7.0064},  {32.9916, -7.0903},  {34.0024, -7.1802},  {35.0302, -7.2766},  {36.0764, -7.3802},
     {37.1426, -7.4918},  {38.2309, -7.6123},  {39.3433, -7.7429},  {40.4823, -7.8848},  {41.6507, -8.0396},
     {42.8519, -8.2092},  {44.0897, -8.3959},  {45.3688, -8.6026},  {46.6947, -8.8329},  {48.0739, -9.0914},
     {49.5150, -9.3843},  {51.0281, -9.7195},  {52.6268, -10.1083}}};

// HesaiLidar_SDK_2.0 (ea7f86f): QT128C2X_Angle Correction File.csv and QT128C2X_Firetime Correction File.csv. Ranges:
// tier4/nebula (606ac41f), pandar_qt128.hpp. Noise is taken from the PandarQT.
BeamTable qt128() {
  BeamTable table{SensorMaker::kHesai,
                  "hesai-qt128",
                  "Hesai QT128C2X",
                  "HesaiLidar_SDK_2.0, angle and firetime correction files of QT128C2X",
                  {},
                  900,
                  111'110.0,
                  false,
                  {},
                  {kHesaiUnit_m, 0.015, 0.05, 50.0, 0.0}};
  for (const auto& [elevation_deg, azimuth_deg] : kQt128_deg) {
    table.lasers.push_back({elevation_deg, azimuth_deg, 0.0, 0.0, 0});
  }
  set_times(kQt128Times_ns, &table);
  number_rings(&table.lasers);
  return table;
}

constexpr std::array<std::int32_t, 64> kPandar64Times_ns = {
    -23180, -21876, -20572, -19268, -17964, -16660, -11444, -46796, -7532,  -36956, -50732, -54668, -40892,
    -44828, -31052, -34988, -48764, -52700, -38924, -42860, -29084, -33020, -46796, -25148, -36956, -50732,
    -27116, -40892, -44828, -31052, -34988, -48764, -25148, -38924, -42860, -29084, -33020, -52700, -6228,
    -54668, -15356, -27116, -10140, -23180, -4924,  -21876, -14052, -17964, -8836,  -19268, -3620,  -20572,
    -12748, -16660, -7532,  -11444, -6228,  -15356, -10140, -4924,  -3620,  -14052, -8836,  -12748};
constexpr std::array<double, 64> kPandar64_deg = {
    14.9,   11.05,  8.077,  5.075,  3.058,  2.046,   1.878,   1.706,   1.54,    1.369,   1.202,   1.031,  0.864,
    0.693,  0.526,  0.355,  0.187,  0.018,  -0.151,  -0.319,  -0.49,   -0.657,  -0.827,  -0.995,  -1.166, -1.333,
    -1.504, -1.67,  -1.842, -2.01,  -2.18,  -2.347,  -2.518,  -2.682,  -2.855,  -3.022,  -3.192,  -3.357, -3.53,
    -3.694, -3.866, -4.032, -4.203, -4.367, -4.54,   -4.702,  -4.874,  -5.039,  -5.211,  -5.373,  -5.547, -5.708,
    -5.88,  -6.043, -7.045, -8.041, -9.042, -10.027, -11.014, -11.988, -12.956, -13.912, -18.871, -24.879};

// Elevations of one sensor, Pandar64.csv of tier4/nebula (606ac41f): those of HesaiLidar_SDK_2.0 (ea7f86f) lie 0.19
// degrees lower. Times are those of its Pandar64_Firetime Correction File.csv. Noise is taken from the Pandar40P.
BeamTable pandar64() {
  BeamTable table{SensorMaker::kHesai,
                  "hesai-pandar64",
                  "Hesai Pandar64",
                  "tier4/nebula, Pandar64.csv; HesaiLidar_SDK_2.0, firetime correction file of Pandar64",
                  {},
                  1800,
                  55'560.0,
                  false,
                  {},
                  {kHesaiUnit_m, 0.01, 0.3, 200.0, 0.0}};
  // From the seventh to the 54th they lie in six columns, in turn.
  constexpr std::array<double, 6> kColumns_deg = {1.042, 3.125, 5.208, -5.208, -3.125, -1.042};
  for (std::size_t i = 0; i < kPandar64_deg.size(); ++i) {
    const double azimuth_deg = i < 54 ? kColumns_deg[i < 6 ? 5 : i % 6] : -1.042;
    table.lasers.push_back({kPandar64_deg[i], azimuth_deg, 0.0, 0.0, 0});
  }
  set_times(kPandar64Times_ns, &table);
  number_rings(&table.lasers);
  return table;
}

}  // namespace

const BeamTable& hesai_qt128() {
  static const BeamTable table = qt128();
  return table;
}

const BeamTable& hesai_pandar64() {
  static const BeamTable table = pandar64();
  return table;
}

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
