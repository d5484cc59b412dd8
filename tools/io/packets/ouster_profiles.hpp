// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How an Ouster lays its packets out: the profiles of a pixel, and the head of a packet, of which there are two kinds.
// The facts are those of ouster-sdk's ouster_core/src/parsing.cpp, commit 46b7bcee (2026-08-13).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools {

// Of a frame, by lidar mode.
inline constexpr std::array<std::uint32_t, 4> kOusterColumns = {512, 1024, 2048, 4096};

struct OusterProfile {
  const char* name;  // as udp_profile_lidar has it
  std::uint8_t pixel_bytes;
  std::uint8_t range_bits;       // 15: in units of 8 mm, else of 1 mm
  std::uint8_t reflectivity_at;  // of the first return
  std::uint8_t second_at;        // where the second return lies, in the same way; 0: there is one return

  bool is_legacy() const { return range_bits == 20; }
};

// All that are read.
const std::vector<OusterProfile>& ouster_profiles();
const OusterProfile* ouster_profile(std::string_view name);

struct OusterReturn {
  double range_m = 0.0;  // 0: no return
  float reflectivity = 0.0F;
};

// Of two returns the first, or the farther one.
OusterReturn ouster_return(const OusterProfile& profile, ByteView pixel, bool takes_farther);

// LEGACY has none: each of its columns has the number of the frame.
enum class OusterHeader { kNone, kStandard, kFusa };

inline constexpr std::size_t kOusterHeadBytes = 32;

struct OusterHead {
  bool is_lidar = false;  // points, as far as can be told
  std::uint32_t frame = 0;
  std::uint32_t session = 0;      // init id: another one each time the sensor starts or is set up
  std::uint64_t serial = 0;       // 0: not told
  bool is_shutting_down = false;  // of heat, soon
  std::uint32_t limiting = 0;     // of its shots, of heat: 0 none, 1 soon, from 2 on a step of 10 % more each
};

// `packet` has at least kOusterHeadBytes.
OusterHead ouster_head(OusterHeader header, ByteView packet);
const char* ouster_header_name(OusterHeader header);

// Of a packet whose columns have so many pixels.
std::size_t ouster_column_bytes(const OusterProfile& profile, std::uint32_t rings);
std::size_t ouster_packet_bytes(const OusterProfile& profile, std::uint32_t rings, std::uint32_t columns);
// Whether some Ouster sends packets of this size.
bool may_be_ouster_packet(std::size_t bytes);

}  // namespace pose_wall::tools
