// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The Velodyne sensors whose packets are read, and how these tell which one it is.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/bags/byte_cursor.hpp"
#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {

constexpr std::size_t kVelodyneBytes = 1206;
constexpr std::size_t kVelodyneBlocks = 12;
constexpr std::size_t kVelodyneBlockBytes = 100;
constexpr std::size_t kVelodyneLasersMax = 32;

enum class VelodyneModel { kVlp16, kVlp16HiRes, kHdl32e, kVlp32c };

struct VelodyneTraits {
  VelodyneModel model;
  const char* word;        // as options name it
  std::uint8_t product;    // byte of its packets
  const BeamTable& beams;  // where its lasers point, and when they fire

  const std::string& title() const { return beams.title; }
  // A block of 32 returns holds one firing of 32 or two of 16.
  std::size_t lasers() const { return beams.lasers.size(); }
  std::size_t firings_per_block() const { return kVelodyneLasersMax / lasers(); }
  double packet_us(bool is_dual) const;
};

const VelodyneTraits& velodyne_traits(VelodyneModel model);

// 1206 bytes of twelve blocks with the flag and an azimuth each.
bool is_velodyne_data(ByteView payload);

// The model by what its packets say: the product byte, and the sensor's own clock, which tells how long a packet takes.
// Where both are heard they have to agree; `stated` is a third voice. Packets are data of one sensor, as they came.
// Throws FrameError that names who says what.
VelodyneModel identify_velodyne(const std::vector<ByteView>& packets, std::optional<VelodyneModel> stated);

// Two returns of each firing, in pairs of blocks.
bool is_velodyne_dual(ByteView payload);

std::uint8_t velodyne_product(ByteView payload);

// To it a sensor sends what a GPS receiver tells (manual of the VLP-16).
constexpr std::uint16_t kVelodynePositionPort = 8308;

// The clock of its first firing, which begins anew with each hour.
constexpr std::int64_t kVelodyneHour_us = 3'600'000'000;
std::int64_t velodyne_clock_us(ByteView payload);

}  // namespace pose_wall::tools
