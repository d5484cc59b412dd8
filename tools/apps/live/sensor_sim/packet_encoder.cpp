// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/sensor_sim/packet_encoder.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/live/sensor_sim/lslidar_encoder.hpp"
#include "apps/live/sensor_sim/robosense_encoder.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr double kTurn_deg = 360.0;

// All of them write little-endian.
template <typename Number>
void put(std::string* bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    bytes->push_back(static_cast<char>((static_cast<std::uint64_t>(number) >> (8U * i)) & 0xFFU));
  }
}

std::uint8_t reflectivity(float intensity) {
  return static_cast<std::uint8_t>(std::lround(std::min(255.0F, std::max(0.0F, intensity))));
}

// A laser's range and light, as Velodyne and Hesai write them.
void put_return(std::string* bytes, const RangeImage& image, std::size_t at, double unit_m) {
  put(bytes, static_cast<std::uint16_t>(std::lround(image.range_m[at] / unit_m)));
  put(bytes, reflectivity(image.intensity[at]));
}

void put_azimuth(std::string* bytes, const RangeImage& image, std::uint32_t column) {
  put(bytes, static_cast<std::uint16_t>(std::lround(100.0 * kTurn_deg * column / image.columns)));
}

void demand_rings(const RangeImage& image, const BeamTable& beams) {
  if (image.rings == beams.lasers.size()) return;
  throw std::invalid_argument("a " + beams.title + " has " + std::to_string(beams.lasers.size()) + " rings");
}

constexpr std::array<VelodyneModel, 4> kVelodynes = {VelodyneModel::kVlp16, VelodyneModel::kVlp16HiRes,
                                                     VelodyneModel::kHdl32e, VelodyneModel::kVlp32c};

}  // namespace

RangeImage range_image(const sim::Sensor& sensor, const sim::Frame& frame) {
  RangeImage image;
  image.rings = static_cast<std::uint32_t>(sensor.rings);
  image.columns = static_cast<std::uint32_t>(sensor.columns);
  if (image.rings < 2 || image.columns < 1) throw std::invalid_argument("only a rotating sensor has rings to encode");
  image.range_m.assign(std::size_t{image.rings} * image.columns, 0.0);
  image.intensity.assign(image.range_m.size(), 0.0F);
  std::vector<sim::Vector> origins(image.range_m.size(), sim::Vector::Zero());
  for (const sim::Beam& beam : sim::beams_of(sensor, 0)) origins[image.at(beam.ring, beam.step)] = beam.origin;
  const double ahead_m = sensor.beams != nullptr ? sensor.beams->ahead_m() : 0.0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const float* p = &frame.xyz_intensity[4 * i];
    const std::size_t at = image.at(frame.ring[i], frame.column[i]);
    image.range_m[at] = (sim::Vector(p[0], p[1], p[2]) - origins[at]).norm() + ahead_m;
    image.intensity[at] = p[3];
  }
  return image;
}

std::vector<std::string> VelodyneEncoder::packets(const RangeImage& image, std::int64_t began_ns,
                                                  std::int64_t turn_ns) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;  // packets tell the microseconds since the full one
  demand_rings(image, traits_.beams);
  const auto of_block = static_cast<std::uint32_t>(traits_.firings_per_block());
  const auto of_packet = static_cast<std::uint32_t>(kVelodyneBlocks) * of_block;
  std::vector<std::string> packets;
  for (std::uint32_t first = 0; first + of_packet <= image.columns; first += of_packet) {
    std::string packet;
    for (std::uint32_t firing = first; firing < first + of_packet; ++firing) {
      if ((firing - first) % of_block == 0) {
        put(&packet, std::uint16_t{0xEEFF});
        put_azimuth(&packet, image, firing);
      }
      for (const Laser& laser : traits_.beams.lasers) {
        put_return(&packet, image, image.at(laser.ring, firing), traits_.beams.ranges.unit_m);
      }
    }
    const std::int64_t time_ns = began_ns + turn_ns * first / image.columns;
    put(&packet, static_cast<std::uint32_t>(time_ns % kHour_ns / 1000));
    put(&packet, std::uint8_t{0x37});  // the strongest return
    put(&packet, traits_.product);
    packets.push_back(std::move(packet));
  }
  return packets;
}

