// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/drive_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/csv/csv_table.hpp"
#include "io/language/language.hpp"
#include "io/terminal/text_table.hpp"
#include "study/planar/stop_reasons.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kShownAround_m = 8.0;  // of the map

// From when the stop held it, and for how long.
struct Stop {
  std::size_t first = 0;
  double lasts_s = 0.0;
};

// A stop begins where the machine was let go before. The first, at the start, is none.
std::vector<Stop> stops_of(const std::vector<DriveFrame>& frames) {
  std::vector<Stop> stops;
  bool is_open = false;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const bool is_stopped = frames[k].stop_state == POSE_WALL_PLANAR_STOP_STOP;
    const bool was_stopped = frames[k - 1].stop_state == POSE_WALL_PLANAR_STOP_STOP;
    if (is_stopped && !was_stopped) stops.push_back({k, 0.0});
    is_open = is_stopped && (is_open || !was_stopped);
    if (is_open) stops.back().lasts_s += kFrame_s;
  }
  return stops;
}

MapPlace place_of(const pose_wall_planar_pose& pose) {
  return {pose.x_m, pose.y_m};
}

void add_stops(const std::vector<DriveFrame>& frames, TextTable* table) {
  struct Sum {
    std::size_t count = 0;
    double lasts_s = 0.0;
  };
  std::map<std::string, Sum> by_reason;
  const std::vector<Stop> stops = stops_of(frames);
  for (const Stop& stop : stops) {
    Sum& sum = by_reason[stop_reasons_text(frames[stop.first].stop_reasons)];
    ++sum.count;
    sum.lasts_s += stop.lasts_s;
  }
  table->add_row({tr("stops"), std::to_string(stops.size())});
  for (const auto& [reason, sum] : by_reason) {
    table->add_row({"  " + reason, say("{} times, {:.1f} s", sum.count, sum.lasts_s)});
  }
}

double nearest_person_m(const std::vector<DriveFrame>& frames) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const DriveFrame& frame : frames) nearest_m = std::min(nearest_m, frame.nearest_m);
  return nearest_m;
}

std::string people_text(const DriveRun& drive) {
  const double nearest_m = nearest_person_m(drive.frames());
  return std::isfinite(nearest_m) ? say("{}, the nearest at {:.2f} m", drive.people().size(), nearest_m)
                                  : std::to_string(drive.people().size());
}

// By sim::loss_name.
std::string loss_words(const std::string& name) {
  if (name == "dark_wall") return tr("those of a wall");
  return name == "dropout" ? tr("most of them") : tr("all of them");
}

}  // namespace

std::string drive_as_csv(const std::vector<DriveFrame>& frames) {
  std::string csv = csv_line({"time_s",      "phase",       "true_x_m",  "true_y_m", "true_yaw_rad", "x_m",
                              "y_m",         "yaw_rad",     "place",     "sigma_m",  "stop",         "reasons",
                              "allowed_m_s", "limit_x_m",   "limit_y_m", "wish_m_s", "wish_rad_s",   "speed_m_s",
                              "turn_rad_s",  "off_route_m", "person_m",  "lost",     "contact"});
  for (const DriveFrame& row : frames) {
    csv += csv_line({csv_number(row.time_s),
                     pilot_phase_name(row.phase),
                     csv_number(row.truth.x_m),
                     csv_number(row.truth.y_m),
                     csv_number(row.truth.yaw_rad),
                     csv_number(row.believed.x_m),
                     csv_number(row.believed.y_m),
                     csv_number(row.believed.yaw_rad),
                     pose_wall_planar_localise_state_name(row.place_state),
                     csv_number(row.place_sigma_m),
                     pose_wall_planar_stop_state_name(row.stop_state),
                     fmt::format("{}", fmt::join(stop_reason_names(row.stop_reasons), " ")),
                     csv_number(row.allowed_m_s),
                     csv_number(row.limit_x_m),
                     csv_number(row.limit_y_m),
                     csv_number(row.wished.speed_m_s),
                     csv_number(row.wished.turn_rad_s),
                     csv_number(row.command.speed_m_s),
                     csv_number(row.command.turn_rad_s),
                     csv_number(row.off_route_m),
                     csv_number(row.nearest_m),
                     row.loss,
                     row.is_contact ? "1" : "0"});
  }
  return csv;
}

