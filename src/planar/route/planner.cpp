// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/planner.hpp"

#include "base/math/finite.hpp"
#include "planar/route/taut.hpp"

namespace pose_wall::planar::route {
namespace {

// Sweeps of pulling taut, in rows of cells; one takes some 9 ns.
constexpr std::uint64_t kRowsOfPulling = 4000000;

Footprint footprint_of(const pose_wall_planar_plan_settings& s) {
  return {s.front_m + s.margin_m, s.rear_m + s.margin_m, s.left_m + s.margin_m, s.right_m + s.margin_m};
}

std::uint32_t step_cells(const pose_wall_planar_plan_settings& s, std::uint32_t level) {
  const auto cells = static_cast<std::uint32_t>(s.lattice_m / s.resolution_m + 0.5);
  return level == 0 ? cells : cells / 2;
}

}  // namespace

void Planner::lay_out(Arena& arena, const pose_wall_planar_plan_settings& settings) {
  const double reach_cells = footprint_of(settings).reach_m() / settings.resolution_m;
  grid_.lay_out(arena, settings.width_max, settings.height_max);
  sweeps_.lay_out(arena, settings.height_max);
  lattice_[0].lay_out(arena, 32, reach_cells);
  lattice_[1].lay_out(arena, 64, reach_cells);
  narrow_ = lattice_[1].room_for_shape(arena);
  coarse_.lay_out(arena, settings.width_max / step_cells(settings, 1) + 1,
                  settings.height_max / step_cells(settings, 1) + 1);
  const std::uint32_t finest = step_cells(settings, 1);
  const std::uint32_t places = (settings.width_max / finest + 1) * (settings.height_max / finest + 1);
  field_.lay_out(arena, places);
  search_.lay_out(arena, places, settings.places_max, settings.open_max);
  corners_ = arena.take<Corner>(kCornersMost);
}

void Planner::open(const pose_wall_planar_plan_settings& settings) {
  settings_ = settings;
  costs_ = {settings.turn_cost_m_rad, settings.reverse_cost, settings.cusp_cost_m};
  for (std::uint32_t level = 0; level < kLevels; ++level) {
    lattice_[level].open(step_cells(settings, level), settings.resolution_m, footprint_of(settings));
  }
  has_grid_ = false;
}

bool Planner::read(const pose_wall_planar_grid& grid) {
  const double difference_m = grid.resolution_m - settings_.resolution_m;
  const bool fits = difference_m < 1e-9 && difference_m > -1e-9 && grid.width <= settings_.width_max &&
                    grid.height <= settings_.height_max;
  if (!fits || !grid_.read(grid, settings_.occupied_from)) return false;
  sweeps_.open(&grid_, footprint_of(settings_));
  has_grid_ = true;
  return true;
}

double Planner::clearance_m(const Eigen::Vector2d& at_m) const {
  constexpr double kMost_m = 5.0;  // farther things are told as this: the look costs its square
  if (!has_grid_) return not_a_number();
  const Eigen::Vector2d at = grid_.in_cells(at_m);
  const bool is_inside = at.x() > 0.0 && at.y() > 0.0 && at.x() < grid_.width() && at.y() < grid_.height();
  if (!is_inside) return 0.0;
  const auto column = static_cast<std::int32_t>(at.x() + 0.5), row = static_cast<std::int32_t>(at.y() + 0.5);
  const auto most = static_cast<std::int32_t>(kMost_m / settings_.resolution_m);
  return grid_.clearance(column, row, most) * settings_.resolution_m;
}

// On the spot, straight, on the spot.
bool Planner::go_straight() {
  for (const std::int32_t gear : {1, -1}) {
    const double yaw_rad = driving_yaw(start_.place(), goal_.place(), gear, start_.yaw_rad);
    const double length_m = (goal_.place() - start_.place()).norm();
    const double first_rad = wrapped(yaw_rad - start_.yaw_rad), last_rad = wrapped(goal_.yaw_rad - yaw_rad);
    const Pose2 leaving{start_.x_m, start_.y_m, yaw_rad}, arriving{goal_.x_m, goal_.y_m, yaw_rad};
    const double cost_m = costs_.of_stretch(length_m, gear) + costs_.of_turn(first_rad) + costs_.of_turn(last_rad);
    if (count_ == 2 && cost_m >= lower_m_) continue;
    const bool is_free = sweeps_.is_straight_free(leaving, gear * length_m) &&
                         sweeps_.is_turn_free(start_, first_rad) && sweeps_.is_turn_free(arriving, last_rad);
    if (!is_free) continue;
    corners_[0] = {start_.x_m, start_.y_m, yaw_rad, first_rad, gear, 0};
    corners_[1] = {goal_.x_m, goal_.y_m, goal_.yaw_rad, last_rad, 0, 0};
    count_ = 2;
    lower_m_ = cost_m;
  }
  // Worth it if hardly any way can be cheaper: length and turn at least.
  const double least_m =
      (goal_.place() - start_.place()).norm() + costs_.of_turn(wrapped(goal_.yaw_rad - start_.yaw_rad));
  const bool is_best = count_ == 2 && lower_m_ <= settings_.weight * least_m + 1e-9;
  if (is_best) {
    lower_m_ = least_m;
  } else {
    count_ = 0;
  }
  return is_best;
}

bool Planner::spread(const Lattice& lattice, const Shape& circle, std::uint32_t longest) {
  const LatticePlaces places = LatticePlaces::of(grid_, lattice.step_cells());
  if (places.count() > field_.capacity()) return false;
  coarse_.read_coarse(grid_, lattice.step_cells());
  field_.begin(&lattice, seen_by(lattice), &circle, places, longest);
  const CostToGo::Target about_goal = Search::around(grid_, lattice, goal_);
  for (std::int32_t r = about_goal.row - about_goal.reach; r <= about_goal.row + about_goal.reach; ++r) {
    for (std::int32_t c = about_goal.column - about_goal.reach; c <= about_goal.column + about_goal.reach; ++c) {
      if (!places.holds(c, r)) continue;
      const double step = lattice.step_cells();
      const double distance_m = (grid_.in_map(c * step, r * step) - goal_.place()).norm();
      field_.seed(places.number(c, r), static_cast<std::uint32_t>(distance_m / kUnits_m));
    }
  }
  return field_.spread(Search::around(grid_, lattice, start_));
}

// Every way can be driven both ways. Where the machine got stuck at once on its way from the goal, no search from the
// start could come, and it would look everywhere first.
bool Planner::can_leave_goal(const Search::Task& task, pose_wall_planar_plan_result* result) {
  constexpr std::uint32_t kExpansions = 500;  // few beside those of a search, which hurries after 25,000
  Search::Task probe = task;
  probe.start = goal_;
  probe.weight = 0.0;
  probe.hurry_after = 0;
  probe.is_probe = true;
  if (probe.expansions_most > kExpansions) probe.expansions_most = kExpansions;
  const bool is_left = search_.run(probe) != Found::none;
  if (!is_left) result->expansions += search_.expansions();
  return is_left;
}

std::uint32_t Planner::search(pose_wall_planar_plan_result* result) {
  Found found = Found::none;
  is_goal_tight_ = false;
  for (std::uint32_t level = 0; level < kLevels && found != Found::way; ++level) {
    const Lattice& lattice = lattice_[level];
    if (!spread(lattice, lattice.circle(), kUnitsMost)) continue;
    const Search::Task task{&lattice,
                            seen_by(lattice),
                            &field_,
                            &sweeps_,
                            LatticePlaces::of(grid_, lattice.step_cells()),
                            costs_,
                            settings_.weight,
                            settings_.hurry_after,
                            start_,
                            goal_,
                            settings_.expansions_max - result->expansions};
    is_goal_tight_ = !can_leave_goal(task, result);
    if (is_goal_tight_) continue;
    found = search_.run(task);
    result->expansions += search_.expansions();
    result->places = search_.places();
    ++result->searches;
    if (found == Found::work_spent) return POSE_WALL_PLANAR_PLAN_WORK_LIMIT;
  }
  if (found == Found::list_full) return POSE_WALL_PLANAR_PLAN_LIST_FULL;
  if (found != Found::way) return POSE_WALL_PLANAR_PLAN_TOO_TIGHT;
  count_ = search_.write(corners_);
  lower_m_ = search_.least_cost_m();
  result->search_cost_m = search_.cost_m();
  return count_ > 0 ? POSE_WALL_PLANAR_PLAN_FOUND : POSE_WALL_PLANAR_PLAN_LIST_FULL;
}

void Planner::plan(const Pose2& start, const Pose2& goal, Span<pose_wall_planar_path_pose> poses,
                   pose_wall_planar_plan_result* result) {
  start_ = start;
  goal_ = goal;
  count_ = 0;
  const double none = not_a_number();
  *result = {sizeof(*result),
             POSE_WALL_PLANAR_PLAN_FOUND,
             0,
             0,
             0,
             0,
             0,
             0,
             none,
             none,
             none,
             none,
             none,
             {none, none, none},
             none};
  if (!sweeps_.is_pose_free(start)) {
    result->outcome = POSE_WALL_PLANAR_PLAN_START_BLOCKED;
  } else if (!sweeps_.is_pose_free(goal)) {
    result->outcome = POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED;
  } else if (!go_straight()) {
    result->outcome = search(result);
  }
  if (result->outcome == POSE_WALL_PLANAR_PLAN_TOO_TIGHT) explain(result);
  if (result->outcome == POSE_WALL_PLANAR_PLAN_FOUND) finish(poses, result);
}

void Planner::finish(Span<pose_wall_planar_path_pose> poses, pose_wall_planar_plan_result* result) {
  if (count_ > 2) {
    Taut taut(&sweeps_, costs_, corners_, count_, start_.yaw_rad, kRowsOfPulling);
    taut.pull();
    count_ = taut.count();
  }
  const Rounding rounding{settings_.radius_min_m, settings_.radius_max_m, settings_.pose_step_m};
  const Written written = write_poses(corners_.first(count_), start_, costs_, rounding, &sweeps_, poses);
  if (written.poses > poses.size()) result->outcome = POSE_WALL_PLANAR_PLAN_ROOM_SMALL;
  result->poses = written.poses;
  result->cusps = written.cusps;
  result->spot_turns = written.spot_turns;
  result->length_m = written.length_m;
  result->turning_rad = written.turning_rad;
  result->cost_m = written.cost_m;
  if (result->searches == 0) result->search_cost_m = written.cost_m;
  result->bound = lower_m_ > 0.0 ? larger(written.cost_m / lower_m_, 1.0) : 1.0;
}

// The circle of the machine may not pass either: then how wide is the widest way? All fields of this question together
// look at fewer places than the last search's field, whose lattice has 64 headings: they go by at most eight.
void Planner::explain(pose_wall_planar_plan_result* result) {
  const double machine_cells = footprint_of(settings_).inscribed_m() / settings_.resolution_m;
  if (is_goal_tight_) {
    result->place = pose_for_caller(goal_);
    return;
  }
  if (result->searches > 0) {
    const Eigen::Vector2d nearest = search_.nearest_m();
    result->place = {nearest.x(), nearest.y(), not_a_number()};
    return;
  }
  double fits = 0.1, does_not = machine_cells;  // less than a cell: hardly more than a point
  if (!is_wide_enough(fits)) {
    result->outcome = POSE_WALL_PLANAR_PLAN_NOT_CONNECTED;
    return;
  }
  constexpr std::uint32_t kHalvings = 10;  // of 500 cells at most to half a cell
  for (std::uint32_t k = 0; k < kHalvings && does_not - fits > 0.5; ++k) {
    const double middle = 0.5 * (fits + does_not);
    (is_wide_enough(middle) ? fits : does_not) = middle;
  }
  result->outcome = POSE_WALL_PLANAR_PLAN_TOO_NARROW;
  if (is_wide_enough(fits)) find_bottleneck(fits, result);
}

// From neighbour to neighbour; to one across a corner where the circle covers what lies between.
bool Planner::is_wide_enough(double radius_cells) {
  lattice_[1].write_circle(radius_cells, &narrow_);
  const double step_cells = lattice_[1].step_cells(), step = lattice_[1].step_m() / kUnits_m;
  constexpr double kRoot2 = 1.41421356237309505;  // the diagonal of a cell
  const double longest =
      2.0 * radius_cells >= kRoot2 * step_cells ? 1.5 * step : 1.1 * step;  // the next are 1, 1.41, 2
  return spread(lattice_[1], narrow_, static_cast<std::uint32_t>(longest));
}

// Down the field from the start to the goal. Where the way cuts corners it is as near to the rock as in the narrow
// stretch, but not for as long: the middle of the longest stretch with no more room is the place.
void Planner::find_bottleneck(double fits_cells, pose_wall_planar_plan_result* result) {
  const std::int32_t step = lattice_[1].step_cells();
  const LatticePlaces places = LatticePlaces::of(grid_, step);
  const auto most = static_cast<std::int32_t>(fits_cells) + 3;
  const auto room_at = [&](std::uint32_t place) {
    return grid_.clearance(places.column(place) * step, places.row(place) * step, most);
  };
  std::uint32_t at = field_.nearest_of_target(), longest = 0, longest_end = 0, run = 0;
  for (std::uint32_t k = 0; k < places.count(); ++k) {
    run = room_at(at) <= fits_cells + 1.0 ? run + 1 : 0;
    if (run > longest) {
      longest = run;
      longest_end = k;
    }
    const std::uint32_t next = field_.step_down(at);
    if (next == at) break;
    at = next;
  }
  at = field_.nearest_of_target();
  for (std::uint32_t k = 0; k + longest / 2 < longest_end; ++k) at = field_.step_down(at);
  const Eigen::Vector2d middle = grid_.in_map(places.column(at) * step, places.row(at) * step);
  result->place = {middle.x(), middle.y(), not_a_number()};
  result->width_m = 2.0 * room_at(at) * settings_.resolution_m;
}

}  // namespace pose_wall::planar::route
