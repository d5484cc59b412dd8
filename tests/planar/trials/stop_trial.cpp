// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall_planar_stop_trial [--encounters N] [--seed S] [--only K] [--clear HOURS] [--dust HOURS] [--density PER_M]
//                             [--mount NAME] [--mounts] [--rock] [--table MINUTES]
// Contacts in drawn encounters, or false stops on a clear road. Exit status 1 if there was a contact. --density: of the
// clouds of dust along the road, in returns a metre of ray; with it encounters have such clouds, too. With --mount the
// machine has a mount of those whose names hold this, and --mounts lists them. With --rock roads have the relief of
// real rock. The table says what each mount lets the machine do on clear roads.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "planar/encounter/events.hpp"
#include "planar/encounter/mount_table.hpp"
#include "planar/stop/settings.hpp"

namespace {

using namespace pose_wall::test;

struct Arguments {
  std::uint64_t encounters = 1000, seed = 1, only = 0;
  bool is_dusty = false;                                      // encounters
  double clear_h = 0.0, dust_h = 0.0, density_per_m = 0.001;  // hours that pass in the simulator
  double table_min = 0.0;
  std::vector<Mount> mounts;  // none: drawn ones that suit the stop
  bool has_only = false, has_rock = false, lists = false;
};

Arguments arguments_of(int argc, char** argv) {
  Arguments a;
  for (int k = 1; k < argc; ++k) {
    const char* value = k + 1 < argc ? argv[k + 1] : "";
    if (std::strcmp(argv[k], "--rock") == 0) a.has_rock = true;
    if (std::strcmp(argv[k], "--mounts") == 0) a.lists = true;
    if (std::strcmp(argv[k], "--mount") == 0) a.mounts = pose_wall::test::mounts_named(value);
    if (std::strcmp(argv[k], "--table") == 0) a.table_min = std::strtod(value, nullptr);
    if (std::strcmp(argv[k], "--encounters") == 0) a.encounters = std::strtoull(value, nullptr, 10);
    if (std::strcmp(argv[k], "--seed") == 0) a.seed = std::strtoull(value, nullptr, 10);
    if (std::strcmp(argv[k], "--only") == 0) a.only = std::strtoull(value, nullptr, 10), a.has_only = true;
    if (std::strcmp(argv[k], "--clear") == 0) a.clear_h = std::strtod(value, nullptr);
    if (std::strcmp(argv[k], "--density") == 0) a.density_per_m = std::strtod(value, nullptr), a.is_dusty = true;
    if (std::strcmp(argv[k], "--dust") == 0) a.dust_h = std::strtod(value, nullptr);
  }
  return a;
}

std::uint64_t seed_of(std::uint64_t seed, std::uint64_t encounter) {
  pose_wall::Random mixed(seed);
  return pose_wall::Random(mixed.next() ^ (encounter * 0xD1B54A32D192ED03ULL)).next();
}

// So many events begin from one run-up, and every eighth encounter from standstill with all things there already.
constexpr std::uint64_t kOfOneRunUp = 16, kFromStandstill = 8;

// The mount of an encounter, if any was asked for.
std::optional<Mount> draw_mount(const Arguments& a, Draw* draw) {
  if (a.mounts.empty()) return std::nullopt;
  return a.mounts[draw->below(static_cast<std::uint32_t>(a.mounts.size()))];
}

// Clouds of thin dust along the road.
void put_dust(Draw* draw, double density_per_m, Plan* plan) {
  for (int j = 0; j < 8; ++j) {
    plan->world.dust.push_back(
        {4.0 + 6.0 * j, draw->within(-1.5, 1.5), draw->within(0.3, 1.5), draw->within(0.5, 2.0), density_per_m});
  }
}

void finish(const Arguments& a, const std::optional<Mount>& mount, Plan* plan, Draw* draw) {
  if (mount.has_value()) pose_wall::test::put_on(*mount, plan);
  if (a.has_rock) plan->world.rock = std::make_shared<pose_wall::test::Rock>(draw->below(1000000));
}

class Encounters {
 public:
  explicit Encounters(const Arguments& a) : arguments_(a) {}

