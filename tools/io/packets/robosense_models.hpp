// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The spinning RoboSense sensors whose packets are read, and how these packets are laid out. Facts: RoboSense's
// rs_driver 4eeadace, its ros_rslidar 726eacca, and the user manuals of RS-LiDAR-16, RS-LiDAR-32, RS-Bpearl and
// RS-Helios. Numbers are big-endian.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/bags/byte_cursor.hpp"

namespace pose_wall::tools {

constexpr std::size_t kRoboSenseBytes = 1248;  // of data and of device packets
constexpr std::size_t kRoboSenseHeadBytes = 42;
constexpr std::uint16_t kRoboSensePort = 6699, kRoboSenseDevicePort = 7788;

enum class RoboSenseModel { kRs16, kRs32, kHelios32, kHelios16p, kBpearl, kBpearl4, kAiry };
constexpr std::size_t kRoboSenseModels = 7;

// Which models send data of one kind of head and blocks.
enum class RoboSenseLayout { kFirst, kHelios, kAiry };

// When lasers fire; some models had two rhythms in their life.
struct RoboSenseRhythm {
  double firing_us;               // from one firing of all lasers to the next
  std::vector<double> lasers_us;  // since the first one, in the order of packets
};

struct RoboSenseTraits {
  RoboSenseModel model;
  const char* word;  // as options name it
  const char* title;
  RoboSenseLayout layout;
  std::size_t lasers;
  double unit_m;
  double nearest_m, farthest_m;          // what the maker's driver keeps
  double lens_out_m, lens_up_m;          // along the head's azimuth, and above the origin
  std::vector<RoboSenseRhythm> rhythms;  // the newest first

  std::size_t blocks() const { return layout == RoboSenseLayout::kAiry ? 8 : 12; }
  std::size_t channels() const { return layout == RoboSenseLayout::kAiry ? 48 : 32; }  // of a block
  std::size_t block_bytes() const { return 4 + 3 * channels(); }
};

const RoboSenseTraits& robosense_traits(RoboSenseModel model);
const std::vector<RoboSenseTraits>& robosense_sensors();

// Up to six bytes that are known to be there, the highest first.
std::uint64_t robosense_number(ByteView bytes, std::size_t offset, std::size_t size);

// The kind of data packet that this is; nothing where it is none.
std::optional<RoboSenseLayout> robosense_layout_of(ByteView payload);
// What a sensor says of itself (DIFOP), on a port of its own.
bool is_robosense_device(ByteView payload);
// An Airy also sends packets without points.
bool has_robosense_points(ByteView payload, RoboSenseLayout layout);

std::size_t robosense_block_start(const RoboSenseTraits& traits, std::size_t block);
// In hundredths of a degree; nothing for a block that holds none.
std::optional<std::uint32_t> robosense_azimuth(const RoboSenseTraits& traits, ByteView payload, std::size_t block);
// The sensor's clock, microseconds since some moment: only differences of it are of use. RoboSense's calendar times are
// of no known time zone.
std::int64_t robosense_clock_us(const RoboSenseTraits& traits, ByteView payload);

// What it is where it is data of a RoboSense that is not read; else "".
std::string unread_robosense(ByteView payload);

}  // namespace pose_wall::tools
