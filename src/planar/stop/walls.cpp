// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Which high things are walls, which stand, and which may be people who walk. All directions `away` are from the sensor
// to the place, on the ground.

#include <cmath>

#include "planar/stop/places.hpp"

namespace pose_wall::planar {
namespace {

constexpr auto kPlace_mm = static_cast<std::int32_t>(1000.0 * kPlace_m + 0.5);  // rounded to whole ones
// What stands out of a wall by less is its rock; a person's chest is thicker. Along a diagonal in both axes.
constexpr std::int32_t kChest_mm = 230, kChestDiagonal_mm = 325;
// What lies so much deeper than the rock to both sides of it is of the same wall: blocks are up to 0.5 m deep in the
// rock that was measured (lab/sim/rock_scales.hpp). Whoever is in there comes out of the line before they are near.
constexpr std::int32_t kDeep_mm = 500, kDeepDiagonal_mm = 707;
constexpr std::int32_t kDeepPlaces = 5;   // as many of 0.1 m
constexpr std::int32_t kChestPlaces = 3;  // of 0.1 m, which hold a chest's depth
// Half of a sixth of a metre, a step along a line: wider, and the wall would fill in for a body's end.
constexpr double kStationHalf_mm = 84.0;
constexpr double kAcross2 = 0.2 * 0.2;  // sine, squared: of a line that points at the sensor no side is the deeper one
constexpr double kBody_m = 0.115;       // from a chest's front to its middle
constexpr double kSomething_m = 1e-6;   // a place at the sensor has no direction

}  // namespace

// Whether it was there and still seen when the other last was. Who walks leaves places behind them, where nobody sees
// them gone.
bool Places::was_seen_with(const Place& near, const Place& place) const {
  return near.thing_high_ms != 0 && near.first_ms <= place.thing_high_ms &&
         near.thing_high_ms + delay_ms_ >= place.thing_high_ms;
}

// The ground under the middle of a body whose front returned at a place: what is in sight returns there.
const Place* Places::under_body(const Place& place, const Eigen::Vector2d& away) const {
  const Eigen::Vector2d front_m(kPlace_m * place.ix + 0.001 * place.high_x_mm,
                                kPlace_m * place.iy + 0.001 * place.high_y_mm);
  const Eigen::Vector2d middle_m = front_m + kBody_m / (away.norm() + kSomething_m) * away;
  return known_at(place_of(middle_m.x()), place_of(middle_m.y()));
}

// Whether it came into sight with its ground: nobody was seen there, and nobody gone.
bool Places::came_into_sight(const Place& place, const Eigen::Vector2d& away) const {
  const Place* const ground = under_body(place, away);
  return ground == nullptr || ground->tall_ms == 0;
}

// Whether it came onto ground that was watched until then. Rock comes into sight as its ground does, or with rays
// beside it that still pass.
bool Places::walked_in(const Place& place, const Eigen::Vector2d& away) const {
  const Place* const ground = under_body(place, away);
  if (ground == nullptr || ground->tall_ms == 0 || ground->tall_ms >= place.first_ms) return false;
  return place.first_ms - ground->tall_ms <= gap_ms_;
}

// Whether it may be of a line: it stood for long, or, of what came into sight with its ground, for two thirds of the
// delay.
bool Places::has_stood(const Place& place, const Eigen::Vector2d& away) const {
  const std::uint32_t stood_ms = place.thing_high_ms - place.first_ms;
  return stood_ms >= settle_ms_ || (3 * stood_ms >= 2 * delay_ms_ && came_into_sight(place, away));
}

// Whether it stood for long, or what it touches did: surfaces change places as they are seen from elsewhere.
bool Places::is_settled(const Place& place) const {
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const near = known_at(place.ix + dx, place.iy + dy);
      if (near == nullptr || !was_seen_with(*near, place)) continue;
      if (near->thing_high_ms - near->first_ms >= settle_ms_) return true;
    }
  }
  return false;
}

