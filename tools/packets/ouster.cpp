// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "packets/ouster.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "angles.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kTurn_rad = 6.283185307179586;
constexpr double kUnit_m = 1e-3;
// Of Ouster's lidar modes, by the manual of the sensor's firmware.
constexpr std::array<std::uint32_t, 4> kColumnsOfModes = {512, 1024, 2048, 4096};
// Turns and columns are as even as this, and modes differ by half and more.
constexpr double kEvenness = 0.1;

struct Pixel {
  double range_m;
  float reflectivity;
};

Pixel pixel_of(OusterProfile profile, ByteView bytes) {
  switch (profile) {
    case OusterProfile::kLegacy:
      return {kUnit_m * (little_endian_at(bytes, 0, 4) & 0xFFFFFU), static_cast<float>(little_endian_at(bytes, 4, 1))};
    case OusterProfile::kSingle:
      return {kUnit_m * (little_endian_at(bytes, 0, 4) & 0x7FFFFU), static_cast<float>(little_endian_at(bytes, 4, 1))};
    case OusterProfile::kDual:
      return {kUnit_m * (little_endian_at(bytes, 0, 4) & 0x7FFFFU), static_cast<float>(little_endian_at(bytes, 3, 1))};
    case OusterProfile::kLowRate:
      break;
  }
  return {kUnit_m * 8.0 * (little_endian_at(bytes, 0, 2) & 0x7FFFU), static_cast<float>(little_endian_at(bytes, 2, 1))};
}

}  // namespace

OusterAssembler::Layout OusterAssembler::layout_of(OusterProfile profile) {
  switch (profile) {
    case OusterProfile::kLegacy:
      return {0, 16, 12, 4, 0};
    case OusterProfile::kSingle:
      return {32, 12, 12, 0, 32};
    case OusterProfile::kDual:
      return {32, 12, 16, 0, 32};
    case OusterProfile::kLowRate:
      break;
  }
  return {32, 12, 4, 0, 32};
}

OusterAssembler::OusterAssembler(OusterMetadata metadata)
    : metadata_(std::move(metadata)),
      layout_(layout_of(metadata_.profile)),
      kind_(say("packets of an Ouster {}", metadata_.product)) {}

std::size_t OusterAssembler::packet_bytes(std::uint32_t rings) const {
  const std::size_t column = layout_.column_head + rings * layout_.pixel + layout_.column_tail;
  return layout_.packet_head + metadata_.columns_per_packet * column + layout_.packet_tail;
}

void OusterAssembler::look_for_other_pixels(std::size_t bytes) {
  if (!hint_.empty()) return;
  for (const std::uint32_t rings : {16U, 32U, 64U, 128U}) {
    if (bytes != packet_bytes(rings)) continue;
    hint_ = fmt::format(
        "the packets have {} pixels a column, but the metadata's pixels_per_column is {}: it is of another sensor or "
        "mode; read it from the sensor again",
        rings, metadata_.rings);
  }
}

bool OusterAssembler::add(const Datagram& datagram) {
  if (!contradiction_.empty()) throw FrameError(contradiction_);
  if (datagram.payload.size != packet_bytes()) {
    if (!sensor_) look_for_other_pixels(datagram.payload.size);
    return false;
  }
  if (!sensor_) {
    sensor_ = datagram.source_address;
    hint_.clear();
  }
  if (*sensor_ != datagram.source_address) return false;  // of another sensor on the same wire
  ByteCursor packet(datagram.payload);
  std::uint32_t frame = 0;
  if (layout_.packet_head > 0) {
    const auto kind = packet.number<std::uint16_t>("kind of packet");
    frame = packet.number<std::uint16_t>("frame");
    packet.bytes(layout_.packet_head - 4, "head of a packet");
    if (kind != 1) return false;
  }
  for (std::uint32_t i = 0; i < metadata_.columns_per_packet; ++i) {
    const ByteView column =
        packet.bytes(layout_.column_head + metadata_.rings * layout_.pixel + layout_.column_tail, "column of a packet");
    add_column(ByteCursor(column), frame);
  }
  return true;
}

