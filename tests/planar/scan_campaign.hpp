// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Drawn scenes with one thing of 0.2 m or more within 10 m: is it in the scan, and does a scan without it claim to be
// clear there?

#pragma once

#include <map>
#include <string>
#include <tuple>

#include "planar/scan_scenes.hpp"
#include "planar/scanner_under_test.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::test {

enum class ThingKind { post, box, low, hanging, floating, kinds };
inline const char* name_of(ThingKind kind) {
  static const char* const names[] = {"post", "box", "low", "hanging", "floating"};
  return names[static_cast<int>(kind)];
}

struct DrawnScene {
  RoadScene road;
  ThingKind kind = ThingKind::post;
  double size_m = 0.0;   // the smaller of its height and its width
  double range_m = 0.0;  // of its middle
};

constexpr double kThingLeast_m = 0.2, kThingFarthest_m = 10.0;

inline DrawnScene draw_scene(SceneDraw* draw, const pose_wall_planar_scanner_settings& settings) {
  DrawnScene out;
  RoadScene& road = out.road;
  road.height_m = draw->between(0.6, 2.3);  // also from above the band
  road.left_m = draw->between(1.5, 4.0);
  road.right_m = draw->between(1.5, 4.0);
  road.roof_m = draw->between(2.6, 4.5);
  road.ahead_m = draw->between(12.0, 60.0);
  road.behind_m = draw->between(12.0, 60.0);
  road.roll_rad = draw->between(-0.12, 0.12);
  road.pitch_rad = draw->between(-0.12, 0.12);
  road.yaw_rad = draw->between(-M_PI, M_PI);
  road.lost = draw->below(2) == 0 ? 0.0 : draw->between(0.0, 0.2);
  road.dust = draw->below(4) == 0 ? draw->between(0.0, 0.05) : 0.0;
  const double top_m = settings.machine_height_m + settings.margin_m;
  SceneThing thing;
  out.kind = static_cast<ThingKind>(draw->below(static_cast<std::uint32_t>(ThingKind::kinds)));
  const double width_m = draw->between(kThingLeast_m, 0.6), tall_m = draw->between(kThingLeast_m, 0.6);
  thing.round = out.kind == ThingKind::post || draw->below(2) == 0;
  thing.half_length = thing.half_width = 0.5 * width_m;
  if (!thing.round) thing.half_length = 0.5 * draw->between(width_m, 1.0);
  thing.turn_rad = draw->between(0.0, M_PI);
  const bool stands = out.kind == ThingKind::post || out.kind == ThingKind::box || out.kind == ThingKind::low;
  if (stands) thing.z1 = out.kind == ThingKind::post ? draw->between(1.0, road.roof_m) : tall_m;
  if (out.kind == ThingKind::box) thing.z1 = draw->between(0.6, 1.6);
  if (out.kind == ThingKind::hanging) thing.z0 = top_m - tall_m, thing.z1 = road.roof_m;
  if (out.kind == ThingKind::floating) {
    thing.z0 = draw->between(0.0, top_m - tall_m);
    thing.z1 = thing.z0 + tall_m;
  }
  out.size_m = std::min(width_m, std::min(thing.z1, top_m) - std::max(thing.z0, 0.0));
  // In the road, the machine itself apart.
  for (int attempt = 0; attempt < 100; ++attempt) {
    out.range_m = draw->between(1.2, kThingFarthest_m);
    const double a = draw->between(-M_PI, M_PI), reach_m = std::hypot(thing.half_length, thing.half_width);
    thing.x = out.range_m * std::cos(a), thing.y = out.range_m * std::sin(a);
    if (thing.y < road.left_m - reach_m && thing.y > reach_m - road.right_m && out.range_m > reach_m + 0.5) break;
  }
  road.things = {thing};
  return out;
}

// Nearest and farthest range of the thing in a direction of the world; nearest infinite: it is not there.
struct Stretch {
  double near_m, far_m;
};
inline Stretch stretch_of(const PlacedThing& column, double angle_rad) {
  const Eigen::Vector3f ray(static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad)), 0.0F);
  const auto near_m = static_cast<double>(meets(column, ray, 0.0F));
  return {near_m, near_m + 2.0 * std::hypot(column.half_length, column.half_width)};
}
// Its outline, at all heights.
inline PlacedThing column_of(const SceneThing& thing) {
  SceneThing column = thing;
  column.z0 = -1.0, column.z1 = 1.0;
  return PlacedThing(column);
}
// Whether the thing can be in this direction of the world.
inline bool may_be_at(const PlacedThing& column, double angle_rad) {
  const auto c = static_cast<float>(std::cos(angle_rad)), s = static_cast<float>(std::sin(angle_rad));
  return c * column.to_x + s * column.to_y >= column.cosine_least - 0.01F;
}

