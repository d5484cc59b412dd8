// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/pcd_compressed.hpp"

#include <fmt/format.h>
#include <lzf.h>

#include <cstdint>
#include <cstring>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// LZF's longest reference, 264 bytes, takes three bytes: no stream grows by more than this. It keeps a lying size
// from allocating more than the file can fill.
constexpr std::uint64_t kLzfGrowthMax = 88;

std::uint32_t little_endian_uint32(const std::byte* at) {
  return std::to_integer<std::uint32_t>(at[0]) | std::to_integer<std::uint32_t>(at[1]) << 8U |
         std::to_integer<std::uint32_t>(at[2]) << 16U | std::to_integer<std::uint32_t>(at[3]) << 24U;
}

struct Packed {
  const std::byte* data = nullptr;
  std::uint32_t bytes = 0;
  std::uint32_t unpacked_bytes = 0;
};

Packed find_packed(const Bytes& bytes, const PcdHeader& header) {
  const std::uint64_t available = bytes.size() - header.data_offset;
  if (available < 8) throw FrameError(say("compressed points: {} bytes follow, 8 bytes of sizes expected", available));
  const std::byte* start = bytes.data() + header.data_offset;
  const Packed packed{start + 8, little_endian_uint32(start), little_endian_uint32(start + 4)};
  if (packed.bytes > available - 8) {
    throw FrameError(say("compressed points: {} bytes announced, {} bytes follow", packed.bytes, available - 8));
  }
  const std::uint64_t declared = points_or_held(header, packed.unpacked_bytes) * header.point_step;
  if (packed.unpacked_bytes != declared) {
    throw FrameError(say("compressed points: {} points of {} bytes are {} bytes, but the packed size says {}",
                         declared / header.point_step, header.point_step, declared, packed.unpacked_bytes));
  }
  if (packed.unpacked_bytes > kLzfGrowthMax * packed.bytes) {
    throw FrameError(
        say("compressed points: {} packed bytes cannot hold {} bytes", packed.bytes, packed.unpacked_bytes));
  }
  return packed;
}

// Packed files store each field of all points together.
Bytes interleave(const Bytes& columns, const PcdHeader& header) {
  Bytes points(columns.size());
  const std::size_t count = columns.size() / header.point_step;
  const std::byte* from = columns.data();
  for (const PcdField& field : header.fields) {
    const std::size_t field_bytes = std::size_t{field.size} * field.count;
    std::byte* to = points.data() + field.offset;
    for (std::size_t i = 0; i < count; ++i, from += field_bytes, to += header.point_step) {
      std::memcpy(to, from, field_bytes);
    }
  }
  return points;
}

}  // namespace

Bytes decompress_pcd_points(const Bytes& bytes, const PcdHeader& header) {
  const Packed packed = find_packed(bytes, header);
  if (packed.unpacked_bytes == 0) return {};
  Bytes columns(packed.unpacked_bytes);
  const unsigned int written = lzf_decompress(packed.data, packed.bytes, columns.data(), packed.unpacked_bytes);
  if (written != packed.unpacked_bytes) {
    throw FrameError(
        say("compressed points: damaged, {} of {} bytes could be unpacked", written, packed.unpacked_bytes));
  }
  return interleave(columns, header);
}

}  // namespace pose_wall::tools