// An axis of a line: how much a place may stand out of it or lie deeper, and to which side the sensor is.
Places::LineAxis Places::line_axis(const Eigen::Vector2d& away, const std::int32_t* axis) {
  const std::int32_t x = axis[0] > 0 ? 1 : 0, y = axis[1] > 0 ? 1 : axis[1] < 0 ? -1 : 0;
  const bool is_diagonal = x * y != 0;
  const double across = away.x() * y - away.y() * x;
  const bool is_across = across * across > kAcross2 * away.squaredNorm() * (is_diagonal ? 2.0 : 1.0);
  const std::int32_t chest_mm = is_diagonal ? kChestDiagonal_mm : kChest_mm;
  const std::int32_t deep_mm = !is_across ? chest_mm : is_diagonal ? kDeepDiagonal_mm : kDeep_mm;
  return {x, y, is_diagonal ? 2 : 1, chest_mm, deep_mm, across > 0.0 ? -1 : 1};
}

Eigen::Vector2d Places::between_mm(const Place& from, const Place& to) {
  return {kPlace_mm * (to.ix - from.ix) + to.high_x_mm - from.high_x_mm,
          kPlace_mm * (to.iy - from.iy) + to.high_y_mm - from.high_y_mm};
}

// Whether another place may be of a place's line: the place does not stand out of it.
bool Places::is_of_line(const Place& place, const Place& near, const Eigen::Vector2d& away,
                        const LineAxis& axis) const {
  const Eigen::Vector2d there_mm = between_mm(place, near);
  const double deeper_mm = axis.to_sensor * (there_mm.x() * axis.along_y - there_mm.y() * axis.along_x);
  if (deeper_mm > axis.deep_mm || deeper_mm < -axis.chest_mm) return false;
  return was_seen_with(near, place) && has_stood(near, away + 0.001 * there_mm);
}

// Whether a line goes on a step along an axis: there, or a place more or less far.
bool Places::goes_on(const Place& place, const Eigen::Vector2d& away, const std::int32_t* axis_step,
                     std::int32_t side) const {
  const LineAxis axis = line_axis(away, axis_step);
  for (std::int32_t dy = -kDeepPlaces; dy <= kDeepPlaces; ++dy) {
    for (std::int32_t dx = -kDeepPlaces; dx <= kDeepPlaces; ++dx) {
      const std::int32_t along = dx * axis.along_x + dy * axis.along_y;
      if (along > axis.along_most || along < -axis.along_most) continue;
      const Place* const near = known_at(place.ix + side * axis_step[0] + dx, place.iy + side * axis_step[1] + dy);
      if (near != nullptr && is_of_line(place, *near, away, axis)) return true;
    }
  }
  return false;
}

// Whether something of a line is near a point: up to half a step beside it along the line, and standing out of it by
// less than a chest to either side.
bool Places::is_line_at(const Place& place, const Eigen::Vector2d& away, const Eigen::Vector2d& along_mm,
                        double at) const {
  const double length_mm = along_mm.norm();
  const Eigen::Vector2d to_mm = at * along_mm;
  const std::int32_t ix = place_of(0.001 * (kPlace_mm * place.ix + place.high_x_mm + to_mm.x()));
  const std::int32_t iy = place_of(0.001 * (kPlace_mm * place.iy + place.high_y_mm + to_mm.y()));
  for (std::int32_t dy = -kChestPlaces; dy <= kChestPlaces; ++dy) {
    for (std::int32_t dx = -kChestPlaces; dx <= kChestPlaces; ++dx) {
      const Place* const near = known_at(ix + dx, iy + dy);
      if (near == nullptr || near->thing_high_ms == 0) continue;
      const Eigen::Vector2d there_mm = between_mm(place, *near), off_mm = there_mm - to_mm;
      const double across_mm = (off_mm.x() * along_mm.y() - off_mm.y() * along_mm.x()) / length_mm;
      if (std::fabs(across_mm) > kChest_mm || std::fabs(off_mm.dot(along_mm)) > kStationHalf_mm * length_mm) continue;
      if (was_seen_with(*near, place) && has_stood(*near, away + 0.001 * there_mm)) return true;
    }
  }
  return false;
}

