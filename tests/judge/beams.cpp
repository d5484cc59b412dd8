// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/beams.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace pose_wall::judge {
namespace {

constexpr double kTurn_us = 1e5;  // 10 Hz

Beams with_rings(Beams beams) {
  for (Beam& beam : beams.lasers) {
    beam.ring = static_cast<int>(std::count_if(beams.lasers.begin(), beams.lasers.end(), [&](const Beam& other) {
      return other.elevation_deg < beam.elevation_deg;
    }));
  }
  return beams;
}

// Rings at even steps that all fire at once, `columns` times a turn. Their azimuths repeat after every fourth.
Beams ouster(int rings, double up_deg, int columns, double lens_m, const std::array<double, 4>& azimuths_deg) {
  Beams beams;
  beams.firing_us = kTurn_us / columns;
  beams.lens_m = lens_m;
  beams.from_axis = true;
  for (int k = 0; k < rings; ++k) {
    const double elevation_deg = up_deg - 2.0 * up_deg * k / (rings - 1);
    beams.lasers.push_back({elevation_deg, azimuths_deg.at(static_cast<std::size_t>(k % 4)), 0.0, 0.0, 0});
  }
  return with_rings(beams);
}

}  // namespace

// Velodyne, VLP-16 User Manual, 63-9243: vertical angles and vertical corrections in mm by laser, and the table of
// times: a laser every 2.304 us, 16 of them and a pause in 55.296 us. Lasers look down and up in turn. One that looks
// down leaves the sensor as much higher as its mirror image leaves it lower.
const Beams& vlp16_beams() {
  static const Beams beams = [] {
    constexpr std::array<double, 8> kDown_deg = {15, 13, 11, 9, 7, 5, 3, 1};
    constexpr std::array<double, 8> kDown_mm = {11.2, 9.7, 8.1, 6.6, 5.1, 3.7, 2.2, 0.7};
    Beams puck;
    puck.firing_us = 55.296;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t mirrored = 7 - k;
      const double first_us = 2.0 * 2.304 * static_cast<double>(k);
      puck.lasers.push_back({-kDown_deg[k], 0.0, 1e-3 * kDown_mm[k], first_us, 0});
      puck.lasers.push_back({kDown_deg[mirrored], 0.0, -1e-3 * kDown_mm[mirrored], first_us + 2.304, 0});
    }
    return with_rings(puck);
  }();
  return beams;
}

// Velodyne, HDL-32E User Manual, 63-9113: lasers 4/3 of a degree apart from -30.67 to 10.67 degrees, of the lower and
// of the upper half in turn; one every 1.152 us, a firing in 46.080 us.
const Beams& hdl32_beams() {
  static const Beams beams = [] {
    Beams hdl;
    hdl.firing_us = 46.080;
    for (int k = 0; k < 32; ++k) {
      const int step = k % 2 == 0 ? k / 2 : 16 + k / 2;
      hdl.lasers.push_back({-92.0 / 3.0 + 4.0 / 3.0 * step, 0.0, 0.0, 1.152 * k, 0});
    }
    return with_rings(hdl);
  }();
  return beams;
}

// Velodyne, VLP-32C User Manual, 63-9325: elevations, and the azimuths by which lasers are off (positive there as the
// head turns, to the right). Two lasers at once every 2.304 us, a firing in 55.296 us.
const Beams& vlp32c_beams() {
  static const Beams beams = [] {
    constexpr std::array<std::pair<double, double>, 32> kLasers_deg = {
        {{-25.0, 1.4},   {-1.0, -4.2},  {-1.667, 1.4},  {-15.639, -1.4}, {-11.31, 1.4},  {0.0, -1.4},    {-0.667, 4.2},
         {-8.843, -1.4}, {-7.254, 1.4}, {0.333, -4.2},  {-0.333, 1.4},   {-6.148, -1.4}, {-5.333, 4.2},  {1.333, -1.4},
         {0.667, 4.2},   {-4.0, -1.4},  {-4.667, 1.4},  {1.667, -4.2},   {1.0, 1.4},     {-3.667, -4.2}, {-3.333, 4.2},
         {3.333, -1.4},  {2.333, 1.4},  {-2.667, -1.4}, {-3.0, 1.4},     {7.0, -1.4},    {4.667, 1.4},   {-2.333, -4.2},
         {-2.0, 4.2},    {15.0, -1.4},  {10.333, 1.4},  {-1.333, -1.4}}};
    Beams ultra;
    ultra.firing_us = 55.296;
    for (std::size_t k = 0; k < kLasers_deg.size(); ++k) {
      const double after_us = 2.304 * static_cast<double>(k / 2);
      ultra.lasers.push_back({kLasers_deg[k].first, -kLasers_deg[k].second, 0.0, after_us, 0});
    }
    return with_rings(ultra);
  }();
  return beams;
}

// Hesai, PandarXT-32 User Manual: a degree apart from 15 down to -16; the first laser after 0.368 us, then one every
// 1.512 us; 2000 firings a turn at 10 Hz.
const Beams& xt32_beams() {
  static const Beams beams = [] {
    Beams xt;
    xt.firing_us = 50.0;
    for (int k = 0; k < 32; ++k) xt.lasers.push_back({15.0 - k, 0.0, 0.0, 0.368 + 1.512 * k, 0});
    return with_rings(xt);
  }();
  return beams;
}

// Ouster, Software User Manual: lidar_origin_to_beam_origin_mm is 15.806 of an OS1 and 27.67 of an OS0. Elevations by
// the data sheets. Four columns of lasers look 4.2, 1.4, -1.4 and -4.2 degrees aside in an OS1 (its metadata). Those of
// an OS0-128 were not at hand: none are aside here.
const Beams& os1_64_beams() {
  static const Beams beams = ouster(64, 22.5, 1024, 0.015806, {4.2, 1.4, -1.4, -4.2});
  return beams;
}

// Every other column of 1024: as many rays as the even row of the sensors' table has.
const Beams& os0_128_beams() {
  static const Beams beams = ouster(128, 45.0, 512, 0.02767, {0.0, 0.0, 0.0, 0.0});
  return beams;
}

// RoboSense, rs_driver: lens 38.25 mm from the axis; lasers 2.8 us apart, a firing in 55.5 us. Elevations of the design
// in the order of lasers: -15 up to -1, then 15 down to 1.
const Beams& rs16_beams() {
  static const Beams beams = [] {
    Beams rs;
    rs.firing_us = 55.5;
    rs.lens_m = 0.03825;
    for (int k = 0; k < 16; ++k) {
      const double elevation_deg = k < 8 ? -15.0 + 2.0 * k : 15.0 - 2.0 * (k - 8);
      rs.lasers.push_back({elevation_deg, 0.0, 0.0, 2.8 * k, 0});
    }
    return with_rings(rs);
  }();
  return beams;
}

Beams without_offsets(const Beams& beams) {
  Beams same = beams;
  same.lens_m = 0.0;
  for (Beam& beam : same.lasers) beam.up_m = 0.0;
  return same;
}

}  // namespace pose_wall::judge
