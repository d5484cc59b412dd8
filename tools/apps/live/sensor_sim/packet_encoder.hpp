// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Simulated turns as the packets that a sensor would send of them. Lasers and layouts are those of the decoders'
// tables; how they are written is worked out here anew, so that each is a check of the other.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/packets/hesai_models.hpp"
#include "io/packets/velodyne_models.hpp"
#include "lab/sim/simulator.hpp"

namespace pose_wall::tools::live {

// Ranges of a turn as the sensor counts them, ring by ring from the lowest, in columns clockwise from x; 0: no return.
struct RangeImage {
  std::uint32_t rings = 0, columns = 0;
  std::vector<double> range_m;
  std::vector<float> intensity;
  std::size_t at(std::uint32_t ring, std::uint32_t column) const { return std::size_t{ring} * columns + column; }
};

// Of a rotating sensor's frame; of two returns the second. Throws std::invalid_argument for another sensor.
RangeImage range_image(const sim::Sensor& sensor, const sim::Frame& frame);

// The packets of one turn in the order and, by their number, at the times at which the sensor sends them. What a turn
// holds beyond whole packets is not sent.
class PacketEncoder {
 public:
  PacketEncoder() = default;
  PacketEncoder(const PacketEncoder&) = delete;
  PacketEncoder& operator=(const PacketEncoder&) = delete;
  virtual ~PacketEncoder() = default;

  // began_ns: of the sensor's clock; turn_ns: what the turn takes.
  virtual std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) = 0;
  // What the sensor sends about once a second to another port (KnownSensor::device_port); "": nothing.
  virtual std::string device_packet(std::int64_t /*turn_ns*/) const { return ""; }
};

// In single return mode: 1206 bytes, 24 firings of 16 lasers a packet, or 12 of 32.
class VelodyneEncoder final : public PacketEncoder {
 public:
  explicit VelodyneEncoder(VelodyneModel model) : traits_(velodyne_traits(model)) {}

  std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) override;

 private:
  const VelodyneTraits& traits_;
};

// In single return mode, with as much of head and tail as tells what packets they are.
class HesaiEncoder final : public PacketEncoder {
 public:
  explicit HesaiEncoder(HesaiModel model) : traits_(hesai_traits(model)) {}

  std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) override;

 private:
  const HesaiTraits& traits_;
};

// The legacy profile of 16 columns a packet.
class OusterEncoder final : public PacketEncoder {
 public:
  explicit OusterEncoder(const sim::Sensor& sensor) : sensor_(sensor) {}

  std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) override;
  // What such a sensor says of itself.
  std::string metadata() const;

 private:
  // As an Ouster leaves the factory; its metadata tells it, too.
  static constexpr std::uint32_t kColumnsPerPacket = 16;
  std::string column(const RangeImage& image, std::uint32_t column, std::int64_t time_ns) const;

  sim::Sensor sensor_;
  std::uint16_t frame_ = 0;
};

// Those that make_encoder knows.
std::vector<std::string> sensors_with_packets();
// Throws std::invalid_argument for a sensor whose packets are not known. A vlp16, whose light all leaves the origin,
// sends the packets of a real one: their decoder adds its heights, up to 1.1 cm.
std::unique_ptr<PacketEncoder> make_encoder(const sim::Sensor& sensor);

}  // namespace pose_wall::tools::live
