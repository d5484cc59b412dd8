// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "frames/point_position.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "frames/frame.hpp"

namespace pose_wall::tools {
namespace {

template <typename Number>
double number_at(const std::byte* from, bool turned_round) {
  std::array<std::byte, sizeof(Number)> bytes;
  std::copy_n(from, bytes.size(), bytes.begin());
  if (turned_round) std::reverse(bytes.begin(), bytes.end());
  Number number;
  std::memcpy(&number, bytes.data(), sizeof number);
  return static_cast<double>(number);
}

}  // namespace

Eigen::Vector3d point_position(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column) {
  const std::size_t row_step =
      cloud.row_step != 0 ? cloud.row_step : std::size_t{cloud.width} * std::size_t{cloud.point_step};
  const auto* const point =
      static_cast<const std::byte*>(cloud.data) + row * row_step + std::size_t{column} * cloud.point_step;
  const bool turned_round = (cloud.big_endian != 0) != host_is_big_endian();
  const auto coordinate = [&](const pose_wall_field& field) {
    return field.type == POSE_WALL_FIELD_FLOAT64 ? number_at<double>(point + field.offset, turned_round)
                                                 : number_at<float>(point + field.offset, turned_round);
  };
  return {coordinate(cloud.x), coordinate(cloud.y), coordinate(cloud.z)};
}

}  // namespace pose_wall::tools