  Outcome run(std::uint64_t k, Plan* plan) {
    Draw draw(seed_of(arguments_.seed, k));
    if (k % kFromStandstill == 0) {
      const std::optional<Mount> mount = draw_mount(arguments_, &draw);
      const auto settings = mount.has_value() ? settings_of(*mount) : pose_wall::test::encounter_settings();
      *plan = pose_wall::test::draw_plan(&draw, settings);
      finish(arguments_, mount, plan, &draw);
      if (arguments_.is_dusty) put_dust(&draw, arguments_.density_per_m, plan);
      plan->lasts_s = 10.0;
      Encounter encounter(*plan, settings, &still_, &draw);
      if (arguments_.has_only) encounter.tell_frames();
      return encounter.run();
    }
    run_up(k / kOfOneRunUp);
    Encounter encounter = *base_;
    if (arguments_.has_only) encounter.tell_frames();
    driven_.bring_back();
    *plan = pose_wall::test::draw_event(road_, encounter.machine(), settings_, &draw);
    return encounter.run_on(*plan, &draw);
  }

 private:
  void run_up(std::uint64_t which) {
    if (base_.has_value() && which_ == which) return;
    which_ = which;
    Draw draw(seed_of(arguments_.seed + 1000003, which));
    const std::optional<Mount> mount = draw_mount(arguments_, &draw);
    settings_ = mount.has_value() ? settings_of(*mount) : pose_wall::test::encounter_settings();
    road_ = pose_wall::test::draw_run_up(&draw, settings_);
    finish(arguments_, mount, &road_, &draw);
    if (arguments_.is_dusty) put_dust(&draw, arguments_.density_per_m, &road_);
    base_.emplace(road_, settings_, &driven_, &draw);
    base_->run_up(draw.within(4.8, 7.0));
    driven_.keep();
  }

  Arguments arguments_;
  pose_wall_planar_stop_settings settings_{};  // of the run-up
  StopUnderTest still_, driven_;
  Plan road_;
  std::optional<Encounter> base_;
  std::uint64_t which_ = 0;
};

using Count = unsigned long long;

struct Tally {
  Count runs = 0, moved = 0, stopped = 0, fast = 0, contacts = 0, creeping = 0;  // contacts: faster than creeping speed

