// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/field_value.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "io/frames/frame.hpp"

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

double field_value(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column,
                   const pose_wall_field& field) {
  const std::size_t row_step =
      cloud.row_step != 0 ? cloud.row_step : std::size_t{cloud.width} * std::size_t{cloud.point_step};
  const auto* const from = static_cast<const std::byte*>(cloud.data) + row * row_step +
                           std::size_t{column} * cloud.point_step + field.offset;
  const bool turned_round = (cloud.big_endian != 0) != host_is_big_endian();
  switch (field.type) {
    case POSE_WALL_FIELD_INT8:
      return number_at<std::int8_t>(from, turned_round);
    case POSE_WALL_FIELD_UINT8:
      return number_at<std::uint8_t>(from, turned_round);
    case POSE_WALL_FIELD_INT16:
      return number_at<std::int16_t>(from, turned_round);
    case POSE_WALL_FIELD_UINT16:
      return number_at<std::uint16_t>(from, turned_round);
    case POSE_WALL_FIELD_INT32:
      return number_at<std::int32_t>(from, turned_round);
    case POSE_WALL_FIELD_UINT32:
      return number_at<std::uint32_t>(from, turned_round);
    case POSE_WALL_FIELD_FLOAT32:
      return number_at<float>(from, turned_round);
    case POSE_WALL_FIELD_FLOAT64:
      return number_at<double>(from, turned_round);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

std::string_view field_type_name(std::uint32_t type) {
  constexpr std::array<std::string_view, 9> kNames = {"none",  "int8",   "uint8",   "int16",  "uint16",
                                                      "int32", "uint32", "float32", "float64"};
  return type < kNames.size() ? kNames[type] : "unknown";
}

}  // namespace pose_wall::tools
