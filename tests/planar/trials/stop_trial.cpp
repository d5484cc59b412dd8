// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_planar_stop_trial [--encounters N] [--seed S] [--only K] [--clear HOURS] [--dust HOURS]
// Contacts in drawn encounters, or false stops on a clear road. Exit status 1 if there was a contact.

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "planar/encounter/plans.hpp"

namespace {

using pose_wall::test::Draw;
using pose_wall::test::Encounter;
using pose_wall::test::Outcome;
using pose_wall::test::Plan;
using pose_wall::test::StopUnderTest;

struct Arguments {
  std::uint64_t encounters = 1000, seed = 1, only = 0;
  double clear_h = 0.0, dust_h = 0.0;
  bool has_only = false;
};

Arguments arguments_of(int argc, char** argv) {
  Arguments a;
  for (int k = 1; k + 1 < argc; k += 2) {
    const char* value = argv[k + 1];
    if (std::strcmp(argv[k], "--encounters") == 0) a.encounters = std::strtoull(value, nullptr, 10);
    if (std::strcmp(argv[k], "--seed") == 0) a.seed = std::strtoull(value, nullptr, 10);
    if (std::strcmp(argv[k], "--only") == 0) a.only = std::strtoull(value, nullptr, 10), a.has_only = true;
    if (std::strcmp(argv[k], "--clear") == 0) a.clear_h = std::strtod(value, nullptr);
    if (std::strcmp(argv[k], "--dust") == 0) a.dust_h = std::strtod(value, nullptr);
  }
  return a;
}

std::uint64_t seed_of(std::uint64_t seed, std::uint64_t encounter) {
  pose_wall::Random mixed(seed);
  return pose_wall::Random(mixed.next() ^ (encounter * 0xD1B54A32D192ED03ULL)).next();
}

int encounters(const Arguments& a) {
  const pose_wall_planar_stop_settings settings = pose_wall::test::encounter_settings();
  StopUnderTest stop;
  constexpr auto kKinds = static_cast<std::size_t>(pose_wall::test::Kind::kinds);
  std::uint64_t runs[kKinds] = {}, contacts[kKinds] = {}, moved[kKinds] = {}, stopped[kKinds] = {}, total = 0;
  std::uint64_t frames = 0, whole = 0, lost = 0;
  double metres = 0.0;
  const std::uint64_t first = a.has_only ? a.only : 0, end = a.has_only ? a.only + 1 : a.encounters;
  for (std::uint64_t k = first; k < end; ++k) {
    Draw draw(seed_of(a.seed, k));
    const Plan plan = pose_wall::test::draw_plan(&draw, settings);
    const Outcome out = Encounter(plan, settings, &stop, &draw).run(a.has_only);
    const auto kind = static_cast<std::size_t>(plan.kind);
    ++runs[kind];
    moved[kind] += out.moved_m > 0.1 ? 1 : 0;
    stopped[kind] += out.stops > 0 ? 1 : 0;
    frames += out.frames, metres += out.moved_m;
    whole += out.top_m_s > 0.9 ? 1 : 0;
    lost += plan.loss_from_s < out.lasted_s ? 1 : 0;
    if (!out.contact) continue;
    ++contacts[kind], ++total;
    std::printf("contact: encounter %llu %s drive %d sensor %d loss %d at %.2f s, %.2f m/s\n",
                static_cast<unsigned long long>(k), pose_wall::test::name_of(plan.kind), static_cast<int>(plan.drive),
                static_cast<int>(plan.sensor.pattern), static_cast<int>(plan.loss), out.contact_s, out.contact_m_s);
    std::fflush(stdout);
  }
  for (std::size_t k = 1; k < kKinds; ++k) {
    std::printf("%-15s %8llu encounters, moved in %8llu, stopped from motion in %8llu, contacts %llu\n",
                pose_wall::test::name_of(static_cast<pose_wall::test::Kind>(k)),
                static_cast<unsigned long long>(runs[k]), static_cast<unsigned long long>(moved[k]),
                static_cast<unsigned long long>(stopped[k]), static_cast<unsigned long long>(contacts[k]));
  }
  std::printf(
      "seed %llu: %llu encounters, %llu contacts, %llu frames, %.0f m, above 0.9 m/s in %llu, sensor lost in "
      "%llu\n",
      static_cast<unsigned long long>(a.seed), static_cast<unsigned long long>(end - first),
      static_cast<unsigned long long>(total), static_cast<unsigned long long>(frames), metres,
      static_cast<unsigned long long>(whole), static_cast<unsigned long long>(lost));
  return total == 0 ? 0 : 1;
}

// Drives on a road without things, with or without thin dust, and counts stops.
int false_stops(const Arguments& a, bool has_dust) {
  const pose_wall_planar_stop_settings settings = pose_wall::test::encounter_settings();
  StopUnderTest stop;
  const double hours = has_dust ? a.dust_h : a.clear_h;
  double drove_s = 0.0;
  std::uint64_t stops = 0, by[POSE_WALL_PLANAR_STOP_REASON_COUNT] = {}, runs = 0;
  double metres = 0.0;
  for (std::uint64_t k = 0; drove_s < hours * 3600.0 && k < 1000000; ++k, ++runs) {
    Draw draw(seed_of(a.seed + 77, k));
    Plan plan = pose_wall::test::draw_plan(&draw, settings);
    if (plan.drive != pose_wall::test::Drive::straight) continue;
    plan.world.things.clear(), plan.world.puddles.clear(), plan.world.dust.clear();
    plan.world.face_m = 1000.0;
    plan.loss = pose_wall::test::Loss::none;
    plan.machine.set_arc(1.0, 0.0);
    plan.machine.yaw_rad = 0.0;
    plan.lasts_s = 60.0;
    if (has_dust) {
      for (int j = 0; j < 8; ++j) {
        plan.world.dust.push_back({4.0 + 6.0 * j, draw.within(-1.5, 1.5), draw.within(0.3, 1.5), draw.within(0.5, 2.0),
                                   draw.within(0.002, 0.05)});
      }
    }
    const Outcome out = Encounter(plan, settings, &stop, &draw).run(a.has_only && a.only == k);
    drove_s += out.drove_s, metres += out.moved_m;
    stops += out.stops;
    for (std::uint32_t bit = 0; out.stops > 0 && bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
      by[bit] += (out.stop_reasons >> bit) & 1U;
    }
  }
  std::printf("%s: %llu stops in %.2f h of driving, %.0f m: %.2f an hour\n", has_dust ? "dust" : "clear",
              static_cast<unsigned long long>(stops), drove_s / 3600.0, metres,
              static_cast<double>(stops) * 3600.0 / drove_s);
  for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
    if (by[bit] > 0) {
      std::printf("  %s %llu\n", pose_wall_planar_stop_reason_name(bit), static_cast<unsigned long long>(by[bit]));
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments a = arguments_of(argc, argv);
  if (a.clear_h > 0.0) return false_stops(a, false);
  if (a.dust_h > 0.0) return false_stops(a, true);
  return encounters(a);
}
