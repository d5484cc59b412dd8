// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/map_fit.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "io/frames/whole_file.hpp"
#include "io/json/json_words.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kFitFile = "map.json";
// People and dust spoil a scan in ten of a good map. Where most scans fit badly, the others stand on these.
constexpr double kDoubtfulFit = 0.1, kBadFit = 0.5;

}  // namespace

MapGrade MapFit::grade() const {
  const auto off = static_cast<double>(badly + blind), all = static_cast<double>(scans);
  if (off > kBadFit * all) return MapGrade::kNotUsable;
  return off > kDoubtfulFit * all ? MapGrade::kDoubtful : MapGrade::kGood;
}

std::string MapFit::verdict() const {
  const std::string bad = part_of_scans(badly, scans), few = part_of_scans(blind, scans);
  if (grade() == MapGrade::kGood)
    return say("the scans fit: of {}, {} fit badly and {} show too little", scans, bad, few);
  if (grade() == MapGrade::kDoubtful) {
    return say("doubtful: of {} scans, {} fit badly and {} show too little. Places of the map may be off", scans, bad,
               few);
  }
  return say("not usable: of {} scans, {} fit badly and {} show too little. No place of the map is known", scans, bad,
             few);
}

MapFit fit_of(const ScanTrail& trail) {
  MapFit fit;
  fit.scans = trail.scans().size();
  fit.badly = trail.count(POSE_WALL_PLANAR_SLAM_DOUBTFUL);
  fit.blind = trail.count(POSE_WALL_PLANAR_SLAM_BLIND);
  const std::size_t trails = trail.count(POSE_WALL_PLANAR_SLAM_FIRST);
  fit.new_trails = trails > 1 ? trails - 1 : 0;
  return fit;
}

std::string part_of_scans(std::size_t part, std::size_t scans) {
  return fmt::format("{} ({:.1f} %)", part,
                     scans > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(scans) : 0.0);
}

void write_fit(const std::filesystem::path& folder, const MapFit& fit) {
  const Json json = {{"scans", fit.scans},
                     {"scans_that_fit_badly", fit.badly},
                     {"scans_with_too_few_points", fit.blind},
                     {"new_trails", fit.new_trails}};
  write_whole_file(folder / kFitFile, json_text(json, 1) + "\n");
}

std::optional<MapFit> read_fit(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder / kFitFile, ignored)) return std::nullopt;
  const Json json = Json::parse(read_whole_file(folder / kFitFile), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  MapFit fit;
  const std::pair<const char*, std::size_t*> members[] = {{"scans", &fit.scans},
                                                          {"scans_that_fit_badly", &fit.badly},
                                                          {"scans_with_too_few_points", &fit.blind},
                                                          {"new_trails", &fit.new_trails}};
  for (const auto& [name, member] : members) {
    const auto found = json.find(name);
    if (found == json.end() || !found->is_number_unsigned()) return std::nullopt;
    *member = found->get<std::size_t>();
  }
  return fit;
}

}  // namespace pose_wall::tools
