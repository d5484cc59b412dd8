// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Simulated frames as the packets of Livox' sensors, made by hand from the header of Livox-SDK2, and captures of them.

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/numbers/angles.hpp"
#include "lab/sim/simulator.hpp"
#include "packet_files.hpp"

namespace pose_wall::tools::test {

// Data types: livox_lidar_def.h of Livox-SDK2, commit 08f523c9.
constexpr std::uint8_t kLivoxMm = 0x01, kLivoxCm = 0x02, kLivoxSpherical = 0x03, kLivoxDual = 0x11;

inline std::string livox_cartesian(double x_m, double y_m, double z_m) {
  const auto mm = [](double m) { return raw(static_cast<std::int32_t>(std::lround(1e3 * m))); };
  return mm(x_m) + mm(y_m) + mm(z_m) + "\x2A\x01";
}

// One point of a data type. Of two returns the nearer one is dust half way, or missing; either comes first.
inline std::string livox_point(std::uint8_t type, const float* p_m, std::size_t index) {
  const double x_m = p_m[0], y_m = p_m[1], z_m = p_m[2], range_m = std::hypot(x_m, y_m, z_m);
  if (type == kLivoxMm) return livox_cartesian(x_m, y_m, z_m);
  if (type == kLivoxCm) {
    const auto cm = [](double m) { return raw(static_cast<std::int16_t>(std::lround(1e2 * m))); };
    return cm(x_m) + cm(y_m) + cm(z_m) + "\x2A\x01";
  }
  if (type == kLivoxSpherical) {
    const auto hundredths = [](double rad) {
      return static_cast<std::uint16_t>(std::lround(100.0 * rad / kRadPerDeg));
    };
    const double azimuth_rad = std::atan2(y_m, x_m), zenith_rad = range_m > 0.0 ? std::acos(z_m / range_m) : 0.0;
    return raw(static_cast<std::uint32_t>(std::lround(1e3 * range_m))) + raw(hundredths(zenith_rad)) +
           raw(hundredths(azimuth_rad < 0.0 ? azimuth_rad + 2.0 * M_PI : azimuth_rad)) + "\x2A\x01";
  }
  const double share = index % 3 == 0 ? 0.0 : 0.5;
  const std::string farther = livox_cartesian(x_m, y_m, z_m),
                    nearer = livox_cartesian(share * x_m, share * y_m, share * z_m);
  return index % 2 == 0 ? farther + nearer : nearer + farther;
}

// A frame's returns one after another at this rate, in packets of so many points. Each hundredth beam has no return,
// and so have those that fill the last packet.
struct LivoxStream {
  std::uint8_t type = kLivoxMm;
  std::size_t points = 96;
  double rate_hz = 452'000.0;  // of a HAP: its user manual
  std::uint64_t begins_ns = 1'700'000'000'000'000'000;
};

inline std::vector<std::string> livox_packets(const sim::Frame& frame, const LivoxStream& stream) {
  std::vector<std::string> beams;
  const float none[3] = {0.0F, 0.0F, 0.0F};
  for (std::size_t i = 0; i < frame.count(); ++i) {
    if (beams.size() % 100 == 99) beams.push_back(livox_point(stream.type, none, i));
    beams.push_back(livox_point(stream.type, &frame.xyz_intensity[4 * i], i));
  }
  while (beams.size() % stream.points != 0) beams.push_back(livox_point(stream.type, none, 0));
  const double packet_ns = 1e9 * static_cast<double>(stream.points) / stream.rate_hz;
  std::vector<std::string> packets;
  for (std::size_t i = 0; i < beams.size(); i += stream.points) {
    const double since_ns = packet_ns * static_cast<double>(i / stream.points);
    packets.push_back(mid360_payload(stream.type, stream.begins_ns + static_cast<std::uint64_t>(std::llround(since_ns)),
                                     {beams.begin() + static_cast<std::ptrdiff_t>(i),
                                      beams.begin() + static_cast<std::ptrdiff_t>(i + stream.points)},
                                     static_cast<std::uint16_t>(std::lround(packet_ns / 100.0))));
  }
  return packets;
}

// A packet each millisecond, between these ports.
inline std::string livox_capture(const std::vector<std::string>& payloads, std::uint16_t from, std::uint16_t to) {
  std::string file = capture_head();
  for (std::uint32_t i = 0; i < payloads.size(); ++i) {
    const auto size = static_cast<std::uint16_t>(8 + payloads[i].size());
    file += captured(big(from) + big(to) + big(size) + big(0) + payloads[i], 1000 * i);
  }
  return file;
}

}  // namespace pose_wall::tools::test
