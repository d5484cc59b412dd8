// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/box/result_difference.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstring>
#include <vector>

namespace pose_wall::tools {
namespace {

enum class Kind { kNumber, kCount, kStamp, kCount64 };

struct Field {
  std::string name;
  std::size_t offset;
  Kind kind;
};

Kind kind_of(const double& /*member*/) {
  return Kind::kNumber;
}
Kind kind_of(const std::uint32_t& /*member*/) {
  return Kind::kCount;
}
Kind kind_of(const std::int64_t& /*member*/) {
  return Kind::kStamp;
}
Kind kind_of(const std::uint64_t& /*member*/) {
  return Kind::kCount64;
}

// Names of members with their places, relative to the result they lie in.
class Fields {
 public:
  Fields() {
    add("struct_size", r_.struct_size);
    add("frame_reasons", r_.frame_reasons);
    add("mark", r_.mark);
    add("config_crc32", r_.config_crc32);
    add("source_id", r_.source_id);
    for (int i = 0; i < 3; ++i) add(fmt::format("positive_means[{}]", i), r_.positive_means[i]);
    add("publication", r_.publication);
    add("work", r_.work);
    add("stamp_ns", r_.stamp_ns);
    add("frame_index", r_.frame_index);
    add("confidence", r_.confidence);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      add_value(fmt::format("quantity[{}].", pose_wall_quantity_name(q)), r_.quantity[q]);
    }
    add_plane("floor.", r_.floor);
    add_plane("left.", r_.left);
    add_plane("right.", r_.right);
    for (int i = 0; i < 9; ++i) add(fmt::format("R_level_base[{}]", i), r_.R_level_base[i]);
    add("left_right_yaw_difference_rad", r_.left_right_yaw_difference_rad);
    add("voxel_leaf_m", r_.voxel_leaf_m);
    add_counts();
  }
  const std::vector<Field>& all() const { return fields_; }

 private:
  template <typename T>
  void add(const std::string& name, const T& member) {
    const auto* const start = reinterpret_cast<const unsigned char*>(&r_);
    const auto* const at = reinterpret_cast<const unsigned char*>(&member);
    fields_.push_back({name, static_cast<std::size_t>(at - start), kind_of(member)});
  }

  void add_value(const std::string& of, const pose_wall_value& v) {
    add(of + "value", v.value);
    add(of + "raw", v.raw);
    add(of + "sigma", v.sigma);
    add(of + "protection_level", v.protection_level);
    add(of + "raw_protection_level", v.raw_protection_level);
    add(of + "confidence", v.confidence);
    add(of + "age_s", v.age_s);
    for (std::uint32_t i = 0; i < POSE_WALL_PARTS; ++i) {
      add(fmt::format("{}part[{}]", of, pose_wall_part_name(i)), v.part[i]);
    }
    add(of + "state", v.state);
    add(of + "reasons", v.reasons);
    add(of + "raw_state", v.raw_state);
    add(of + "cause", v.cause);
    for (int i = 0; i < 2; ++i) add(fmt::format("{}reserved[{}]", of, i), v.reserved[i]);
  }

  void add_plane(const std::string& of, const pose_wall_plane& p) {
    for (int i = 0; i < 3; ++i) add(fmt::format("{}normal[{}]", of, i), p.normal[i]);
    add(of + "d_m", p.d_m);
    add(of + "rms_m", p.rms_m);
    add(of + "lean_rad", p.lean_rad);
    add(of + "extent_min_m", p.extent_min_m);
    add(of + "extent_max_m", p.extent_max_m);
    add(of + "area_m2", p.area_m2);
    add(of + "found", p.found);
    add(of + "inliers", p.inliers);
    add(of + "iterations", p.iterations);
    add(of + "reasons", p.reasons);
  }

  void add_counts() {
    add("points_in", r_.points_in);
    add("dropped_not_finite", r_.dropped_not_finite);
    add("dropped_zero", r_.dropped_zero);
    add("dropped_near", r_.dropped_near);
    add("dropped_far", r_.dropped_far);
    add("dropped_body", r_.dropped_body);
    add("voxels", r_.voxels);
    add("outliers", r_.outliers);
    add("open_points", r_.open_points);
    add("wall_points", r_.wall_points);
  }

  pose_wall_result r_{};
  std::vector<Field> fields_;
};

std::size_t bytes_of(Kind kind) {
  return kind == Kind::kCount ? 4 : 8;
}

template <typename T>
T member(const pose_wall_result& result, const Field& field) {
  T value;
  std::memcpy(&value, reinterpret_cast<const unsigned char*>(&result) + field.offset, sizeof value);
  return value;
}

std::string text(const pose_wall_result& result, const Field& field) {
  switch (field.kind) {
    case Kind::kNumber:
      return fmt::format("{:.17g} (0x{:016x})", member<double>(result, field), member<std::uint64_t>(result, field));
    case Kind::kCount:
      return fmt::format("{}", member<std::uint32_t>(result, field));
    case Kind::kStamp:
      return fmt::format("{}", member<std::int64_t>(result, field));
    default:
      return fmt::format("{}", member<std::uint64_t>(result, field));
  }
}

}  // namespace

std::optional<ResultDifference> first_difference(const pose_wall_result& recorded, const pose_wall_result& computed) {
  static const Fields fields;
  const auto* const a = reinterpret_cast<const unsigned char*>(&recorded);
  const auto* const b = reinterpret_cast<const unsigned char*>(&computed);
  for (const Field& field : fields.all()) {
    if (std::memcmp(a + field.offset, b + field.offset, bytes_of(field.kind)) == 0) continue;
    return ResultDifference{field.name, text(recorded, field), text(computed, field)};
  }
  return std::nullopt;
}

}  // namespace pose_wall::tools
