// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/comparison_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/language/language.hpp"
#include "io/terminal/text_table.hpp"
#include "study/motion/directions.hpp"
#include "study/motion/motion_rows.hpp"

namespace pose_wall::tools {
namespace {

// The way of a standing machine is too short for a share of it.
constexpr double kWayMin_m = 0.1;

constexpr std::size_t kUnreadableState = POSE_WALL_ALONG_MEASURED + 1;

std::string along_state_words(std::size_t state) {
  return state == kUnreadableState ? kUnreadableFrame
                                   : pose_wall_motion_along_state_name(static_cast<std::uint32_t>(state));
}

// Names that people read; those of tables and JSON have no language.
constexpr const char* kShownStates[] = {translatable("lost"), translatable("unobservable"), translatable("ambiguous"),
                                        translatable("measured"), translatable("unreadable")};
constexpr const char* kShownDirections[] = {translatable("along"), translatable("across"), translatable("up"),
                                            translatable("roll"),  translatable("pitch"),  translatable("yaw")};

const char* shown_state(std::size_t state) {
  return tr(kShownStates[state]);
}

const char* shown_direction(std::uint32_t direction) {
  return tr(kShownDirections[direction]);
}

std::string share_of(double part, double whole) {
  return std::isfinite(part) && whole > 0.0 ? fmt::format("{:.3f} %", 100.0 * part / whole) : "-";
}

std::string share_of_way(const MotionComparison& c, double error_m) {
  return c.way_m >= kWayMin_m ? share_of(error_m, c.way_m) : "-";
}

std::string z2_words(double mean_z2) {
  return std::isfinite(mean_z2) ? fmt::format("{:.2f}", mean_z2) : "-";
}

std::string head_text(const MotionComparison& c) {
  return say(
      "{} frames matched by {}; without partner: {} results, {} truth rows\n"
      "Poses laid exactly on the truth at frame {}; along: {}\n"
      "way: {:.3f} m of true path up to frame {}; along the road {:+.3f} m, measured {:+.3f} m\n",
      c.matched, c.matched_by, c.table_rows_alone, c.truth_rows_alone, c.first_frame,
      c.along_is_road ? tr("the road's X") : tr("from there to the furthest place"), c.way_m, c.last_frame,
      c.true_along_m, c.measured_along_m);
}

std::string states_text(const MotionComparison& c) {
  std::string text = tr("states along the road:");
  const char* between = " ";
  for (const std::size_t state : {3U, 2U, 1U, 0U, 4U}) {
    if (state == kUnreadableState && c.states[state] == 0) continue;
    text += between + std::string(shown_state(state)) + " " +
            share_of(static_cast<double>(c.states[state]), static_cast<double>(c.matched));
    between = ", ";
  }
  return text + "\n";
}

std::string travel_text(const MotionComparison& c) {
  TextTable table({tr("error"), tr("at the end"), tr("of the way"), tr("largest"), tr("of the way"), tr("at frame")});
  for (std::uint32_t d = 0; d < c.travel.size(); ++d) {
    const TravelError& e = c.travel[d];
    table.add_row({shown_direction(d), fmt::format("{:+.4f} m", e.at_end), share_of_way(c, e.at_end),
                   direction_amount(d, e.largest), share_of_way(c, e.largest), std::to_string(e.largest_at_frame)});
  }
  table.add_row({tr("turn"), direction_amount(POSE_WALL_MOTION_YAW, c.turn.at_end), "",
                 direction_amount(POSE_WALL_MOTION_YAW, c.turn.largest), "", std::to_string(c.turn.largest_at_frame)});
  return table.text();
}

std::string drift_text(const MotionComparison& c) {
  if (c.drift.count == 0) return say("drift over {:.0f} m: the way is shorter\n", kSegment_m);
  return say("drift over {:.0f} m, from every frame on: mean {}, worst {} (from frame {}), {} segments\n", kSegment_m,
             share_of(c.drift.mean, 1.0), share_of(c.drift.worst, 1.0), c.drift.worst_from_frame, c.drift.count);
}

std::string directions_text(const char* what,
                            const std::array<DirectionErrors, POSE_WALL_MOTION_DIRECTIONS>& directions) {
  TextTable table({what, tr("frames"), tr("RMSE"), tr("max error"), tr("mean z²"), tr("> level")});
  for (std::uint32_t d = 0; d < directions.size(); ++d) {
    const DirectionErrors& e = directions[d];
    table.add_row({shown_direction(d), std::to_string(e.count()), direction_amount(d, e.rmse()),
                   direction_amount(d, e.largest()), z2_words(e.mean_z2()), std::to_string(e.beyond())});
  }
  return table.text();
}

Json travel_json(const TravelError& error) {
  return {{"at_end", error.at_end}, {"largest", error.largest}, {"largest_at_frame", error.largest_at_frame}};
}

Json directions_json(const std::array<DirectionErrors, POSE_WALL_MOTION_DIRECTIONS>& directions) {
  Json json;
  for (std::uint32_t d = 0; d < directions.size(); ++d) {
    const DirectionErrors& e = directions[d];
    json[pose_wall_motion_direction_name(d)] = {{"count", e.count()},
                                                {"rmse", e.rmse()},
                                                {"absolute_max", e.largest()},
                                                {"mean_z2", e.mean_z2()},
                                                {"beyond", e.beyond()}};
  }
  return json;
}

Json misleading_json(const Misleading& misleading) {
  return {{"measured", misleading.measured}, {"misleading", misleading.misleading}};
}

}  // namespace

std::string motion_comparison_text(const MotionComparison& c) {
  return head_text(c) + states_text(c) + '\n' + travel_text(c) + drift_text(c) + '\n' +
         directions_text(tr("pose"), c.pose) + '\n' + directions_text(tr("step"), c.step) +
         say("\nmisleading (measured, but with an error along the road above the level): {} of {} poses, {} of {} "
             "steps\n",
             c.misleading_poses.misleading, c.misleading_poses.measured, c.misleading_steps.misleading,
             c.misleading_steps.measured);
}

Json motion_comparison_json(const MotionComparison& c) {
  Json states;
  for (std::size_t state = 0; state < c.states.size(); ++state) states[along_state_words(state)] = c.states[state];
  return {{"matched", c.matched},
          {"matched_by", c.matched_by},
          {"other_stamps", c.other_stamps},
          {"result_rows_alone", c.table_rows_alone},
          {"truth_rows_alone", c.truth_rows_alone},
          {"along", c.along_is_road ? "road" : "way"},
          {"first_frame", c.first_frame},
          {"last_frame", c.last_frame},
          {"states", states},
          {"way_m", c.way_m},
          {"true_along_m", c.true_along_m},
          {"measured_along_m", c.measured_along_m},
          {"error",
           {{"along_m", travel_json(c.travel[0])},
            {"across_m", travel_json(c.travel[1])},
            {"up_m", travel_json(c.travel[2])},
            {"turn_rad", travel_json(c.turn)}}},
          {"drift",
           {{"segment_m", kSegment_m},
            {"segments", c.drift.count},
            {"mean", c.drift.mean},
            {"worst", c.drift.worst},
            {"worst_from_frame", c.drift.worst_from_frame}}},
          {"pose", directions_json(c.pose)},
          {"step", directions_json(c.step)},
          {"misleading_poses", misleading_json(c.misleading_poses)},
          {"misleading_steps", misleading_json(c.misleading_steps)}};
}

}  // namespace pose_wall::tools
