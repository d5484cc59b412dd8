// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/result_json.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "io/json/json_words.hpp"
#include "io/numbers/quantities.hpp"
#include "study/results/result_csv.hpp"
#include "study/steer/steering.hpp"

namespace pose_wall::tools {
namespace {

Json text_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json value_json(std::uint32_t quantity, const pose_wall_result& r) {
  const pose_wall_value v = written_value(r.quantity[quantity]);
  const std::string unit = is_angle(quantity) ? "_rad" : "_m";
  return {{"value" + unit, v.value},
          {"raw" + unit, v.raw},
          {"sigma" + unit, v.sigma},
          {"protection_level" + unit, v.protection_level},
          {"protection_level_parts" + unit, parts_json(v)},
          {"cause", text_or_null(cause_name(v))},
          {"raw_protection_level" + unit, v.raw_protection_level},
          {"raw_state", pose_wall_state_name(v.raw_state)},
          {"positive_means", text_or_null(positive_means(r, quantity))},
          {"state", pose_wall_state_name(v.state)},
          {"reasons", reason_list(v.reasons)},
          {"confidence", v.confidence},
          {"age_s", v.age_s}};
}

Json values_json(const pose_wall_result& r) {
  Json values;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    values[pose_wall_quantity_name(q)] = value_json(q, r);
  }
  return values;
}

Json plane_json(const pose_wall_plane& p) {
  const auto if_found = [&p](Json value) { return p.found != 0 ? std::move(value) : Json(); };
  return {{"found", p.found != 0},
          {"distance_m", if_found(p.d_m)},
          {"rms_m", if_found(p.rms_m)},
          {"inliers", if_found(p.inliers)},
          {"iterations", if_found(p.iterations)},
          {"extent_min_m", if_found(p.extent_min_m)},
          {"extent_max_m", if_found(p.extent_max_m)},
          {"lean_rad", if_found(p.lean_rad)},
          {"reasons", reason_list(p.reasons)}};
}

Json points_json(const pose_wall_result& r) {
  return {{"in", r.points_in},
          {"dropped_not_finite", r.dropped_not_finite},
          {"dropped_zero", r.dropped_zero},
          {"dropped_near", r.dropped_near},
          {"dropped_far", r.dropped_far},
          {"dropped_body", r.dropped_body},
          {"voxels", r.voxels},
          {"outliers", r.outliers},
          {"open_points", r.open_points},
          {"wall_points", r.wall_points}};
}

Json times_json(const FrameOutcome& outcome) {
  Json stages;
  if (outcome.result) {
    for (std::uint32_t stage = 0; stage < POSE_WALL_STAGES; ++stage) {
      stages[pose_wall_stage_name(stage)] = 1e-6 * static_cast<double>(outcome.result->stage_ns[stage]);
    }
  }
  const auto if_read = [&outcome](double ms) { return outcome.result ? Json(ms) : Json(); };
  return {{"load", if_read(outcome.load_ms)},
          {"engine", if_read(outcome.total_ms)},
          {"engine_processor", if_read(outcome.processor_ms)},
          {"stages", stages}};
}

// The members that only a frame has that could be read.
void add_result(Json& line, const pose_wall_result& r, const AlertLimits& limits) {
  const Steering steering = steering_of(r, limits);
  line["steer_line"] = steer_line_json(steering);
  line["steer"] = steer_json(steering);
  line["status"] = pose_wall_state_name(worst_state(r));
  line["reasons"] = reason_list(all_reasons(r));
  line["frame_reasons"] = reason_list(r.frame_reasons);
  line["confidence"] = r.confidence;
  line["values"] = values_json(r);
  line["left_right_yaw_difference_rad"] = r.left_right_yaw_difference_rad;
  line["planes"] = {
      {"floor", plane_json(r.floor)}, {"left_wall", plane_json(r.left)}, {"right_wall", plane_json(r.right)}};
  line["points"] = points_json(r);
  line["voxel_leaf_m"] = r.voxel_leaf_m;
  line["work"] = r.work;
  line["publication"] = r.publication;
  line["source_id"] = r.source_id;
  line["config_crc32"] = r.config_crc32;
}

}  // namespace

Json result_as_json(const FrameOutcome& outcome) {
  Json line = {{"schema", kResultJsonSchema},
               {"frame", outcome.frame},
               {"source", outcome.source},
               {"stamp_ns", outcome.stamp_ns},
               {"status", "unreadable"},
               {"error", outcome.result ? Json() : Json(outcome.error)},
               {"reasons", Json::array({"unreadable"})}};
  for (const char* name :
       {"steer_line", "steer", "frame_reasons", "confidence", "values", "left_right_yaw_difference_rad", "planes",
        "points", "voxel_leaf_m", "work", "publication", "source_id", "config_crc32"}) {
    line[name] = nullptr;
  }
  if (outcome.result) add_result(line, *outcome.result, outcome.limits);
  line["times_ms"] = times_json(outcome);
  return line;
}

std::string result_json_line(const FrameOutcome& outcome) {
  return json_text(result_as_json(outcome)) + '\n';
}

}  // namespace pose_wall::tools
