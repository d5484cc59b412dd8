// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The spinning sensors of LSLidar (Leishen) whose packets are read, and how a packet tells which one it is of.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "io/bags/byte_cursor.hpp"
#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {

constexpr std::size_t kLslidarBlocks = 12;
constexpr std::size_t kLslidarBlockBytes = 100;
constexpr std::size_t kLslidarReturns = 32;  // of a block

enum class LslidarModel {
  kC16V3,  // of firmware 2 and 3: 15 degrees up and down, or 10
  kC32V3,  // of firmware 2 and 3
  kC16V4,
  kC16V4B,  // with another order of lasers
  kC16V5,
  kC32V4,
  kC32V5,
  kC32W45,  // 70 degrees, four kinds by their model byte
  kC32W46,
  kC32W47,
  kC32W48,
  kCh32r5a,  // 90 degrees, two kinds
  kCh32r5d,
  kC8,
  kC8f,
  kCkm8
};

struct LslidarTraits {
  LslidarModel model;
  std::uint8_t byte;  // with which it names itself
  BeamTable beams;    // by the design

  std::size_t firings_per_block() const { return kLslidarReturns / beams.lasers.size(); }
  bool is_first_kind() const { return model == LslidarModel::kC16V3 || model == LslidarModel::kC32V3; }
};

const LslidarTraits& lslidar_traits(LslidarModel model);

// The packet without what a message of fixed length holds behind it. The maker's newer driver keeps packets of 1206
// bytes in 1212, of which the last are zero.
ByteView lslidar_packet(ByteView payload);

// Data of one of these sensors.
std::optional<LslidarModel> lslidar_model_of(ByteView payload);

// Two returns of each firing, in pairs of blocks. Of a data packet.
bool is_lslidar_dual(ByteView packet, const LslidarTraits& traits);

double lslidar_azimuth_deg(ByteView packet, std::size_t block);

// The part of the sensor's clock that every packet has, in units that are told by how it goes: see lslidar.cpp.
std::uint32_t lslidar_clock(ByteView packet, const LslidarTraits& traits);

// The unit of a clock by the gap between two packets, which take `least_us` to a hundred times as long: a microsecond,
// or a nanosecond by a time mode that only device packets tell. Both are never meant. 0: the gap does not tell.
std::int64_t lslidar_clock_unit_ns(std::int64_t gap, std::int64_t least_us);

// Of LSLidar's packets those that are known and not read: "an LSLidar C1 of one line"; else "".
std::string unread_lslidar(ByteView payload);

}  // namespace pose_wall::tools
