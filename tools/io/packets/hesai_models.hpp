// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The Hesai sensors whose packets are read: how these lie in memory.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/bags/byte_cursor.hpp"
#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {

enum class HesaiModel { kXt32, kPandar40p, kQt64, kXt16, kXt32m, kQt128, kPandar64 };

constexpr std::array<HesaiModel, 7> kHesaiModels = {HesaiModel::kXt32,    HesaiModel::kPandar40p, HesaiModel::kQt64,
                                                    HesaiModel::kXt16,    HesaiModel::kXt32m,     HesaiModel::kQt128,
                                                    HesaiModel::kPandar64};

constexpr std::size_t kHesaiNowhere = static_cast<std::size_t>(-1);
constexpr std::size_t kHesaiShortHeadBytes = 8;  // of a Pandar64, as of a Pandar20

struct HesaiLaser {
  double elevation_deg = 0.0;
  double azimuth_deg = 0.0;  // beside the head's; clockwise from above
};

struct HesaiTraits {
  HesaiModel model;
  const BeamTable& beams;  // as designed: each sensor is a little off
  std::size_t blocks;
  std::size_t head_bytes;        // before the first block
  std::size_t block_head_bytes;  // flag and azimuth before a block's returns
  std::size_t return_bytes;
  std::size_t tail_bytes;
  std::size_t mode_offset;    // of the return mode, within the tail
  std::size_t speed_offset;   // of the turns a minute, within the tail
  std::size_t date_offset;    // of the time of its packet, six bytes down to the second, within the tail
  std::size_t micros_offset;  // of the microseconds since then, within the tail
  std::size_t heat_offset;    // of whether it pauses because of heat, within the tail; kHesaiNowhere: not told
  double first_laser_ns;      // from a firing's time to the first laser's
  double known_firing_ns;     // from a packet's time to its first firing, or to the last
  bool last_is_known;
  std::uint16_t protocol = 0;    // version of its head, the lower byte first; 0: it is not looked at
  std::size_t returns_most = 2;  // of a laser's shot
  // Of those that tell what a packet holds: which are looked at, and which of these have to be there.
  std::uint8_t flags_looked_at = 0, flags = 0;

  const std::string& title() const { return beams.title; }
  std::size_t lasers() const { return beams.lasers.size(); }
  std::size_t block_bytes() const { return block_head_bytes + lasers() * return_bytes; }
  std::size_t tail_at() const { return head_bytes + blocks * block_bytes(); }
  std::size_t bytes() const { return tail_at() + tail_bytes; }

  // From a packet's time to that of one of its `firings`, counted from 0.
  double firing_start_ns(std::size_t firing, std::size_t firings) const;
};

const HesaiTraits& hesai_traits(HesaiModel model);

// The model whose data these bytes are, with lengths, counts, unit, azimuths and return mode that fit it.
std::optional<HesaiModel> hesai_model_of(ByteView payload);

// What data of a Hesai is that is not read: "a Hesai of 16 lasers in 2 blocks". A model that counts in another unit
// than its own is named with both. "" for anything else.
std::string unread_hesai(ByteView payload);

// The packet's number, where it has one.
std::optional<std::uint32_t> hesai_number(const HesaiTraits& traits, ByteView payload);

// The time of the packet by the sensor's clock, since 1970; nothing where it is no date.
std::optional<std::int64_t> hesai_clock_ns(const HesaiTraits& traits, ByteView payload);

// The microseconds of that time, which begin anew with each second.
std::int64_t hesai_clock_us(const HesaiTraits& traits, ByteView payload);

// Whether it says that it pauses because of heat.
bool is_hesai_overheated(const HesaiTraits& traits, ByteView payload);

// How many returns of a shot such data holds, one block each: 1 to 3.
std::size_t hesai_returns(const HesaiTraits& traits, ByteView payload);

// A file of angles, as the sensor or its maker gives it: a head, then a line for each laser with its number from 1,
// elevation and azimuth in degrees. Throws FrameError unless each of `lasers` is there once.
std::vector<HesaiLaser> parse_hesai_angles(const std::string& text, std::size_t lasers);

}  // namespace pose_wall::tools
