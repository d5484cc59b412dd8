// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, of motion and of every planar part, by all rows of its table: _settings_init gives the default; both ends of
// a range are taken; what lies beyond or is no number is refused by the member's name; rules over several members
// name the one that must give way. Does not prove: that a part works with the ends.

#include "part/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "pose_wall_motion.h"
#include "pose_wall_planar.h"

namespace pose_wall::test {
namespace {

constexpr double pi = 3.14159265358979323846;  // tables name it so
constexpr double kInf = std::numeric_limits<double>::infinity();

using Rows = std::vector<SettingRow>;
const Rows kMotionRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_motion_settings, __VA_ARGS__)
#include "pose_wall_motion_settings.def"
};
const Rows kScannerRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_scanner_settings, __VA_ARGS__)
#include "pose_wall_planar_scanner_settings.def"
};
const Rows kSlamRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_slam_settings, __VA_ARGS__)
#include "pose_wall_planar_slam_settings.def"
};
const Rows kMapRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_map_settings, __VA_ARGS__)
#include "pose_wall_planar_map_settings.def"
};
const Rows kLocaliseRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_localise_settings, __VA_ARGS__)
#include "pose_wall_planar_localise_settings.def"
};
const Rows kPlanRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_plan_settings, __VA_ARGS__)
#include "pose_wall_planar_plan_settings.def"
};
const Rows kTrackRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_track_settings, __VA_ARGS__)
#include "pose_wall_planar_track_settings.def"
};
const Rows kStopRows = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_stop_settings, __VA_ARGS__)
#include "pose_wall_planar_stop_settings.def"
};

// A part's calls, and the members of which an end may break a rule over several of them.
template <typename Settings, typename Fault>
class PartOfSettings {
 public:
  PartOfSettings(std::int32_t (*init)(Settings*), std::int32_t (*check)(const Settings*, Fault*))
      : init_(init), check_(check) {}

  // The refused member of the defaults with a change; "" where they are taken.
  template <typename Change>
  std::string refused(const Change& change) const {
    Settings settings;
    std::memset(&settings, 0x5A, sizeof settings);
    EXPECT_EQ(init_(&settings), POSE_WALL_OK);
    change(&settings);
    Fault fault{"", ""};
    const std::int32_t status = check_(&settings, &fault);
    EXPECT_EQ(check_(&settings, nullptr), status);
    EXPECT_EQ(status, *fault.member == '\0' ? POSE_WALL_OK : POSE_WALL_E_VALUE_RANGE);
    EXPECT_EQ(std::string(fault.rule).empty(), *fault.member == '\0') << "the rule is told";
    return fault.member;
  }
  void expect_table(const Rows& rows, const std::set<std::string>& ruled = {}) const {
    EXPECT_EQ(refused([&](Settings* s) {
                for (const SettingRow& row : rows) EXPECT_EQ(value_at(row, s), row.standard) << row.fault.member;
              }),
              "");
    for (const SettingRow& row : rows) expect_row(row, ruled.count(row.fault.member) != 0);
    EXPECT_EQ(check_(nullptr, nullptr), POSE_WALL_E_NULL);
    Settings shorter{};
    for (const std::uint32_t size : {0U, 4U, static_cast<std::uint32_t>(sizeof shorter) - 8}) {
      shorter.struct_size = size;
      EXPECT_EQ(check_(&shorter, nullptr), POSE_WALL_E_STRUCT_SIZE) << size;
    }
  }

 private:
  void expect_row(SettingRow row, bool is_ruled) const {
    SCOPED_TRACE(row.fault.member);
    const auto refused_at = [&](double value) {
      row.standard = value;
      return refused([&](Settings* s) { put_standard(row, s); });
    };
    for (const double end : {row.least, row.most}) EXPECT_TRUE(refused_at(end).empty() || is_ruled) << end;
    std::vector<double> beyond = {row.most + 1.0};
    if (row.is_count && row.least > 0.0) beyond.push_back(row.least - 1.0);
    if (!row.is_count) {
      beyond = {std::nextafter(row.least, -kInf), std::nextafter(row.most, kInf), -kInf, kInf, std::nan("")};
    }
    for (const double value : beyond) EXPECT_EQ(refused_at(value), row.fault.member) << value;
  }

  std::int32_t (*init_)(Settings*);
  std::int32_t (*check_)(const Settings*, Fault*);
};

TEST(Settings, OfMotionFollowTheirTable) {
  const PartOfSettings motion(pose_wall_motion_settings_init, pose_wall_motion_settings_check);
  motion.expect_table(kMotionRows);
  EXPECT_EQ(motion.refused([](auto* s) { s->reserved = 1; }), "reserved");
}

TEST(Settings, OfSlamFollowTheirTable) {
  PartOfSettings(pose_wall_planar_slam_settings_init, pose_wall_planar_slam_settings_check).expect_table(kSlamRows);
}

