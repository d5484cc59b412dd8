// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/result_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/live/health_words.hpp"
#include "io/json/json_words.hpp"
#include "study/results/result_json.hpp"

namespace pose_wall::tools::live {
namespace {

Json part_json(const PartHealth& part) {
  Json facts = Json::object();
  for (const auto& [name, value] : part.facts) facts[name] = value;
  return {{"part", part.part}, {"grade", grade_name(part.grade)}, {"summary", part.summary}, {"facts", facts}};
}

}  // namespace

std::string result_json(const LiveResult& result) {
  const pose_wall_publication& publication = result.publication;
  FrameOutcome outcome;
  outcome.frame = publication.frame;
  outcome.source = result.frame_id;
  outcome.stamp_ns = publication.result.stamp_ns;
  outcome.result = publication.result;
  outcome.limits = alert_limits_of(result.config);
  Json line = result_as_json(outcome);
  line.erase("times_ms");
  line.erase("error");
  line["told_by"] = publication.cause == POSE_WALL_RUNTIME_FRAME ? "frame" : "silence";
  line["header_stamp_ns"] = result.header_stamp_ns;
  line["publication"] = publication.index;
  line["age_ms"] = static_cast<double>(publication.age_ns) * 1e-6;
  line["thinning"] = publication.thinning;
  line["held_thinning"] = publication.held_thinning;
  return json_text(line);
}

std::string health_json(const std::vector<PartHealth>& parts) {
  Json list = Json::array();
  for (const PartHealth& part : parts) list.push_back(part_json(part));
  return json_text({{"schema", 1}, {"parts", list}});
}

std::string health_in_both_json(const std::vector<PartHealth>& parts) {
  Json list = Json::array();
  for (const PartHealth& part : parts) {
    Json told = part_json(part);
    told["zh"] = part_json(in_language(Language::kChinese, part));
    list.push_back(std::move(told));
  }
  return json_text({{"schema", 1}, {"parts", list}});
}

}  // namespace pose_wall::tools::live
