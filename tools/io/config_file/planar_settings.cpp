// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/planar_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

using StopMember = double pose_wall_planar_stop_settings::*;
using PlanarMember = std::variant<std::string PlanarSettings::*, double PlanarSettings::*, StopMember>;

struct PlanarKeyRow {
  OutsideKey info;
  PlanarMember member;
};

// From a frame's stamp to its answer. src/planar/stop/README.md has 0.04 s for a sensor at a busy machine.
constexpr double kFrameDelay_s = 0.05;
// By pose_wall_planar_stop.h dust is told from things in three frames at least.
constexpr double kFramesOfDust = 3.0;
// Sums of keys as a person adds them up.
constexpr double kRounding_s = 1e-9;

constexpr const char* kRoadwayGroup = translatable("Live: map of the roadway");
constexpr const char* kStopGroup = translatable("Live: obstacle stop, and the machine that it stops");

constexpr SettingRange<pose_wall_planar_stop_settings> kStopRanges[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_RANGE(pose_wall_planar_stop_settings, __VA_ARGS__)
#include "pose_wall_planar_stop_settings.def"
};

PlanarKeyRow stop_key(const char* name, StopMember member, const char* help) {
  return {key_of(kStopRanges, member, name, kStopGroup, help), member};
}

// The ranges lie within those of pose_wall_planar_stop.h, _scan.h and _map.h, also of what follows from the keys
// (stop_settings_of): delay_s from 0.1 to 2, slack_s up to 2.
const std::vector<PlanarKeyRow>& planar_key_rows() {
  static const std::vector<PlanarKeyRow> table = {
      {{"planar", kRoadwayGroup, OutsideKey::Type::kChoice, "", 0, 0, "off, map, localise",
        translatable("off: no map and no obstacle stop. map: a new map from the start on. localise: the place in the "
                     "map of planar_map. The obstacle stop works in both")},
       &PlanarSettings::mode},
      {{"planar_map", kRoadwayGroup, OutsideKey::Type::kText, "", 0, 0, "",
        translatable(
            "localise: the map that is read: the folder of `pose_wall map -o` or of planar: map, its trail.pwt, or "
            "map.yaml as Nav2 has it. map: where the map is saved, a name in .pwt; a file that is there "
            "already is kept")},
       &PlanarSettings::map},
      {{"planar_map_whole", kRoadwayGroup, OutsideKey::Type::kChoice, "", 0, 0, "no, yes",
        translatable(
            "localise: yes: the map holds every road where the machine can be, so a place between smooth walls "
            "counts as unique, too. no: unique needs relief of the rock")},
       &PlanarSettings::map_whole},
      {{"planar_cell", kRoadwayGroup, OutsideKey::Type::kNumber, "m", 0.02, 0.5, "",
        translatable("side of a cell of the map")},
       &PlanarSettings::cell_m},
      {{"planar_map_every_s", kRoadwayGroup, OutsideKey::Type::kNumber, "s", 1, 3600, "",
        translatable("shortest time between two maps that are published")},
       &PlanarSettings::map_every_s},
      {{"planar_tf", kRoadwayGroup, OutsideKey::Type::kChoice, "", 0, 0, "off, base, odom",
        translatable("transforms by ROS. base: from planar_map_frame to base_frame. odom: from planar_map_frame to "
                     "planar_odom_frame, and from there to base_frame by motion")},
       &PlanarSettings::tf},
      {{"planar_map_frame", kRoadwayGroup, OutsideKey::Type::kText, "", 0, 0, "",
        translatable("name of the map's frame")},
       &PlanarSettings::map_frame},
      {{"planar_odom_frame", kRoadwayGroup, OutsideKey::Type::kText, "", 0, 0, "",
        translatable("name of the frame in which motion counts, for planar_tf: odom")},
       &PlanarSettings::odom_frame},
      {{"planar_motion", kStopGroup, OutsideKey::Type::kChoice, "", 0, 0, "assumed, measured",
        translatable("motion that the stop reckons with. assumed: every motion within planar_speed_max and "
                     "planar_turn_max_deg. measured: that of the last frame, straight ahead while the machine stands")},
       &PlanarSettings::motion},
      {{"planar_x_min", kStopGroup, OutsideKey::Type::kNumber, "m", -5, -0.05, "",
        translatable("rectangle about all parts of the machine that can touch anything, in base: least x")},
       &PlanarSettings::x_min_m},
      {{"planar_x_max", kStopGroup, OutsideKey::Type::kNumber, "m", 0.05, 5, "", translatable("likewise: largest x")},
       &PlanarSettings::x_max_m},
      {{"planar_y_min", kStopGroup, OutsideKey::Type::kNumber, "m", -5, -0.05, "", translatable("likewise: least y")},
       &PlanarSettings::y_min_m},
      {{"planar_y_max", kStopGroup, OutsideKey::Type::kNumber, "m", 0.05, 5, "", translatable("likewise: largest y")},
       &PlanarSettings::y_max_m},
      stop_key("planar_floor_z", &pose_wall_planar_stop_settings::floor_z_m,
               translatable("height of the tracks' contact with the floor, in base")),
      {{"planar_height", kStopGroup, OutsideKey::Type::kNumber, "m", 1.4, 6, "",
        translatable("height of the machine above the floor, with clearance; higher things are no obstacle")},
       &PlanarSettings::height_m},
      {{"planar_clearance", kStopGroup, OutsideKey::Type::kNumber, "m", 0.2, 1.2, "",
        translatable("height of the body's lowest part above the floor; lower things are not in the map")},
       &PlanarSettings::clearance_m},
      stop_key("planar_speed_max", &pose_wall_planar_stop_settings::speed_max_m_s,
               translatable("largest speed of any point of the machine that is allowed")),
      {{"planar_turn_max_deg", kStopGroup, OutsideKey::Type::kNumber, "deg/s", 1, 110, "",
        translatable("fastest turn that is allowed")},
       &PlanarSettings::turn_max_deg_s},
      stop_key("planar_deceleration", &pose_wall_planar_stop_settings::deceleration_m_s2,
               translatable("least deceleration by the brakes")),
      stop_key("planar_acceleration", &pose_wall_planar_stop_settings::acceleration_m_s2,
               translatable("largest acceleration by the drive. By so much the motion may have changed since it was "
                            "measured")),
      stop_key(
          "planar_creep", &pose_wall_planar_stop_settings::creep_m_s,
          translatable("speed at which the machine may pass a thing that stands still, however near; 0: not at all")),
      {{"planar_latency", kStopGroup, OutsideKey::Type::kNumber, "s", 0, 1.4, "",
        translatable("from the stop's answer to the first effect of the brakes, the controller's cycle included")},
       &pose_wall_planar_stop_settings::latency_s},
      {{"planar_period", kStopGroup, OutsideKey::Type::kNumber, "s", 0.04, 0.5, "",
        translatable("longest time between two frames of the sensor. Much slower ones stop the machine")},
       &PlanarSettings::period_s},
      stop_key("planar_stale", &pose_wall_planar_stop_settings::stale_s,
               translatable(
                   "age of the newest frame at which the machine is stopped. At least planar_period and 0.05 s, its "
                   "own delay")),
      stop_key(
          "planar_scan_time", &pose_wall_planar_stop_settings::scan_s,
          translatable("so long before its stamp a frame began, at most planar_period; 0: all points at the stamp")),
  };
  return table;
}

