// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a mount lets the machine do on clear roads: whether it starts, what somebody must confirm for that, how fast and
// how long it drives, and what holds it.

#pragma once

#include "planar/encounter/events.hpp"
#include "planar/encounter/mounts.hpp"

namespace pose_wall::test {

enum class Road { straight, curve, reverse };

inline const char* name_of(Road road) {
  static constexpr const char* kNames[] = {"straight", "curve", "reverse"};
  return kNames[static_cast<int>(road)];
}

// A clear road: with rough rock or waves as drawn, or flat with smooth walls.
inline Plan clear_road(const Mount& mount, Road road, bool is_flat, bool has_rock, Draw* draw) {
  Plan plan = draw_run_up(draw, settings_of(mount));
  put_on(mount, &plan);
  if (has_rock) plan.world.rock = std::make_shared<Rock>(draw->below(1000000));
  if (is_flat) {
    plan.world.rock = nullptr;
    plan.world.floor_wave_m = plan.world.floor_rough_m = plan.world.wall_wave_m = 0.0;
    plan.world.half_width_m = 2.5;
  }
  constexpr double kBend_rad_m = 0.05;  // 20 m of radius
  plan.drive = road == Road::straight ? Drive::straight : road == Road::curve ? Drive::curve : Drive::reverse;
  plan.machine.set_arc(road == Road::reverse ? -1.0 : 1.0, road == Road::curve ? kBend_rad_m : 0.0);
  if (road == Road::curve) plan.world.bend_rad_m = kBend_rad_m;
  plan.machine.yaw_rad = 0.0;
  plan.wish_m_s = 1.0;
  plan.goes_on = true;
  plan.lasts_s = 60.0;
  return plan;
}

class MountTable {
 public:
  MountTable(double minutes, std::uint64_t seed, bool has_rock) : minutes_(minutes), seed_(seed), has_rock_(has_rock) {
    std::printf(
        "| mount | road | confirm m | driven %% | m/s | allowed m/s | false stops/h | first metre s | held by %% | "
        "blind ahead, beside, behind %% |\n|---|---|---|---|---|---|---|---|---|---|\n");
  }

  void add(const Mount& mount) {
    for (const Road road : {Road::straight, Road::curve, Road::reverse}) {
      Outcome held;
      const double confirm_m = least_confirmed_m(mount, road, &held);
      if (confirm_m > kConfirmMost_m) {
        std::printf("| %s | %s | never | | | | | |", mount.name.c_str(), name_of(road));
        print_held(held);
      } else {
        std::printf("| %s | %s | %.2f |", mount.name.c_str(), name_of(road), confirm_m);
        print(driven(mount, road));
      }
      std::fflush(stdout);
    }
  }

 private:
  static constexpr double kConfirmMost_m = 3.0, kConfirmStep_m = 0.25;  // the most that the setting allows
  static constexpr double kOn_m = 4.0;                                  // further than any strip reaches

  // The narrowest strip with which the machine drives on over a flat road; more than the most: none. The last outcome
  // in which it did not.
  double least_confirmed_m(const Mount& mount, Road road, Outcome* held) {
    const int most = static_cast<int>(kConfirmMost_m / kConfirmStep_m);
    if (!drives_on(mount, road, kConfirmMost_m, held)) return kConfirmMost_m + kConfirmStep_m;
    int least = 0, enough = most;
    while (least < enough) {
      const int middle = (least + enough) / 2;
      if (drives_on(mount, road, middle * kConfirmStep_m, held)) {
        enough = middle;
      } else {
        least = middle + 1;
      }
    }
    return enough * kConfirmStep_m;
  }

  bool drives_on(const Mount& mount, Road road, double confirm_m, Outcome* held) {
    Draw draw(seed_);
    pose_wall_planar_stop_settings settings = settings_of(mount);
    settings.confirm_m = confirm_m;
    Plan plan = clear_road(mount, road, true, false, &draw);
    plan.lasts_s = 20.0;
    plan.ends_m = kOn_m;
    const Outcome out = Encounter(plan, settings, &stop_, &draw).run();
    if (out.moved_m < kOn_m) *held = out;
    return out.moved_m >= kOn_m;
  }

  Outcome driven(const Mount& mount, Road road) {
    Outcome all;
    double first_s = 0.0;
    int runs = 0;
    for (; all.lasted_s < 60.0 * minutes_; ++runs) {
      Draw draw(seed_ + 1 + static_cast<std::uint64_t>(runs));
      const pose_wall_planar_stop_settings settings = settings_of(mount);
      const Plan plan = clear_road(mount, road, false, has_rock_, &draw);
      const Outcome out = Encounter(plan, settings, &stop_, &draw).run();
      all.lasted_s += plan.lasts_s, all.drove_s += out.drove_s, all.moved_m += out.moved_m, all.stops += out.stops;
      all.allowed_m += out.allowed_m, all.held += out.held, first_s += std::fmin(out.first_metre_s, plan.lasts_s);
      all.blind_ahead += out.blind_ahead, all.blind_beside += out.blind_beside, all.blind_behind += out.blind_behind;
      for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) all.held_by[bit] += out.held_by[bit];
    }
    all.first_metre_s = first_s / runs;
    return all;
  }

  static void print(const Outcome& all) {
    const double drove_s = std::fmax(all.drove_s, 1e-3);
    std::printf(" %.0f | %.2f | %.2f | %.1f | %.1f |", 100.0 * all.drove_s / all.lasted_s, all.moved_m / drove_s,
                all.allowed_m / drove_s, all.stops * 3600.0 / drove_s, all.first_metre_s);
    print_held(all);
  }
  // The commonest reason other than that of a restart.
  static void print_held(const Outcome& out) {
    const double held = std::fmax(out.held, 1.0);
    constexpr std::uint32_t kRestart = 11;  // the bit of POSE_WALL_PLANAR_STOP_R_RESTART, the last one
    for (std::uint32_t bit = 0; bit < kRestart; ++bit) {
      const double share = 100.0 * out.held_by[bit] / held;
      if (share >= 10.0) std::printf(" %s %.0f", pose_wall_planar_stop_reason_name(bit), share);
    }
    std::printf(" | %.0f, %.0f, %.0f |\n", 100.0 * out.blind_ahead / held, 100.0 * out.blind_beside / held,
                100.0 * out.blind_behind / held);
  }

  double minutes_;
  std::uint64_t seed_;
  bool has_rock_;
  StopUnderTest stop_;
};

}  // namespace pose_wall::test
