// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/page/roadway_events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/live/planar/live_map.hpp"
#include "study/planar/indexed_png.hpp"
#include "study/planar/stop_reasons.hpp"
#include "study/report/columns.hpp"

namespace pose_wall::tools::live {
namespace {

using nlohmann::ordered_json;

// As pictures of `pose_wall map` have them: unknown, free, a thing. The first is the page's ground (live.css).
constexpr std::array<Rgb, 4> kShades = {{{222, 219, 212}, {255, 255, 255}, {34, 40, 46}, {255, 255, 255}}};
constexpr int kOccupied = 65, kFree = 35;  // per cent

std::uint8_t shade_of(std::int8_t cell) {
  if (cell >= kOccupied) return 2;
  return cell >= 0 && cell <= kFree ? 1 : 0;
}

// Cells of a picture's pixel, along each side.
std::uint32_t step_of(const RoadwayMap& map) {
  return (std::max(map.width, map.height) + kPictureMost - 1) / kPictureMost;
}

std::string event(const char* name, const std::string& data) {
  return fmt::format("event: {}\ndata: {}\n\n", name, data);
}

// No number is null; digits enough for the eye.
ordered_json number(double value, double digits = 1e3) {
  return std::isfinite(value) ? ordered_json(std::round(value * digits) / digits) : ordered_json(nullptr);
}

ordered_json place(const pose_wall_planar_pose& pose) {
  return {number(pose.x_m), number(pose.y_m), number(pose.yaw_rad, 1e4)};
}

}  // namespace

std::string stop_json(const StopNews& news, const StopLine& line) {
  const pose_wall_planar_stop_result& result = news.result;
  const bool has_frame = result.frames > 0;
  ordered_json json = {{"state", pose_wall_planar_stop_state_name(result.state)},
                       {"reasons", stop_reason_names(result.reasons)},
                       {"allowed_speed_m_s", number(result.allowed_speed_m_s)},
                       {"heartbeat", news.rounds}};
  json["age_ms"] = has_frame ? ordered_json((result.now_ns - result.stamp_ns) / 1'000'000) : ordered_json(nullptr);
  json["speed_m_s"] = has_frame ? number(result.speed_m_s) : ordered_json(nullptr);
  json["turn_rad_s"] = has_frame ? number(result.turn_rad_s, 1e4) : ordered_json(nullptr);
  const bool has_place = has_frame && std::isfinite(result.nearest_m[0]) && std::isfinite(result.nearest_m[1]);
  json["nearest_m"] =
      has_place ? ordered_json{number(result.nearest_m[0]), number(result.nearest_m[1])} : ordered_json(nullptr);
  json["nearest_distance_m"] = has_place ? number(result.nearest_distance_m) : ordered_json(nullptr);
  json["why"] = {{"en", line.text(Language::kEnglish, result, news.cause_for_s())},
                 {"zh", line.text(Language::kChinese, result, news.cause_for_s())}};
  return json.dump();
}

std::string roadway_json(const RoadwayNews& news) {
  ordered_json json = {{"state", news.state}, {"header_stamp_ns", news.header_stamp_ns}};
  json["pose"] = news.pose ? place(*news.pose) : ordered_json(nullptr);
  json["candidates"] = ordered_json::array();
  for (const pose_wall_planar_pose& candidate : news.candidates) json["candidates"].push_back(place(candidate));
  json["track"] = ordered_json::array();
  if (news.track) {
    for (const pose_wall_planar_pose& pose : *news.track) {
      json["track"].push_back({number(pose.x_m, 100.0), number(pose.y_m, 100.0)});
    }
  }
  json["map"] = news.map ? ordered_json(news.map->version) : ordered_json(nullptr);
  return json.dump();
}

std::string stop_event(const StopNews& news, const StopLine& line) {
  return event("stop", stop_json(news, line));
}

std::string roadway_event(const RoadwayNews& news) {
  return event("roadway", roadway_json(news));
}

std::string map_event(const RoadwayMap& map) {
  const double size_m = map.resolution_m * step_of(map);
  const auto pixels = [&](std::uint32_t cells) { return (cells + step_of(map) - 1) / step_of(map); };
  const ordered_json json = {{"version", map.version},
                             {"origin_m", {number(map.origin_x_m), number(map.origin_y_m)}},
                             {"size_m", {number(size_m * pixels(map.width)), number(size_m * pixels(map.height))}},
                             {"resolution_m", map.resolution_m},
                             {"png", "data:image/png;base64," + report::base64(map_png(map))}};
  return event("map", json.dump());
}

std::string map_png(const RoadwayMap& map) {
  const std::uint32_t step = step_of(map);
  const std::uint32_t width = (map.width + step - 1) / step, height = (map.height + step - 1) / step;
  std::vector<std::int8_t> cells(std::size_t{width} * height);
  coarsen_rows(map.cells.data(), map.width, map.height, step, cells.data());
  std::vector<std::uint8_t> pixels(cells.size());
  for (std::size_t row = 0; row < height; ++row) {
    const std::int8_t* const from = &cells[(height - 1 - row) * width];
    std::transform(from, from + width, &pixels[row * width], shade_of);
  }
  return indexed_png(width, height, pixels, kShades);
}

}  // namespace pose_wall::tools::live
