// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/manifest.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "io/config_file/key_table.hpp"
#include "io/config_file/load_config.hpp"
#include "io/frames/whole_file.hpp"
#include "io/json/json_words.hpp"
#include "io/terminal/counted.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace pose_wall::tools::campaign {
namespace {

// Every key that is not at its default, whichever file or option it came from.
std::string settings_text(const LoadedConfig& loaded) {
  const api::Config defaults;
  std::string text;
  for (const pose_wall_key_info& key : config_keys()) {
    const std::string value = config_value_text(*loaded.config.get(), key);
    if (value != config_value_text(*defaults.get(), key)) text += fmt::format("{}={} ", key.name, value);
  }
  for (const OutsideKey& key : motion_keys()) {
    const std::string value = motion_value_text(loaded.motion, key);
    if (value != motion_value_text(default_motion_settings(), key)) text += fmt::format("{}={} ", key.name, value);
  }
  return text.empty() ? "defaults" : text.substr(0, text.size() - 1);
}

bool moves(const api::Config& config) {
  char motion[POSE_WALL_TEXT_MAX] = {};
  pose_wall_config_get_text(config.get(), "motion", motion, sizeof(motion));
  return std::string(motion) == "on";
}

// Of all runs, drawn sizes included by way of the program that draws them.
std::string runs_text(const std::vector<Run>& runs) {
  std::string text;
  for (const Run& run : runs) {
    text += fmt::format("{} {} {} {} {} {}{}\n", run.scene, run.sensor, run.draw, run.seed, run.frames, run.drive_in_m,
                        set_words(run.settings));
  }
  return fmt::format("{}, {}, {}", counted(runs.size(), "run"), counted(frames_of(runs), "frame"),
                     fingerprint_text(fingerprint(text)));
}

// Null stands for what was not asked for.
Json number_page(const std::optional<std::uint32_t>& number) {
  return number ? Json(*number) : Json();
}

std::optional<std::uint32_t> number_from(const Json& page) {
  return page.is_null() ? std::nullopt : std::optional(page.get<std::uint32_t>());
}

Json plan_page(const PlanRequest& plan) {
  return {{"motion", plan.motion},
          {"size", plan.size},
          {"scenes", plan.scenes},
          {"kind", plan.kind},
          {"surfaces", plan.surfaces},
          {"sensors", plan.sensors},
          {"draws", number_page(plan.draws)},
          {"first_draw", plan.first_draw},
          {"frames", number_page(plan.frames)},
          {"seed", plan.seed},
          {"drive_in_m", plan.drive_in_m},
          {"scans", scans_name(plan.scans)}};
}

PlanRequest plan_from(const Json& page) {
  PlanRequest plan;
  plan.motion = page.at("motion");
  plan.size = page.at("size");
  page.at("scenes").get_to(plan.scenes);
  plan.kind = page.at("kind");
  plan.surfaces = page.value("surfaces", std::vector<std::string>{});
  page.at("sensors").get_to(plan.sensors);
  plan.draws = number_from(page.at("draws"));
  plan.first_draw = page.at("first_draw");
  plan.frames = number_from(page.at("frames"));
  plan.seed = page.at("seed");
  plan.drive_in_m = page.value("drive_in_m", 0.0);
  plan.scans = scans_named(page.value("scans", scans_name(Scans::kInstant)));  // what older versions did
  return plan;
}

std::string plan_difference(const Manifest& first, const Manifest& second, const Holders& holders) {
  const auto before = request_words(first.plan);
  const auto after = request_words(second.plan);
  std::string lines;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i].second == after[i].second) continue;
    lines += fmt::format("  {}: {} {}, {} {}\n", after[i].first, holders.first, before[i].second, holders.second,
                         after[i].second);
  }
  if (!lines.empty()) return lines;
  return fmt::format("  plan: {} {} with {}, {} {} with {}, of the same words\n", holders.first,
                     counted(first.runs, "run"), counted(first.frames, "frame"), holders.second,
                     counted(second.runs, "run"), counted(second.frames, "frame"));
}

std::string part_words(const Manifest& manifest) {
  return manifest.part ? "part " + part_text(*manifest.part) : "all runs";
}

// Null stands for all runs.
Json part_page(const Manifest& manifest) {
  if (!manifest.part) return {};
  return {{"number", manifest.part->number}, {"of", manifest.part->of}, {"runs", manifest.part_runs}};
}

void take_part(const Json& page, Manifest* manifest) {
  if (page.is_null()) return;
  manifest->part = Part{page.at("number"), page.at("of")};
  manifest->part_runs = page.at("runs");
}

