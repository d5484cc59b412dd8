// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <utility>

#include "io/frames/field_aliases.hpp"
#include "io/frames/wide_times.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

const PointField* find_once(const std::vector<PointField>& fields, std::string_view name) {
  const PointField* found = nullptr;
  for (const PointField& field : fields) {
    if (field.name != name) continue;
    if (found != nullptr) throw FrameError(say("field '{}' appears twice", name));
    found = &field;
  }
  return found;
}

[[noreturn]] void tell_missing(std::string_view name, const std::vector<std::string_view>& present) {
  const auto is_capital = [name](std::string_view other) {
    return other.size() == 1 && std::tolower(static_cast<unsigned char>(other.front())) == name.front();
  };
  const bool has_capital = std::any_of(present.begin(), present.end(), is_capital);
  throw FrameError(say("field '{}' is missing; fields present: {}{}", name,
                       present.empty() ? tr("none") : fmt::format("{}", fmt::join(present, ", ")),
                       has_capital ? tr(" (x, y and z are written small)") : ""));
}

pose_wall_field required_coordinate(const std::vector<PointField>& fields, std::string_view name) {
  const PointField* field = find_once(fields, name);
  if (field == nullptr) {
    std::vector<std::string_view> names;
    for (const PointField& present : fields) names.push_back(present.name);
    tell_missing(name, names);
  }
  if (field->where.type != POSE_WALL_FIELD_FLOAT32 && field->where.type != POSE_WALL_FIELD_FLOAT64) {
    throw FrameError(say("field '{}' must be a float of 4 or 8 bytes", name));
  }
  return field->where;
}

pose_wall_field optional_field(const std::vector<PointField>& fields, std::string_view name) {
  const PointField* field = find_once(fields, name);
  return field != nullptr ? field->where : pose_wall_field{0, POSE_WALL_FIELD_NONE};
}

pose_wall_field field_of(FieldRole role, const std::vector<PointField>& fields) {
  for (const std::string_view name : field_names(role)) {
    const pose_wall_field field = optional_field(fields, name);
    if (field.type != POSE_WALL_FIELD_NONE) return field;
  }
  return {0, POSE_WALL_FIELD_NONE};
}

}  // namespace

void require_coordinates(const std::vector<std::string_view>& names) {
  for (const std::string_view wanted : {"x", "y", "z"}) {
    if (std::find(names.begin(), names.end(), wanted) == names.end()) tell_missing(wanted, names);
  }
}

Frame describe_frame(Bytes bytes, PointLayout layout) {
  Frame frame;
  frame.bytes = std::move(bytes);
  narrow_wide_fields(frame.bytes.data() + layout.data_offset, &layout);
  pose_wall_cloud& cloud = frame.cloud;
  cloud.struct_size = sizeof cloud;
  cloud.big_endian = layout.big_endian ? 1U : 0U;
  cloud.data = frame.bytes.data() + layout.data_offset;
  cloud.data_bytes = std::uint64_t{layout.count} * layout.point_step;
  cloud.width = layout.count;
  cloud.height = 1;
  cloud.point_step = layout.point_step;
  // A row of 2^27 or more points has a row_step beyond 32 bits; 0 lets the engine multiply in 64.
  cloud.row_step = 0;
  cloud.x = required_coordinate(layout.fields, "x");
  cloud.y = required_coordinate(layout.fields, "y");
  cloud.z = required_coordinate(layout.fields, "z");
  cloud.intensity = field_of(FieldRole::kIntensity, layout.fields);
  cloud.time = field_of(FieldRole::kTime, layout.fields);
  cloud.ring = field_of(FieldRole::kRing, layout.fields);
  for (const PointField& field : layout.fields) frame.fields.push_back({std::string(field.name), field.where});
  return frame;
}

std::uint32_t count_points(std::uint64_t declared, std::uint64_t available, std::uint32_t point_step) {
  const std::uint64_t held = available / point_step;
  if (declared > held) {
    throw FrameError(say("the header declares {} points of {} bytes, but the {} bytes that follow hold {}", declared,
                         point_step, available, held));
  }
  if (declared > std::numeric_limits<std::uint32_t>::max()) {
    throw FrameError(say("{} points; at most {} are allowed", declared, std::numeric_limits<std::uint32_t>::max()));
  }
  return static_cast<std::uint32_t>(declared);
}

bool host_is_big_endian() {
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

}  // namespace pose_wall::tools
