// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One LiDAR frame: the bytes of a file as they came, and the description by which the engine reads them in place.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::tools {

using Bytes = std::vector<std::byte>;

// Why a file is no frame; the message names what was found and what is allowed, but not the file.
class FrameError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One named field of a point, as its input names it.
struct FrameField {
  std::string name;
  pose_wall_field where;
};

// Copying would leave cloud.data pointing into another frame's bytes.
struct Frame {
  Frame() = default;
  Frame(Frame&&) = default;
  Frame& operator=(Frame&&) = default;
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  ~Frame() = default;

  Bytes bytes;
  pose_wall_cloud cloud{};
  std::vector<FrameField> fields;        // all that were kept, also those that the engine does not look at
  std::optional<std::int64_t> stamp_ns;  // where the file tells; cloud.stamp_ns is for who reads a row of frames
};

// One named field of a point, as a file format describes it.
struct PointField {
  std::string_view name;
  pose_wall_field where;
};

// Where a file format keeps its points.
struct PointLayout {
  std::size_t data_offset = 0;
  std::uint32_t count = 0;
  std::uint32_t point_step = 0;
  bool big_endian = false;
  std::vector<PointField> fields;  // also of the types in wide_times.hpp
  std::uint32_t rows = 1;          // of count / rows points each
  std::size_t row_step = 0;        // bytes from row to row; 0: one follows the other
};

// Throws FrameError, with all the names there are, unless x, y and z are among them.
void require_coordinates(const std::vector<std::string_view>& names);

// Takes the bytes over and describes them. Throws FrameError when x, y or z is missing, appears twice or is no float.
Frame describe_frame(Bytes bytes, PointLayout layout);

// Points that `available` bytes can hold against what a header declares; the header loses. Throws FrameError when
// bytes are missing.
std::uint32_t count_points(std::uint64_t declared, std::uint64_t available, std::uint32_t point_step);

bool host_is_big_endian();

}  // namespace pose_wall::tools