std::filesystem::path file_in(const std::filesystem::path& folder) {
  return folder / "campaign.json";
}

}  // namespace

std::string Manifest::fingerprint() const {
  std::string text;
  for (const auto& [name, value] : identity) text += fmt::format("{}: {}\n", name, value);
  return fingerprint_text(campaign::fingerprint(text));
}

Manifest make_manifest(const PlanRequest& request, const std::vector<Run>& runs, const EngineChoice& choice) {
  const LoadedConfig loaded = load_config(choice.config_file, choice.settings);
  Manifest manifest;
  manifest.identity = {{"version", pose_wall_version()},
                       {"program", program_fingerprint()},
                       {"settings", settings_text(loaded)},
                       {"plan", runs_text(runs)}};
  for (const std::string& file : request.surfaces) {
    manifest.identity.emplace_back("surface " + file, fingerprint_text(campaign::fingerprint(read_whole_file(file))));
  }
  manifest.limits = alert_limits_of(loaded.config);
  manifest.runs = runs.size();
  manifest.frames = frames_of(runs);
  manifest.plan = request;
  manifest.engine = choice;
  manifest.motion_is_on = moves(loaded.config);
  return manifest;
}

std::string identity_difference(const Manifest& first, const Manifest& second, const Holders& holders) {
  std::string lines;
  for (const auto& [name, value] : second.identity) {
    for (const auto& [old_name, old_value] : first.identity) {
      if (name != old_name || value == old_value) continue;
      if (name == "plan") {
        lines += plan_difference(first, second, holders);
      } else if (name == "program") {
        lines += "  program: another build of pose_wall made the records\n";
      } else {
        lines += fmt::format("  {}: {} '{}', {} '{}'\n", name, holders.first, old_value, holders.second, value);
      }
    }
  }
  if (lines.empty() && first.fingerprint() != second.fingerprint()) lines = "  the records are of another kind\n";
  return lines;
}

std::string difference(const Manifest& records, const Manifest& now) {
  const Holders holders;
  std::string lines = identity_difference(records, now, holders);
  const std::string before = part_words(records), after = part_words(now);
  if (before != after) {
    lines += fmt::format("  part: {} {}, {} {}\n", holders.first, before, holders.second, after);
  }
  return lines;
}

void write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  Json page;
  for (const auto& [name, value] : manifest.identity) page["identity"][name] = value;
  page["alert_limit_angle_rad"] = manifest.limits.angle_rad;
  page["alert_limit_distance_m"] = manifest.limits.distance_m;
  page["runs"] = manifest.runs;
  page["frames"] = manifest.frames;
  page["request"] = plan_page(manifest.plan);
  page["part"] = part_page(manifest);
  page["engine"] = {{"config", manifest.engine.config_file},
                    {"set", manifest.engine.settings},
                    {"motion", manifest.motion_is_on ? "on" : "off"}};
  page["command"] = manifest.command();
  write_whole_file(file_in(folder), page.dump(2) + "\n");
}

bool holds_campaign(const std::filesystem::path& folder) {
  std::ifstream in(file_in(folder));
  const auto page = nlohmann::json::parse(in, nullptr, false);
  return page.is_object() && page.contains("identity") && page["identity"].contains("program");
}

Manifest read_manifest(const std::filesystem::path& folder) {
  std::ifstream in(file_in(folder));
  if (!in)
    throw std::runtime_error(
        fmt::format("{}: cannot be read; no campaign was run there. Another folder is needed, or this one "
                    "without its records",
                    file_in(folder).string()));
  try {
    const auto page = Json::parse(in);
    Manifest manifest;
    for (const auto& [name, value] : page.at("identity").items()) manifest.identity.emplace_back(name, value);
    manifest.limits = {page.at("alert_limit_angle_rad"), page.at("alert_limit_distance_m")};
    manifest.runs = page.at("runs");
    manifest.frames = page.at("frames");
    manifest.plan = plan_from(page.at("request"));
    take_part(page.value("part", Json()), &manifest);
    manifest.engine.config_file = page.at("engine").at("config");
    page.at("engine").at("set").get_to(manifest.engine.settings);
    manifest.motion_is_on = page.at("engine").value("motion", "on") == "on";
    return manifest;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("{}: not as this version writes it ({}); another folder is needed, or --fresh",
                                         file_in(folder).string(), error.what()));
  }
}

}  // namespace pose_wall::tools::campaign
