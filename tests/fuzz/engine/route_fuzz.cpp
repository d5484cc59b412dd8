// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: routes and what follows them. Grids of any cells, starts and goals anywhere, settings that pass their
// check. A route begins at its start, ends at its goal, has lengths that rise, and no pose of it stands on a cell that
// is not driven on. The tracker gets these routes, and routes of any numbers, with poses and times that are anything.
// Its commands stay within the settings, and without a good pose they are 0.

#include "fuzz/fuzz_target.hpp"
#include "fuzz/scans_from_input.hpp"
#include "fuzz/stamps_from_input.hpp"
#include "pose_wall_planar_plan.h"
#include "pose_wall_planar_track.h"

namespace {

using namespace pose_wall::test;  // NOLINT(google-build-using-namespace): one target, one file

constexpr std::uint32_t kSide = 160, kPosesMax = 512;
constexpr int kStepsMax = 40;

struct Grid {
  pose_wall_planar_grid grid;
  std::int8_t cells[kSide * kSide];
};

// Free, with blocks; or any bytes.
void draw(Input* input, double resolution_m, Grid* out) {
  std::memset(&out->grid, 0, sizeof out->grid);
  out->grid.struct_size = sizeof out->grid;
  out->grid.width = 60 + input->below(kSide - 59);
  out->grid.height = 60 + input->below(kSide - 59);
  out->grid.resolution_m = resolution_m;
  out->grid.origin_x_m = input->between(-100.0, 100.0);
  out->grid.origin_y_m = input->between(-100.0, 100.0);
  out->grid.cells = out->cells;
  const std::uint8_t how = input->byte();
  const std::uint32_t count = out->grid.width * out->grid.height;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto chance = static_cast<std::uint8_t>(scramble(k + how) & 0xFFU);
    out->cells[k] = how >= 250                                           ? static_cast<std::int8_t>(input->byte())
                    : chance < how % 8U && (how & 8U) != 0 && chance > 4 ? std::int8_t{100}
                                                                         : std::int8_t{0};
  }
  for (std::uint32_t block = input->below(4); block > 0; --block) {
    const std::uint32_t left = input->below(out->grid.width), low = input->below(out->grid.height);
    const std::uint32_t right = left + input->below(24), high = low + input->below(24);
    const std::int8_t value = (block & 1U) != 0 ? std::int8_t{100} : std::int8_t{-1};
    for (std::uint32_t row = low; row <= high && row < out->grid.height; ++row) {
      for (std::uint32_t column = left; column <= right && column < out->grid.width; ++column) {
        out->cells[row * out->grid.width + column] = value;
      }
    }
  }
}

pose_wall_planar_pose pose_on(Input* input, const pose_wall_planar_grid& grid) {
  const std::uint8_t how = input->byte();
  if (how == 255) return any_pose(input);
  return {grid.origin_x_m + grid.width * grid.resolution_m * input->between(0.1, 0.9),
          grid.origin_y_m + grid.height * grid.resolution_m * input->between(0.1, 0.9), input->between(-7.0, 7.0)};
}

pose_wall_planar_plan_settings plan_settings_by(Input* input) {
  pose_wall_planar_plan_settings settings;
  require_ok(pose_wall_planar_plan_settings_init(&settings), "settings");
  settings.width_max = settings.height_max = kSide;
  settings.places_max = 4000;
  settings.open_max = 1000 + 40 * input->below(256);
  settings.expansions_max = 1 + 80 * input->below(256);
  settings.hurry_after = 100 * input->below(64);
  settings.front_m = input->between(0.3, 2.5);
  settings.rear_m = input->between(0.3, 2.5);
  settings.left_m = input->between(0.2, 1.0);
  settings.right_m = input->between(0.2, 1.0);
  settings.margin_m = input->between(0.0, 0.3);
  settings.lattice_m = (settings.front_m + settings.rear_m) / 8.0;
  settings.resolution_m = settings.lattice_m / (2 + input->below(4));
  settings.reverse_cost = input->between(1.0, 4.0);
  settings.weight = input->between(1.0, 3.0);
  require_ok(pose_wall_planar_plan_settings_check(&settings, nullptr), "settings that pass");
  return settings;
}

