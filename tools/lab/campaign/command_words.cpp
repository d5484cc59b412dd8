// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/command_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "io/terminal/shell_word.hpp"

namespace pose_wall::tools::campaign {
namespace {

std::string names_or(const std::vector<std::string>& names, const char* otherwise) {
  return names.empty() ? otherwise : fmt::format("{}", fmt::join(names, ","));
}

std::string number_or(const std::optional<std::uint32_t>& number, const char* otherwise) {
  return number ? std::to_string(*number) : otherwise;
}

}  // namespace

std::string set_words(const std::vector<std::string>& settings) {
  std::string words;
  for (const std::string& setting : settings) words += " --set " + shell_word(setting);
  return words;
}

std::string engine_words(const EngineChoice& choice) {
  std::string words;
  if (!choice.config_file.empty()) words += " --config " + shell_word(choice.config_file);
  return words + set_words(choice.settings);
}

std::string verb_words(const PlanRequest& request) {
  return request.motion ? "pose_wall campaign --motion" : "pose_wall campaign";
}

std::string drive_in_words(double drive_in_m) {
  return drive_in_m > 0.0 ? fmt::format(" --drive-in {}", drive_in_m) : "";
}

std::string scans_words(Scans scans) {
  return scans == Scans::kTurning ? "" : fmt::format(" --scans {}", scans_name(scans));
}

std::string campaign_command(const PlanRequest& request, const EngineChoice& choice) {
  std::string words = fmt::format("{} --size {} --seed {}", verb_words(request), request.size, request.seed);
  if (request.kind != "all") words += " --kind " + request.kind;
  if (!request.scenes.empty()) words += fmt::format(" --scenes {}", fmt::join(request.scenes, ","));
  for (const std::string& file : request.surfaces) words += " --surface " + shell_word(file);
  if (!request.sensors.empty()) words += fmt::format(" --sensors {}", fmt::join(request.sensors, ","));
  if (request.draws) words += fmt::format(" --draws {}", *request.draws);
  if (request.frames) words += fmt::format(" --frames {}", *request.frames);
  words += drive_in_words(request.drive_in_m) + (request.motion ? "" : scans_words(request.scans));
  if (request.first_draw != 0) words += fmt::format(" --first-draw {}", request.first_draw);
  return words + engine_words(choice);
}

std::vector<std::pair<std::string, std::string>> request_words(const PlanRequest& request) {
  return {{"library", request.motion ? "motion" : "engine"},
          {"size", request.size},
          {"scenes", names_or(request.scenes, "all")},
          {"kind", request.kind},
          {"surfaces", names_or(request.surfaces, "none")},
          {"sensors", names_or(request.sensors, "those of the size")},
          {"draws", number_or(request.draws, "those of the size")},
          {"first draw", std::to_string(request.first_draw)},
          {"frames", number_or(request.frames, "those of size and scene")},
          {"seed", std::to_string(request.seed)},
          {"driven in", fmt::format("{} m", request.drive_in_m)},
          {"scans", scans_name(request.scans)}};
}

}  // namespace pose_wall::tools::campaign
