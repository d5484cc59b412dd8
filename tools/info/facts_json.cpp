// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <algorithm>
#include <nlohmann/json.hpp>

#include "frames/field_value.hpp"
#include "info/input_facts.hpp"
#include "results/json_words.hpp"

namespace pose_wall::tools {
namespace {

Json points_json(std::vector<std::uint32_t> points) {
  if (points.empty()) return nullptr;
  std::sort(points.begin(), points.end());
  return {{"min", points.front()}, {"median", points[points.size() / 2]}, {"max", points.back()}};
}

Json stamps_json(const StampFacts& stamps) {
  if (stamps.count == 0) return nullptr;
  return {{"frames", stamps.count},          {"first_ns", stamps.first_ns},   {"last_ns", stamps.last_ns},
          {"interval_s", stamps.interval_s}, {"longest_s", stamps.longest_s}, {"gaps", stamps.gaps},
          {"backwards", stamps.backwards}};
}

Json sensor_json(const SensorFacts& sensor) {
  if (sensor.guess.empty()) return nullptr;
  return {{"rings", sensor.rings},
          {"rings_by", sensor.rings_by},
          {"elevation_min_deg", sensor.elevation_min_deg},
          {"elevation_max_deg", sensor.elevation_max_deg},
          {"azimuth_span_deg", sensor.azimuth_span_deg},
          {"guess", sensor.guess}};
}

}  // namespace

std::string facts_json(const std::string& input, const SourceAbout& about, const InputFacts& facts) {
  Json page = {{"input", input}, {"kind", about.kind}};
  page["topics"] = Json::array();
  for (const SourceTopic& topic : about.topics) {
    page["topics"].push_back({{"name", topic.name},
                              {"type", topic.type},
                              {"messages", topic.messages},
                              {"looked_at", topic.name == about.topic}});
  }
  page["frames"] = facts.frames();
  page["unreadable"] = facts.unreadable();
  page["errors"] = facts.errors();
  page["points"] = points_json(facts.points());
  page["layout"] = facts.layout();
  page["fields"] = Json::array();
  for (const FieldFacts& field : facts.fields()) {
    page["fields"].push_back({{"name", field.name},
                              {"type", field_type_name(field.type)},
                              {"offset", field.offset},
                              {"role", field.role},
                              {"note", field.note}});
  }
  page["other_layouts"] = facts.other_layouts();
  page["stamps"] = stamps_json(facts.stamps());
  const std::optional<RangeFacts> ranges = facts.ranges();
  page["ranges_m"] =
      ranges ? Json{{"min", ranges->min_m}, {"median", ranges->median_m}, {"max", ranges->max_m}} : Json(nullptr);
  page["zero_share"] = facts.zero_share();
  page["not_finite_share"] = facts.not_finite_share();
  page["sensor"] = sensor_json(facts.sensor());
  return json_text(page, 2);
}

}  // namespace pose_wall::tools
