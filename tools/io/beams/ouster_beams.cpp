// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Angles as sensors tell them in their metadata, from the top. Those of a first OS0-128 and OS1-128 are without a mark
// of production: symmetric to the last digit. Revisions keep them within a degree and shift where the light leaves. All
// from tests/ of ouster-lidar/ouster-sdk, 46b7bcee, which holds metadata of real sensors by part number.

#include <array>
#include <cmath>
#include <utility>

#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kOusterUnit_m = 0.001;
constexpr double kOusterTurn_ns = 1e8;
constexpr std::uint32_t kOusterColumns = 1024;  // as it leaves the factory

// Elevation and azimuth of the upper half; the lower is its mirror image in both.
// OS0-128, part 840-102144-A (metadata/1_14_6cccd_os-882002000138-128_legacy.json).
constexpr std::array<std::array<double, 2>, 64> kOs0_deg = {
    {{46.2, 11.15},   {45.12, 3.677},  {44.36, -3.639}, {43.9, -10.81},  {43.14, 10.7},   {42.09, 3.534},
     {41.33, -3.502}, {40.87, -10.41}, {40.11, 10.32},  {39.09, 3.412},  {38.34, -3.384}, {37.86, -10.08},
     {37.11, 9.999},  {36.11, 3.307},  {35.37, -3.283}, {34.88, -9.786}, {34.14, 9.72},   {33.16, 3.217},
     {32.43, -3.197}, {31.92, -9.537}, {31.19, 9.48},   {30.24, 3.14},   {29.51, -3.122}, {28.99, -9.322},
     {28.26, 9.273},  {27.33, 3.074},  {26.61, -3.059}, {26.07, -9.138}, {25.34, 9.096},  {24.44, 3.017},
     {23.72, -3.004}, {23.17, -8.981}, {22.45, 8.945},  {21.57, 2.968},  {20.86, -2.957}, {20.29, -8.847},
     {19.57, 8.818},  {18.72, 2.927},  {18, -2.918},    {17.42, -8.736}, {16.7, 8.711},   {15.87, 2.894},
     {15.16, -2.886}, {14.56, -8.643}, {13.84, 8.623},  {13.04, 2.866},  {12.33, -2.86},  {11.71, -8.57},
     {10.99, 8.554},  {10.21, 2.844},  {9.503, -2.84},  {8.862, -8.513}, {8.152, 8.501},  {7.388, 2.828},
     {6.684, -2.825}, {6.023, -8.472}, {5.314, 8.465},  {4.572, 2.817},  {3.868, -2.815}, {3.188, -8.447},
     {2.479, 8.444},  {1.758, 2.811},  {1.055, -2.811}, {0.3541, -8.438}}};
// OS1-128, part 840-102145-A (metadata/2_0_0_os1-992008000494-128_col_win_legacy.json).
constexpr std::array<std::array<double, 2>, 64> kOs1_deg = {
    {{21.4764, 4.2521},  {21.1679, 1.4197},  {20.8583, -1.4196}, {20.5477, -4.252},  {20.2356, 4.2519},
     {19.9221, 1.4196},  {19.6075, -1.4196}, {19.2919, -4.2518}, {18.975, 4.2517},   {18.6567, 1.4196},
     {18.3375, -1.4195}, {18.0171, -4.2517}, {17.6955, 4.2517},  {17.3729, 1.4196},  {17.0492, -1.4196},
     {16.7242, -4.2518}, {16.3982, 4.2518},  {16.0716, 1.4197},  {15.7437, -1.4197}, {15.4141, -4.2521},
     {15.0841, 4.2522},  {14.7537, 1.4198},  {14.4218, -1.4199}, {14.088, -4.2526},  {13.754, 4.2528},
     {13.4202, 1.4201},  {13.0844, -1.4202}, {12.7466, -4.2534}, {12.409, 4.2536},   {12.0718, 1.4204},
     {11.7326, -1.4205}, {11.3909, -4.2543}, {11.0499, 4.2546},  {10.7097, 1.4208},  {10.3671, -1.421},
     {10.022, -4.2555},  {9.6778, 4.2558},   {9.3348, 1.4213},   {8.9892, -1.4215},  {8.641, -4.2568},
     {8.2939, 4.2572},   {7.9482, 1.4219},   {7.5999, -1.422},   {7.249, -4.2582},   {6.8994, 4.2586},
     {6.5512, 1.4224},   {6.2005, -1.4225},  {5.8474, -4.2596},  {5.4956, 4.2599},   {5.1452, 1.4229},
     {4.7925, -1.423},   {4.4377, -4.2608},  {4.0842, 4.2611},   {3.7318, 1.4234},   {3.3775, -1.4234},
     {3.0216, -4.2618},  {2.6668, 4.262},    {2.3127, 1.4237},   {1.9573, -1.4237},  {1.601, -4.2625},
     {1.2454, 4.2626},   {0.89, 1.4239},     {0.5341, -1.4239},  {0.1779, -4.2628}}};

