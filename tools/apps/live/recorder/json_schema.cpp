// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/recorder/json_schema.hpp"

#include <nlohmann/json.hpp>

namespace pose_wall::tools::live {
namespace {

using Json = nlohmann::ordered_json;

// Of one list: an item may have members that another lacks.
void join(Json* into, const Json& other) {
  for (const auto& [name, member] : other.items()) {
    if (!into->contains(name)) {
      (*into)[name] = member;
    } else if (member.is_object()) {
      join(&(*into)[name], member);
    }
  }
}

// Nothing where the example does not tell. Viewers refuse a schema whole for a member that has no type, or several.
Json schema_of(const Json& value) {
  if (value.is_null()) return nullptr;
  Json schema = Json::object();
  if (value.is_object()) {
    schema["type"] = "object";
    schema["properties"] = Json::object();
    for (const auto& [name, member] : value.items()) {
      Json known = schema_of(member);
      if (known.is_null()) continue;
      known["nullable"] = true;
      schema["properties"][name] = std::move(known);
    }
    return schema;
  }
  if (value.is_array()) {
    Json items = Json::object();
    for (const Json& item : value) join(&items, schema_of(item));
    if (items.empty()) return nullptr;
    return {{"type", "array"}, {"items", items}};
  }
  if (value.is_string()) return {{"type", "string"}};
  if (value.is_boolean()) return {{"type", "boolean"}};
  return {{"type", "number"}};
}

}  // namespace

std::string json_schema_of(const std::string& example) {
  Json schema = schema_of(Json::parse(example));
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  return schema.dump();
}

}  // namespace pose_wall::tools::live