// Whether a line of things goes from it to one 2 to 2.5 m off, without a gap in which a person would fit. The far end
// is to lie on the wall. So half a metre from a body that leans on it, where that body ends, the line is off the wall
// by three quarters of what stands out.
bool Places::ends_line(const Place& place, const Eigen::Vector2d& away) const {
  constexpr std::int32_t kFar = 20, kSide = 14;  // 2 m in places, and its part of 45 degrees
  constexpr std::int32_t kThick = 5;             // places: rock has some that nothing returned from
  constexpr std::int32_t kStations = 12;         // steps of a sixth of a metre
  const auto is_end = [&](std::int32_t dx, std::int32_t dy) {
    const Place* const far = known_at(place.ix + dx, place.iy + dy);
    if (far == nullptr || far->thing_high_ms == 0) return false;
    const Eigen::Vector2d along_mm = between_mm(place, *far);
    if (!was_seen_with(*far, place) || !has_stood(*far, away + 0.001 * along_mm)) return false;
    for (std::int32_t k = 1; k < kStations; ++k) {
      if (!is_line_at(place, away, along_mm, static_cast<double>(k) / kStations)) return false;
    }
    return true;
  };
  for (std::int32_t side = -kSide; side <= kSide; ++side) {
    const auto nearest = static_cast<std::int32_t>(std::sqrt(1.0 * kFar * kFar - side * side) + 0.5);
    for (std::int32_t far = nearest; far <= nearest + kThick; ++far) {
      if (is_end(far, side) || is_end(-far, side) || is_end(side, far) || is_end(side, -far)) return true;
    }
  }
  return false;
}

// Whether it is in a line along any of four axes, with half a metre to both sides, or at the end of one.
bool Places::is_in_line(const Place& place, const Eigen::Vector2d& away) const {
  constexpr std::int32_t kAxes[4][2] = {{5, 0}, {0, 5}, {4, 4}, {4, -4}};  // half a metre in places
  for (const auto& axis : kAxes) {
    if (goes_on(place, away, axis, 1) && goes_on(place, away, axis, -1)) return true;
  }
  return ends_line(place, away);
}

// Whether what came into sight with it is smaller than a person: a tip of rock, or dust, beside others.
bool Places::came_alone(const Place& place) const {
  constexpr std::int32_t kAround = 2;       // a person is 0.3 m wide
  constexpr std::uint32_t kPlacesMost = 3;  // of which a person fills more
  std::uint32_t count = 0;
  for (std::int32_t dy = -kAround; dy <= kAround; ++dy) {
    for (std::int32_t dx = -kAround; dx <= kAround; ++dx) {
      const Place* const near = known_at(place.ix + dx, place.iy + dy);
      if (near == nullptr || near->thing_high_ms == 0) continue;
      const std::uint32_t apart_ms =
          near->first_ms > place.first_ms ? near->first_ms - place.first_ms : place.first_ms - near->first_ms;
      if (apart_ms < settle_ms_) ++count;
    }
  }
  return count <= kPlacesMost;
}

// A wall: in a line of things that stood, and nobody who walked there in sight; or right behind such a place; or a
// small part beside one. For so long as a thing needs to settle it stays one: where neighbours go out of sight, nothing
// new was seen.
bool Places::is_wall(Place* place, const Eigen::Vector2d& away, std::uint32_t now_ms) const {
  const auto is_known = [&](const Place& p) { return p.wall_ms != 0 && now_ms - p.wall_ms <= settle_ms_; };
  const bool is_fresh = place->wall_ms != 0 && 2 * (now_ms - place->wall_ms) < settle_ms_;
  const auto may_stand = [&] { return is_settled(*place) || !walked_in(*place, away); };
  if (!is_fresh && may_stand() && is_in_line(*place, away)) place->wall_ms = now_ms;
  if (is_known(*place)) return true;
  bool is_beside = false;
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const near = known_at(place->ix + dx, place->iy + dy);
      // What hides a place may have come into sight long after it: the same wall, seen from elsewhere.
      if (near == nullptr || near->thing_high_ms + delay_ms_ < place->thing_high_ms || !is_known(*near)) continue;
      if (dx * away.x() + dy * away.y() < 0.0) return true;
      is_beside = true;
    }
  }
  return is_beside && came_alone(*place);
}

}  // namespace pose_wall::planar
