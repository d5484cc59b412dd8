// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/field_aliases.hpp"

#include <algorithm>

namespace pose_wall::tools {

const std::vector<std::string_view>& field_names(FieldRole role) {
  static const std::vector<std::string_view> none;
  static const std::vector<std::string_view> coordinates = {"x", "y", "z"};
  static const std::vector<std::string_view> intensities = {"intensity", "i", "reflectivity"};
  static const std::vector<std::string_view> times = {"time", "t", "timestamp", "offset_time", "time_stamp"};
  static const std::vector<std::string_view> rings = {"ring", "line", "channel"};
  switch (role) {
    case FieldRole::kCoordinate:
      return coordinates;
    case FieldRole::kIntensity:
      return intensities;
    case FieldRole::kTime:
      return times;
    case FieldRole::kRing:
      return rings;
    case FieldRole::kNone:
      break;
  }
  return none;
}

FieldRole field_role(std::string_view name) {
  for (const FieldRole role : {FieldRole::kCoordinate, FieldRole::kIntensity, FieldRole::kTime, FieldRole::kRing}) {
    const std::vector<std::string_view>& names = field_names(role);
    if (std::find(names.begin(), names.end(), name) != names.end()) return role;
  }
  return FieldRole::kNone;
}

double time_unit_s(double spread) {
  for (const double unit_s : {1.0, 1e-3, 1e-6, 1e-9}) {
    if (spread * unit_s >= 0.01 && spread * unit_s <= 1.0) return unit_s;
  }
  return 0.0;
}

}  // namespace pose_wall::tools
