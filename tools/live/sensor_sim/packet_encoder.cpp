// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "live/sensor_sim/packet_encoder.hpp"

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "angles.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr double kTurn_deg = 360.0;

// Both sensors write little-endian.
template <typename Number>
void put(std::string* bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    bytes->push_back(static_cast<char>((static_cast<std::uint64_t>(number) >> (8U * i)) & 0xFFU));
  }
}

std::uint8_t reflectivity(float intensity) {
  return static_cast<std::uint8_t>(std::lround(std::min(255.0F, std::max(0.0F, intensity))));
}

}  // namespace

RangeImage range_image(const sim::Sensor& sensor, const sim::Frame& frame) {
  RangeImage image;
  image.rings = static_cast<std::uint32_t>(sensor.rings);
  image.columns = static_cast<std::uint32_t>(sensor.columns);
  if (image.rings < 2 || image.columns < 1) throw std::invalid_argument("only a rotating sensor has rings to encode");
  image.range_m.assign(std::size_t{image.rings} * image.columns, 0.0);
  image.intensity.assign(image.range_m.size(), 0.0F);
  const double step_deg = (sensor.elevation_max_deg - sensor.elevation_min_deg) / (image.rings - 1);
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const float* p = &frame.xyz_intensity[4 * i];
    const double flat_m = std::hypot(static_cast<double>(p[0]), static_cast<double>(p[1]));
    const double range_m = std::hypot(flat_m, static_cast<double>(p[2]));
    const double elevation_deg = std::atan2(static_cast<double>(p[2]), flat_m) * kDegPerRad;
    const double clockwise_deg = -std::atan2(static_cast<double>(p[1]), static_cast<double>(p[0])) * kDegPerRad;
    const long ring = std::lround((elevation_deg - sensor.elevation_min_deg) / step_deg);
    const long column = std::lround((clockwise_deg + kTurn_deg) / kTurn_deg * image.columns) % image.columns;
    if (ring < 0 || ring >= static_cast<long>(image.rings)) continue;
    const std::size_t at = image.at(static_cast<std::uint32_t>(ring), static_cast<std::uint32_t>(column));
    image.range_m[at] = range_m;
    image.intensity[at] = p[3];
  }
  return image;
}

std::vector<std::string> Vlp16Encoder::packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) {
  // Of a data packet, each block with two firings (VLP-16 user manual, 63-9243).
  constexpr std::uint32_t kBlocks = 12, kRings = 16;
  constexpr double kUnit_m = 0.002;
  // Packets tell the microseconds since the full hour.
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  if (image.rings != kRings) throw std::invalid_argument("a VLP-16 has 16 rings");
  std::vector<std::string> packets;
  for (std::uint32_t first = 0; first + 2 * kBlocks <= image.columns; first += 2 * kBlocks) {
    std::string packet;
    for (std::uint32_t firing = first; firing < first + 2 * kBlocks; ++firing) {
      if ((firing - first) % 2 == 0) {
        put(&packet, std::uint16_t{0xEEFF});
        put(&packet, static_cast<std::uint16_t>(std::lround(100.0 * kTurn_deg * firing / image.columns)));
      }
      // Lasers alternate between the lower and the upper half: -15, 1, -13, 3, ... degrees.
      for (std::uint32_t laser = 0; laser < kRings; ++laser) {
        const std::size_t at = image.at(laser % 2 == 0 ? laser / 2 : 8 + laser / 2, firing);
        put(&packet, static_cast<std::uint16_t>(std::lround(image.range_m[at] / kUnit_m)));
        put(&packet, reflectivity(image.intensity[at]));
      }
    }
    const std::int64_t time_ns = began_ns + turn_ns * first / image.columns;
    put(&packet, static_cast<std::uint32_t>(time_ns % kHour_ns / 1000));
    packet += "\x37\x22";  // strongest return, VLP-16
    packets.push_back(std::move(packet));
  }
  return packets;
}

std::string OusterEncoder::column(const RangeImage& image, std::uint32_t column, std::int64_t time_ns) const {
  std::string bytes;
  put(&bytes, static_cast<std::uint64_t>(time_ns));
  put(&bytes, static_cast<std::uint16_t>(column));
  put(&bytes, frame_);
  put(&bytes, std::uint32_t{0});
  for (std::uint32_t from_top = 0; from_top < image.rings; ++from_top) {
    const std::size_t at = image.at(image.rings - 1 - from_top, column);
    put(&bytes, static_cast<std::uint32_t>(std::lround(image.range_m[at] * 1e3)) & 0xFFFFFU);
    put(&bytes, static_cast<std::uint16_t>(reflectivity(image.intensity[at])));
    bytes.append(6, '\0');
  }
  put(&bytes, std::uint32_t{0xFFFFFFFF});
  return bytes;
}

std::vector<std::string> OusterEncoder::packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) {
  std::vector<std::string> packets;
  for (std::uint32_t first = 0; first < image.columns; first += kColumnsPerPacket) {
    std::string packet;
    for (std::uint32_t i = first; i < first + kColumnsPerPacket && i < image.columns; ++i) {
      packet += column(image, i, began_ns + turn_ns * i / image.columns);
    }
    packets.push_back(std::move(packet));
  }
  ++frame_;
  return packets;
}

std::string OusterEncoder::metadata() const {
  using Json = nlohmann::ordered_json;
  const auto rings = static_cast<std::uint32_t>(sensor_.rings);
  std::vector<double> altitude_deg, azimuth_deg(rings, 0.0);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    altitude_deg.push_back(sensor_.elevation_max_deg -
                           (sensor_.elevation_max_deg - sensor_.elevation_min_deg) * ring / (rings - 1));
  }
  const std::vector<int> unmoved = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Json page = {{"prod_line", "simulated " + sensor_.name},
                     {"beam_altitude_angles", altitude_deg},
                     {"beam_azimuth_angles", azimuth_deg},
                     {"beam_to_lidar_transform", unmoved},
                     {"lidar_to_sensor_transform", unmoved},
                     {"data_format",
                      {{"pixels_per_column", rings},
                       {"columns_per_frame", static_cast<std::uint32_t>(sensor_.columns)},
                       {"columns_per_packet", kColumnsPerPacket},
                       {"udp_profile_lidar", "LEGACY"}}}};
  return page.dump(2);
}

}  // namespace pose_wall::tools::live
