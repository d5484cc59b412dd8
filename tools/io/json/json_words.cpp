// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/json/json_words.hpp"

#include <nlohmann/json.hpp>

#include "pose_wall.h"

namespace pose_wall::tools {

std::string json_text(const Json& json) {
  return json_text(json, -1);
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json reason_list(std::uint32_t reasons) {
  Json names = Json::array();
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) names.push_back(pose_wall_reason_name(bit));
  }
  return names;
}

Json parts_json(const pose_wall_value& value) {
  Json parts;
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) parts[pose_wall_part_name(part)] = value.part[part];
  return parts;
}

}  // namespace pose_wall::tools
