// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <nlohmann/json.hpp>

#include "campaign/motion_card_files.hpp"
#include "campaign/motion_gate.hpp"
#include "campaign/recipe.hpp"
#include "json/json_words.hpp"

namespace pose_wall::tools::campaign {
namespace {

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

Json motion_class_page(const MotionClassCard& one) {
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
          {"broken", motion_class_faults(one)}};
}

}  // namespace

std::string motion_card_json(const MotionCard& card) {
  Json page;
  for (const auto& [name, value] : card.manifest.identity) page["identity"][name] = value;
  page["command"] = card.manifest.command();
  page["runs_planned"] = card.manifest.runs;
  page["runs"] = card.runs;
  page["gate_faults"] = motion_gate_faults(card);
  const RoughTotals rough = rough_totals(card);
  page["rough"] = {
      {"runs", rough.runs}, {"mean_z2_step", rough.along_step.mean_z2()}, {"mean_z2_pose", rough.along_pose.mean_z2()}};
  page["classes"] = Json::array();
  for (const MotionClassCard& one : card.classes) page["classes"].push_back(motion_class_page(one));
  page["worst"] = Json::array();
  for (const MotionEvent& event : card.events) {
    const auto frames = static_cast<std::uint32_t>(event.frame + 1);
    page["worst"].push_back({{"what", event.what},
                             {"class", event.run.scene},
                             {"sensor", event.run.sensor},
                             {"draw", event.run.draw},
                             {"seed", event.run.seed},
                             {"frame", event.frame},
                             {"excess", event.excess},
                             {"command", run_recipe(event.run, frames, card.manifest)}});
  }
  return json_text(page, 1) + "\n";
}

}  // namespace pose_wall::tools::campaign
