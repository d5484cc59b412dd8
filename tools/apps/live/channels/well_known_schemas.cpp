// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/channels/well_known_schemas.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

namespace pose_wall::tools::live {
namespace {

using Json = nlohmann::ordered_json;
using Members = std::initializer_list<std::pair<const char*, Json>>;

Json number() {
  return {{"type", "number"}};
}
Json text() {
  return {{"type", "string"}};
}
Json flag() {
  return {{"type", "boolean"}};
}
Json count() {
  return {{"type", "integer"}, {"minimum", 0}};
}
Json bytes() {
  return {{"type", "string"}, {"contentEncoding", "base64"}};
}
Json list(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

Json object(Members members) {
  Json properties = Json::object(), required = Json::array();
  for (const auto& [name, schema] : members) {
    properties[name] = schema;
    required.push_back(name);
  }
  return {{"type", "object"}, {"properties", properties}, {"required", required}};
}

// Numbers with names.
Json choice(std::initializer_list<const char*> titles) {
  Json alternatives = Json::array();
  for (const char* title : titles) alternatives.push_back({{"title", title}, {"const", alternatives.size()}});
  return {{"oneOf", alternatives}};
}

Json moment() {
  Json schema = object({{"sec", count()}, {"nsec", count()}});
  schema.erase("required");
  return schema;
}
Json duration() {
  Json schema = object({{"sec", {{"type", "integer"}}}, {"nsec", count()}});
  schema.erase("required");
  return schema;
}
Json xyz() {
  return object({{"x", number()}, {"y", number()}, {"z", number()}});
}
Json quaternion() {
  return object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Json pose() {
  return object({{"position", xyz()}, {"orientation", quaternion()}});
}
Json colour() {
  return object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Json pose_in_frame() {
  return object({{"timestamp", moment()}, {"frame_id", text()}, {"pose", pose()}});
}

Json frame_transforms() {
  return object({{"transforms", list(object({{"timestamp", moment()},
                                             {"parent_frame_id", text()},
                                             {"child_frame_id", text()},
                                             {"translation", xyz()},
                                             {"rotation", quaternion()}}))}});
}

Json log() {
  return object({{"timestamp", moment()},
                 {"level", choice({"UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"})},
                 {"message", text()},
                 {"name", text()},
                 {"file", text()},
                 {"line", count()}});
}

Json arrow() {
  return object({{"pose", pose()},
                 {"shaft_length", number()},
                 {"shaft_diameter", number()},
                 {"head_length", number()},
                 {"head_diameter", number()},
                 {"color", colour()}});
}
Json solid() {
  return object({{"pose", pose()}, {"size", xyz()}, {"color", colour()}});
}
Json cylinder() {
  return object(
      {{"pose", pose()}, {"size", xyz()}, {"bottom_scale", number()}, {"top_scale", number()}, {"color", colour()}});
}
Json line() {
  return object({{"type", choice({"LINE_STRIP", "LINE_LOOP", "LINE_LIST"})},
                 {"pose", pose()},
                 {"thickness", number()},
                 {"scale_invariant", flag()},
                 {"points", list(xyz())},
                 {"color", colour()},
                 {"colors", list(colour())},
                 {"indices", list(count())}});
}
Json triangles() {
  return object({{"pose", pose()},
                 {"points", list(xyz())},
                 {"color", colour()},
                 {"colors", list(colour())},
                 {"indices", list(count())}});
}
Json written() {
  return object({{"pose", pose()},
                 {"billboard", flag()},
                 {"font_size", number()},
                 {"scale_invariant", flag()},
                 {"color", colour()},
                 {"text", text()}});
}
Json model() {
  return object({{"pose", pose()},
                 {"scale", xyz()},
                 {"color", colour()},
                 {"override_color", flag()},
                 {"url", text()},
                 {"media_type", text()},
                 {"data", bytes()}});
}

Json scene_update() {
  const Json deletion = object({{"timestamp", moment()}, {"type", choice({"MATCHING_ID", "ALL"})}, {"id", text()}});
  const Json entity = object({{"timestamp", moment()},
                              {"frame_id", text()},
                              {"id", text()},
                              {"lifetime", duration()},
                              {"frame_locked", flag()},
                              {"metadata", list(object({{"key", text()}, {"value", text()}}))},
                              {"arrows", list(arrow())},
                              {"cubes", list(solid())},
                              {"spheres", list(solid())},
                              {"cylinders", list(cylinder())},
                              {"lines", list(line())},
                              {"triangles", list(triangles())},
                              {"texts", list(written())},
                              {"models", list(model())}});
  return object({{"deletions", list(deletion)}, {"entities", list(entity)}});
}

Json schema_of(WellKnown type) {
  switch (type) {
    case WellKnown::kPoseInFrame:
      return pose_in_frame();
    case WellKnown::kFrameTransforms:
      return frame_transforms();
    case WellKnown::kSceneUpdate:
      return scene_update();
    case WellKnown::kLog:
      break;
  }
  return log();
}

}  // namespace

const char* well_known_name(WellKnown type) {
  switch (type) {
    case WellKnown::kPoseInFrame:
      return "foxglove.PoseInFrame";
    case WellKnown::kFrameTransforms:
      return "foxglove.FrameTransforms";
    case WellKnown::kSceneUpdate:
      return "foxglove.SceneUpdate";
    case WellKnown::kLog:
      break;
  }
  return "foxglove.Log";
}

std::string well_known_schema(WellKnown type) {
  Json schema = schema_of(type);
  schema["title"] = well_known_name(type);
  return schema.dump();
}

}  // namespace pose_wall::tools::live