const PlanarKeyRow* find_planar_row(const std::string& name) {
  for (const PlanarKeyRow& row : planar_key_rows()) {
    if (name == row.info.name) return &row;
  }
  return nullptr;
}

bool is_planar_choice(const OutsideKey& key, const std::string& value) {
  if (key.type != OutsideKey::Type::kChoice) return true;
  const std::vector<std::string> choices = choices_of(key);
  return std::find(choices.begin(), choices.end(), value) != choices.end();
}

// What the stop's times ask of the keys from which they follow.
std::string broken_time_rule(const PlanarSettings& settings) {
  const double stale_least_s = settings.period_s + kFrameDelay_s;
  if (settings.stop.stale_s < stale_least_s - kRounding_s) {
    return say(
        "planar_stale: {:g} s is too short for planar_period {:g} s: each frame would be stale before the next one; "
        "allowed: from {:g} s",
        settings.stop.stale_s, settings.period_s, stale_least_s);
  }
  if (settings.stop.scan_s > settings.period_s + kRounding_s) {
    return say("planar_scan_time: {:g} s is longer than planar_period, {:g} s: a frame lasts no longer than its period",
               settings.stop.scan_s, settings.period_s);
  }
  return "";
}

// What the stop refuses of all keys together. The range of a key keeps every other setting within the stop's own.
std::string broken_stop_rule(const PlanarSettings& settings) {
  const pose_wall_planar_stop_settings stop = stop_settings_of(settings);
  pose_wall_planar_fault fault{};
  if (pose_wall_planar_stop_settings_check(&stop, &fault) == POSE_WALL_OK) return "";
  if (std::string(fault.member) != "corner_m") return say("planar stop: {}", fault.rule);
  const bool is_behind = -settings.x_min_m > settings.x_max_m, is_right = -settings.y_min_m > settings.y_max_m;
  const double x_m = is_behind ? settings.x_min_m : settings.x_max_m;
  const double y_m = is_right ? settings.y_min_m : settings.y_max_m;
  return say("{} {:g} m and {} {:g} m: this corner of the machine is {:.2f} m from base; allowed: up to 5 m",
             is_behind ? "planar_x_min" : "planar_x_max", x_m, is_right ? "planar_y_min" : "planar_y_max", y_m,
             std::hypot(x_m, y_m));
}