void OusterAssembler::add_column(ByteCursor column, std::uint32_t frame) {
  const auto time_ns = column.number<std::uint64_t>("time of a column");
  const auto index = column.number<std::uint16_t>("number of a column");
  bool is_valid = false;
  if (metadata_.profile == OusterProfile::kLegacy) {
    frame = column.number<std::uint16_t>("frame of a column");
    column.bytes(4, "encoder of a column");
  } else {
    is_valid = (column.number<std::uint16_t>("status of a column") & 1U) != 0;
  }
  const ByteView pixels = column.bytes(metadata_.rings * layout_.pixel, "pixels of a column");
  if (metadata_.profile == OusterProfile::kLegacy) {
    is_valid = column.number<std::uint32_t>("status of a column") == 0xFFFFFFFFU;
  }
  if (!is_valid) return;
  if (frame_ && *frame_ != frame) {
    check_mode(frame, index, time_ns);
    end_frame();
  }
  if (index >= metadata_.columns_per_frame) return;
  if (!frame_) {
    frame_ = frame;
    scan_.stamp_ns = static_cast<std::int64_t>(time_ns & std::numeric_limits<std::int64_t>::max());
    scan_.rings = metadata_.rings;
    scan_.points.assign(std::size_t{metadata_.rings} * metadata_.columns_per_frame, ScanPoint{});
    columns_ = 0;
    first_ = {index, time_ns};
  }
  ++columns_;
  last_ = {index, time_ns};
  for (std::uint32_t ring = 0; ring < metadata_.rings; ++ring) {
    add_pixel({pixels.data + ring * layout_.pixel, layout_.pixel}, ring, index, time_ns);
  }
}

void OusterAssembler::add_pixel(ByteView bytes, std::uint32_t ring, std::uint32_t column, std::uint64_t time_ns) {
  ScanPoint& point = scan_.points[std::size_t{ring} * metadata_.columns_per_frame + column];
  const Pixel pixel = pixel_of(metadata_.profile, bytes);
  // The rings come from the top, as rows of an image.
  point.ring = static_cast<std::uint16_t>(metadata_.rings - 1 - ring);
  point.t_ns = static_cast<std::uint32_t>(time_ns - static_cast<std::uint64_t>(scan_.stamp_ns));
  if (pixel.range_m == 0.0) return;
  point.intensity = pixel.reflectivity;
  const double encoder_rad = kTurn_rad * (1.0 - static_cast<double>(column) / metadata_.columns_per_frame);
  const double azimuth_rad = encoder_rad - metadata_.azimuth_deg[ring] * kRadPerDeg;
  const double altitude_rad = metadata_.altitude_deg[ring] * kRadPerDeg;
  const double beam_m = pixel.range_m - std::hypot(metadata_.beam_origin_out_m, metadata_.beam_origin_up_m);
  const double flat_m = beam_m * std::cos(altitude_rad);
  const double x_m = flat_m * std::cos(azimuth_rad) + metadata_.beam_origin_out_m * std::cos(encoder_rad);
  const double y_m = flat_m * std::sin(azimuth_rad) + metadata_.beam_origin_out_m * std::sin(encoder_rad);
  const double z_m = beam_m * std::sin(altitude_rad) + metadata_.beam_origin_up_m;
  const auto& turn = metadata_.sensor_from_lidar;
  const auto row = [&](std::size_t i) {
    return static_cast<float>(turn[i] * x_m + turn[i + 1] * y_m + turn[i + 2] * z_m + turn[i + 3]);
  };
  point.x_m = row(0);
  point.y_m = row(4);
  point.z_m = row(8);
}

// A turn's time over a column's is the sensor's number of columns, whatever part of them came.
void OusterAssembler::check_mode(std::uint32_t next_frame, std::uint32_t next_index, std::uint64_t next_time_ns) {
  const bool is_next = static_cast<std::uint16_t>(*frame_ + 1) == static_cast<std::uint16_t>(next_frame);
  if (!is_next || last_.index <= first_.index || last_.time_ns <= first_.time_ns || next_time_ns <= last_.time_ns)
    return;
  const double column_ns = static_cast<double>(last_.time_ns - first_.time_ns) / (last_.index - first_.index);
  const double columns = static_cast<double>(next_time_ns - first_.time_ns) / column_ns + first_.index - next_index;
  for (const std::uint32_t of_mode : kColumnsOfModes) {
    if (of_mode == metadata_.columns_per_frame || std::abs(columns - of_mode) > kEvenness * of_mode) continue;
    contradiction_ = fmt::format(
        "the sensor turns in {} columns, but the metadata's columns_per_frame is {}: it is of another lidar_mode; read "
        "it from the sensor again",
        of_mode, metadata_.columns_per_frame);
    scan_ = Scan{};
    frame_.reset();
    throw FrameError(contradiction_);
  }
}

void OusterAssembler::end_frame() {
  // A packet in a hundred may be lost; a scan that began or ended with the capture lacks more.
  scan_.is_complete = columns_ * 100 >= metadata_.columns_per_frame * 95;
  push(std::exchange(scan_, Scan{}));
  frame_.reset();
}

void OusterAssembler::finish() {
  if (frame_) end_frame();
}

}  // namespace pose_wall::tools
