// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/network_people.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr double kRadius_m = 0.2, kTall_m = 1.75;
constexpr double kFromWall_m = 0.45;  // the middle of who stands at a wall
constexpr double kWallReach_m = 6.0;  // of the look for a wall
constexpr double kKeepsOff_m = 0.3;   // between skin and machine
constexpr double kLeaves_m = 14.0;    // back along the way, past the machine
constexpr double kThere_m = 0.05;
constexpr double kStepsBack_s = 1.0;   // of standing before the machine
constexpr double kTriesAgain_s = 8.0;  // later

// A place of a line at a length from its beginning, and the direction there.
struct Stand {
  Place at, ahead;
};

Stand stand_at(const std::vector<Place>& line, double along_m) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Place step = line[i + 1] - line[i];
    const double length_m = step.norm();
    if (length_m > 0.0 && (along_m <= length_m || i + 2 == line.size())) {
      return {line[i] + std::clamp(along_m / length_m, 0.0, 1.0) * step, step / length_m};
    }
    along_m -= length_m;
  }
  return {line.empty() ? Place(0.0, 0.0) : line.back(), Place(1.0, 0.0)};
}

// Beside the line at one side, close to the wall.
Place at_wall(const Network& network, const Stand& stand, double side) {
  const Place across(-side * stand.ahead.y(), side * stand.ahead.x());
  const PlaneHit hit = network.cast(stand.at, across, kWallReach_m);
  return stand.at + (std::min(hit.range_m, kWallReach_m) - kFromWall_m) * across;
}

}  // namespace

double Footprint::distance_m(const Place& p) const {
  const double c = std::cos(at.yaw_rad), s = std::sin(at.yaw_rad);
  const Place d = p - at.place();
  const double x = c * d.x() + s * d.y(), y = c * d.y() - s * d.x();
  const double out_x = std::max({x - front_m, -rear_m - x, 0.0});
  const double out_y = std::max(std::abs(y) - half_width_m, 0.0);
  return std::hypot(out_x, out_y);
}

// At a station: the first is in the way, and one after stepping back is a place to wait.
void Person::arrive(double time_s) {
  waits_s_ += time_s;
  if (steps_back_) {
    if (waits_s_ < kTriesAgain_s) return;
    steps_back_ = false;
  } else {
    if (next_ == 0 && (plan_.stays || waits_s_ < plan_.pause_s)) return;
    ++next_;
  }
  waits_s_ = 0.0;
}

void Person::step(const Footprint& machine, double time_s) {
  has_started_ = has_started_ || machine.distance_m(at_) < plan_.starts_within_m;
  if (!has_started_ || next_ >= plan_.stations.size()) return;
  const Place before = next_ == 0 ? home_ : plan_.stations[next_ - 1];
  const Place to = (steps_back_ ? before : plan_.stations[next_]) - at_;
  if (to.norm() < kThere_m) return arrive(time_s);
  const Place there = at_ + std::min(1.0, plan_.speed_mps * time_s / to.norm()) * to;
  const double now_m = machine.distance_m(at_), then_m = machine.distance_m(there);
  if (then_m < kRadius_m + kKeepsOff_m && then_m < now_m) {
    blocked_s_ += time_s;
    if (blocked_s_ < kStepsBack_s) return;
    steps_back_ = true;
    blocked_s_ = waits_s_ = 0.0;
    return;
  }
  blocked_s_ = 0.0;
  at_ = there;
}

Pillar Person::pillar() const {
  Pillar pillar;
  pillar.at = at_;
  pillar.radius_m = kRadius_m;
  pillar.height_m = kTall_m;
  return pillar;
}

std::vector<Person> draw_people(const Network& network, const std::vector<Place>& way, int count, double free_m,
                                bool stays, std::uint64_t seed) {
  Random random(seed, 0x9e09);
  std::vector<Person> people;
  const double length_m = length_of(way);
  for (int k = 0; k < count; ++k) {
    // Each has a stretch of the way.
    const double share = (k + random.uniform(0.2, 0.8)) / count;
    const double along_m = free_m + share * std::max(0.0, length_m - free_m - 3.0);
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const Stand here = stand_at(way, along_m);
    Person::Plan plan;
    plan.starts_within_m = random.uniform(3.0, 6.0);
    plan.pause_s = random.uniform(0.0, 5.0);
    plan.speed_mps = random.uniform(0.4, kWalkMost_mps);
    plan.stays = stays;
    plan.stations = {here.at};
    for (double back_m = 0.0; back_m <= std::min(kLeaves_m, along_m); back_m += 2.0) {
      plan.stations.push_back(at_wall(network, stand_at(way, along_m - back_m), -side));
    }
    people.emplace_back(at_wall(network, here, side), plan);
  }
  return people;
}

const char* loss_name(LossKind kind) {
  static constexpr const char* kNames[] = {"dark_wall", "dropout", "blind"};
  return kNames[static_cast<int>(kind)];
}

Loss draw_loss(const Network& network, const std::vector<Place>& way, std::uint64_t seed) {
  Random random(seed, 0x1055);
  Loss loss;
  loss.kind = static_cast<LossKind>(std::min(2, static_cast<int>(random.uniform(0.0, 3.0))));
  loss.from_m = random.uniform(0.25, 0.75) * length_of(way);
  const Stand here = stand_at(way, loss.from_m + 3.0);
  loss.at = at_wall(network, here, random.chance(0.5) ? 1.0 : -1.0);
  loss.radius_m = loss.kind == LossKind::kDarkWall ? random.uniform(2.0, 4.0) : 0.0;
  loss.share = loss.kind == LossKind::kBlind ? 1.0 : loss.kind == LossKind::kDropout ? random.uniform(0.5, 0.9) : 0.0;
  loss.lasts_s = loss.kind == LossKind::kDarkWall ? random.uniform(8.0, 15.0) : random.uniform(2.0, 5.0);
  return loss;
}

}  // namespace pose_wall::tools::sim
