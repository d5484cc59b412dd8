// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"
#include "io/numbers/quantities.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/gate.hpp"
#include "lab/campaign/rate_bound.hpp"
#include "lab/campaign/recipe.hpp"
#include "study/results/result_csv.hpp"
#include "study/truth/error_figures_json.hpp"

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

void tell_place(const char* scene, const Run& run, std::uint64_t frame, Json* page) {
  page->update({{scene, run.scene}, {"sensor", run.sensor}, {"draw", run.draw}, {"seed", run.seed}, {"frame", frame}});
}

Json event_page(const WorstEvent& e, const Manifest& manifest) {
  Json page;
  page["breach"] = breach_name(e.breach);
  tell_place("scene", e.run, e.frame, &page);
  page.update({{"quantity", pose_wall_quantity_name(e.quantity)},
               {"error", e.error},
               {"sigma", e.measured.sigma},
               {"protection_level", e.measured.protection_level},
               {"state", pose_wall_state_name(e.measured.state)},
               {"reasons", reason_names(e.reasons)},
               {"command", recipe(e, manifest)}});
  return page;
}

Json event_page(const MotionEvent& e, const Manifest& manifest) {
  Json page;
  page["what"] = e.what;
  tell_place("class", e.run, e.frame, &page);
  page.update({{"excess", e.excess}, {"command", recipe(e, manifest)}});
  return page;
}

void tell_identity(const Manifest& manifest, Json* page) {
  for (const auto& [name, value] : manifest.identity) (*page)["identity"][name] = value;
}

template <typename AnyCard>
void tell_runs(const AnyCard& card, Json* page) {
  page->update({{"runs_planned", card.manifest.runs}, {"runs", card.runs}, {"gate_faults", gate_faults(card)}});
}

Json spread_page(const std::vector<double>& numbers) {
  const Spread s = spread_of(numbers);
  return {{"share_05", s.low}, {"median", s.middle}, {"share_95", s.high}};
}

Json state_page(const MotionClassCard& one) {
  Json page;
  for (std::uint32_t state = POSE_WALL_ALONG_LOST; state <= POSE_WALL_ALONG_MEASURED; ++state) {
    page[pose_wall_motion_along_state_name(state)] = one.share(state);
  }
  return page;
}

Json direction_page(const DirectionTotals& directions) {
  Json page;
  for (std::uint32_t d = 0; d < directions.size(); ++d) {
    page[pose_wall_motion_direction_name(d)] = {{"values", directions[d].count()},
                                                {"rmse", directions[d].rmse()},
                                                {"largest", directions[d].largest()},
                                                {"beyond", directions[d].beyond()},
                                                {"mean_z2", directions[d].mean_z2()}};
  }
  return page;
}

Json misleading_page(const Misleading& misleading) {
  return {{"measured", misleading.measured},
          {"misleading", misleading.misleading},
          {"worst_excess", misleading.worst_excess}};
}

Json class_page(const MotionClassCard& one) {
  return {{"class", one.kind->name},
          {"sensor", one.sensor},
          {"right", one.kind->expected},
          {"runs", one.runs},
          {"frames", one.frames},
          {"states", state_page(one)},
          {"along_error_m", one.along_m},
          {"along_error_share", one.along_share},
          {"along_error_over_allowed", one.along_excess},
          {"across_m", one.across_m},
          {"up_m", one.up_m},
          {"turn_rad", one.turn_rad},
          {"misleading_steps", misleading_page(one.steps)},
          {"misleading_poses", misleading_page(one.poses)},
          {"step", direction_page(one.step)},
          {"pose", direction_page(one.pose)},
          {"contrast", spread_page(one.contrast)},
          {"patches", spread_page(one.patches)},
          {"ms_mean", one.ms_sum / static_cast<double>(one.frames)},
          {"ms_worst", one.ms_worst},
          {"broken", class_faults(one)}};
}

}  // namespace

std::string card_json(const Card& card) {
  Json page;
  tell_identity(card.manifest, &page);
  page["motion"] = card.manifest.motion_is_on ? "on" : "off";
  page["scans"] = scans_name(card.manifest.plan.scans);
  page["command"] = card.manifest.command();
  page["alert_limit_angle_rad"] = card.manifest.limits.angle_rad;
  page["alert_limit_distance_m"] = card.manifest.limits.distance_m;
  tell_runs(card, &page);
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

std::string card_json(const MotionCard& card) {
  Json page;
  tell_identity(card.manifest, &page);
  page["command"] = card.manifest.command();
  tell_runs(card, &page);
  const RoughTotals rough = rough_totals(card);
  page["rough"] = {
      {"runs", rough.runs}, {"mean_z2_step", rough.along_step.mean_z2()}, {"mean_z2_pose", rough.along_pose.mean_z2()}};
  page["classes"] = Json::array();
  for (const MotionClassCard& one : card.classes) page["classes"].push_back(class_page(one));
  page["worst"] = Json::array();
  for (const MotionEvent& event : card.events) page["worst"].push_back(event_page(event, card.manifest));
  return json_text(page, 1) + "\n";
}

}  // namespace pose_wall::tools::campaign
