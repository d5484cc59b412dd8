// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/told_rings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "io/frames/field_aliases.hpp"
#include "io/frames/field_value.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kRingsMax = 256;

std::size_t distinct_values(const pose_wall_cloud& cloud, const pose_wall_field& field) {
  std::unordered_set<double> values;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width && values.size() <= kRingsMax; ++column) {
      const double value = field_value(cloud, row, column, field);
      if (std::isfinite(value)) values.insert(value);
    }
  }
  return values.size() <= kRingsMax ? values.size() : 0;
}

bool is_ring_count(std::uint32_t count) {
  return count == 8 || count == 16 || count == 32 || count == 40 || count == 64 || count == 80 || count == 128;
}

}  // namespace

ToldRings told_rings(const Frame& frame) {
  for (const std::string_view name : field_names(FieldRole::kRing)) {
    for (const FrameField& field : frame.fields) {
      if (field.name != name) continue;
      const std::size_t count = distinct_values(frame.cloud, field.where);
      if (count > 0) return {count, fmt::format("field {}", name)};
    }
  }
  const std::uint32_t rows = std::min(frame.cloud.height, frame.cloud.width);
  return is_ring_count(rows) ? ToldRings{rows, "rows of the cloud"} : ToldRings{};
}

}  // namespace pose_wall::tools
