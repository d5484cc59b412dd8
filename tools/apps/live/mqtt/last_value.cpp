// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/mqtt/last_value.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/config_file/key_table.hpp"
#include "io/json/json_words.hpp"
#include "io/language/both_languages.hpp"
#include "study/steer/steering.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::int64_t kHolds_ns = std::chrono::nanoseconds(kLastValueHolds).count();

Json in_both(const char* text) {
  return {{"en", tr(Language::kEnglish, text)}, {"zh", tr(Language::kChinese, text)}};
}

Json blank(const char* state, const char* line) {
  return {{"schema", 1},           {"state", state},
          {"told_at_ns", nullptr}, {"valid_until_ns", nullptr},
          {"age_s", nullptr},      {"may_steer", Json::array()},
          {"line", in_both(line)}, {"values", Json::object()}};
}

// state, value and level of each; what is invalid has neither.
Json values_of(const Newest& newest, std::int64_t now_ns) {
  Json values = Json::object();
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& value = newest.result.publication.result.quantity[q];
    const bool is_told = value.state != POSE_WALL_INVALID;
    const std::string unit = q <= POSE_WALL_YAW ? "_rad" : "_m";
    values[pose_wall_quantity_name(q)] = {
        {"state", pose_wall_state_name(value.state)},
        {"value" + unit, is_told ? Json(value.value) : Json(nullptr)},
        {"protection_level" + unit, is_told ? Json(value.protection_level) : Json(nullptr)},
        {"age_s", is_told ? Json(newest.value_age_s(q, now_ns)) : Json(nullptr)}};
  }
  return values;
}

}  // namespace

LastValue last_value(const Newest& newest, std::int64_t now_ns, std::int64_t wall_ns) {
  Json json = blank("stale", translatable("may steer: none. Results are missing or old."));
  json["told_at_ns"] = wall_ns;
  json["valid_until_ns"] = wall_ns + kHolds_ns;
  std::string gist = "stale";
  const pose_wall_publication& publication = newest.result.publication;
  if (newest.is_there() && publication.age_ns < INT64_MAX) {
    json["age_s"] = static_cast<double>(publication.age_ns) * 1e-9;
  }
  if (newest.is_fresh()) {
    const Steering steering = steering_of(publication.result, alert_limits_of(newest.result.config));
    gist = publication.cause == POSE_WALL_RUNTIME_FRAME ? "live" : "silent";
    json["state"] = gist;
    for (const SteerValue& value : steering) {
      if (!value.may_steer()) continue;
      json["may_steer"].push_back(pose_wall_quantity_name(value.quantity));
      gist += fmt::format(" {}", value.quantity);
    }
    json["line"] = steer_line_json(steering);
    json["values"] = values_of(newest, now_ns);
  }
  return {json_text(json), gist};
}

std::string no_last_value() {
  return json_text(blank("gone", translatable("may steer: none. The daemon is gone.")));
}

std::string with_end(std::string json, std::int64_t wall_ns) {
  json.insert(json.size() - 1, fmt::format(",\"valid_until_ns\":{}", wall_ns + kHolds_ns));
  return json;
}

}  // namespace pose_wall::tools::live