// All rows of an OS2-128, part 840-103576-06 (pcaps/OS-2-128-U1_v2.3.0_1024x10.json).
constexpr std::array<std::array<double, 2>, 128> kOs2_deg = {
    {{10.76, 2.07},   {10.58, 0.66},  {10.42, -0.71}, {10.24, -2.08},  {10.1, 2.07},    {9.93, 0.69},   {9.76, -0.7},
     {9.57, -2.09},   {9.41, 2.06},   {9.24, 0.67},   {9.09, -0.71},   {8.91, -2.06},   {8.75, 2.06},   {8.57, 0.69},
     {8.41, -0.71},   {8.23, -2.07},  {8.08, 2.07},   {7.9, 0.69},     {7.74, -0.71},   {7.55, -2.07},  {7.39, 2.07},
     {7.21, 0.69},    {7.03, -0.7},   {6.86, -2.08},  {6.7, 2.05},     {6.53, 0.68},    {6.35, -0.69},  {6.18, -2.06},
     {6.02, 2.06},    {5.83, 0.69},   {5.67, -0.69},  {5.5, -2.07},    {5.32, 2.08},    {5.14, 0.69},   {4.97, -0.69},
     {4.81, -2.06},   {4.63, 2.08},   {4.46, 0.69},   {4.28, -0.69},   {4.11, -2.07},   {3.95, 2.08},   {3.76, 0.69},
     {3.58, -0.69},   {3.43, -2.05},  {3.24, 2.08},   {3.07, 0.7},     {2.9, -0.68},    {2.72, -2.06},  {2.55, 2.09},
     {2.37, 0.7},     {2.21, -0.67},  {2.03, -2.05},  {1.87, 2.08},    {1.69, 0.7},     {1.51, -0.68},  {1.32, -2.05},
     {1.16, 2.08},    {0.98, 0.71},   {0.81, -0.67},  {0.63, -2.06},   {0.46, 2.08},    {0.29, 0.71},   {0.11, -0.68},
     {-0.05, -2.05},  {-0.25, 2.07},  {-0.42, 0.71},  {-0.58, -0.67},  {-0.76, -2.05},  {-0.93, 2.08},  {-1.11, 0.7},
     {-1.28, -0.68},  {-1.45, -2.05}, {-1.63, 2.09},  {-1.81, 0.71},   {-1.97, -0.66},  {-2.16, -2.05}, {-2.32, 2.09},
     {-2.5, 0.71},    {-2.68, -0.67}, {-2.85, -2.05}, {-3.02, 2.09},   {-3.19, 0.71},   {-3.37, -0.66}, {-3.55, -2.05},
     {-3.73, 2.1},    {-3.9, 0.71},   {-4.07, -0.66}, {-4.25, -2.05},  {-4.4, 2.09},    {-4.58, 0.73},  {-4.75, -0.67},
     {-4.94, -2.05},  {-5.11, 2.1},   {-5.28, 0.72},  {-5.46, -0.66},  {-5.64, -2.05},  {-5.8, 2.09},   {-5.96, 0.72},
     {-6.15, -0.66},  {-6.32, -2.05}, {-6.49, 2.11},  {-6.66, 0.73},   {-6.84, -0.69},  {-7, -2.03},    {-7.17, 2.1},
     {-7.35, 0.72},   {-7.51, -0.65}, {-7.69, -2.04}, {-7.86, 2.11},   {-8.04, 0.72},   {-8.22, -0.67}, {-8.38, -2.05},
     {-8.55, 2.1},    {-8.72, 0.72},  {-8.89, -0.66}, {-9.06, -2.04},  {-9.23, 2.11},   {-9.4, 0.72},   {-9.57, -0.66},
     {-9.74, -2.04},  {-9.91, 2.1},   {-10.07, 0.72}, {-10.24, -0.65}, {-10.41, -2.03}, {-10.58, 2.11}, {-10.75, 0.73},
     {-10.92, -0.66}, {-11.09, -2.04}}};

using Row = std::array<double, 2>;

template <std::size_t N>
std::vector<Row> with_mirror_image(const std::array<Row, N>& upper) {
  std::vector<Row> rows(upper.begin(), upper.end());
  for (std::size_t i = N; i-- > 0;) rows.push_back({-upper[i][0], -upper[i][1]});
  return rows;
}

