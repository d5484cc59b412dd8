// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// People beside a machine's way who step into it, and walls that are lost for a while.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/sim/network.hpp"
#include "lab/sim/network_scan.hpp"

namespace pose_wall::tools::sim {

inline constexpr double kWalkMost_mps = 0.8;  // who works beside a machine does not hurry

// A footprint on the floor: a rectangle about a pose.
struct Footprint {
  PlanePose at;
  double front_m = 0.0, rear_m = 0.0, half_width_m = 0.0;

  // From its nearest edge to a place; 0 inside.
  double distance_m(const Place& p) const;
};

// Stands beside the way, crosses it when the machine comes near, waits in it, and leaves past the machine.
class Person {
 public:
  struct Plan {
    std::vector<Place> stations;   // that are walked to in turn
    double starts_within_m = 4.0;  // of the footprint: then the walk begins
    double pause_s = 0.0;          // at the first station
    double speed_mps = 1.0;
    bool stays = false;  // at the first station, for good
  };
  Person(const Place& at, const Plan& plan) : at_(at), home_(at), plan_(plan) {}

  // Nobody walks into a machine. Who cannot go on for a second steps back to the station before, and tries again later.
  void step(const Footprint& machine, double time_s);

  const Place& at() const { return at_; }
  bool has_started() const { return has_started_; }
  Pillar pillar() const;

 private:
  void arrive(double time_s);

  Place at_, home_;
  Plan plan_;
  std::size_t next_ = 0;
  double waits_s_ = 0.0, blocked_s_ = 0.0;
  bool has_started_ = false, steps_back_ = false;
};

// `count` people along a way, which is a line in the open. Nobody is nearer to its beginning than `free_m`.
std::vector<Person> draw_people(const Network& network, const std::vector<Place>& way, int count, double free_m,
                                bool stays, std::uint64_t seed);

enum class LossKind { kDarkWall, kDropout, kBlind };
// "dark wall": a stretch of wall gives no return; "dropout": most beams give none; "blind": none does.
const char* loss_name(LossKind kind);

// What the sensor loses, from when the machine has come so far along its way.
struct Loss {
  LossKind kind = LossKind::kDarkWall;
  Place at = Place::Zero();
  double radius_m = 0.0;
  double share = 0.0;   // of returns
  double from_m = 0.0;  // along the way
  double lasts_s = 0.0;
};
Loss draw_loss(const Network& network, const std::vector<Place>& way, std::uint64_t seed);

}  // namespace pose_wall::tools::sim