struct Verdict {
  bool told = false;         // as a thing or as a low one
  bool false_clear = false;  // a beam through it is clear there, and it is not told
};

inline Verdict judge(const DrawnScene& drawn, const ScannerUnderTest& scanner, double noise_m) {
  const PlacedThing thing = column_of(drawn.road.things[0]);
  const pose_wall_planar_scan& scan = scanner.scan();
  const pose_wall_planar_scan_view& view = scanner.view();
  const double slack_m = 5.0 * noise_m + 0.02;
  Verdict verdict;
  bool clear_through = false;
  for (std::uint32_t beam = 0; beam < scan.beams; ++beam) {
    const double world_rad = scanner.angle_of(beam) + drawn.road.yaw_rad;
    if (!may_be_at(thing, world_rad)) continue;
    // told: within a beam of its outline
    for (const double aside : {0.0, -scan.angle_step_rad, scan.angle_step_rad}) {
      const Stretch s = stretch_of(thing, world_rad + aside);
      if (!std::isfinite(s.near_m)) continue;
      for (const float range :
           {scan.range_m[beam], view.low_m[beam], view.overhead_m[beam], view.alone_m[beam], view.behind_m[beam]}) {
        const auto r = static_cast<double>(range);
        if (r >= s.near_m - slack_m && r <= s.far_m + slack_m) verdict.told = true;
      }
      if (aside == 0.0 && static_cast<double>(view.clear_from_m[beam]) < s.near_m &&
          static_cast<double>(view.clear_m[beam]) > s.far_m) {
        clear_through = true;
      }
    }
  }
  verdict.false_clear = clear_through && !verdict.told;
  return verdict;
}

struct CampaignCell {
  std::uint64_t things = 0, missed = 0, without_rays = 0, all_lost = 0, on_floor = 0, false_clear = 0, promised = 0;
};
// By sensor, kind, size (0: below 0.3, 1: below 0.45, 2: more) and range (0: below 3, 1: 5, 2: 7.5, 3: 10).
using CampaignKey = std::tuple<std::string, int, int, int>;
struct Campaign {
  std::map<CampaignKey, CampaignCell> cells;
  std::uint64_t scenes = 0, false_clear = 0, dark_false_clear = 0, missed = 0;
  std::uint64_t missed_with_returns = 0;
  std::uint64_t clear_behind = 0;                  // beams that are clear beyond what they report
  std::uint64_t promised = 0, promise_broken = 0;  // clear without the thing, no return lost: it has to be told
  double clear_far_m = 0.0;                        // sum over beams of clear_m, and their number
  std::uint64_t clear_beams = 0, beams = 0;
};

constexpr double kCampaignTilt_rad = 0.0005;  // standard deviation of the floor's tilt: 0.03 degrees

class CampaignRunner {
 public:
  explicit CampaignRunner(const RingSensor& sensor, const pose_wall_planar_scanner_settings& settings = scan_settings())
      : sensor_(sensor), settings_(settings), scanner_(config_of(sensor), settings) {
    for (std::uint64_t k = 0; k < (sensor.rings == 0 ? 8U : 1U); ++k) rays_.push_back(rays_of(sensor, 77 + k));
  }

  void run(std::uint64_t seed, Campaign* campaign) {
    SceneDraw draw(seed);
    DrawnScene drawn = draw_scene(&draw, settings_);
    drawn.road.noise_m = sensor_.noise_m;
    drawn.road.things_are_dark = seed % 8 == 7;  // nothing comes back from it: it can only not be clear
    const std::vector<Eigen::Vector3f>& rays = rays_[seed % rays_.size()];
    const pose_wall_planar_floor floor = floor_of(drawn.road, kCampaignTilt_rad, &draw);
    const bool promised = drawn.road.lost == 0.0 && drawn.road.dust == 0.0 && !drawn.road.things_are_dark &&
                          is_promised(drawn, rays, floor);
    const SeenScene seen = see(drawn.road, sensor_, rays, seed);
    scanner_.process(cloud_of(seen.points, static_cast<std::int64_t>(seed)), &floor);
    const Verdict verdict = judge(drawn, scanner_, sensor_.noise_m);
    note_clear(campaign);
    ++campaign->scenes;
    if (drawn.road.things_are_dark) {
      campaign->dark_false_clear += verdict.false_clear ? 1 : 0;
      return;
    }
    const Returns returns = returns_of(drawn, seen);
    CampaignCell& cell = campaign->cells[key_of(drawn)];
    ++cell.things;
    if (promised) ++cell.promised, ++campaign->promised;
    if (promised && !verdict.told) ++campaign->promise_broken;
    if (verdict.false_clear) ++cell.false_clear, ++campaign->false_clear;
    if (verdict.told) return;
    ++cell.missed, ++campaign->missed;
    if (seen.rays_on_things == 0) {
      ++cell.without_rays;
    } else if (returns.all == 0) {
      ++cell.all_lost;
    } else if (returns.between == 0) {
      ++cell.on_floor;
    } else {
      ++campaign->missed_with_returns;
    }
  }