  void add(const Outcome& out, double creeping_m_s) {
    const bool creeps = out.contact && out.contact_m_s <= creeping_m_s;
    ++runs;
    moved += out.moved_m > 0.1 ? 1 : 0;
    stopped += out.stops > 0 ? 1 : 0;
    fast += out.top_near_m_s >= 0.9 ? 1 : 0;
    contacts += out.contact && !creeps ? 1 : 0;
    creeping += creeps ? 1 : 0;
  }
  void print(const char* name) const {
    std::printf(
        "%-15s %7llu encounters, moved in %7llu, 0.9 m/s near a thing in %7llu, stopped from motion in %7llu, "
        "contacts %llu, creeping %llu\n",
        name, runs, moved, fast, stopped, contacts, creeping);
  }
};

void print_contact(Count k, const Plan& plan, const Outcome& out) {
  std::printf("contact: encounter %llu %s drive %d sensor %s at x %.2f z %.2f m loss %d at %.2f s, %.2f m/s\n", k,
              pose_wall::test::name_of(plan.kind), static_cast<int>(plan.drive),
              pose_wall::test::row_of(plan.sensor.pattern).name, plan.sensor.x_m, plan.sensor.z_m,
              static_cast<int>(plan.loss), out.contact_s, out.contact_m_s);
}

int encounters(const Arguments& a) {
  Encounters all(a);
  constexpr auto kKinds = static_cast<std::size_t>(pose_wall::test::Kind::kinds);
  Tally tallies[kKinds] = {}, total;
  Count frames = 0, lost = 0;
  double metres = 0.0;
  const double creeping_m_s = pose_wall::planar::creeping_speed_m_s(pose_wall::test::encounter_settings());
  const std::uint64_t first = a.has_only ? a.only : 0, end = a.has_only ? a.only + 1 : a.encounters;
  for (std::uint64_t k = first; k < end; ++k) {
    Plan plan;
    const Outcome out = all.run(k, &plan);
    tallies[static_cast<std::size_t>(plan.kind)].add(out, creeping_m_s);
    total.add(out, creeping_m_s);
    frames += out.frames, metres += out.moved_m;
    lost += plan.loss != pose_wall::test::Loss::none && plan.loss_from_s < out.lasted_s ? 1 : 0;
    if (out.contact) print_contact(k, plan, out);
    if (out.contact || (k + 1) % 500 == 0) {
      std::printf("after %llu: %llu contacts, creeping %llu\n", total.runs, total.contacts, total.creeping);
      std::fflush(stdout);
    }
  }
  for (std::size_t k = 1; k < kKinds; ++k) tallies[k].print(name_of(static_cast<pose_wall::test::Kind>(k)));
  total.print("all");
  std::printf("seed %llu: %llu frames, %.0f m, sensor lost in %llu\n", Count{a.seed}, frames, metres, lost);
  return total.contacts == 0 ? 0 : 1;
}

// A road without things, with or without thin dust.
Plan draw_clear(Draw* draw, const pose_wall_planar_stop_settings& settings, double density_per_m) {
  Plan plan = pose_wall::test::draw_run_up(draw, settings);
  plan.machine.set_arc(1.0, 0.0);
  plan.machine.yaw_rad = 0.0;
  plan.wish_m_s = draw->happens(0.3) ? 1.0 : draw->within(0.5, 1.0);
  plan.lasts_s = 60.0;
  if (density_per_m > 0.0) put_dust(draw, density_per_m, &plan);
  return plan;
}

// Every stop on such a road is a false one.
int false_stops(const Arguments& a, bool has_dust) {
  StopUnderTest stop;
  const double hours = has_dust ? a.dust_h : a.clear_h;
  Outcome all;
  std::uint64_t runs = 0, stuck = 0;
  for (std::uint64_t k = a.only; all.lasted_s < hours * 3600.0 && k < 1000000; ++k, ++runs) {
    Draw draw(seed_of(a.seed + 77, k));
    const std::optional<Mount> mount = draw_mount(a, &draw);
    const auto settings = mount.has_value() ? settings_of(*mount) : pose_wall::test::encounter_settings();
    Plan plan = draw_clear(&draw, settings, has_dust ? a.density_per_m : 0.0);
    finish(a, mount, &plan, &draw);
    Encounter encounter(plan, settings, &stop, &draw);
    if (a.has_only) encounter.tell_stops();
    const Outcome out = encounter.run();
    all.drove_s += out.drove_s, all.moved_m += out.moved_m, all.lasted_s += out.lasted_s;
    all.stops += out.stops;
    stuck += out.lasted_s < plan.lasts_s - 1.0 ? 1 : 0;
    for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) all.stops_by[bit] += out.stops_by[bit];
  }
  std::printf(
      "%s: %u stops in %.2f h, %.2f h of them driving, %.0f m: %.1f an hour of driving; it stood at the end of "
      "%llu of %llu runs\n",
      has_dust ? "dust" : "clear", all.stops, all.lasted_s / 3600.0, all.drove_s / 3600.0, all.moved_m,
      all.drove_s > 0.0 ? all.stops * 3600.0 / all.drove_s : 0.0, Count{stuck}, Count{runs});
  for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
    if (all.stops_by[bit] > 0) std::printf("  %s %u\n", pose_wall_planar_stop_reason_name(bit), all.stops_by[bit]);
  }
  return 0;
}

int list_mounts() {
  for (const Mount& mount : pose_wall::test::mounts_named("")) std::printf("%s\n", mount.name.c_str());
  return 0;
}

int table(const Arguments& a) {
  pose_wall::test::MountTable table(a.table_min, a.seed, a.has_rock);
  for (const Mount& mount : a.mounts.empty() ? pose_wall::test::mounts_named("") : a.mounts) table.add(mount);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments a = arguments_of(argc, argv);
  if (a.lists) return list_mounts();
  if (a.table_min > 0.0) return table(a);
  if (a.clear_h > 0.0) return false_stops(a, false);
  if (a.dust_h > 0.0) return false_stops(a, true);
  return encounters(a);
}