bool is_driven_on(const pose_wall_planar_grid& grid, std::uint32_t occupied_from, double x_m, double y_m) {
  const double column = std::floor((x_m - grid.origin_x_m) / grid.resolution_m);
  const double row = std::floor((y_m - grid.origin_y_m) / grid.resolution_m);
  if (!(column >= 0.0 && column < grid.width && row >= 0.0 && row < grid.height)) return false;
  const int cell = grid.cells[static_cast<std::uint32_t>(row) * grid.width + static_cast<std::uint32_t>(column)];
  return cell >= 0 && static_cast<std::uint32_t>(cell) < occupied_from;
}

void require_route(const pose_wall_planar_grid& grid, const pose_wall_planar_plan_settings& settings,
                   const pose_wall_planar_path_pose* poses, std::uint32_t count) {
  double along_m = 0.0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const pose_wall_planar_path_pose& p = poses[k];
    require(is_finite(p.pose) && std::isfinite(p.curvature_1_m), "a route of numbers");
    require(p.along_m >= along_m, "a length that rises");
    require(p.drive >= -1 && p.drive <= 1, "forwards, backwards or on the spot");
    const double c = std::cos(p.pose.yaw_rad), s = std::sin(p.pose.yaw_rad);
    for (const double x : {settings.front_m, -settings.rear_m, 0.0}) {
      for (const double y : {settings.left_m, -settings.right_m, 0.0}) {
        require(is_driven_on(grid, settings.occupied_from, p.pose.x_m + c * x - s * y, p.pose.y_m + s * x + c * y),
                "corners and middles stand where the machine may drive");
      }
    }
    along_m = p.along_m;
  }
}

// Returns how many poses the route has.
std::uint32_t plan(Input* input, pose_wall_planar_path_pose* poses) {
  static KeptBlock block;
  static Grid drawn;
  const pose_wall_planar_plan_settings settings = plan_settings_by(input);
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_plan_memory_needed(&settings, &bytes), "memory_needed");
  pose_wall_planar_planner* planner = nullptr;
  require_ok(pose_wall_planar_plan_open(&settings, block.filled(bytes, 0xA5), bytes, &planner), "open");
  draw(input, settings.resolution_m, &drawn);
  const pose_wall_planar_pose start = pose_on(input, drawn.grid), goal = pose_on(input, drawn.grid);
  pose_wall_planar_plan_result result{};
  result.struct_size = sizeof result;
  const std::int32_t status = pose_wall_planar_plan(planner, &drawn.grid, &start, &goal, poses, kPosesMax, &result);
  if (status != POSE_WALL_OK) {
    require(status == POSE_WALL_PLANAR_E_POSE || status == POSE_WALL_PLANAR_E_GRID, "a refusal that the header knows");
    return 0;
  }
  require(result.outcome <= POSE_WALL_PLANAR_PLAN_ROOM_SMALL, "a known outcome");
  require(std::isnan(result.length_m) ==
              (result.outcome != POSE_WALL_PLANAR_PLAN_FOUND && result.outcome != POSE_WALL_PLANAR_PLAN_ROOM_SMALL),
          "a length iff a route");
  if (result.outcome != POSE_WALL_PLANAR_PLAN_FOUND) return 0;
  require(result.poses >= 1 && result.poses <= kPosesMax, "as many poses as there is room");
  require(result.bound >= 1.0, "a bound of 1 or more");
  require(poses[0].pose.x_m == start.x_m && poses[0].pose.y_m == start.y_m, "it begins at the start");
  const pose_wall_planar_pose& end = poses[result.poses - 1].pose;
  require(std::fabs(end.x_m - goal.x_m) < 1e-6 && std::fabs(end.y_m - goal.y_m) < 1e-6, "it ends at the goal");
  require_route(drawn.grid, settings, poses, result.poses);
  return result.poses;
}

// A route that no planner wrote.
std::uint32_t any_route(Input* input, pose_wall_planar_path_pose* poses) {
  const std::uint32_t count = input->below(20);
  double along_m = 0.0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint8_t how = input->byte();
    along_m += input->between(0.0, 2.0);
    poses[k].pose = how == 255
                        ? any_pose(input)
                        : pose_wall_planar_pose{input->between(-5, 5), input->between(-5, 5), input->between(-4, 4)};
    poses[k].curvature_1_m = how == 254 ? input->take<double>() : input->between(-2.0, 2.0);
    poses[k].along_m = how == 253 ? input->take<double>() : along_m;
    poses[k].drive = how == 252 ? input->take<std::int32_t>() : static_cast<std::int32_t>(input->below(3)) - 1;
    poses[k].flags = input->byte();
  }
  return count;
}

