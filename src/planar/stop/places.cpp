// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/places.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "planar/pose2.hpp"

namespace pose_wall::planar {
namespace {

constexpr std::int16_t kNowhere = 0x7FFF;  // of a place that is none of the ground's
constexpr float kInside_m = 0.1F;          // so far inside the footprint nothing but the machine can be
constexpr float kNotUnder_m = -0.02F;      // places under the machine are not in its way

std::int32_t place_of(double m) {
  return static_cast<std::int32_t>(std::floor(m / kPlace_m));
}

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
  protection_m_ = static_cast<float>(settings.protection_m);
  approach_m_s_ = static_cast<float>(settings.approach_m_s);
  confirm_m_ = static_cast<float>(settings.confirm_m);
  forget();
}

void Places::forget() {
  Place none{};
  none.ix = none.iy = kNowhere;
  places_.fill(none);
}

std::uint32_t Places::index_of(std::int32_t ix, std::int32_t iy) {
  constexpr std::uint32_t kOffset = kPlacesAcross * 100000U;  // no machine goes as far: above 0
  const std::uint32_t a = (static_cast<std::uint32_t>(ix) + kOffset) % kPlacesAcross;
  return a + kPlacesAcross * ((static_cast<std::uint32_t>(iy) + kOffset) % kPlacesAcross);
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
  return place.ix == static_cast<std::int16_t>(ix) && place.iy == static_cast<std::int16_t>(iy) ? &place : nullptr;
}

bool Places::is_remembered(std::uint32_t when_ms, float drift_m, const Track& track, std::uint32_t now_ms) const {
  return when_ms != 0 && now_ms - when_ms <= memory_ms_ && static_cast<float>(track.drift_m) - drift_m <= drift_most_m_;
}

bool Places::is_thing(const Place& place, const Track& track, std::uint32_t now_ms) const {
  return is_remembered(place.thing_low_ms, place.thing_drift_m, track, now_ms) ||
         is_remembered(place.thing_high_ms, place.thing_drift_m, track, now_ms);
}

bool Places::is_free(const Place& place, const Track& track, std::uint32_t now_ms) const {
  return is_remembered(place.low_ms, place.low_drift_m, track, now_ms) && place.tall_ms != 0 &&
         now_ms - place.tall_ms <= delay_ms_;
}

// A doubtful return is a thing's once there were others around it for two thirds of the delay: with a frame's period
// of a third, before the delay has passed.
void Places::doubt(Place* place, std::uint32_t now_ms) {
  std::uint32_t first_ms = now_ms;
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const near = known_at(place->ix + dx, place->iy + dy);
      if (near == nullptr || near->doubt_ms == 0 || now_ms - near->doubt_ms > delay_ms_) continue;
      if (near->doubt_first_ms < first_ms) first_ms = near->doubt_first_ms;
    }
  }
  place->doubt_first_ms = first_ms;
  place->doubt_ms = now_ms;
}

void Places::put_returns(const Sight& sight, const Track& track, const Eigen::Vector2d& sensor_m,
                         std::uint32_t now_ms) {
  const Turn2 turn(track.yaw_rad);
  const Eigen::Vector2d origin = turn * sensor_m + Eigen::Vector2d(track.x_m, track.y_m);
  const auto drift_m = static_cast<float>(track.drift_m);
  sight.each_return([&](const Sight::Return& hit) {
    const Eigen::Vector2d at =
        turn * Eigen::Vector2d(static_cast<double>(hit.x), static_cast<double>(hit.y)) + origin;
    Place& place = place_at(place_of(at.x()), place_of(at.y()));
    bool counts = !hit.is_doubtful;
    if (hit.is_doubtful) {
      doubt(&place, now_ms);
      counts = 3 * (now_ms - place.doubt_first_ms) >= 2 * delay_ms_;
    }
    if (!counts) return;
    std::uint32_t& last_ms = hit.is_high ? place.thing_high_ms : place.thing_low_ms;
    std::uint32_t& first_ms = hit.is_high ? place.first_ms : place.low_first_ms;
    if (last_ms == 0 || now_ms - last_ms > gap_ms_) first_ms = now_ms;
    last_ms = now_ms;
    place.thing_drift_m = drift_m;
  });
}

// visit(ix, iy, x and y in base): all places around base, row by row.
template <typename Visit>
void Places::each_around(const Track& track, const Visit& visit) const {
  const Turn2 turn(track.yaw_rad);
  const std::int32_t bx = place_of(track.x_m), by = place_of(track.y_m);
  for (std::int32_t iy = by - kPlacesAround; iy <= by + kPlacesAround; ++iy) {
    const std::int32_t ix = bx - kPlacesAround;
    const Eigen::Vector2d first =
        turn.back({(ix + 0.5) * kPlace_m - track.x_m, (iy + 0.5) * kPlace_m - track.y_m});
    const auto step_x = static_cast<float>(turn.c * kPlace_m), step_y = static_cast<float>(-turn.s * kPlace_m);
    const auto x = static_cast<float>(first.x()), y = static_cast<float>(first.y());
    for (std::int32_t k = 0; k <= 2 * kPlacesAround; ++k) {
      visit(ix + k, iy, x + static_cast<float>(k) * step_x, y + static_cast<float>(k) * step_y);
    }
  }
}

