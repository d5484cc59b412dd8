// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The only extern "C" file of localisation: checks arguments, translates, calls.

#include "pose_wall_planar_localise.h"

#include <limits>

#include "part/shell.hpp"
#include "planar/localise/localiser.hpp"

namespace pose_wall::planar {
namespace {

using Opened = Held<Localiser, 0x65736C6163636F6CULL>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // what is not known, as the header says

constexpr SettingRow kRows[] = {
#define POSE_WALL_SETTING(...) POSE_WALL_SETTING_ROW(pose_wall_planar_localise_settings, __VA_ARGS__)
#include "pose_wall_planar_localise_settings.def"
};

struct LocaliseTable : SettingsTable<LocaliseSettings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows() { return rows_of(kRows); }
};

bool are_points(const float* xy_m, std::uint32_t points) {
  constexpr float kFarthest_m = 2000.0F;  // from base: half of the square that a map may lie in
  for (std::uint32_t k = 0; k < 2 * points; ++k) {
    if (!(xy_m[k] >= -kFarthest_m && xy_m[k] <= kFarthest_m)) return false;
  }
  return true;
}

bool add_points(PlaceMap* map, const Pose2& pose, const float* xy_m, std::uint32_t points) {
  constexpr std::uint32_t kAtOnce = 64;  // points: half a kilobyte of stack
  ScanPoint room[kAtOnce];
  bool fits = true;
  for (std::uint32_t first = 0; first < points; first += kAtOnce) {
    const std::uint32_t count = points - first < kAtOnce ? points - first : kAtOnce;
    for (std::uint32_t k = 0; k < count; ++k) room[k] = {xy_m[2 * (first + k)], xy_m[2 * (first + k) + 1]};
    fits = map->add(Span<const ScanPoint>(room, count), pose) && fits;
  }
  return fits;
}

bool is_grid(const pose_wall_planar_grid& grid) {
  return grid.width >= 1 && grid.width <= POSE_WALL_PLANAR_GRID_SIDE_MAX && grid.height >= 1 &&
         grid.height <= POSE_WALL_PLANAR_GRID_SIDE_MAX && is_within(grid.resolution_m, 0.01, 1.0) &&
         is_place(grid.origin_x_m, grid.origin_y_m);
}

bool add_cells(PlaceMap* map, const pose_wall_planar_grid& grid) {
  constexpr std::int8_t kFree = 35, kThing = 65, kMost = 100;  // as the header says
  bool fits = true;
  for (std::uint32_t row = 0; row < grid.height; ++row) {
    for (std::uint32_t column = 0; column < grid.width; ++column) {
      const std::int8_t cell = grid.cells[static_cast<std::uint64_t>(row) * grid.width + column];
      const Eigen::Vector2d place(grid.origin_x_m + (column + 0.5) * grid.resolution_m,
                                  grid.origin_y_m + (row + 0.5) * grid.resolution_m);
      if (cell >= kThing && cell <= kMost) fits = map->add_surface(place) && fits;
      if (cell >= 0 && cell <= kFree) fits = map->add_free(place) && fits;
    }
  }
  return fits;
}

void write_place(const Localiser& own, pose_wall_planar_localise_result* out) {
  const bool is_placed = out->state >= POSE_WALL_PLANAR_LOCALISE_UNIQUE;
  out->pose = {kNone, kNone, kNone};
  for (double& value : out->covariance) value = kNone;
  out->fits = out->explained = out->misfit_m = out->slide_m = kNone;
  if (is_placed) {
    const auto& follower = own.follower();
    out->pose = pose_for_caller(follower.pose());
    for (int k = 0; k < 9; ++k) out->covariance[k] = follower.covariance()(k / 3, k % 3);
    out->fits = follower.verdict().fits;
    out->explained = follower.fit().explained;
    out->misfit_m = follower.fit().rms_m;
    out->slide_m = follower.slide_m();
  } else if (own.verdict().count > 0) {
    const auto& best = own.verdict().best;
    out->fits = best.fits;
    out->explained = best.explained;
    out->misfit_m = best.rms_m;
    out->slide_m = best.slide_m;
  }
}

void write_result(const Localiser& own, Where where, std::int64_t stamp_ns, pose_wall_planar_localise_result* result) {
  pose_wall_planar_localise_result out{};
  out.struct_size = sizeof(out);
  out.state = static_cast<std::uint32_t>(where);
  out.reason = static_cast<std::uint32_t>(own.why());
  out.stamp_ns = stamp_ns;
  write_place(own, &out);
  const auto& verdict = own.verdict();
  out.rival = verdict.count > 0 ? verdict.best.rival : kNone;
  out.progress = own.search().progress();
  out.candidates = own.is_tracking() ? 0 : verdict.count;
  out.candidates_all = own.is_tracking() ? 0 : verdict.all;
  out.searches = own.searches();
  out.lost = own.lost();
  *result = out;
}

constexpr const char* kStates[] = {"searching", "unknown", "ambiguous", "unique", "doubtful"};
// In the order of Why.
constexpr const char* kReasons[] = {"none",   "searching",    "no_fit",       "several", "crowded",
                                    "misfit", "unseen",       "through",      "few",     "slides",
                                    "smooth", "scan_differs", "contradicted", "repeated"};
static_assert(sizeof(kReasons) / sizeof(kReasons[0]) == POSE_WALL_PLANAR_LOCALISE_REASONS);
static_assert(static_cast<std::uint32_t>(Why::repeated) + 1 == POSE_WALL_PLANAR_LOCALISE_REASONS);

}  // namespace