// A row's number in the settings, which are const or not.
template <typename Settings>
auto& number_at(Settings* settings, const PlanarMember& member) {
  const auto of_stop = std::get_if<StopMember>(&member);
  return of_stop != nullptr ? settings->stop.**of_stop : settings->*std::get<double PlanarSettings::*>(member);
}

}  // namespace

pose_wall_planar_stop_settings default_stop_settings() {
  pose_wall_planar_stop_settings stop{};
  static_cast<void>(pose_wall_planar_stop_settings_init(&stop));
  return stop;
}

const std::vector<OutsideKey>& planar_keys() {
  static const std::vector<OutsideKey> keys = [] {
    std::vector<OutsideKey> infos;
    for (const PlanarKeyRow& row : planar_key_rows()) infos.push_back(row.info);
    return infos;
  }();
  return keys;
}

const OutsideKey* find_planar_key(const std::string& name) {
  const PlanarKeyRow* row = find_planar_row(name);
  return row != nullptr ? &row->info : nullptr;
}

std::string planar_value_text(const PlanarSettings& settings, const OutsideKey& key) {
  const PlanarMember member = find_planar_row(key.name)->member;
  if (const auto text = std::get_if<std::string PlanarSettings::*>(&member)) return settings.**text;
  return fmt::format("{:.9g}", number_at(&settings, member));
}

bool set_planar_value(PlanarSettings* settings, const OutsideKey& key, const std::string& value) {
  const PlanarMember member = find_planar_row(key.name)->member;
  if (const auto text = std::get_if<std::string PlanarSettings::*>(&member)) {
    if (!is_planar_choice(key, value)) return false;
    settings->** text = value;
    return true;
  }
  const std::optional<double> read = number_of(key, value);
  if (read) number_at(settings, member) = *read;
  return read.has_value();
}

pose_wall_planar_stop_settings stop_settings_of(const PlanarSettings& settings) {
  pose_wall_planar_stop_settings stop = settings.stop;
  static_cast<void>(
      pose_wall_planar_stop_rectangle(&stop, settings.x_min_m, settings.x_max_m, settings.y_min_m, settings.y_max_m));
  stop.top_m = settings.height_m;
  stop.turn_max_rad_s = settings.turn_max_deg_s * kRadPerDeg;
  stop.delay_s = kFramesOfDust * settings.period_s;
  stop.slack_s = settings.period_s + kFrameDelay_s + stop.latency_s;
  return stop;
}

pose_wall_planar_scanner_settings scanner_settings_of(const PlanarSettings& settings) {
  pose_wall_planar_scanner_settings scanner{};
  static_cast<void>(pose_wall_planar_scanner_settings_init(&scanner));
  scanner.machine_height_m = settings.height_m;
  scanner.ground_clearance_m = settings.clearance_m;
  return scanner;
}

std::string broken_planar_rule(const PlanarSettings& settings) {
  if (settings.mode == "localise" && settings.map.empty()) {
    return say("planar: localise needs planar_map, the file of a saved map");
  }
  const std::string ending = ".pwt";
  const bool is_trail = settings.map.size() > ending.size() &&
                        settings.map.compare(settings.map.size() - ending.size(), ending.size(), ending) == 0;
  if (settings.maps() && !settings.map.empty() && !is_trail) {
    return say("planar_map: with planar: map the name must end in .pwt");
  }
  if (settings.tf != "off" && (settings.map_frame.empty() || settings.odom_frame.empty())) {
    return say("planar_tf: {} needs names in planar_map_frame and planar_odom_frame", settings.tf);
  }
  if (settings.is_on()) {
    if (std::string rule = broken_time_rule(settings); !rule.empty()) return rule;
  }
  if (std::string rule = broken_stop_rule(settings); !rule.empty()) return rule;
  pose_wall_planar_fault fault{};
  const pose_wall_planar_scanner_settings scanner = scanner_settings_of(settings);
  if (pose_wall_planar_scanner_settings_check(&scanner, &fault) == POSE_WALL_OK) return "";
  return say("planar_height {:g} m, planar_clearance {:g} m are refused: {}", settings.height_m, settings.clearance_m,
             fault.rule);
}

}  // namespace pose_wall::tools