  ScannerUnderTest& scanner() { return scanner_; }

 private:
  static pose_wall_config config_of(const RingSensor& sensor) {
    pose_wall_config config = config_with();
    set(&config, "extrinsic_roll", sensor.mount_roll_rad);
    set(&config, "range_noise", sensor.noise_m);
    return config;
  }
  // Whether the same road without the thing is clear all over its place, so that the thing has to be told.
  bool is_promised(DrawnScene drawn, const std::vector<Eigen::Vector3f>& rays, const pose_wall_planar_floor& floor) {
    const PlacedThing thing = column_of(drawn.road.things[0]);
    drawn.road.things.clear();
    scanner_.process(cloud_of(see(drawn.road, sensor_, rays, 1).points, 0), &floor);
    std::uint32_t beams = 0;
    for (std::uint32_t beam = 0; beam < scanner_.scan().beams; ++beam) {
      const Stretch s = stretch_of(thing, scanner_.angle_of(beam) + drawn.road.yaw_rad);
      if (!std::isfinite(s.near_m)) continue;
      ++beams;
      const pose_wall_planar_scan_view& view = scanner_.view();
      const bool clear = static_cast<double>(view.clear_from_m[beam]) < s.near_m - 0.05 &&
                         static_cast<double>(view.clear_m[beam]) > s.far_m + 0.05;
      if (!clear) return false;
    }
    return beams > 0;
  }

  // Of the thing: all that came back, and those of them that are surely neither at the floor nor over the band.
  struct Returns {
    std::uint64_t all = 0, between = 0;
  };
  Returns returns_of(const DrawnScene& drawn, const SeenScene& seen) const {
    const Eigen::Matrix3d R = drawn.road.R_world_base() * rotation_zyx(sensor_.mount_roll_rad, 0.0, 0.0);
    const double slack_m = 5.0 * sensor_.noise_m + 4.0 * kCampaignTilt_rad * kThingFarthest_m;
    Returns out;
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
      if (seen.thing[i] < 0) continue;
      const auto& p = seen.points[i];
      const Eigen::Vector3d q(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
      const double z_m = (R * q).z() + drawn.road.height_m;
      ++out.all;
      const double top_m = settings_.machine_height_m + settings_.margin_m;
      if (z_m > settings_.floor_tolerance_m + slack_m && z_m < top_m - slack_m) ++out.between;
    }
    return out;
  }
  CampaignKey key_of(const DrawnScene& drawn) const {
    const int size = drawn.size_m < 0.3 ? 0 : drawn.size_m < 0.45 ? 1 : 2;
    const int range = drawn.range_m < 3.0 ? 0 : drawn.range_m < 5.0 ? 1 : drawn.range_m < 7.5 ? 2 : 3;
    return {sensor_.name, static_cast<int>(drawn.kind), size, range};
  }
  void note_clear(Campaign* campaign) const {
    for (std::uint32_t beam = 0; beam < scanner_.scan().beams; ++beam) {
      const float clear_m = scanner_.view().clear_m[beam];
      ++campaign->beams;
      for (const float reported_m : {scanner_.scan().range_m[beam], scanner_.view().low_m[beam]}) {
        if (clear_m > reported_m + 0.2F) ++campaign->clear_behind;  // NaN fails; a bias is less
      }
      if (clear_m > 0.0F) ++campaign->clear_beams, campaign->clear_far_m += static_cast<double>(clear_m);
    }
  }

  RingSensor sensor_;
  pose_wall_planar_scanner_settings settings_;
  ScannerUnderTest scanner_;
  std::vector<std::vector<Eigen::Vector3f>> rays_;
};

}  // namespace pose_wall::test
