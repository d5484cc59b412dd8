// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/summary_json.hpp"

#include <nlohmann/json.hpp>

#include "study/explain/gate_list.hpp"
#include "study/explain/summary_text.hpp"

namespace pose_wall::tools::explain {
namespace {

constexpr std::size_t kStretchesMost = 1000;

Json quantities_json(const RecordingSummary& summary) {
  Json out = Json::array();
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const QuantitySummary& quantity = summary.quantities()[q];
    Json states;
    for (std::uint32_t s = 0; s < quantity.states.size(); ++s) states[pose_wall_state_name(s)] = quantity.states[s];
    const std::uint32_t cause = quantity.cause();
    out.push_back({{"quantity", pose_wall_quantity_name(q)},
                   {"frames", states},
                   {"median_protection_level", quantity.levels.median()},
                   {"largest_part", cause < POSE_WALL_PARTS ? Json(pose_wall_part_name(cause)) : Json()}});
  }
  return out;
}

Json reasons_json(const RecordingSummary& summary) {
  Json out = Json::array();
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    const ReasonSummary& reason = summary.reasons()[bit];
    if (reason.frames == 0) continue;
    Json gates = Json::array();
    for (const std::uint32_t gate : reason.gates) gates.push_back(gate_list()[gate].name);
    out.push_back({{"reason", pose_wall_reason_name(bit)}, {"frames", reason.frames}, {"gates", gates}});
  }
  return out;
}

Json story_json(const Story& story) {
  return {{"kind", story_name(story.kind)}, {"words", story_words(story)}};
}

Json stretches_json(const RecordingSummary& summary) {
  Json out = Json::array();
  for (const Stretch& s : summary.longest_stretches(kStretchesMost)) {
    out.push_back({{"first", s.first}, {"last", s.last}, {"story", story_json(s.story)}});
  }
  return out;
}

Json stories_json(const RecordingSummary& summary) {
  Json out = Json::array();
  for (const StorySummary& s : summary.stories()) {
    out.push_back({{"story", story_json(s.story)}, {"frames", s.frames}, {"first", s.first}});
  }
  return out;
}

}  // namespace

Json summary_json(const RecordingSummary& summary, const std::string& command) {
  Json to_see = Json::array();
  for (const FrameToSee& f : frames_to_see(summary)) {
    to_see.push_back({{"frame", f.frame}, {"why", f.why}, {"command", command_for(command, f.frame)}});
  }
  return {{"frames", summary.frames()},
          {"unreadable", summary.unreadable()},
          {"quantities", quantities_json(summary)},
          {"reasons", reasons_json(summary)},
          {"stories", stories_json(summary)},
          {"stretch_count", summary.stretch_count()},
          {"stretches", stretches_json(summary)},
          {"frames_to_look_at", to_see}};
}

}  // namespace pose_wall::tools::explain
