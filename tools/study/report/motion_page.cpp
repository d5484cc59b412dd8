// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/report/motion_page.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/json/json_words.hpp"
#include "pose_wall.h"
#include "study/motion/comparison_words.hpp"
#include "study/report/assets.hpp"
#include "study/report/columns.hpp"
#include "study/report/filled_page.hpp"

namespace pose_wall::tools::report {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

Json motion_words() {
  Json words;
  for (std::uint32_t bit = 0; bit < POSE_WALL_MOTION_REASON_COUNT; ++bit) {
    words["reason_texts"][pose_wall_motion_reason_name(bit)] = pose_wall_motion_reason_text(bit);
  }
  for (std::uint32_t d = 0; d < POSE_WALL_MOTION_DIRECTIONS; ++d) {
    words["directions"].push_back(pose_wall_motion_direction_name(d));
  }
  return words;
}

// Few of them differ: each is written once.
Json reasons_of(const MotionTable& table) {
  std::map<std::string, std::size_t> places;
  Json names = Json::array();
  Column<std::uint32_t> of_frame;
  for (const MotionRow& row : table.rows) {
    const auto [place, is_new] = places.emplace(row.reason, names.size());
    if (is_new) names.push_back(row.reason);
    of_frame.add(place->second);
  }
  return {{"names", names}, {"of_frame", of_frame.text()}};
}

// Travel since the last frame, by the poses of both; the table's own step says how far it may be off.
double step_along_m(const MotionRow* last, const MotionRow& row) {
  const bool have_both = last != nullptr && last->T_start_base && row.T_start_base;
  return have_both ? row.along_m - last->along_m : kNoValue;
}

Json frames_of(const MotionTable& table) {
  Column<double> stamp_s;
  Column<float> place, along, levels, step, step_level, ms;
  Column<std::uint32_t> frame;
  Column<std::uint8_t> state;
  Json sources = Json::array();
  const MotionRow* last = nullptr;
  for (const MotionRow& row : table.rows) {
    frame.add(row.frame);
    sources.push_back(row.source);
    stamp_s.add(static_cast<double>(row.stamp_ns) * 1e-9);
    state.add(row.along_state.value_or(POSE_WALL_ALONG_MEASURED + 1));
    for (Eigen::Index k = 0; k < 3; ++k) place.add(row.T_start_base ? row.T_start_base->translation()[k] : kNoValue);
    along.add(row.T_start_base ? row.along_m : kNoValue);
    for (const double level : row.level) levels.add(level);
    step.add(step_along_m(last, row));
    step_level.add(row.step_level[POSE_WALL_MOTION_ALONG]);
    ms.add(row.total_ms);
    last = &row;
  }
  return {{"frames", table.rows.size()},     {"source", sources},       {"frame", frame.text()},
          {"stamp_s", stamp_s.text()},       {"state", state.text()},   {"place", place.text()},
          {"along", along.text()},           {"levels", levels.text()}, {"step", step.text()},
          {"step_level", step_level.text()}, {"ms", ms.text()}};
}

Json truth_of(const MotionComparison& comparison) {
  Column<float> place;
  for (const std::optional<Eigen::Vector3d>& p : comparison.true_place_start_m) {
    for (Eigen::Index k = 0; k < 3; ++k) place.add(p ? (*p)[k] : kNoValue);
  }
  Json truth = motion_comparison_json(comparison);
  truth["place"] = place.text();
  return truth;
}

}  // namespace

std::string motion_page(const MotionPageHead& head, const MotionTable& table,
                        const std::optional<MotionComparison>& comparison) {
  Json all = frames_of(table);
  all["head"] = {
      {"title", head.title}, {"language", head.language}, {"truth", head.truth}, {"version", pose_wall_version()}};
  all["words"] = motion_words();
  all["reasons"] = reasons_of(table);
  all["truth"] = comparison ? truth_of(*comparison) : Json();
  return filled_page(motion_assets(), json_text(all), head.title);
}

}  // namespace pose_wall::tools::report
