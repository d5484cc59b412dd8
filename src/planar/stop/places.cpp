// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/places.hpp"

#include <algorithm>
#include <cmath>

#include "base/math/elementary.hpp"
#include "place/pose2.hpp"

namespace pose_wall::planar {
namespace {

constexpr std::int16_t kNowhere = 0x7FFF;  // of a place that is none of the ground's
constexpr float kInside_m = 0.1F;          // so far inside the footprint nothing but the machine can be
constexpr float kNotUnder_m = -0.02F;      // places under the machine are not in its way

std::uint32_t milliseconds(double s) {
  return static_cast<std::uint32_t>(s * 1000.0 + 0.5);
}

}  // namespace

void Places::open(const StopSettings& settings) {
  memory_ms_ = milliseconds(settings.memory_s);
  delay_ms_ = milliseconds(settings.delay_s);
  settle_ms_ = milliseconds(settings.settle_s);
  gap_ms_ = 2 * delay_ms_;  // a thing that is not seen for longer has gone, or was another one
  drift_most_m_ = static_cast<float>(settings.drift_max_m);
  thing_half_m_ = static_cast<float>(0.5 * settings.thing_width_m);
  protection_m_ = static_cast<float>(settings.protection_m);
  approach_m_s_ = static_cast<float>(settings.approach_m_s);
  confirm_m_ = static_cast<float>(settings.confirm_m);
  // What is known already needs no delay to be believed; it has to come nearer only.
  sooner_s_ = static_cast<float>(settings.scan_s + settings.delay_s);
  forget();
}

void Places::forget() {
  Place none{};
  none.ix = none.iy = kNowhere;
  places_.fill(none);
  dust_.forget();
  last_ms_ = 0;
}

std::int32_t Places::place_of(double m) {
  return static_cast<std::int32_t>(std::floor(m / kPlace_m));
}

std::uint32_t Places::index_of(std::int32_t ix, std::int32_t iy) {
  return in_ring(ix) + kPlacesAcross * in_ring(iy);
}

Place& Places::place_at(std::int32_t ix, std::int32_t iy) {
  Place& place = places_[index_of(ix, iy)];
  const auto x = static_cast<std::int16_t>(ix), y = static_cast<std::int16_t>(iy);
  if (place.ix != x || place.iy != y) {
    place = Place{};
    place.ix = x, place.iy = y;
  }
  return place;
}

const Place* Places::known_at(std::int32_t ix, std::int32_t iy) const {
  const Place& place = places_[index_of(ix, iy)];
  return is_of(place, ix, iy) ? &place : nullptr;
}

bool Places::is_remembered(std::uint32_t when_ms, const Way& way, std::uint32_t now_ms) const {
  return when_ms != 0 && now_ms - when_ms <= memory_ms_ && way.error_m(when_ms) <= drift_most_m_;
}

bool Places::is_thing(const Place& place, const Way& way, std::uint32_t now_ms) const {
  return is_remembered(place.thing_low_ms, way, now_ms) || is_remembered(place.thing_high_ms, way, now_ms);
}

// Low things do not come by themselves, and nobody brings one to a place that is watched: of the time since it was seen
// free low, the part without a watch counts.
bool Places::is_low_free(const Place& place, const Way& way) const {
  const std::uint32_t unwatched_ms = place.watched_ms > place.low_ms ? place.watched_ms - place.low_ms : 0;
  return is_remembered(place.low_ms, way, place.low_ms + unwatched_ms);
}

bool Places::is_free(const Place& place, const Way& way, std::uint32_t now_ms) const {
  return is_low_free(place, way) && is_remembered(place.top_ms, way, now_ms) && place.tall_ms != 0 &&
         now_ms - place.tall_ms <= delay_ms_;
}

void Places::put_returns(const Sight& sight, const Way& way, const Eigen::Vector2d& sensor_m, std::uint32_t now_ms) {
  const Turn2 turn(way.base().yaw_rad);
  const Eigen::Vector2d origin = turn * sensor_m + way.base().place();
  dust_.next();
  sight.each_return([&](const Sight::Return& hit) {
    const Eigen::Vector2d at = turn * Eigen::Vector2d(static_cast<double>(hit.x), static_cast<double>(hit.y)) + origin;
    Place& place = place_at(place_of(at.x()), place_of(at.y()));
    if (brings_doubt_only(sight, way, turn, origin, hit, &place, now_ms)) return;
    std::uint32_t& last_ms = hit.is_high ? place.thing_high_ms : place.thing_low_ms;
    std::uint32_t& first_ms = hit.is_high ? place.first_ms : place.low_first_ms;
    const bool is_new = last_ms == 0 || now_ms - last_ms > gap_ms_;
    if (is_new) first_ms = now_ms;
    if (is_new && hit.is_high) place.wall_ms = 0;
    last_ms = now_ms;
    if (!hit.is_high) return;
    const auto x_mm = static_cast<std::int32_t>((at.x() - place.ix * kPlace_m) * 1000.0);
    const auto y_mm = static_cast<std::int32_t>((at.y() - place.iy * kPlace_m) * 1000.0);
    const auto steps = static_cast<std::int32_t>(hit.height_m * (1.0F / kHeightStep_m));
    place.high_x_mm = static_cast<std::uint8_t>(is_new ? x_mm : (3 * place.high_x_mm + x_mm) / 4);
    place.high_y_mm = static_cast<std::uint8_t>(is_new ? y_mm : (3 * place.high_y_mm + y_mm) / 4);
    place.high_steps = static_cast<std::uint8_t>(is_new ? steps : (3 * place.high_steps + steps) / 4);
  });
  last_ms_ = now_ms;
}

// visit(ix, iy, which of them count, x and y in base): places within a square around a point of base, four of a row at
// a time.
template <typename Visit>
void Places::each_four(const Way& way, const Eigen::Vector2d& middle_m, double half_m, const Visit& visit) const {
  const Pose2& base = way.base();
  const Turn2 turn(base.yaw_rad);
  const std::int32_t bx = place_of(base.x_m), by = place_of(base.y_m);
  const Eigen::Vector2d middle = turn * middle_m + base.place();
  const auto bounded = [](double at_m, std::int32_t around) {
    const std::int32_t place = place_of(at_m), least = around - kPlacesAround, most = around + kPlacesAround;
    return place < least ? least : place > most ? most : place;
  };
  const std::int32_t first_x = bounded(middle.x() - half_m, bx), last_x = bounded(middle.x() + half_m, bx);
  const std::int32_t first_y = bounded(middle.y() - half_m, by), last_y = bounded(middle.y() + half_m, by);
  const auto step_x = static_cast<float>(turn.c * kPlace_m), step_y = static_cast<float>(-turn.s * kPlace_m);
  constexpr FourFloats kLanes = {0.0F, 1.0F, 2.0F, 3.0F};
  for (std::int32_t iy = first_y; iy <= last_y; ++iy) {
    const Eigen::Vector2d first = turn.back({(first_x + 0.5) * kPlace_m - base.x_m, (iy + 0.5) * kPlace_m - base.y_m});
    const auto x = static_cast<float>(first.x()), y = static_cast<float>(first.y());
    for (std::int32_t ix = first_x; ix <= last_x; ix += static_cast<std::int32_t>(kFour)) {
      const FourFloats steps = static_cast<float>(ix - first_x) + kLanes;
      visit(ix, iy, first_of_four(static_cast<std::uint32_t>(last_x - ix + 1)), x + steps * step_x, y + steps * step_y);
    }
  }
}

template <typename Visit>
void Places::each_around(const Way& way, const Eigen::Vector2d& middle_m, double half_m, const Visit& visit) const {
  each_four(way, middle_m, half_m, [&](std::int32_t ix, std::int32_t iy, FourTruths those, FourFloats x, FourFloats y) {
    for (std::int32_t lane = 0; lane < static_cast<std::int32_t>(kFour); ++lane) {
      if (those[lane] != 0) visit(ix + lane, iy, x[lane], y[lane]);
    }
  });
}

void Places::put_seen(const Sight& sight, const Way& way, const Eigen::Vector2d& sensor_m, const Sweep& sweep,
                      std::uint32_t now_ms) {
  const auto sx = static_cast<float>(sensor_m.x()), sy = static_cast<float>(sensor_m.y());
  const float most_m = sight.seen_most_m();
  const Sight::Bounds& in = sight.seen_within();
  const auto put = [&](std::int32_t ix, std::int32_t iy, std::int32_t seen) {
    Place& place = place_at(ix, iy);
    if ((seen & Sight::kTall) != 0) {
      if (place.tall_ms == 0 || now_ms - place.tall_ms > delay_ms_) place.watched_ms = now_ms;
      place.tall_ms = now_ms;
    }
    if ((seen & Sight::kTop) != 0) place.top_ms = now_ms;
    if ((seen & Sight::kLow) == 0) return;
    place.low_ms = now_ms;
    if (now_ms - place.thing_low_ms > delay_ms_) place.thing_low_ms = 0;
  };
  each_four(way, sensor_m, static_cast<double>(most_m),
            [&](std::int32_t ix, std::int32_t iy, FourTruths those, FourFloats x, FourFloats y) {
              const FourFloats dx = x - sx, dy = y - sy;
              those &= (dx * dx + dy * dy < all_four(most_m * most_m)) & (dx >= all_four(in.low_x)) &
                       (dx <= all_four(in.high_x)) & (dy >= all_four(in.low_y)) & (dy <= all_four(in.high_y));
              if (!any_of(those)) return;
              const FourInts seen = sight.seen(dx, dy) & those;
              for (std::int32_t lane = 0; lane < static_cast<std::int32_t>(kFour); ++lane) {
                if (seen[lane] != 0) put(ix + lane, iy, seen[lane]);
              }
            });
  // Where the machine stands, nothing lies.
  each_around(way, {0.0, 0.0}, sweep.radius_m(), [&](std::int32_t ix, std::int32_t iy, float x, float y) {
    if (!(sweep.distance_now(x, y) < -kInside_m)) return;
    Place& place = place_at(ix, iy);
    place.low_ms = place.top_ms = now_ms;
    place.thing_low_ms = place.thing_high_ms = 0;
  });
}

void Places::confirm(const Way& way, const Sweep& sweep, std::uint32_t now_ms) {
  const double reach_m = sweep.radius_m() + static_cast<double>(confirm_m_);
  each_around(way, {0.0, 0.0}, reach_m, [&](std::int32_t ix, std::int32_t iy, float x, float y) {
    if (!(sweep.distance_now(x, y) <= confirm_m_)) return;
    Place& place = place_at(ix, iy);
    place.low_ms = place.top_ms = now_ms;
  });
}

// A high thing is gone where rays pass at its height and nothing returned for the delay. Rays above a low boom, and
// below one that hangs, tell nothing of it.
void Places::let_go(Place* place, const Sight& sight, float x, float y, std::uint32_t now_ms) const {
  const bool may_go = place->thing_high_ms != 0 && now_ms - place->thing_high_ms > delay_ms_;
  if (may_go && sight.passed_at(x, y, place->high_steps * kHeightStep_m)) place->thing_high_ms = 0;
}

// What a place is to the sweep: false if it is free.
bool Places::is_hazard(Place* place, const Way& way, const Eigen::Vector2d& away, std::uint32_t now_ms,
                       Hazard* hazard) const {
  hazard->margin_m = protection_m_ + kPlaceCorner_m;
  hazard->approach_m_s = hazard->sooner_s = 0.0F;
  hazard->kind = POSE_WALL_PLANAR_STOP_UNSEEN;
  if (place == nullptr) return true;
  const bool is_low = is_remembered(place->thing_low_ms, way, now_ms);
  const bool is_high = is_remembered(place->thing_high_ms, way, now_ms);
  // What was low stays in doubt until it is seen gone: nobody who looks from a distance confirms it away.
  if (!is_low && !is_high) return place->thing_low_ms != 0 || !is_free(*place, way, now_ms);
  const std::uint32_t first_ms = !is_low    ? place->thing_high_ms
                                 : !is_high ? place->thing_low_ms
                                            : std::min(place->thing_low_ms, place->thing_high_ms);
  hazard->margin_m += kCellCorner_m + way.error_m(first_ms);
  hazard->kind =
      static_cast<std::uint32_t>((is_low ? POSE_WALL_PLANAR_STOP_LOW : 0) + (is_high ? POSE_WALL_PLANAR_STOP_HIGH : 0));
  if (!is_high) return true;
  if (is_wall(place, away, now_ms)) return true;
  hazard->approach_m_s = approach_m_s_;
  hazard->sooner_s = is_settled(*place) ? sooner_s_ : 0.0F;
  return true;
}

// A place in the way, and what is gone goes. False if it is none.
bool Places::find_at(const HazardScene& scene, std::int32_t ix, std::int32_t iy, bool is_near, Hazard* hazard,
                     Count* count) {
  const float dx = hazard->x_m - scene.sensor_x_m, dy = hazard->y_m - scene.sensor_y_m;
  Place* const place = is_of(places_[hazard->place], ix, iy) ? &places_[hazard->place] : nullptr;
  if (place != nullptr) let_go(place, scene.sight, dx, dy, scene.now_ms);
  if (place != nullptr && is_near && (place->doubt_ms == scene.now_ms || place->dust_ms == scene.now_ms)) {
    ++count->doubtful;
  }
  const Eigen::Vector2d away = scene.turn * Eigen::Vector2d(static_cast<double>(dx), static_cast<double>(dy));
  if (!is_hazard(place, scene.way, away, scene.now_ms, hazard)) return false;
  const bool is_blind = hazard->kind == POSE_WALL_PLANAR_STOP_UNSEEN;
  if (!is_blind) ++count->things;
  if (!is_near && !(hazard->approach_m_s > 0.0F)) return false;
  if (scene.sweep.distance_now(hazard->x_m, hazard->y_m) < kNotUnder_m) return false;
  if (is_blind) ++count->blind;
  return true;
}

std::uint32_t Places::find_hazards(const Sight& sight, const Way& way, const Eigen::Vector2d& sensor_m,
                                   const Sweep& sweep, std::uint32_t now_ms, Span<Hazard> hazards, Count* count) {
  const float still_reach_m = protection_m_ + kPlaceCorner_m + kCellCorner_m + drift_most_m_ + sweep.growth_m(0.0F);
  const float walk_reach_m = still_reach_m + sweep.growth_m(approach_m_s_) - sweep.growth_m(0.0F);
  const auto sx = static_cast<float>(sensor_m.x()), sy = static_cast<float>(sensor_m.y());
  const HazardScene scene{sight, way, sweep, Turn2(way.base().yaw_rad), sx, sy, now_ms};
  std::uint32_t found = 0;
  const auto find = [&](std::int32_t ix, std::int32_t iy, float x, float y, bool is_near) {
    const std::uint32_t index = index_of(ix, iy);
    if (!is_near && places_[index].thing_high_ms == 0) return;
    Hazard hazard{x, y, 0.0F, 0.0F, 0.0F, index, 0};
    if (find_at(scene, ix, iy, is_near, &hazard, count)) hazards[found++] = hazard;  // there is room for every place
  };
  each_four(way, sweep.middle_m(), sweep.half_m() + static_cast<double>(walk_reach_m),
            [&](std::int32_t ix, std::int32_t iy, FourTruths those, FourFloats x, FourFloats y) {
              those &= sweep.concerns(x, y, walk_reach_m);
              if (!any_of(those)) return;
              const FourTruths near = sweep.concerns(x, y, still_reach_m);
              for (std::int32_t lane = 0; lane < static_cast<std::int32_t>(kFour); ++lane) {
                if (those[lane] != 0) find(ix + lane, iy, x[lane], y[lane], near[lane] != 0);
              }
            });
  return found;
}

double Places::size_around(std::uint32_t index, const Way& way, std::uint32_t now_ms) const {
  constexpr std::int32_t kAround = 10;  // 1 m to each side
  const Place& middle = places_[index];
  std::int32_t low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  for (std::int32_t dy = -kAround; dy <= kAround; ++dy) {
    for (std::int32_t dx = -kAround; dx <= kAround; ++dx) {
      const Place* const near = known_at(middle.ix + dx, middle.iy + dy);
      if (near == nullptr || !is_thing(*near, way, now_ms)) continue;
      if (dx < low_x) low_x = dx;
      if (dx > high_x) high_x = dx;
      if (dy < low_y) low_y = dy;
      if (dy > high_y) high_y = dy;
    }
  }
  const std::int32_t across_x = high_x - low_x + 1, across_y = high_y - low_y + 1;
  return kPlace_m * (across_x > across_y ? across_x : across_y);
}

}  // namespace pose_wall::planar
