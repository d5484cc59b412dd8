// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/report/page.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "io/config_file/key_table.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/json/json_words.hpp"
#include "io/language/language.hpp"
#include "io/picture/parts.hpp"
#include "study/report/assets.hpp"
#include "study/report/filled_page.hpp"
#include "study/results/usability.hpp"
#include "study/steer/steer_cause.hpp"

namespace pose_wall::tools::report {

Json words_json() {
  Json words;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    words["reason_names"].push_back(pose_wall_reason_name(bit));
    words["reason_texts"].push_back(pose_wall_reason_text(bit));
  }
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) words["parts"].push_back(pose_wall_part_name(part));
  for (std::uint32_t sense = 0; sense <= POSE_WALL_SENSE_TURNED_RIGHT; ++sense) {
    words["senses"].push_back(pose_wall_sense_name(sense));
  }
  for (std::uint32_t stage = 0; stage < POSE_WALL_STAGES; ++stage)
    words["stages"].push_back(pose_wall_stage_name(stage));
  for (std::uint32_t cause = 0; cause < kSteerCauses; ++cause) {
    words["steer_causes"].push_back(steer_cause_name(cause));
    for (const auto& [name, language] : {std::pair("en", Language::kEnglish), std::pair("zh", Language::kChinese)}) {
      words["steer_texts"][name].push_back(steer_cause_words(language, cause));
      words["steer_remedies"][name].push_back(steer_remedy(language, cause));
    }
  }
  return words;
}

namespace {

Json settings_of(const LoadedConfig& loaded) {
  const api::Config defaults;
  Json rows = Json::array();
  for (const pose_wall_key_info& key : config_keys()) {
    const std::string value = config_value_text(*loaded.config.get(), key);
    const std::string usual = config_value_text(*defaults.get(), key);
    if (value != usual) rows.push_back({key.name, value, usual});
  }
  return rows;
}

// The axes in which the page draws boxes of base, and the outline of the machine.
Json machine_of(const api::Config& config) {
  const ResolvedFrames frames = resolve_frames(config);
  return {{"forward", {frames.forward_base[0], frames.forward_base[1]}},
          {"left", {frames.left_base[0], frames.left_base[1]}},
          {"length_m", picture::kMachineLength_m},
          {"width_m", picture::kMachineWidth_m}};
}

Json boxes_of(const api::Config& config) {
  Json boxes = Json::array();
  for (const char* key : {"body_box_1", "body_box_2", "body_box_3", "body_box_4"}) {
    double box[6] = {};
    const bool is_set = pose_wall_config_get_box(config.get(), key, box) == POSE_WALL_OK && box[0] < box[1];
    if (is_set) boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

Json head_json(const PageHead& head, const LoadedConfig& loaded) {
  return {{"title", head.title},
          {"language", head.language},
          {"truth", head.truth},
          {"complete", head.complete},
          {"inputs", head.inputs},
          {"from_table", head.from_table},
          {"version", pose_wall_version()},
          {"settings", settings_of(loaded)},
          {"forward_axis", resolve_frames(loaded.config).forward_axis},
          {"usable_share", kUsableShare},
          {"in_part_share", kInPartShare},
          {"alert_deg", loaded.config.number("alert_limit_angle_deg")},
          {"alert_m", loaded.config.number("alert_limit_distance")},
          {"wall_z_min", loaded.config.number("wall_z_min")},
          {"wall_z_max", loaded.config.number("wall_z_max")},
          {"machine", machine_of(loaded.config)},
          {"body_boxes", boxes_of(loaded.config)}};
}

std::string page(const PageHead& head, const LoadedConfig& loaded, const PageData& data) {
  Json all = data.json();
  all["head"] = head_json(head, loaded);
  all["words"] = words_json();
  Assets parts = assets();
  if (data.clouds() > 0) parts.library = three_library();
  return filled_page(parts, json_text(all), head.title);
}

}  // namespace pose_wall::tools::report