extern "C" {

POSE_WALL_EXPORT const char* pose_wall_planar_localise_state_name(uint32_t state) {
  return state < sizeof(kStates) / sizeof(kStates[0]) ? kStates[state] : "?";
}

POSE_WALL_EXPORT const char* pose_wall_planar_localise_reason_name(uint32_t reason) {
  return reason < POSE_WALL_PLANAR_LOCALISE_REASONS ? kReasons[reason] : "?";
}

POSE_WALL_SETTINGS_CALLS(pose_wall_planar_localise, LocaliseTable, pose_wall_planar_fault)
POSE_WALL_BLOCK_CALLS(pose_wall_planar_localise, Opened, LocaliseTable, pose_wall_planar_localise)

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_clear(pose_wall_planar_localise* localise) {
  return with_part<Opened>(localise, [](Localiser& own) { own.clear(); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_add(pose_wall_planar_localise* localise,
                                                       const pose_wall_planar_pose* pose, const float* xy_m,
                                                       uint32_t points) {
  if (pose == nullptr || xy_m == nullptr) return POSE_WALL_E_NULL;
  if (!is_pose(*pose)) return POSE_WALL_PLANAR_E_POSE;
  if (points > POSE_WALL_PLANAR_BEAMS_MAX || !are_points(xy_m, points)) return POSE_WALL_PLANAR_E_SCAN;
  return with_part<Opened>(localise, [&](Localiser& own) -> std::int32_t {
    PlaceMap& map = own.map();
    if (map.is_finished()) return POSE_WALL_PLANAR_E_ORDER;
    return ok_if(add_points(&map, pose_of(*pose), xy_m, points), POSE_WALL_E_BLOCK_SMALL);
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_add_grid(pose_wall_planar_localise* localise,
                                                            const pose_wall_planar_grid* grid) {
  if (grid == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*grid); size != POSE_WALL_OK) return size;
  if (grid->cells == nullptr) return POSE_WALL_E_NULL;
  if (!is_grid(*grid)) return POSE_WALL_PLANAR_E_GRID;
  return with_part<Opened>(localise, [&](Localiser& own) -> std::int32_t {
    PlaceMap& map = own.map();
    if (map.is_finished()) return POSE_WALL_PLANAR_E_ORDER;
    return ok_if(add_cells(&map, *grid), POSE_WALL_E_BLOCK_SMALL);
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_finish(pose_wall_planar_localise* localise) {
  return with_part<Opened>(localise, [](Localiser& own) -> std::int32_t {
    PlaceMap& map = own.map();
    if (map.is_finished() || map.is_empty()) return POSE_WALL_PLANAR_E_ORDER;
    map.finish();
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_process(pose_wall_planar_localise* localise,
                                                           const pose_wall_planar_scan* scan,
                                                           const pose_wall_planar_pose* odometry,
                                                           pose_wall_planar_localise_result* result) {
  if (result == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*result); size != POSE_WALL_OK) return size;
  const std::int32_t status = check_scan(scan);
  if (status != POSE_WALL_OK) return status;
  if (odometry != nullptr && !is_pose(*odometry)) return POSE_WALL_PLANAR_E_POSE;
  return with_part<Opened>(localise, [&](Localiser& own) -> std::int32_t {
    if (!own.map().is_finished()) return POSE_WALL_PLANAR_E_ORDER;
    const Pose2 given = odometry != nullptr ? pose_of(*odometry) : Pose2();
    const Where where = own.process(read_beams(*scan, own.beams()), odometry != nullptr ? &given : nullptr);
    write_result(own, where, scan->stamp_ns, result);
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_candidate(const pose_wall_planar_localise* localise, uint32_t number,
                                                             pose_wall_planar_candidate* candidate) {
  if (candidate == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = check_struct(*candidate); size != POSE_WALL_OK) return size;
  return with_part<Opened>(localise, [&](const Localiser& own) -> std::int32_t {
    if (own.is_tracking() || number >= own.verdict().count) return POSE_WALL_E_INDEX;
    const CandidatePlace& place = own.verdict().candidates[number];
    pose_wall_planar_candidate out{};
    out.struct_size = sizeof(out);
    out.pose = pose_for_caller(own.now(place.pose));
    out.weight = place.weight;
    out.worse_by = place.worse_by > 0.0 ? place.worse_by : 0.0;
    out.fits = place.fits;
    out.spread_m = place.spread_m;
    *candidate = out;
    return POSE_WALL_OK;
  });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_place(pose_wall_planar_localise* localise,
                                                         const pose_wall_planar_pose* base, double sigma_m,
                                                         double sigma_rad) {
  if (base == nullptr) return POSE_WALL_E_NULL;
  if (!is_pose(*base)) return POSE_WALL_PLANAR_E_POSE;
  if (!is_within(sigma_m, 0.001, 1.0) || !is_within(sigma_rad, 0.001, 0.5)) return POSE_WALL_E_VALUE_RANGE;
  return with_part<Opened>(localise, [&](Localiser& own) { own.place(pose_of(*base), sigma_m, sigma_rad); });
}

POSE_WALL_EXPORT int32_t pose_wall_planar_localise_forget(pose_wall_planar_localise* localise) {
  return with_part<Opened>(localise, [](Localiser& own) { own.forget(); });
}

}  // extern "C"

}  // namespace pose_wall::planar
