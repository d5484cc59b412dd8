// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Simulated turns as the packets that a sensor would send of them: a VLP-16, or an Ouster of any number of rings.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/simulator.hpp"

namespace pose_wall::tools::live {

// Ranges of a turn, ring by ring from the lowest, in columns clockwise from x; 0: no return.
struct RangeImage {
  std::uint32_t rings = 0, columns = 0;
  std::vector<double> range_m;
  std::vector<float> intensity;
  std::size_t at(std::uint32_t ring, std::uint32_t column) const { return std::size_t{ring} * columns + column; }
};

// Of a rotating sensor's frame. Throws std::invalid_argument for another one.
RangeImage range_image(const sim::Sensor& sensor, const sim::Frame& frame);

// The packets of one turn in the order and, by their number, at the times at which the sensor sends them.
class PacketEncoder {
 public:
  PacketEncoder() = default;
  PacketEncoder(const PacketEncoder&) = delete;
  PacketEncoder& operator=(const PacketEncoder&) = delete;
  virtual ~PacketEncoder() = default;

  // began_ns: of the sensor's clock; turn_ns: what the turn takes.
  virtual std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) = 0;
};

// 16 rings of 2 degrees, as a VLP-16 in single return mode: 1206 bytes, 24 firings a packet.
class Vlp16Encoder final : public PacketEncoder {
 public:
  std::vector<std::string> packets(const RangeImage& image, std::int64_t began_ns, std::int64_t turn_ns) override;
};

// The legacy profile of 16 columns a packet, for beams that start in the middle.
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

}  // namespace pose_wall::tools::live