std::vector<std::string> HesaiEncoder::packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  demand_rings(image, traits_.beams);
  const auto of_packet = static_cast<std::uint32_t>(traits_.blocks);
  std::vector<std::string> packets;
  for (std::uint32_t first = 0; first + of_packet <= image.columns; first += of_packet) {
    std::string packet;
    const auto unit_mm = static_cast<char>(std::lround(1e3 * traits_.beams.ranges.unit_m));
    const std::string sizes = {static_cast<char>(traits_.lasers()), static_cast<char>(traits_.blocks), '\0', unit_mm};
    if (traits_.head_bytes == kHesaiShortHeadBytes) {
      packet = "\xEE\xFF" + sizes + std::string(2, '\0');
    } else if (traits_.head_bytes > 0) {
      packet = "\xEE\xFF";
      put(&packet, traits_.protocol);
      packet += std::string(2, '\0') + sizes + std::string("\x01\0", 2);
    }
    for (std::uint32_t firing = first; firing < first + of_packet; ++firing) {
      if (traits_.block_head_bytes > 2) put(&packet, std::uint16_t{0xEEFF});
      put_azimuth(&packet, image, firing);
      for (const Laser& laser : traits_.beams.lasers) {
        put_return(&packet, image, image.at(laser.ring, firing), traits_.beams.ranges.unit_m);
        packet.append(traits_.return_bytes - 3, '\0');
      }
    }
    std::string tail(traits_.tail_bytes, '\0');
    tail[traits_.mode_offset] = '\x37';  // the strongest return
    std::string clock;
    put(&clock, static_cast<std::uint32_t>((began_ns + turn_ns * first / image.columns) % kSecond_ns / 1000));
    tail.replace(traits_.micros_offset, clock.size(), clock);
    packets.push_back(packet + tail);
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
  std::vector<double> altitude_deg(rings), azimuth_deg(rings, 0.0);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    altitude_deg[ring] =
        sensor_.elevation_max_deg - (sensor_.elevation_max_deg - sensor_.elevation_min_deg) * ring / (rings - 1);
  }
  double out_mm = 0.0;
  if (sensor_.beams != nullptr) {
    out_mm = 1e3 * sensor_.beams->lens.out_m;
    for (const Laser& laser : sensor_.beams->lasers) {
      altitude_deg[rings - 1 - laser.ring] = laser.elevation_deg;
      azimuth_deg[rings - 1 - laser.ring] = laser.azimuth_deg;
    }
  }
  const std::vector<int> unmoved = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const std::vector<double> of_beam = {1, 0, 0, out_mm, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Json page = {{"prod_line", "simulated " + sensor_.name},
                     {"beam_altitude_angles", altitude_deg},
                     {"beam_azimuth_angles", azimuth_deg},
                     {"lidar_origin_to_beam_origin_mm", out_mm},
                     {"beam_to_lidar_transform", of_beam},
                     {"lidar_to_sensor_transform", unmoved},
                     {"data_format",
                      {{"pixels_per_column", rings},
                       {"columns_per_frame", static_cast<std::uint32_t>(sensor_.columns)},
                       {"columns_per_packet", kColumnsPerPacket},
                       {"udp_profile_lidar", "LEGACY"}}}};
  return page.dump(2);
}

std::vector<std::string> sensors_with_packets() {
  std::vector<std::string> names = {"vlp16", "os1-64", "os0-128"};
  for (const BeamTable* const table : beam_tables()) {
    names.push_back(table->word);
  }
  return names;
}

std::unique_ptr<PacketEncoder> make_encoder(const sim::Sensor& sensor) {
  const bool is_ouster = sensor.beams != nullptr ? sensor.beams->maker == SensorMaker::kOuster
                                                 : sensor.name == "os1-64" || sensor.name == "os0-128";
  if (is_ouster) return std::make_unique<OusterEncoder>(sensor);
  if (sensor.name == "vlp16") return std::make_unique<VelodyneEncoder>(VelodyneModel::kVlp16);
  for (const VelodyneModel model : kVelodynes) {
    if (&velodyne_traits(model).beams == sensor.beams) return std::make_unique<VelodyneEncoder>(model);
  }
  for (const HesaiModel model : kHesaiModels) {
    if (&hesai_traits(model).beams == sensor.beams) return std::make_unique<HesaiEncoder>(model);
  }
  if (sensor.beams != nullptr && sensor.beams->maker == SensorMaker::kRoboSense) {
    return std::make_unique<RoboSenseEncoder>(*sensor.beams);
  }
  if (sensor.beams != nullptr && sensor.beams->maker == SensorMaker::kLslidar) {
    return std::make_unique<LslidarEncoder>(*sensor.beams);
  }
  throw std::invalid_argument(sensor.name + ": no packets of such a sensor are known");
}

}  // namespace pose_wall::tools::live
