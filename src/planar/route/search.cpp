// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/search.hpp"

#include <cmath>

namespace pose_wall::planar::route {
namespace {

std::uint32_t units(double cost_m) {
  const double whole = cost_m / kUnits_m + 0.5;
  return whole < static_cast<double>(kUnitsMost) ? static_cast<std::uint32_t>(whole) : kUnitsMost;
}

std::int32_t sign_of(std::uint32_t gear) {
  return gear == 0 ? 1 : -1;
}

}  // namespace

void Search::lay_out(Arena& arena, std::uint32_t places_table, std::uint32_t places_entered, std::uint32_t open_most) {
  entries_most_ = places_entered;
  entry_of_place_ = arena.take<std::uint32_t>(places_table);
  place_of_entry_ = arena.take<std::uint32_t>(places_entered);
  for (auto* bits : {&standing_known_, &standing_free_, &turning_known_, &turning_free_}) {
    *bits = arena.take<std::uint64_t>(places_entered);
  }
  cost_ = arena.take<std::uint32_t>(places_entered * kHeadingsMost);
  how_ = arena.take<std::uint8_t>(places_entered * kHeadingsMost);
  yaw_units_ = arena.take<std::uint32_t>(kHeadingsMost);
  open_.lay_out(arena, open_most);
}

CostToGo::Target Search::around(const BitGrid& grid, const Lattice& lattice, const Pose2& pose) {
  const Eigen::Vector2d at = grid.in_cells(pose.place()) / lattice.step_cells();
  return {static_cast<std::int32_t>(at.x() + 0.5), static_cast<std::int32_t>(at.y() + 0.5), kReach};
}
CostToGo::Target Search::around(const Pose2& pose) const {
  return around(*task_.grid.exact, *task_.lattice, pose);
}

void Search::clear() {
  gears_ = task_.costs.cusp_m > 0.0 ? 2 : 1;
  slots_ = task_.lattice->headings() * gears_;
  entry_of_place_.first(task_.places.count()).fill(kNone);
  open_.clear();
  entries_ = expansions_ = 0;
  best_ = least_missed_ = nearest_ = kUnitsMost;
  best_parent_ = kNone;
  nearest_place_ = 0;
  is_full_ = false;
  for (std::uint32_t k = 0; k < task_.lattice->headings(); ++k) {
    yaw_units_[k] = turn_units(wrapped(task_.lattice->heading(k).yaw_rad - task_.goal.yaw_rad));
  }
}

Search::State Search::state_of(std::uint32_t number) const {
  const std::uint32_t slot = number % slots_;
  return {number, number / slots_, slot / gears_, gears_ == 2 ? slot & 1 : 0};
}

// The entry of a place; kNone if there is no room, or if the circle does not fit there.
std::uint32_t Search::entry_of(std::uint32_t place) {
  std::uint32_t& entry = entry_of_place_[place];
  if (entry != kNone) return entry;
  if (task_.field->at(place) >= kUnitsMost) return kNone;
  const std::uint32_t room = static_cast<std::uint32_t>(cost_.size() / slots_);
  if (entries_ == entries_most_ || entries_ == room) {
    is_full_ = true;
    return kNone;
  }
  entry = entries_++;
  place_of_entry_[entry] = place;
  standing_known_[entry] = standing_free_[entry] = turning_known_[entry] = turning_free_[entry] = 0;
  for (std::uint32_t k = 0; k < slots_; ++k) cost_[entry * slots_ + k] = kUnitsMost;
  return entry;
}

Eigen::Vector2d Search::place_m(std::uint32_t place) const {
  const double step = task_.lattice->step_cells();
  return task_.grid.exact->in_map(task_.places.column(place) * step, task_.places.row(place) * step);
}

Eigen::Vector2d Search::nearest_m() const {
  return place_m(nearest_place_);
}

bool Search::is_standing_free(std::uint32_t entry, std::uint32_t heading) {
  const std::uint64_t bit = 1ULL << heading;
  if ((standing_known_[entry] & bit) == 0) {
    const std::uint32_t place = place_of_entry_[entry];
    standing_known_[entry] |= bit;
    if (task_.grid.is_free(task_.lattice->standing(heading), task_.places.column(place), task_.places.row(place))) {
      standing_free_[entry] |= bit;
    }
  }
  return (standing_free_[entry] & bit) != 0;
}

bool Search::is_turning_free(std::uint32_t entry, std::uint32_t heading) {
  const std::uint64_t bit = 1ULL << heading;
  if ((turning_known_[entry] & bit) == 0) {
    const std::uint32_t place = place_of_entry_[entry];
    turning_known_[entry] |= bit;
    if (task_.grid.is_free(task_.lattice->turning(heading), task_.places.column(place), task_.places.row(place))) {
      turning_free_[entry] |= bit;
    }
  }
  return (turning_free_[entry] & bit) != 0;
}

std::uint32_t Search::turn_units(double turn_rad) const {
  return units(task_.costs.of_turn(turn_rad));
}

// The circle's way and the turn that the goal's yaw takes at least: one is of lengths, the other of turns, so both add.
// Rounding takes a unit from each for the sum to stay below the true cost.
std::uint32_t Search::distance(const State& state) const {
  const std::uint32_t way = task_.field->at(place_of_entry_[state.entry]), turn = yaw_units_[state.heading];
  return way + (turn > 64 ? turn - 64 : 0);
}

void Search::reach(std::uint32_t entry, std::uint32_t heading, std::uint32_t gear, std::uint32_t cost,
                   std::uint8_t how) {
  const State state{number_of(entry, heading, gear), entry, heading, gear};
  if (cost >= cost_[state.number] || cost >= kUnitsMost) return;
  const std::uint32_t ahead = distance(state);
  // Written before it is read: how_ counts only where there is a cost.
  if (cost_[state.number] != kUnitsMost && (how_[state.number] & kClosed) != 0) {
    if (cost + ahead < least_missed_) least_missed_ = cost + ahead;
    return;  // at most the weight too dear already
  }
  const double key = cost + task_.weight * ahead;
  if (key >= static_cast<double>(kUnitsMost)) return;
  if (open_.is_full()) {
    is_full_ = true;
    return;
  }
  cost_[state.number] = cost;
  how_[state.number] = how;
  open_.push(static_cast<std::uint32_t>(key), state.number);
}

// Far places by a slight turn, those around by any.
bool Search::is_worth_joining(double length_m, double turn_rad) const {
  constexpr double kSlight_rad = 0.6;  // 34 degrees: three headings of 32
  return std::abs(turn_rad) <= kSlight_rad || length_m <= 1.5 * task_.lattice->step_m();
}

// From the start straight to a place nearby and on the spot to the two headings about that direction.
void Search::start_at(std::int32_t column, std::int32_t row, std::int32_t gear) {
  if (!task_.places.holds(column, row)) return;
  const std::uint32_t place = task_.places.number(column, row);
  if (task_.field->at(place) >= kUnitsMost) return;
  const Eigen::Vector2d to = place_m(place);
  const double yaw_rad = driving_yaw(task_.start.place(), to, gear, task_.start.yaw_rad);
  const double length_m = (to - task_.start.place()).norm(), turn_rad = wrapped(yaw_rad - task_.start.yaw_rad);
  if (!is_worth_joining(length_m, turn_rad)) return;
  const Pose2 leaving{task_.start.x_m, task_.start.y_m, yaw_rad}, there{to.x(), to.y(), yaw_rad};
  if (!task_.sweeps->is_straight_free(leaving, gear * length_m)) return;
  if (!task_.sweeps->is_turn_free(task_.start, turn_rad)) return;
  const std::uint32_t before = task_.lattice->at_or_before(yaw_rad);
  for (const std::uint32_t heading : {before, task_.lattice->next(before)}) {
    const double last_rad = wrapped(task_.lattice->heading(heading).yaw_rad - yaw_rad);
    if (!task_.sweeps->is_turn_free(there, last_rad)) continue;
    const std::uint32_t entry = entry_of(place);
    if (entry == kNone || !is_standing_free(entry, heading)) continue;
    const double cost_m =
        task_.costs.of_stretch(length_m, gear) + task_.costs.of_turn(turn_rad) + task_.costs.of_turn(last_rad);
    const auto how = static_cast<std::uint8_t>(kFromStart | (gear < 0 ? kDriveBackward : 0));
    reach(entry, heading, gear < 0 ? 1U : 0U, units(cost_m), how);
  }
}

// A place near enough to be joined with a pose. In a narrow road only those straight ahead or behind can be.
bool Search::is_about(const Pose2& pose, std::int32_t column, std::int32_t row) const {
  const CostToGo::Target target = around(pose);
  if (target.holds(column, row)) return true;
  const CostToGo::Target wide{target.column, target.row, kReachStraight};
  if (!wide.holds(column, row)) return false;
  const double step = task_.lattice->step_cells();
  const Eigen::Vector2d off = task_.grid.exact->in_map(column * step, row * step) - pose.place();
  return std::abs(Turn2(pose.yaw_rad).back(off).y()) <= 0.75 * task_.lattice->step_m();
}

void Search::start_from() {
  const CostToGo::Target target = around(task_.start);
  for (std::int32_t row = target.row - kReachStraight; row <= target.row + kReachStraight; ++row) {
    for (std::int32_t column = target.column - kReachStraight; column <= target.column + kReachStraight; ++column) {
      if (!is_about(task_.start, column, row)) continue;
      for (const std::int32_t gear : {1, -1}) start_at(column, row, gear);
    }
  }
}

Found Search::run(const Task& task) {
  task_ = task;
  clear();
  start_from();
  while (!open_.is_empty()) {
    const std::uint64_t entry = open_.pop();
    if (OpenList::key_of(entry) >= best_) return Found::way;
    const State state = state_of(OpenList::number_of(entry));
    if ((how_[state.number] & kClosed) != 0) continue;
    if (expansions_ == task_.expansions_most) return best_parent_ != kNone ? Found::way : Found::work_spent;
    ++expansions_;
    how_[state.number] |= kClosed;
    if (task_.hurry_after > 0 && expansions_ % task_.hurry_after == 0) hurry();
    expand(state);
  }
  if (best_parent_ != kNone) return Found::way;
  return is_full_ ? Found::list_full : Found::none;
}

// What was put off comes nearer the front if it is nearer the goal. Nothing gets dearer than the last weight says.
void Search::hurry() {
  // A step that changes the order little, and a way that costs three times the best at most.
  constexpr double kGrowth = 1.1, kWeightMost = 3.0;
  if (task_.weight * kGrowth > kWeightMost) return;
  task_.weight *= kGrowth;
  open_.rekey([&](std::uint32_t number) {
    if ((how_[number] & kClosed) != 0) return OpenList::kDrop;
    const double key = cost_[number] + task_.weight * distance(state_of(number));
    return key < static_cast<double>(kUnitsMost) ? static_cast<std::uint32_t>(key) : kUnitsMost;
  });
}

void Search::expand(const State& state) {
  const std::uint32_t cost = cost_[state.number], place = place_of_entry_[state.entry];
  if (task_.field->at(place) < nearest_) {
    nearest_ = task_.field->at(place);
    nearest_place_ = place;
  }
  drive(state, cost, kForward);
  drive(state, cost, kBackward);
  turn(state, cost, kLeft);
  turn(state, cost, kRight);
  if (task_.is_probe || !is_about(task_.goal, task_.places.column(place), task_.places.row(place))) return;
  arrive(state, cost, 1);
  arrive(state, cost, -1);
}

// Both ends are free, and the rectangle is longer than the step: so all between is free.
void Search::drive(const State& state, std::uint32_t cost, Move move) {
  const Heading& heading = task_.lattice->heading(state.heading);
  const std::uint32_t gear = move == kForward ? 0 : 1, place = place_of_entry_[state.entry];
  const std::int32_t column = task_.places.column(place) + sign_of(gear) * heading.dx;
  const std::int32_t row = task_.places.row(place) + sign_of(gear) * heading.dy;
  if (!task_.places.holds(column, row)) return;
  const std::uint32_t entry = entry_of(task_.places.number(column, row));
  if (entry == kNone) return;
  double more_m = task_.costs.of_stretch(heading.length * kUnits_m, sign_of(gear));
  if (gears_ == 2 && gear != state.gear) more_m += task_.costs.cusp_m;
  const std::uint32_t sum = cost + units(more_m);
  if (sum >= cost_[number_of(entry, state.heading, gear)] || !is_standing_free(entry, state.heading)) return;
  reach(entry, state.heading, gear, sum, static_cast<std::uint8_t>(move | (state.gear == 1 ? kParentBackward : 0)));
}

void Search::turn(const State& state, std::uint32_t cost, Move move) {
  const Lattice& lattice = *task_.lattice;
  const std::uint32_t to = move == kLeft ? lattice.next(state.heading) : lattice.before(state.heading);
  const std::uint32_t between = move == kLeft ? state.heading : to;
  const std::uint32_t sum = cost + turn_units(lattice.gap_rad(between));
  if (sum >= cost_[number_of(state.entry, to, state.gear)] || !is_turning_free(state.entry, between)) return;
  reach(state.entry, to, state.gear, sum, static_cast<std::uint8_t>(move | (state.gear == 1 ? kParentBackward : 0)));
}

// From a place straight to the goal, if the heading is about that direction.
void Search::arrive(const State& state, std::uint32_t cost, std::int32_t gear) {
  constexpr double kAbout_rad = 0.26;  // more than the widest gap between headings
  const Eigen::Vector2d from = place_m(place_of_entry_[state.entry]);
  const double heading_rad = task_.lattice->heading(state.heading).yaw_rad;
  const double yaw_rad = driving_yaw(from, task_.goal.place(), gear, heading_rad);
  const double turn_rad = wrapped(yaw_rad - heading_rad), last_rad = wrapped(task_.goal.yaw_rad - yaw_rad);
  if (!(std::abs(turn_rad) <= kAbout_rad)) return;
  const double length_m = (task_.goal.place() - from).norm();
  if (!is_worth_joining(length_m, last_rad)) return;
  double more_m =
      task_.costs.of_stretch(length_m, gear) + task_.costs.of_turn(turn_rad) + task_.costs.of_turn(last_rad);
  if (gears_ == 2 && gear != sign_of(state.gear)) more_m += task_.costs.cusp_m;
  const std::uint32_t sum = cost + units(more_m);
  if (sum >= best_) return;
  const Pose2 here{from.x(), from.y(), heading_rad};
  if (!task_.sweeps->is_turn_free(here, turn_rad)) return;
  if (!task_.sweeps->is_straight_free({from.x(), from.y(), yaw_rad}, gear * length_m)) return;
  if (!task_.sweeps->is_turn_free({task_.goal.x_m, task_.goal.y_m, yaw_rad}, last_rad)) return;
  best_ = sum;
  best_parent_ = state.number;
  best_gear_ = gear;
}

double Search::least_cost_m() const {
  std::uint32_t least = best_ < least_missed_ ? best_ : least_missed_;
  for (const std::uint64_t entry : open_.entries()) {
    const State state = state_of(OpenList::number_of(entry));
    if ((how_[state.number] & kClosed) != 0) continue;
    const std::uint32_t sum = cost_[state.number] + distance(state);
    if (sum < least) least = sum;
  }
  return least * kUnits_m;
}

Search::State Search::parent_of(const State& state) const {
  const std::uint8_t how = how_[state.number];
  const std::uint32_t gear = (how & kParentBackward) != 0 ? 1 : 0;
  std::uint32_t entry = state.entry, heading = state.heading;
  const Heading& vector = task_.lattice->heading(heading);
  const std::uint32_t place = place_of_entry_[entry];
  const auto behind = [&](std::int32_t sign) {
    return entry_of_place_[task_.places.number(task_.places.column(place) - sign * vector.dx,
                                               task_.places.row(place) - sign * vector.dy)];
  };
  switch (how & kMoveBits) {
    case kForward:
      entry = behind(1);
      break;
    case kBackward:
      entry = behind(-1);
      break;
    case kLeft:
      heading = task_.lattice->before(heading);
      break;
    default:
      heading = task_.lattice->next(heading);
      break;
  }
  return {number_of(entry, heading, gear), entry, heading, gear};
}

// Backwards from the goal into the end of the room, then to its front.
std::uint32_t Search::write(Span<Corner> corners) const {
  std::uint32_t first = corners.size();
  if (first < 4 || best_parent_ == kNone) return 0;
  corners[--first] = {task_.goal.x_m, task_.goal.y_m, task_.goal.yaw_rad, 0.0, 0, 0};
  State state = state_of(best_parent_);
  double yaw_rad = task_.lattice->heading(state.heading).yaw_rad, leaving_rad = yaw_rad;
  std::int32_t gear = best_gear_;  // in which the place is left
  {
    const Eigen::Vector2d from = place_m(place_of_entry_[state.entry]);
    leaving_rad = driving_yaw(from, task_.goal.place(), gear, yaw_rad);
    corners[first].turn_rad = wrapped(task_.goal.yaw_rad - leaving_rad);
    corners[--first] = {from.x(), from.y(), leaving_rad, wrapped(leaving_rad - yaw_rad), gear, 0};
  }
  while ((how_[state.number] & kMoveBits) != kFromStart) {
    const std::uint8_t move = how_[state.number] & kMoveBits;
    const State parent = parent_of(state);
    if (move == kLeft) corners[first].turn_rad += task_.lattice->gap_rad(parent.heading);
    if (move == kRight) corners[first].turn_rad -= task_.lattice->gap_rad(state.heading);
    if (move == kForward || move == kBackward) {
      gear = move == kForward ? 1 : -1;
      const Eigen::Vector2d from = place_m(place_of_entry_[parent.entry]);
      yaw_rad = task_.lattice->heading(parent.heading).yaw_rad;
      const bool goes_on = corners[first].gear == gear && std::abs(corners[first].turn_rad) < 1e-9;
      if (!goes_on && first < 2) return 0;
      if (!goes_on) --first;
      corners[first] = {from.x(), from.y(), yaw_rad, 0.0, gear, 0};
    }
    state = parent;
  }
  if (first < 1) return 0;
  gear = (how_[state.number] & kDriveBackward) != 0 ? -1 : 1;
  yaw_rad = task_.lattice->heading(state.heading).yaw_rad;
  leaving_rad = driving_yaw(task_.start.place(), corners[first].place(), gear, task_.start.yaw_rad);
  corners[first].turn_rad += wrapped(yaw_rad - leaving_rad);
  corners[--first] = {
      task_.start.x_m, task_.start.y_m, leaving_rad, wrapped(leaving_rad - task_.start.yaw_rad), gear, 0};
  const std::uint32_t count = corners.size() - first;
  for (std::uint32_t k = 0; k < count; ++k) corners[k] = corners[first + k];
  return count;
}

}  // namespace pose_wall::planar::route
