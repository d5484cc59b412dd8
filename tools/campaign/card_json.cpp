// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <cmath>
#include <nlohmann/json.hpp>

#include "campaign/card_files.hpp"
#include "campaign/gate.hpp"
#include "campaign/rate_bound.hpp"
#include "campaign/recipe.hpp"
#include "json/json_words.hpp"
#include "quantities.hpp"
#include "results/result_csv.hpp"

namespace pose_wall::tools::campaign {
namespace {

Json shares(const StateShares& s) {
  return {{"valid", s.valid}, {"degraded", s.degraded}, {"held", s.held}, {"invalid", s.invalid}};
}

Json level_page(const LevelFigures& levels) {
  return {{"median", levels.median},
          {"absolute_error_95", levels.absolute_error_95},
          {"median_over_error_95", levels.over_error()}};
}

// By group: valid share, its floor (null without one), and the levels.
Json valid_page(const SevenStatistics& quantities, const ValidCounts& counts) {
  Json page;
  const std::vector<QuantityGroup> groups = grouped(quantities);
  for (std::size_t group = 0; group < kGroups; ++group) {
    const ErrorStatistics& s = groups[group].statistics;
    page[groups[group].name] = {{"values_with_truth", s.frames()},
                                {"share", state_shares(s).valid},
                                {"floor", counts[group].floor()},
                                {"level", level_page(s.valid_levels())}};
  }
  return page;
}

Json kind_page(const KindCard& row) {
  return {{"kind", sim::scene_kind_name(row.kind)},
          {"sensor", row.sensor},
          {"runs", row.runs},
          {"valid", valid_page(row.quantities, row.valid)}};
}

Json frames_page(const FramesCard& row) {
  Json page = {
      {"kind", sim::scene_kind_name(row.kind)}, {"frames", row.name}, {"runs", row.runs}, {"number", row.frames}};
  for (const QuantityGroup& group : grouped(row.quantities)) {
    page["valid"][group.name] = {{"values_with_truth", group.statistics.frames()},
                                 {"share", state_shares(group.statistics).valid}};
  }
  return page;
}

Json scaled_page(const ScaledCounts& c) {
  const auto share = [](std::size_t part, std::size_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  };
  return {{"frames", c.frames},
          {"valid_angles", share(c.valid_angles, c.angles)},
          {"valid_distances", share(c.valid_distances, c.distances)},
          {"misleading", c.misleading},
          {"beyond", c.beyond}};
}

Json seven(const SevenStatistics& quantities) {
  Json all;
  for (std::uint32_t q = 0; q < quantities.size(); ++q) {
    const ErrorStatistics& s = quantities[q];
    all[pose_wall_quantity_name(q)] = {{"unit", is_angle(q) ? "rad" : "m"},
                                       {"values_with_truth", s.frames()},
                                       {"shares", shares(state_shares(s))},
                                       {"valid_level", level_page(s.valid_levels())},
                                       {"raw", error_figures_json(s.raw())},
                                       {"value", error_figures_json(s.value())},
                                       {"raw_beyond_protection", s.raw_beyond_protection()},
                                       {"value_beyond_protection", s.value_beyond_protection()},
                                       {"valid_beyond_alert", s.valid_beyond_alert()},
                                       {"valid_without_truth", s.valid_without_truth()},
                                       {"mean_z2", s.mean_z2()}};
  }
  return all;
}

Json rate_of(std::size_t events, std::size_t frames) {
  return {{"frames", events},
          {"rate", frames > 0 ? static_cast<double>(events) / static_cast<double>(frames) : std::nan("")},
          {"rate_bound_95", rate_bound_95(events, frames)}};
}

Json counts(const FrameCounts& f) {
  return {{"frames", f.frames},
          {"misleading", rate_of(f.misleading, f.frames)},
          {"value_beyond_protection", rate_of(f.value_beyond_protection, f.frames)},
          {"raw_beyond_protection", rate_of(f.raw_beyond_protection, f.frames)},
          {"work_limited", rate_of(f.work_limited, f.frames)}};
}

Json totals(const Totals& t) {
  return {{"classes", t.classes},
          {"runs", t.runs},
          {"counts", counts(t.frames)},
          {"shares", shares(state_shares(t.quantities))},
          {"quantities", seven(t.quantities)},
          {"no_motion_in_scan", {{"runs", t.straight_runs}, {"quantities", seven(t.straight)}}}};
}

Json class_page(const ClassCard& card) {
  Json reasons = Json::object();
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if (card.reasons[bit] > 0) reasons[pose_wall_reason_name(bit)] = card.reasons[bit];
  }
  return {{"scene", card.scene->name},
          {"sensor", card.sensor},
          {"kind", sim::scene_kind_name(card.scene->kind)},
          {"draws", card.draws},
          {"valid", valid_page(card.quantities, valid_counts(card))},
          {"shares", shares(state_shares(card.quantities))},
          {"counts", counts(card.frames)},
          {"frames_to_alert_max", card.times.alert_max},
          {"frames_to_notice", card.times.noticed},
          {"never_noticed", card.times.never_noticed},
          {"frames_to_recover", card.times.recovered},
          {"never_recovered", card.times.never_recovered},
          {"reasons_of_values_not_valid", reasons},
          {"quantities", seven(card.quantities)}};
}

Json event_page(const WorstEvent& e, const Manifest& manifest) {
  return {{"breach", breach_name(e.breach)},
          {"scene", e.run.scene},
          {"sensor", e.run.sensor},
          {"draw", e.run.draw},
          {"seed", e.run.seed},
          {"frame", e.frame},
          {"quantity", pose_wall_quantity_name(e.quantity)},
          {"error", e.error},
          {"sigma", e.measured.sigma},
          {"protection_level", e.measured.protection_level},
          {"state", pose_wall_state_name(e.measured.state)},
          {"reasons", reason_names(e.reasons)},
          {"command", recipe(e, manifest)}};
}

}  // namespace

std::string card_json(const Card& card) {
  Json page;
  for (const auto& [name, value] : card.manifest.identity) page["identity"][name] = value;
  page["motion"] = card.manifest.motion_is_on ? "on" : "off";
  page["scans"] = scans_name(card.manifest.plan.scans);
  page["command"] = card.manifest.command();
  page["alert_limit_angle_rad"] = card.manifest.limits.angle_rad;
  page["alert_limit_distance_m"] = card.manifest.limits.distance_m;
  page["runs_planned"] = card.manifest.runs;
  page["runs"] = card.runs;
  page["gate_faults"] = gate_faults(card);
  page["totals"] = {{"mine", totals(card.mine)},
                    {"nominal", totals(card.nominal)},
                    {"adversarial", totals(card.adversarial)},
                    {"both", totals(card.judged)},
                    {"unobservable", totals(card.unobservable)}};
  page["kinds"] = Json::array();
  for (const KindCard& row : card.kinds) page["kinds"].push_back(kind_page(row));
  page["frames"] = Json::array();
  for (const FramesCard& row : card.frames) page["frames"].push_back(frames_page(row));
  for (std::size_t i = 0; i < kLevelScales.size(); ++i) {
    page["level_curve"].push_back({{"scale", kLevelScales[i]},
                                   {"nominal", scaled_page(card.nominal_curve[i])},
                                   {"adversarial", scaled_page(card.adversarial_curve[i])}});
  }
  for (const ClassCard& one : card.classes) page["classes"].push_back(class_page(one));
  page["worst_events"] = Json::array();
  for (const WorstEvent& event : card.events) page["worst_events"].push_back(event_page(event, card.manifest));
  return json_text(page, 1) + "\n";
}

}  // namespace pose_wall::tools::campaign