// Of 64 lasers each second row is there, the last one among them (metadata/ouster-studio-reduced-config-v1.json).
std::vector<Row> every_second(const std::vector<Row>& rows) {
  std::vector<Row> half;
  for (std::size_t i = 1; i < rows.size(); i += 2) half.push_back(rows[i]);
  return half;
}

// The SDK's design values of the first generation, to a thousandth: even steps, four columns of lasers in turn.
std::vector<Row> of_first_generation() {
  constexpr double kTop_deg = 16.611;
  constexpr std::array<double, 4> kColumns_deg = {3.164, 1.055, -1.055, -3.164};
  std::vector<Row> rows;
  for (int i = 0; i < 64; ++i) {
    const double elevation_deg = std::round(1000.0 * kTop_deg * (1.0 - i / 31.5)) / 1000.0;
    rows.push_back({elevation_deg, kColumns_deg[static_cast<std::size_t>(i % 4)]});
  }
  return rows;
}

// All lasers of a column fire at once. A range holds the way from the axis to the lens, too.
BeamTable ouster(const char* word, const char* title, const char* source, const std::vector<Row>& rows, double out_m,
                 const Ranges& ranges) {
  BeamTable table{
      SensorMaker::kOuster, word,  title, source, {}, kOusterColumns, kOusterTurn_ns / kOusterColumns, false,
      {out_m, 0.0, true},   ranges};
  for (const auto& [elevation_deg, azimuth_deg] : rows) {
    table.lasers.push_back({elevation_deg, azimuth_deg, 0.0, 0.0, 0});
  }
  number_rings(&table.lasers);
  return table;
}

// Precision, nearest and farthest range, width of a beam: the data sheets of OS0, OS1 and OS2. REV7 begins at 0.5 m.
constexpr Ranges kOs0 = {kOusterUnit_m, 0.015, 0.3, 50.0, 0.35}, kOs0Rev7 = {kOusterUnit_m, 0.015, 0.5, 75.0, 0.35};
constexpr Ranges kOs1 = {kOusterUnit_m, 0.012, 0.3, 120.0, 0.18}, kOs1Rev7 = {kOusterUnit_m, 0.012, 0.5, 170.0, 0.18};
constexpr Ranges kOs2 = {kOusterUnit_m, 0.025, 1.0, 240.0, 0.09};

}  // namespace

const BeamTable& ouster_os0_128() {
  static const BeamTable table =
      ouster("ouster-os0-128", "Ouster OS0-128", "metadata of OS0-128 840-103574-06: 27.67 mm",
             with_mirror_image(kOs0_deg), 0.02767, kOs0);
  return table;
}

const BeamTable& ouster_os0_128_rev7() {
  static const BeamTable table =
      ouster("ouster-os0-128-rev7", "Ouster OS0-128 REV7", "metadata of OS0-128 840-104681-C: 27.116 mm",
             with_mirror_image(kOs0_deg), 0.027116, kOs0Rev7);
  return table;
}

const BeamTable& ouster_os1_64_gen1() {
  static const BeamTable table =
      ouster("ouster-os1-64-gen1", "Ouster OS1-64 of the first generation",
             "metadata of OS1-64 840-101396-03: 12.163 mm", of_first_generation(), 0.012163, kOs1);
  return table;
}

const BeamTable& ouster_os1_64() {
  static const BeamTable table =
      ouster("ouster-os1-64", "Ouster OS1-64", "metadata of OS1-128 840-103575-06: 15.806 mm",
             every_second(with_mirror_image(kOs1_deg)), 0.015806, kOs1);
  return table;
}

const BeamTable& ouster_os1_64_rev7() {
  static const BeamTable table =
      ouster("ouster-os1-64-rev7", "Ouster OS1-64 REV7", "metadata of OS1-128 840-104682-C: 16.721 mm",
             every_second(with_mirror_image(kOs1_deg)), 0.016721, kOs1Rev7);
  return table;
}

const BeamTable& ouster_os2_128() {
  static const BeamTable table =
      ouster("ouster-os2-128", "Ouster OS2-128", "metadata of OS2-128 840-103576-06: 13.762 mm",
             {kOs2_deg.begin(), kOs2_deg.end()}, 0.013762, kOs2);
  return table;
}

const BeamTable& ouster_os2_128_rev7() {
  static const BeamTable table =
      ouster("ouster-os2-128-rev7", "Ouster OS2-128 REV7", "metadata of OS2-128 840-104704-B: 27.397 mm",
             {kOs2_deg.begin(), kOs2_deg.end()}, 0.027397, kOs2);
  return table;
}

}  // namespace pose_wall::tools
