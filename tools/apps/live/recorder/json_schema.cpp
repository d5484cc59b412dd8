// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/recorder/json_schema.hpp"

#include <nlohmann/json.hpp>

namespace pose_wall::tools::live {
namespace {

using Json = nlohmann::ordered_json;

Json schema_of(const Json& value) {
  if (value.is_object()) {
    Json schema = {{"type", "object"}, {"properties", Json::object()}};
    for (const auto& [name, member] : value.items()) schema["properties"][name] = schema_of(member);
    return schema;
  }
  if (value.is_array()) {
    Json schema = {{"type", "array"}};
    if (!value.empty()) schema["items"] = schema_of(value.front());
    return schema;
  }
  if (value.is_string()) return {{"type", "string"}};
  if (value.is_boolean()) return {{"type", "boolean"}};
  if (value.is_null()) return Json::object();  // anything
  return {{"type", {"number", "null"}}};
}

}  // namespace

std::string json_schema_of(const std::string& example) {
  Json schema = schema_of(Json::parse(example));
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  return schema.dump();
}

}  // namespace pose_wall::tools::live
