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
constexpr std::int32_t kDeepPlaces = 5;  // as many of 0.1 m
constexpr double kAcross2 = 0.2 * 0.2;   // sine, squared: of a line that points at the sensor no side is the deeper one
constexpr double kBody_m = 0.5e-3 * kChest_mm;  // from a chest's front to its middle

}  // namespace

// Whether it was still seen when the other last was. Who walks leaves places behind them, where nobody sees them gone.
bool Places::was_seen_with(const Place& near, const Place& place) const {
  return near.thing_high_ms != 0 && near.thing_high_ms + delay_ms_ >= place.thing_high_ms;
}

// Where the middle of a body would be whose front returned at a place: what is in sight returns there.
Eigen::Vector2d Places::body_behind(const Place& place, const Eigen::Vector2d& away) const {
  const Eigen::Vector2d in_place_m(0.001 * place.high_x_mm, 0.001 * place.high_y_mm);
  return kPlace_m * Eigen::Vector2d(place.ix, place.iy) + in_place_m + kBody_m / away.norm() * away;
}

// False where rays passed through the body that would have returned there, since it last did: a tip of rock. A body may
// have its middle beside the place that is right behind the return.
bool Places::fits_person(const Place& place, const Eigen::Vector2d& away) const {
  const Eigen::Vector2d body_m = body_behind(place, away);
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const at = known_at(place_of(body_m.x()) + dx, place_of(body_m.y()) + dy);
      const bool is_itself = at == &place;
      if (!is_itself && (at == nullptr || at->tall_ms < place.thing_high_ms)) return true;
    }
  }
  return false;
}

// Whether nobody can have walked there in sight: its ground was hidden until now. People who come out of hiding are on
// ground that was seen as soon as they have made a step.
bool Places::came_into_sight(const Place& place, const Eigen::Vector2d& away) const {
  const Eigen::Vector2d body_m = body_behind(place, away);
  const Place* const body = known_at(place_of(body_m.x()), place_of(body_m.y()));
  return body == nullptr || body->tall_ms == 0;
}

// Known to stand: for long, or, of what came into sight with its ground, for two thirds of the delay.
bool Places::has_stood(const Place& place, const Eigen::Vector2d& away) const {
  const std::uint32_t stood_ms = place.thing_high_ms - place.first_ms;
  return stood_ms >= settle_ms_ || (3 * stood_ms >= 2 * delay_ms_ && came_into_sight(place, away));
}

// It, or what it touches: surfaces change places as they are seen from elsewhere.
bool Places::has_stood_here(const Place& place, const Eigen::Vector2d& away) const {
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const near = known_at(place.ix + dx, place.iy + dy);
      if (near != nullptr && was_seen_with(*near, place) && has_stood(*near, away)) return true;
    }
  }
  return false;
}

// How a line of things goes on so many steps along an axis: there, or a place more or less far. The place does not
// stand out of it, or is deeper.
Places::Line Places::line_on(const Place& place, const Eigen::Vector2d& away, const std::int32_t* axis,
                             std::int32_t times) const {
  const std::int32_t along_x = axis[0] > 0 ? 1 : 0, along_y = axis[1] > 0 ? 1 : axis[1] < 0 ? -1 : 0;
  const bool is_diagonal = along_x * along_y != 0;
  const std::int32_t along_most = is_diagonal ? 2 : 1, chest_mm = is_diagonal ? kChestDiagonal_mm : kChest_mm;
  const double across = away.x() * along_y - away.y() * along_x;
  const bool is_across = across * across > kAcross2 * away.squaredNorm() * (is_diagonal ? 2.0 : 1.0);
  const std::int32_t deep_mm = !is_across ? chest_mm : is_diagonal ? kDeepDiagonal_mm : kDeep_mm;
  const std::int32_t to_sensor = across > 0.0 ? -1 : 1;
  Line line = Line::none;
  for (std::int32_t dy = -kDeepPlaces; dy <= kDeepPlaces; ++dy) {
    for (std::int32_t dx = -kDeepPlaces; dx <= kDeepPlaces; ++dx) {
      const std::int32_t along = dx * along_x + dy * along_y;
      if (along > along_most || along < -along_most) continue;
      const Place* const near = known_at(place.ix + times * axis[0] + dx, place.iy + times * axis[1] + dy);
      if (near == nullptr) continue;
      const std::int32_t x_mm = kPlace_mm * (near->ix - place.ix) + near->high_x_mm - place.high_x_mm;
      const std::int32_t y_mm = kPlace_mm * (near->iy - place.iy) + near->high_y_mm - place.high_y_mm;
      const std::int32_t deeper_mm = to_sensor * (x_mm * along_y - y_mm * along_x);
      if (deeper_mm > deep_mm || deeper_mm < -chest_mm) continue;
      const bool is_flush = deeper_mm <= chest_mm;
      if (!is_flush && line == Line::deeper) continue;
      const Eigen::Vector2d away_there = away + Eigen::Vector2d(0.001 * x_mm, 0.001 * y_mm);
      if (!was_seen_with(*near, place) || !has_stood(*near, away_there)) continue;
      if (is_flush) return Line::flush;
      line = Line::deeper;
    }
  }
  return line;
}

// Whether it is in a line along any of four axes: with half a metre to both sides, or flush for a metre to one, without
// a gap in which a person would fit.
bool Places::is_in_line(const Place& place, const Eigen::Vector2d& away) const {
  constexpr std::int32_t kAxes[4][2] = {{5, 0}, {0, 5}, {4, 4}, {4, -4}};  // half a metre in places
  constexpr std::int32_t kHalves[4][2] = {{3, 0}, {0, 3}, {2, 2}, {2, -2}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto on = [&](const std::int32_t* axis, std::int32_t times) { return line_on(place, away, axis, times); };
    const auto is_flush = [&](std::int32_t side) {
      return on(kAxes[k], 2 * side) == Line::flush && on(kHalves[k], side) == Line::flush;
    };
    const Line ahead = on(kAxes[k], 1), behind = on(kAxes[k], -1);
    if (ahead != Line::none && behind != Line::none) return true;
    if ((ahead == Line::flush && is_flush(1)) || (behind == Line::flush && is_flush(-1))) return true;
  }
  return false;
}

// A wall: in a line of things that stood, or right behind such a place. For so long as a thing needs to settle it stays
// one: where neighbours go out of sight, nothing new was seen.
bool Places::is_wall(Place* place, const Eigen::Vector2d& away, std::uint32_t now_ms) const {
  const auto is_known = [&](const Place& p) { return p.wall_ms != 0 && now_ms - p.wall_ms <= settle_ms_; };
  const bool is_fresh = place->wall_ms != 0 && 2 * (now_ms - place->wall_ms) < settle_ms_;
  if (!is_fresh && is_in_line(*place, away)) place->wall_ms = now_ms;
  if (is_known(*place)) return true;
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      if (!(dx * away.x() + dy * away.y() < 0.0)) continue;
      const Place* const near = known_at(place->ix + dx, place->iy + dy);
      if (near != nullptr && was_seen_with(*near, *place) && is_known(*near)) return true;
    }
  }
  return false;
}

}  // namespace pose_wall::planar
