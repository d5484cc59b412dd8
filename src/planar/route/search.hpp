// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Weighted A* over places, headings and gears (Pohl 1970): from the start to the goal, both of which lie between
// places.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "planar/route/bit_grid.hpp"
#include "planar/route/cost_to_go.hpp"
#include "planar/route/footprint.hpp"
#include "planar/route/lattice.hpp"
#include "planar/route/leg.hpp"
#include "planar/route/open_list.hpp"

namespace pose_wall::planar::route {

enum class Found : std::uint32_t { way, none, list_full, work_spent };

class Search {
 public:
  // At most so many places are entered, with the headings of the finest lattice.
  void lay_out(Arena& arena, std::uint32_t places_table, std::uint32_t places_entered, std::uint32_t open_most);

  struct Task {
    const Lattice* lattice = nullptr;
    LatticeGrid grid;
    const CostToGo* field = nullptr;
    Sweeps* sweeps = nullptr;
    LatticePlaces places;
    Costs costs;
    double weight = 1.0;            // of the distance to the goal
    std::uint32_t hurry_after = 0;  // expansions after which the weight grows, again and again; 0: never
    Pose2 start, goal;
    std::uint32_t expansions_most = 0;
    bool is_probe = false;  // how far the machine gets from the start; no goal ends it
  };
  Found run(const Task& task);

  // The way that was found, from start to goal. 0 if it does not fit.
  std::uint32_t write(Span<Corner> corners) const;

  std::uint32_t places() const { return entries_; }
  std::uint32_t expansions() const { return expansions_; }
  double cost_m() const { return best_ * kUnits_m; }
  // No way in the lattice costs less.
  double least_cost_m() const;
  // Of the expanded places, the one that was nearest to the goal by the circle's distance.
  Eigen::Vector2d nearest_m() const;

  // Start and goal are connected with places at most so many steps away; straight ahead and behind with farther ones.
  static constexpr std::int32_t kReach = 6, kReachStraight = 20;
  CostToGo::Target around(const Pose2& pose) const;
  static CostToGo::Target around(const BitGrid& grid, const Lattice& lattice, const Pose2& pose);

 private:
  // Numbers that no state has:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU, kGoal = 0xFFFFFFFEU;
  enum Move : std::uint8_t { kForward, kBackward, kLeft, kRight, kFromStart, kMoves };
  // Bits of how a state was reached, the Move lowest:
  static constexpr std::uint8_t kMoveBits = 7, kParentBackward = 8, kDriveBackward = 16, kClosed = 32;

  // A state is entry * slots + heading * gears + gear.
  struct State {
    std::uint32_t number, entry, heading, gear;
  };
  State state_of(std::uint32_t number) const;
  std::uint32_t number_of(std::uint32_t entry, std::uint32_t heading, std::uint32_t gear) const {
    return entry * slots_ + heading * gears_ + (gears_ == 2 ? gear : 0);
  }
  std::uint32_t entry_of(std::uint32_t place);
  Eigen::Vector2d place_m(std::uint32_t place) const;
  bool is_standing_free(std::uint32_t entry, std::uint32_t heading);
  bool is_turning_free(std::uint32_t entry, std::uint32_t heading);
  std::uint32_t turn_units(double turn_rad) const;
  std::uint32_t distance(const State& state) const;
  void reach(std::uint32_t entry, std::uint32_t heading, std::uint32_t gear, std::uint32_t cost, std::uint8_t how);
  bool is_about(const Pose2& pose, std::int32_t column, std::int32_t row) const;
  bool is_worth_joining(double length_m, double turn_rad) const;
  void start_from();
  void start_at(std::int32_t column, std::int32_t row, std::int32_t gear);
  void expand(const State& state);
  void drive(const State& state, std::uint32_t cost, Move move);
  void turn(const State& state, std::uint32_t cost, Move move);
  void arrive(const State& state, std::uint32_t cost, std::int32_t gear);
  void hurry();
  State parent_of(const State& state) const;
  void clear();

  Task task_;
  std::uint32_t slots_ = 0, gears_ = 1, entries_ = 0, expansions_ = 0, entries_most_ = 0;
  std::uint32_t best_ = 0, best_parent_ = kNone, nearest_place_ = 0, nearest_ = 0, least_missed_ = 0;
  std::int32_t best_gear_ = 1;
  bool is_full_ = false;
  Span<std::uint32_t> entry_of_place_, place_of_entry_, cost_, yaw_units_;
  Span<std::uint64_t> standing_known_, standing_free_, turning_known_, turning_free_;
  Span<std::uint8_t> how_;
  OpenList open_;
};

}  // namespace pose_wall::planar::route