void require_command(const pose_wall_planar_track_command& c, const pose_wall_planar_track_settings& settings) {
  require(c.state <= POSE_WALL_PLANAR_TRACK_NO_POSE && c.slowed_by <= POSE_WALL_PLANAR_SLOWED_BY_STOP, "a known state");
  require(std::fabs(c.speed_m_s) <= settings.speed_max_m_s + 1e-9, "no faster than allowed");
  require(std::fabs(c.turn_rad_s) <= settings.turn_max_rad_s + 1e-9, "turns no faster than allowed");
  require(std::isfinite(c.left_m_s) && std::isfinite(c.right_m_s), "tracks have speeds");
  const bool stands = c.state == POSE_WALL_PLANAR_TRACK_IDLE || c.state == POSE_WALL_PLANAR_TRACK_DONE ||
                      c.state == POSE_WALL_PLANAR_TRACK_OFF_PATH || c.state == POSE_WALL_PLANAR_TRACK_NO_POSE;
  require(!stands || (c.speed_m_s == 0.0 && c.turn_rad_s == 0.0), "it stands");
}

double any_clearance(void* context, double x_m, double y_m) {
  require(std::isfinite(x_m) && std::isfinite(y_m), "it asks about places");
  return *static_cast<const double*>(context);
}

void track(Input* input, const pose_wall_planar_path_pose* poses, std::uint32_t count) {
  static KeptBlock block;
  pose_wall_planar_track_settings settings;
  require_ok(pose_wall_planar_track_settings_init(&settings), "settings");
  settings.path_max = kPosesMax;
  std::uint64_t bytes = 0;
  require_ok(pose_wall_planar_track_memory_needed(&settings, &bytes), "memory_needed");
  pose_wall_planar_tracker* tracker = nullptr;
  require_ok(pose_wall_planar_track_open(&settings, block.filled(bytes, 0xA5), bytes, &tracker), "open");
  double clearance_m = input->byte() < 200 ? input->between(0.0, 3.0) : input->take<double>();
  const std::int32_t status = pose_wall_planar_track_route(tracker, poses, count, any_clearance, &clearance_m);
  require(status == POSE_WALL_OK || status == POSE_WALL_PLANAR_E_POSE || status == POSE_WALL_E_VALUE_RANGE,
          "a known refusal");
  pose_wall_planar_track_input now{};
  now.struct_size = sizeof now;
  if (count > 0) now.pose = poses[0].pose;
  for (int k = 0; k < kStepsMax && !input->empty(); ++k) {
    move_stamp(input, {200, 215, 230}, &now.now_ns);
    const std::uint8_t with = input->byte();
    now.has_pose = with % 8U != 0 ? 1 : 0;
    now.pose_ns = with % 16U != 3 ? now.now_ns : input->take<std::int64_t>();
    if (with % 16U == 5) now.pose = any_pose(input);
    if (with % 16U == 6 && count > 0) now.pose = poses[input->below(256) % count].pose;
    now.pose_level_m = with % 16U == 7 ? input->take<double>() : 0.05;
    now.speed_m_s = with % 16U == 9 ? input->take<double>() : std::nan("");
    pose_wall_planar_track_command command{};
    command.struct_size = sizeof command;
    require_ok(pose_wall_planar_track_step(tracker, &now, &command), "step");
    require_command(command, settings);
    const bool good = now.has_pose != 0 && is_finite(now.pose) && now.pose_level_m <= settings.pose_level_max_m;
    require(good || (command.speed_m_s == 0.0 && command.turn_rad_s == 0.0), "without a good pose it stands");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static pose_wall_planar_path_pose poses[kPosesMax];
  Input input(data, size);
  const bool planned = input.byte() % 4U != 0;
  const std::uint32_t count = planned ? plan(&input, poses) : any_route(&input, poses);
  track(&input, poses, count);
  return 0;
}