void Places::put_seen(const Sight& sight, const Track& track, const Eigen::Vector2d& sensor_m, const Sweep& sweep,
                      std::uint32_t now_ms) {
  const auto drift_m = static_cast<float>(track.drift_m);
  const auto sx = static_cast<float>(sensor_m.x()), sy = static_cast<float>(sensor_m.y());
  const float most_m = sight.seen_most_m();
  const auto machine_m = static_cast<float>(sweep.radius_m());
  each_around(track, [&](std::int32_t ix, std::int32_t iy, float x, float y) {
    const float dx = x - sx, dy = y - sy;
    const bool is_near = dx * dx + dy * dy < most_m * most_m;
    std::uint8_t seen = is_near ? sight.seen(dx, dy) : std::uint8_t{0};
    const bool is_machine = x * x + y * y < machine_m * machine_m && sweep.distance_now(x, y) < -kInside_m;
    if (is_machine) seen = Sight::kLow;
    Place& place = places_[index_of(ix, iy)];
    if (seen != 0) {
      (void)place_at(ix, iy);
      if (is_machine) place.thing_low_ms = place.thing_high_ms = 0;
      if ((seen & Sight::kTall) != 0) place.tall_ms = now_ms;
      if ((seen & Sight::kLow) != 0) place.low_ms = now_ms, place.low_drift_m = drift_m;
      if ((seen & Sight::kLow) != 0 && now_ms - place.thing_low_ms > delay_ms_) place.thing_low_ms = 0;
    }
    const bool may_go = place.thing_high_ms != 0 && now_ms - place.thing_high_ms > delay_ms_;
    if (may_go && known_at(ix, iy) != nullptr && sight.passed_high(dx, dy)) place.thing_high_ms = 0;
  });
}

void Places::confirm(const Track& track, const Sweep& sweep, std::uint32_t now_ms) {
  const auto drift_m = static_cast<float>(track.drift_m);
  each_around(track, [&](std::int32_t ix, std::int32_t iy, float x, float y) {
    if (!(sweep.distance_now(x, y) <= confirm_m_)) return;
    Place& place = place_at(ix, iy);
    place.low_ms = now_ms, place.low_drift_m = drift_m;
  });
}

// It, or a neighbour, was there for long. What went out of sight then is taken to be still there.
bool Places::is_settled(const Place& place, std::uint32_t now_ms) const {
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Place* const near = known_at(place.ix + dx, place.iy + dy);
      if (near == nullptr || near->thing_high_ms == 0 || now_ms - near->thing_high_ms > memory_ms_) continue;
      if (near->thing_high_ms - near->first_ms >= settle_ms_) return true;
    }
  }
  return false;
}

std::uint32_t Places::find_hazards(const Track& track, const Sweep& sweep, std::uint32_t now_ms, Span<Hazard> hazards,
                                   Count* count, bool* full) const {
  const float still_m = protection_m_ + kPlaceCorner_m, thing_m = still_m + kCellCorner_m;
  const float still_reach_m = thing_m + drift_most_m_ + sweep.growth_m(0.0F);
  const float walk_reach_m = still_reach_m + approach_m_s_ * (sweep.growth_m(1.0F) - sweep.growth_m(0.0F));
  const auto drift_m = static_cast<float>(track.drift_m);
  std::uint32_t found = 0;
  *full = false;
  each_around(track, [&](std::int32_t ix, std::int32_t iy, float x, float y) {
    if (!sweep.concerns(x, y, walk_reach_m)) return;
    const bool is_near = sweep.concerns(x, y, still_reach_m);
    const Place* const place = known_at(ix, iy);
    if (place == nullptr && !is_near) return;
    Hazard hazard{x, y, still_m, 0.0F, index_of(ix, iy), POSE_WALL_PLANAR_STOP_UNSEEN};
    if (place != nullptr) {
      const bool is_low = is_remembered(place->thing_low_ms, place->thing_drift_m, track, now_ms);
      const bool is_high = is_remembered(place->thing_high_ms, place->thing_drift_m, track, now_ms);
      count->doubtful += place->doubt_ms == now_ms && is_near ? 1 : 0;
      if (is_low || is_high) {
        ++count->things;
        hazard.margin_m = thing_m + drift_m - place->thing_drift_m;
        hazard.kind = static_cast<std::uint32_t>((is_low ? POSE_WALL_PLANAR_STOP_LOW : 0) +
                                                 (is_high ? POSE_WALL_PLANAR_STOP_HIGH : 0));
        if (is_high && !is_settled(*place, now_ms)) hazard.approach_m_s = approach_m_s_;
        if (!is_near && !(hazard.approach_m_s > 0.0F)) return;
      } else if (!is_near || is_free(*place, track, now_ms)) {
        return;
      }
    }
    if (sweep.distance_now(x, y) < kNotUnder_m) return;
    if (hazard.kind == POSE_WALL_PLANAR_STOP_UNSEEN) ++count->blind;
    if (found < hazards.size()) {
      hazards[found++] = hazard;
    } else {
      *full = true;
    }
  });
  return found;
}

double Places::size_around(std::uint32_t index, const Track& track, std::uint32_t now_ms) const {
  constexpr std::int32_t kAround = 10;  // 1 m
  const Place& middle = places_[index];
  std::int32_t low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  for (std::int32_t dy = -kAround; dy <= kAround; ++dy) {
    for (std::int32_t dx = -kAround; dx <= kAround; ++dx) {
      const Place* const near = known_at(middle.ix + dx, middle.iy + dy);
      if (near == nullptr || !is_thing(*near, track, now_ms)) continue;
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