TEST(Settings, OfLocalisationFollowTheirTable) {
  PartOfSettings(pose_wall_planar_localise_settings_init, pose_wall_planar_localise_settings_check)
      .expect_table(kLocaliseRows);
}

TEST(Settings, OfTheScannerFollowTheirTableAndRules) {
  const PartOfSettings scanner(pose_wall_planar_scanner_settings_init, pose_wall_planar_scanner_settings_check);
  scanner.expect_table(kScannerRows,
                       {"ground_clearance_m", "machine_height_m", "margin_m", "floor_tolerance_m", "thing_m",
                        "angle_min_rad", "angle_max_rad", "angle_step_rad", "range_min_m", "range_max_m"});
  EXPECT_EQ(scanner.refused([](auto* s) { s->machine_height_m = 0.2; }), "machine_height_m");
  EXPECT_EQ(scanner.refused([](auto* s) { s->margin_m = 0.24; }), "floor_tolerance_m");
  EXPECT_EQ(scanner.refused([](auto* s) { s->thing_m = 0.06; }), "thing_m");
  EXPECT_EQ(scanner.refused([](auto* s) { s->angle_max_rad = 4.0; }), "angle_max_rad");
  EXPECT_EQ(scanner.refused([](auto* s) { s->angle_max_rad = s->angle_min_rad; }), "angle_max_rad");
  EXPECT_EQ(scanner.refused([](auto* s) { s->angle_step_rad = 0.0009; }), "angle_step_rad");
  EXPECT_EQ(scanner.refused([](auto* s) { s->range_max_m = 0.3; }), "range_max_m");
}

TEST(Settings, OfTheMapFollowTheirTableAndRules) {
  const PartOfSettings map(pose_wall_planar_map_settings_init, pose_wall_planar_map_settings_check);
  map.expect_table(kMapRows, {"cell_m", "distance_cap_m", "occupied_probability", "free_probability"});
  EXPECT_EQ(map.refused([](auto* s) { s->distance_cap_m = 0.04; }), "distance_cap_m");
  EXPECT_EQ(map.refused([](auto* s) { s->distance_cap_m = 6.1; }), "distance_cap_m");
  EXPECT_EQ(map.refused([](auto* s) { s->most_probability = 0.75, s->occupied_probability = 0.8; }),
            "occupied_probability");
  EXPECT_EQ(map.refused([](auto* s) { s->least_probability = 0.3, s->free_probability = 0.2; }), "free_probability");
}

TEST(Settings, OfThePlannerFollowTheirTableAndRules) {
  const PartOfSettings plan(pose_wall_planar_plan_settings_init, pose_wall_planar_plan_settings_check);
  plan.expect_table(kPlanRows, {"resolution_m", "lattice_m", "radius_min_m", "radius_max_m"});
  EXPECT_EQ(plan.refused([](auto* s) { s->lattice_m = 1.0; }), "lattice_m");
  EXPECT_EQ(plan.refused([](auto* s) { s->lattice_m = 0.05; }), "lattice_m");
  EXPECT_EQ(plan.refused([](auto* s) { s->radius_max_m = 0.5; }), "radius_max_m");
  EXPECT_EQ(plan.refused([](auto* s) { s->resolution_m = 0.01, s->front_m = s->rear_m = 20.0; }), "resolution_m");
}

TEST(Settings, OfTheTrackerFollowTheirTableAndRules) {
  const PartOfSettings track(pose_wall_planar_track_settings_init, pose_wall_planar_track_settings_check);
  track.expect_table(kTrackRows, {"speed_max_m_s", "speed_min_m_s"});
  EXPECT_EQ(track.refused([](auto* s) { s->speed_min_m_s = 0.6; }), "speed_min_m_s");
}

TEST(Settings, OfTheStopFollowTheirTableAndRules) {
  const PartOfSettings stop(pose_wall_planar_stop_settings_init, pose_wall_planar_stop_settings_check);
  stop.expect_table(kStopRows, {"top_m", "tall_m", "thing_height_m", "floor_band_m"});
  EXPECT_EQ(stop.refused([](auto* s) { s->corners = 2; }), "corner_m");
  EXPECT_EQ(stop.refused([](auto* s) { std::swap(s->corner_m[0], s->corner_m[1]); }), "corner_m");
  EXPECT_EQ(stop.refused([](auto* s) { s->corner_m[0][0] = std::nan(""); }), "corner_m");
  EXPECT_EQ(stop.refused([](auto* s) { s->corner_m[0][0] = -20.0; }), "corner_m");
  EXPECT_EQ(stop.refused([](auto* s) { s->floor_band_m = 0.28; }), "floor_band_m");
  EXPECT_EQ(stop.refused([](auto* s) { s->tall_m = 2.0, s->top_m = 1.0; }), "tall_m");
}

}  // namespace
}  // namespace pose_wall::test