std::string drive_picture(const DriveRun& drive, const DriveEnd& end, const TaughtRoads& roads,
                          const std::string& title) {
  const std::vector<DriveFrame>& frames = drive.frames();
  MapScene scene;
  scene.grid = roads.map.grid();
  scene.title = title;
  scene.subtitle = say("{:.1f} m in {:.0f} s, {} stops, {} contacts", end.driven_m, end.time_s, stops_of(frames).size(),
                       end.contacts);
  scene.margin_m = kShownAround_m;
  draw_route(drive.first_route(), drive_plan_settings(scene.grid, kMargin_m), &scene);
  MapLine driven{{}, kTrailColour, 1.6};
  for (const DriveFrame& frame : frames) driven.places.push_back(place_of(frame.truth));
  scene.lines.push_back(driven);
  for (const std::vector<MapPlace>& way : drive.people_ways()) {
    scene.lines.push_back({way, kClosureColour, 1.6, "4 3"});
    scene.dots.push_back({way.back(), kClosureColour, ""});
  }
  for (const Stop& stop : stops_of(frames)) scene.dots.push_back({place_of(frames[stop.first].truth), kBadColour, ""});
  const std::vector<MapPlace> outline = machine_outline(drive_plan_settings(scene.grid, kMargin_m));
  scene.machines.push_back({frames.front().truth, outline, kTrailColour, tr("start")});
  scene.machines.push_back({frames.back().truth, outline, kPathColour, tr("end")});
  scene.machines.push_back({drive.goal(), {}, kPathColour, tr("goal")});
  scene.legend.push_back({kTrailColour, tr("driven")});
  scene.legend.push_back({kClosureColour, tr("people")});
  scene.legend.push_back({kBadColour, tr("stops")});
  return map_picture(scene);
}

std::string drive_table(const DriveRun& drive, const DriveEnd& end, const TaughtRoads& roads) {
  TextTable table({tr("drive"), ""});
  table.add_row(
      {tr("teaching drive"), say("{:.1f} m, {} scans, {} closures", roads.driven_m, roads.scans, roads.closures)});
  table.add_row({tr("map against the truth, worst"), fmt::format("{:.2f} m", roads.worst_m)});
  table.add_row({tr("place unique after the restart"),
                 end.unique_after_s > 0.0 ? say("{:.1f} s, {:.1f} m", end.unique_after_s, end.crept_m) : tr("never")});
  table.add_row({tr("driven"), say("{:.1f} m in {:.0f} s", end.driven_m, end.time_s)});
  table.add_row({tr("routes"), std::to_string(end.plans)});
  table.add_row({tr("position error, mean"), fmt::format("{:.3f} m", end.error_mean_m)});
  table.add_row({tr("position error, worst"), fmt::format("{:.3f} m", end.error_worst_m)});
  table.add_row({tr("frames unique and wrong"), std::to_string(end.wrong_places)});
  table.add_row({tr("off the route, worst"), fmt::format("{:.3f} m", end.off_route_worst_m)});
  table.add_row({tr("floors that the engine did not measure"), say("{} of {}", end.own_planes, end.floors)});
  table.add_row({tr("people"), people_text(drive)});
  table.add_row(
      {tr("returns lost"), end.loss.empty() ? tr("none") : say("{}, {:.1f} s", loss_words(end.loss), end.loss_s)});
  add_stops(drive.frames(), &table);
  table.add_row({tr("contacts"), std::to_string(end.contacts)});
  table.add_row({tr("goal"), end.has_arrived ? tr("reached") : tr("not reached")});
  return table.text();
}

}  // namespace pose_wall::tools
