// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/wide_times.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "io/frames/field_aliases.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kWideBytes = 8;

template <typename Number>
void narrow_one(std::byte* at, bool is_turned) {
  std::array<std::byte, kWideBytes> raw;
  std::copy_n(at, kWideBytes, raw.begin());
  if (is_turned) std::reverse(raw.begin(), raw.end());
  Number number{};
  std::memcpy(&number, raw.data(), kWideBytes);
  const auto narrow = static_cast<double>(number);
  std::memcpy(raw.data(), &narrow, kWideBytes);
  if (is_turned) std::reverse(raw.begin(), raw.end());
  std::copy_n(raw.begin(), kWideBytes, at);
}

bool is_wide(const pose_wall_field& field) {
  return field.type == kFieldInt64 || field.type == kFieldUint64;
}

bool shares_bytes(const PointField& wide, const std::vector<PointField>& fields) {
  return std::any_of(fields.begin(), fields.end(), [&wide](const PointField& other) {
    const std::uint64_t end = std::uint64_t{other.where.offset} + field_type_bytes(other.where.type);
    return &other != &wide && other.where.offset < std::uint64_t{wide.where.offset} + kWideBytes &&
           end > wide.where.offset;
  });
}

void narrow_field(std::byte* points, const PointLayout& layout, const pose_wall_field& field) {
  const bool is_turned = layout.big_endian != host_is_big_endian();
  const std::uint32_t rows = std::max(layout.rows, 1U);
  const std::uint32_t columns = layout.count / rows;
  const std::size_t row_step = layout.row_step != 0 ? layout.row_step : std::size_t{columns} * layout.point_step;
  for (std::uint32_t row = 0; row < rows; ++row) {
    std::byte* at = points + row * row_step + field.offset;
    for (std::uint32_t column = 0; column < columns; ++column, at += layout.point_step) {
      field.type == kFieldInt64 ? narrow_one<std::int64_t>(at, is_turned) : narrow_one<std::uint64_t>(at, is_turned);
    }
  }
}

}  // namespace

std::uint32_t field_type_bytes(std::uint32_t type) {
  constexpr std::uint32_t kBytes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8, 1};
  return type < std::size(kBytes) ? kBytes[type] : 0;
}

void narrow_wide_fields(std::byte* points, PointLayout* layout) {
  for (PointField& field : layout->fields) {
    if (field.where.type == kFieldBool) field.where.type = POSE_WALL_FIELD_UINT8;
    if (!is_wide(field.where)) continue;
    const FieldRole role = field_role(field.name);
    const bool is_taken = role == FieldRole::kTime || role == FieldRole::kIntensity || role == FieldRole::kRing;
    if (!is_taken || shares_bytes(field, layout->fields)) {
      field.where.type = POSE_WALL_FIELD_NONE;
      continue;
    }
    narrow_field(points, *layout, field.where);
    field.where.type = POSE_WALL_FIELD_FLOAT64;
  }
}

}  // namespace pose_wall::tools
