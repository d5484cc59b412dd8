// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/motion_classes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "lab/sim/parameters.hpp"

namespace pose_wall::tools::campaign {
namespace {

using Values = std::vector<sim::SceneValue>;

constexpr double kNotAsked = std::numeric_limits<double>::quiet_NaN();
// "Across and up <= 1 cm, turn <= 0.1 degrees while floor and walls are seen": what the library promises.
constexpr double kAcross_m = 0.01;
constexpr double kTurn_deg = 0.1;
// Of the way along: a hand's breadth in ten metres is not asked of a run of a few metres.
constexpr double kAlong_m = 0.01;
constexpr double kMostFrames = 0.95;

MotionLimits measured_within(double along_share, double along_share_few) {
  return {kMostFrames, kNotAsked, kNotAsked, along_share, along_share_few, kAlong_m, kAcross_m, kTurn_deg};
}

// Some frames may tell nothing of the way along; those that are measured must be right.
MotionLimits measured_mostly(double measured_min, double along_share) {
  return {measured_min, kNotAsked, kNotAsked, along_share, along_share, kAlong_m, kAcross_m, kTurn_deg};
}

MotionLimits stays_within(double along_m) {
  return {kMostFrames, kNotAsked, kNotAsked, 0.0, 0.0, along_m, kAcross_m, kTurn_deg};
}

MotionLimits honest() {
  return {kNotAsked, kNotAsked, kNotAsked, kNotAsked, kNotAsked, kNotAsked, kAcross_m, kTurn_deg};
}

// One of several places that fit alike, and the level covers them.
MotionLimits told() {
  MotionLimits limits = honest();
  limits.told_min = kMostFrames;
  return limits;
}

// Nothing tells the way along: measured is wrong.
MotionLimits unobservable() {
  return {kNotAsked, kNotAsked, 0.99, kNotAsked, kNotAsked, kNotAsked, kAcross_m, kTurn_deg};
}

// Across and turn cannot be told there from the way along.
MotionLimits unobservable_in_a_curve() {
  return {kNotAsked, kNotAsked, 0.99, kNotAsked, kNotAsked, kNotAsked, kNotAsked, kNotAsked};
}

// In the ranges of the scenes the machine turns by up to 1 degree a second: in a minute it would stand across the road.
Values at_speed(double low_m_s, double high_m_s) {
  return {{"speed_mps", "0.8", low_m_s, high_m_s}, {"turn_rate_dps", "0", -0.05, 0.05},
          {"turned_left_deg", "0", -5.0, 5.0},     {"drift_mps", "0", -0.003, 0.003},
          {"lateral_m", "0", -0.3, 0.3},           {"rock_repeats", "no", 0.0, 0.0}};
}

// Where a class is about something else than weak rock: relief that stands well above any sensor's noise.
Values plain_rock() {
  return {{"roughness_m", "0.05", 0.03, 0.08}, {"roughness_length_m", "0.5", 0.2, 1.0}};
}

Values driving() {
  return at_speed(0.3, 1.5);
}

Values at_rest() {
  return {{"speed_mps", "0", 0.0, 0.0},
          {"turn_rate_dps", "0", 0.0, 0.0},
          {"drift_mps", "0", 0.0, 0.0},
          {"rock_repeats", "no", 0.0, 0.0}};
}

Values still() {
  Values values = at_rest();
  values.insert(values.end(), {{"sway_roll_deg", "0", 0.0, 0.0}, {"sway_pitch_deg", "0", 0.0, 0.0}});
  return values;
}

Values operator+(Values values, const Values& more) {
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

Values people() {
  return {{"width_m", "5.5", 4.8, 6.5},    {"people_side", "both", 1.0, 3.0},
          {"people_count", "4", 2.0, 6.0}, {"people_from_m", "-5", -6.0, -3.0},
          {"people_to_m", "5", 3.0, 6.0},  {"people_standoff_m", "0.6", 0.4, 0.9}};
}

Values sets() {
  return {
      {"steel_pitch_m", "0.8", 0.5, 1.2}, {"steel_depth_m", "0.12", 0.08, 0.18}, {"steel_width_m", "0.12", 0.08, 0.15}};
}

// Wider and higher than a road and closed at both ends, beyond where the machine gets. Its walls are nearly smooth.
Values hall() {
  return {{"width_m", "22", 14.0, 32.0},         {"height_m", "6", 4.0, 9.0},
          {"face_distance_m", "32", 28.0, 44.0}, {"rear_distance_m", "10", 6.0, 25.0},
          {"roughness_m", "0.004", 0.002, 0.01}, {"floor_roughness_m", "0.004", 0.002, 0.01},
          {"lateral_m", "0", -4.0, 4.0},         {"rock_repeats", "no", 0.0, 0.0}};
}

// Pillars, a vehicle, boulders: what stands free is no witness, and hides what is.
Values furniture() {
  return {{"prop_side", "both", 0.0, 3.0},      {"prop_pitch_m", "6", 4.0, 9.0},
          {"prop_radius_m", "0.25", 0.15, 0.4}, {"prop_standoff_m", "3", 2.0, 5.0},
          {"vehicle_side", "left", 0.0, 2.0},   {"vehicle_at_m", "6", -4.0, 14.0},
          {"clutter_count", "8", 0.0, 20.0},    {"vehicle_standoff_m", "1", 0.5, 3.0}};
}

// Half a metre and up to 30 degrees from one frame to the next.
Values carried() {
  return {{"rate_hz", "2", 2.0, 2.0},
          {"turn_rate_dps", "20", 5.0, 60.0, true},
          {"sway_roll_deg", "6", 0.0, 8.0},
          {"sway_pitch_deg", "4", 0.0, 6.0},
          {"sway_period_s", "4", 3.0, 8.0}};
}

const std::vector<MotionLink> kPeopleWalkAlong = {{"people_speed_mps", "speed_mps", 1.0}};

constexpr double kLong_s = 600.0, kCut_s = 120.0, kTurn_s = 36.0, kHall_s = 24.0;

std::vector<MotionClass> driven_classes() {  // NOLINT(readability-function-size): a table
  return {
      {"rough",
       "rough",
       "drives along rough rock, 2 to 8 cm",
       "measured; 0.5 % of the way",
       MotionLength::kWay,
       0.0,
       true,
       measured_within(0.005, 0.01),
       driving() + Values{{"roughness_m", "0.05", 0.02, 0.08}, {"roughness_length_m", "0.5", 0.1, 1.0}},
       {}},
      {"faint",
       "rough",
       "drives along rock of 5 to 20 mm, which a sensor's noise may hide",
       "measured or unobservable; the level holds",
       MotionLength::kWay,
       0.0,
       false,
       honest(),
       driving() + Values{{"roughness_m", "0.01", 0.005, 0.02}},
       {}},
      {"shotcrete",
       "shotcrete",
       "drives along shotcrete",
       "measured; 0.5 % of the way",
       MotionLength::kWay,
       0.0,
       true,
       measured_within(0.005, 0.01),
       driving(),
       {}},
      {"steel_sets",
       "steel_sets",
       "drives along steel sets on rough rock",
       "measured; 0.3 % of the way",
       MotionLength::kWay,
       0.0,
       true,
       measured_within(0.003, 0.01),
       driving(),
       {}},
      {"nominal",
       "nominal",
       "drives away from a face, on a working day",
       "measured; 0.3 % of the way",
       MotionLength::kWay,
       0.0,
       true,
       measured_within(0.003, 0.01),
       driving() + Values{{"face_distance_m", "0", 0.0, 0.0}, {"rear_distance_m", "6", 4.0, 10.0}},
       {}},
      {"arch",
       "arch",
       "drives through an arched road of rough rock",
       "measured; 0.5 % of the way",
       MotionLength::kWay,
       0.0,
       false,
       measured_within(0.005, 0.01),
       driving() + Values{{"roughness_m", "0.03", 0.02, 0.05}},
       {}},
      {"crosscut",
       "crosscut",
       "drives past a road that branches off",
       "measured; 0.5 % of the way",
       MotionLength::kWay,
       0.0,
       false,
       measured_within(0.005, 0.01),
       driving() + Values{{"roughness_m", "0.04", 0.02, 0.06}, {"crosscut_at_m", "5", 3.0, 12.0}},
       {}},
      {"people", "rough", "people walk along beside the machine", "measured by the rock; 0.5 % of the way",
       MotionLength::kWay, 0.0, false, measured_within(0.005, 0.01), driving() + people(), kPeopleWalkAlong},
      {"convoy",
       "rough",
       "a vehicle drives ahead at the same speed",
       "measured by the rock; 0.5 % of the way",
       MotionLength::kWay,
       0.0,
       false,
       measured_within(0.005, 0.01),
       driving() + Values{{"width_m", "5.5", 4.8, 6.5},
                          {"vehicle_side", "left", 1.0, 2.0},
                          {"vehicle_at_m", "7", 5.0, 9.0},
                          {"vehicle_width_m", "1.2", 0.8, 1.4}},
       {{"vehicle_speed_mps", "speed_mps", 1.0}}},
      {"dust",
       "rough",
       "drives through dust and drops",
       "measured, else unobservable; 1 % of the way",
       MotionLength::kWay,
       0.0,
       false,
       measured_mostly(0.8, 0.01),
       driving() + Values{{"dust", "0.2", 0.05, 0.4},
                          {"dust_range_m", "1.5", 0.5, 4.0},
                          {"drops", "0.02", 0.0, 0.05},
                          {"dropout", "0.2", 0.0, 0.4}},
       {}},
      {"reversing",
       "rough",
       "drives ahead, then back",
       "measured both ways; 0.5 % of the whole way",
       MotionLength::kWay,
       0.0,
       false,
       measured_within(0.005, 0.01),
       at_speed(0.3, 1.0) + Values{{"speed_change_at_s", "3", 2.0, 4.0}},
       {{"speed_after_mps", "speed_mps", -1.0}}},
      {"stopping",
       "rough",
       "drives, then stands",
       "measured; it stays where it stopped",
       MotionLength::kFrames,
       0.0,
       false,
       measured_within(0.005, 0.01),
       driving() + Values{{"speed_change_at_s", "3", 2.0, 4.0}},
       {}},
      {"rate_2hz",
       "rough",
       "drives; two frames a second",
       "measured; 0.5 % of the way",
       MotionLength::kWay,
       0.0,
       false,
       measured_within(0.005, 0.01),
       driving() + Values{{"rate_hz", "2", 2.0, 2.0}},
       {}},
      {"gaps",
       "rough",
       "drives; 1 to 3 s without frames again and again",
       "found again; 1 % of the way",
       MotionLength::kFrames,
       0.0,
       false,
       measured_mostly(0.8, 0.01),
       at_speed(0.3, 0.8) + Values{{"drop_every", "25", 20.0, 30.0}, {"drop_length", "20", 10.0, 30.0}},
       {}},
      {"gaps_long",
       "rough",
       "drives; 3 to 30 s without frames again and again",
       "found again, or unobservable in the frame behind a gap; the level covers the gap",
       MotionLength::kFrames,
       0.0,
       false,
       honest(),
       driving() + Values{{"drop_every", "25", 20.0, 30.0}, {"drop_length", "150", 30.0, 300.0}},
       {}},
      {"distorted",
       "rough",
       "drives at 1.5 m/s, and each scan takes 0.1 s",
       "measured; 0.5 % of the way",
       MotionLength::kWay,
       0.0,
       false,
       measured_within(0.005, 0.01),
       at_speed(1.5, 1.5) + Values{{"scan_s", "0.1", 0.1, 0.1}},
       {}},
      {"distorted_turn",
       "rough",
       "turns at 10 degrees a second, and each scan takes 0.1 s",
       "measured; stays in place",
       MotionLength::kTime,
       kTurn_s,
       false,
       stays_within(0.02),
       at_rest() + Values{{"scan_s", "0.1", 0.1, 0.1}, {"turn_rate_dps", "10", 10.0, 10.0, true}},
       {}},
  };
}

std::vector<MotionClass> open_classes() {  // NOLINT(readability-function-size): a table
  return {
      {"hall",
       "clean",
       "drives through a hall",
       "measured by its planes; 0.5 % of the way",
       MotionLength::kTime,
       kHall_s,
       false,
       measured_within(0.005, 0.01),
       at_speed(0.3, 1.0) + hall() + furniture(),
       {}},
      {"hall_2hz",
       "clean",
       "is carried through a hall; two frames a second, turns of up to 30 degrees",
       "measured by its planes; 0.5 % of the way",
       MotionLength::kTime,
       kHall_s,
       false,
       measured_within(0.005, 0.01),
       at_speed(0.5, 1.0) + hall() + furniture() + carried(),
       {}},
      {"hall_people", "clean", "people walk along beside the machine in a hall",
       "measured by its walls; 0.5 % of the way", MotionLength::kTime, kHall_s, false, measured_within(0.005, 0.01),
       at_speed(0.5, 1.0) + people() + hall(), kPeopleWalkAlong},
      {"junction",
       "crossing",
       "drives along smooth walls to where roads cross",
       "measured while the crossing is in sight, else unobservable",
       MotionLength::kTime,
       kHall_s,
       false,
       honest(),
       at_speed(0.3, 0.8) + Values{{"roughness_m", "0.004", 0.0, 0.01}, {"crosscut_at_m", "8", 6.0, 14.0}},
       {}},
      {"street",
       "clean",
       "drives between two walls under the sky, past niches and what stands there",
       "measured or unobservable; the level holds",
       MotionLength::kTime,
       kHall_s,
       false,
       honest(),
       at_speed(0.3, 1.2) + furniture() +
           Values{{"roof", "no", 0.0, 0.0},
                  {"width_m", "16", 10.0, 24.0},
                  {"niche_side", "both", 1.0, 3.0},
                  {"niche_pitch_m", "7", 5.0, 9.0},
                  {"niche_width_m", "1.5", 1.0, 3.0},
                  {"niche_depth_m", "0.3", 0.2, 0.8}},
       {}},
      {"mine",
       "mine_blasted",
       "drives along rock as it was measured",
       "measured; 1 % of the way",
       MotionLength::kWay,
       0.0,
       false,
       measured_mostly(0.8, 0.01),
       driving(),
       {}},
  };
}

std::vector<MotionClass> resting_classes() {
  return {
      {"creeping",
       "rough",
       "drives 5 mm a frame",
       "measured; 5 mm in ten minutes, or 0.1 % of the way",
       MotionLength::kTime,
       kLong_s,
       false,
       {kMostFrames, kNotAsked, kNotAsked, 0.001, 0.001, 0.005, kAcross_m, kTurn_deg},
       at_speed(0.05, 0.05),
       {}},
      {"standing",
       "rough",
       "stands still",
       "measured; 5 mm in ten minutes",
       MotionLength::kTime,
       kLong_s,
       false,
       stays_within(0.005),
       still(),
       {}},
      {"cutting",
       "rough",
       "stands, sways and swings its boom",
       "measured; 5 mm",
       MotionLength::kTime,
       kCut_s,
       false,
       stays_within(0.005),
       at_rest() + Values{{"body", "yes", 1.0, 1.0},
                          {"boom", "yes", 1.0, 1.0},
                          {"boom_sweep_deg", "30", 10.0, 50.0},
                          {"boom_elevation_deg", "8", 0.0, 20.0},
                          {"boom_period_s", "6", 3.0, 12.0}},
       {}},
      {"turning",
       "rough",
       "turns on the spot",
       "measured; stays in place",
       MotionLength::kTime,
       kTurn_s,
       false,
       stays_within(0.02),
       at_rest() + Values{{"turn_rate_dps", "5", 2.0, 10.0, true}},
       {}},
  };
}

std::vector<MotionClass> smooth_classes() {
  return {
      {"smooth",
       "clean",
       "drives along a smooth lining",
       "unobservable; measured is wrong",
       MotionLength::kWay,
       0.0,
       false,
       unobservable(),
       driving(),
       {}},
      {"smooth_curve",
       "clean",
       "drives around a bend of smooth lining",
       "unobservable; measured is wrong",
       MotionLength::kWay,
       0.0,
       false,
       unobservable_in_a_curve(),
       driving() + Values{{"curve_radius_m", "60", 25.0, 200.0, true}},
       {}},
      {"smooth_slope",
       "clean",
       "drives along a smooth lining with a floor that slopes",
       "unobservable; measured is wrong",
       MotionLength::kWay,
       0.0,
       false,
       unobservable(),
       driving() + Values{{"cross_fall_deg", "5", 2.0, 8.0, true}, {"slope_deg", "8", 0.0, 15.0, true}},
       {}},
      {"smooth_people", "clean", "people walk along beside the machine, before a smooth lining",
       "unobservable: people are no rock; measured is wrong", MotionLength::kWay, 0.0, false, unobservable(),
       driving() + people(), kPeopleWalkAlong},
      {"smooth_standing",
       "clean",
       "stands before a smooth lining",
       "unobservable: it cannot know that it stands",
       MotionLength::kTime,
       kCut_s,
       false,
       unobservable(),
       still(),
       {}},
      {"sets",
       "clean",
       "drives along smooth walls with steel sets",
       "measured or ambiguous; no set is skipped without a note",
       MotionLength::kWay,
       0.0,
       false,
       told(),
       driving() + sets(),
       {}},
      {"sets_2hz",
       "clean",
       "the same; two frames a second, a set's pitch from one to the next",
       "ambiguous or unobservable where two places fit; no set is skipped without a note",
       MotionLength::kWay,
       0.0,
       false,
       honest(),
       driving() + sets() + Values{{"rate_hz", "2", 2.0, 2.0}},
       {}},
  };
}

}  // namespace

const std::vector<MotionClass>& motion_classes() {
  static const std::vector<MotionClass> table = [] {
    std::vector<MotionClass> all = driven_classes();
    for (const auto& part : {open_classes(), resting_classes(), smooth_classes()})
      all.insert(all.end(), part.begin(), part.end());
    for (MotionClass& one : all) {
      if (std::string_view(one.scene) == "rough") one.values = plain_rock() + one.values;
    }
    return all;
  }();
  return table;
}

const MotionClass* find_motion_class(std::string_view name) {
  for (const MotionClass& one : motion_classes()) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

const MotionClass& motion_class_of_record(std::string_view name) {
  if (const MotionClass* const one = find_motion_class(name)) return *one;
  throw std::runtime_error(fmt::format("a record of the class '{}', which does not exist", name));
}

sim::Setup make_motion_setup(const MotionClass& one, std::string_view sensor, std::uint64_t seed) {
  sim::SceneChoice scene = *sim::find_scene(one.scene);
  scene.values.insert(scene.values.end(), one.values.begin(), one.values.end());
  sim::Setup setup = sim::make_setup(scene, sensor, true, seed);
  for (const MotionLink& link : one.links) {
    sim::find_parameter(link.target)->field(setup) = link.factor * sim::find_parameter(link.source)->field(setup);
  }
  return setup;
}

bool has_few_points(std::string_view sensor) {
  return sensor == "vlp16" || sensor == "mid360";
}

}  // namespace pose_wall::tools::campaign
