// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/frames/field_value.hpp"
#include "io/json/json_words.hpp"
#include "study/info/input_facts.hpp"

namespace pose_wall::tools {
namespace {

Json points_json(std::vector<std::uint32_t> points) {
  if (points.empty()) return nullptr;
  std::sort(points.begin(), points.end());
  return {{"min", points.front()}, {"median", points[points.size() / 2]}, {"max", points.back()}};
}

Json stamps_json(const StampFacts& stamps) {
  if (stamps.count == 0) return nullptr;
  const StampSteps& steps = stamps.steps;
  return {{"frames", stamps.count},     {"first_ns", stamps.first_ns},
          {"last_ns", stamps.last_ns},  {"interval_s", steps.rate_hz > 0.0 ? 1.0 / steps.rate_hz : 0.0},
          {"jitter_s", steps.jitter_s}, {"longest_s", steps.longest_s},
          {"gaps", steps.gaps},         {"still", steps.still},
          {"backwards", steps.back}};
}

Json sensor_json(const SensorFacts& sensor) {
  Json config = sensor.config.empty() ? Json(nullptr) : Json(sensor.config);
  return {{"class", sensor.model},
          {"config", std::move(config)},
          {"returns_per_frame", sensor.returns},
          {"rings", sensor.rings},
          {"rings_by", sensor.rings_by},
          {"rings_certain", sensor.rings_are_told},
          {"elevation_min_deg", sensor.elevation_min_deg},
          {"elevation_max_deg", sensor.elevation_max_deg},
          {"azimuth_span_deg", sensor.azimuth_span_deg}};
}

Json times_json(const ScanTimeFacts& times) {
  if (times.scans == 0) return nullptr;
  return {{"scans", times.scans},
          {"spread_s", times.spread_s},
          {"turn_s", times.turn_s},
          {"fault", time_fault_name(times.fault)},
          {"faulty", times.faulty}};
}

Json ranges_json(const RangeFacts& ranges) {
  return {{"min", ranges.min_m}, {"near", ranges.near_m}, {"median", ranges.median_m},
          {"far", ranges.far_m}, {"max", ranges.max_m},   {"doubtful_unit", is_unit_doubtful(ranges)}};
}

// Without a language: for programs.
std::string note_of(const FieldFacts& field) {
  if (!field.times) return "";
  if (field.times->unit.empty()) return fmt::format("unit unknown, spreads over {:g}", field.times->spread);
  return fmt::format("{}, {:.4f} s a frame{}", field.times->unit, field.times->spread_s,
                     field.times->is_absolute ? ", absolute" : "");
}

std::string layout_of(const std::optional<LayoutFacts>& layout) {
  if (!layout) return "";
  return fmt::format("{} x {} points, {} bytes a point, {}-endian", layout->rows, layout->columns, layout->point_step,
                     layout->is_big_endian ? "big" : "little");
}

Json sender_facts_json(const SourceSender& sender) {
  Json facts = Json::object();
  for (const SourceFact& fact : sender.facts) {
    std::string key = fact.word;
    std::replace(key.begin(), key.end(), ' ', '_');
    facts[key] = fact.found;
  }
  return facts;
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
  page["sources"] = Json::array();
  for (const SourceSender& sender : about.senders) {
    page["sources"].push_back({{"name", sender.name},
                               {"count", sender.count},
                               {"read", sender.is_read},
                               {"facts", sender_facts_json(sender)},
                               {"oddities", sender.oddities}});
  }
  page["frames"] = facts.frames();
  page["unreadable"] = facts.unreadable();
  page["errors"] = facts.errors();
  page["points"] = points_json(facts.points());
  page["layout"] = layout_of(facts.layout());
  page["fields"] = Json::array();
  for (const FieldFacts& field : facts.fields()) {
    page["fields"].push_back({{"name", field.name},
                              {"type", field_type_name(field.type)},
                              {"offset", field.offset},
                              {"role", field.role},
                              {"note", note_of(field)}});
  }
  page["other_layouts"] = facts.other_layouts();
  page["stamps"] = stamps_json(facts.stamps());
  const SensorFacts sensor = facts.sensor();
  page["ranges_m"] = facts.has_returns() ? ranges_json(sensor.ranges) : Json(nullptr);
  page["times"] = times_json(facts.scan_times());
  page["zero_share"] = facts.zero_share();
  page["not_finite_share"] = facts.not_finite_share();
  page["sensor"] = facts.has_returns() ? sensor_json(sensor) : Json(nullptr);
  return json_text(page, 2);
}

}  // namespace pose_wall::tools
