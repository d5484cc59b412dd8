// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Places of 0.1 m that stand still on the ground while the machine moves over them: when each was seen free, and when
// a thing was there. The ground's frame is that of the way; it serves for minutes, and its errors are bounded.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "place/pose2.hpp"
#include "planar/stop/dust_rate.hpp"
#include "planar/stop/sight.hpp"
#include "planar/stop/sweep.hpp"
#include "planar/stop/way.hpp"

namespace pose_wall::planar {

constexpr double kPlace_m = 0.1;            // a third of the smallest thing
constexpr std::int32_t kPlacesAround = 79;  // to each side of base
// From the middle of a place to its corner, and from the middle of a cell of the sight to its own.
constexpr float kPlaceCorner_m = 0.0707F, kCellCorner_m = 0.0640F;

struct Place {
  std::int16_t ix, iy;                         // which place of the ground this is
  std::uint32_t low_ms;                        // seen free low; 0: never
  std::uint32_t tall_ms;                       // seen free of people
  std::uint32_t watched_ms;                    // since then it was, again and again
  std::uint32_t top_ms;                        // seen free of what hangs
  std::uint32_t thing_low_ms, thing_high_ms;   // last return; 0: none, or seen gone
  std::uint32_t first_ms;                      // of the high returns that go on until now
  std::uint32_t low_first_ms;                  // likewise of the low ones
  std::uint32_t doubt_first_ms, doubt_ms;      // a few returns
  std::uint32_t dust_ms;                       // returns of dust or of a thin thing
  std::uint32_t wall_ms;                       // last part of a wall
  std::uint8_t doubts[2], doubts_in_frame[2];  // low and high ones, as long as they go on, and in the last frame
  std::uint8_t dust_run;                       // of frames in turn with such returns around it
  std::uint8_t high_x_mm, high_y_mm;           // where in it the high returns are, in the mean of the last ones
  std::uint8_t high_steps;                     // and their height, in steps of kHeightStep_m
};

class Places {
 public:
  void lay_out(Arena& arena) { places_ = arena.take<Place>(kPlacesAcross * kPlacesAcross); }
  void open(const StopSettings& settings);
  void forget();

  // The returns of a frame at time now_ms. `sensor` in base.
  void put_returns(const Sight& sight, const Way& way, const Eigen::Vector2d& sensor_m, std::uint32_t now_ms);
  // What was seen free, and what is gone.
  void put_seen(const Sight& sight, const Way& way, const Eigen::Vector2d& sensor_m, const Sweep& sweep,
                std::uint32_t now_ms);
  // Someone has looked.
  void confirm(const Way& way, const Sweep& sweep, std::uint32_t now_ms);

  struct Count {
    std::uint32_t things = 0, blind = 0, doubtful = 0;
  };
  // All that is in the way of a sweep, and high things that are gone go. `hazards` has room for kHazards.
  std::uint32_t find_hazards(const Sight& sight, const Way& way, const Eigen::Vector2d& sensor_m, const Sweep& sweep,
                             std::uint32_t now_ms, Span<Hazard> hazards, Count* count);

  const Place& at(std::uint32_t index) const { return places_[index]; }
  // Across, of things that hang together around a place.
  double size_around(std::uint32_t index, const Way& way, std::uint32_t now_ms) const;
  bool is_thing(const Place& place, const Way& way, std::uint32_t now_ms) const;

 private:
  template <typename Visit>
  void each_four(const Way& way, const Eigen::Vector2d& middle_m, double half_m, const Visit& visit) const;
  template <typename Visit>
  void each_around(const Way& way, const Eigen::Vector2d& middle_m, double half_m, const Visit& visit) const;
  void let_go(Place* place, const Sight& sight, float x, float y, std::uint32_t now_ms) const;
  bool is_wall(Place* place, const Eigen::Vector2d& away, std::uint32_t now_ms) const;
  // What find_hazards looks from.
  struct HazardScene {
    const Sight& sight;
    const Way& way;
    const Sweep& sweep;
    Turn2 turn;  // from base to the ground
    float sensor_x_m, sensor_y_m;
    std::uint32_t now_ms;
  };
  bool find_at(const HazardScene& scene, std::int32_t ix, std::int32_t iy, bool is_near, Hazard* hazard, Count* count);
  bool is_hazard(Place* place, const Way& way, const Eigen::Vector2d& away, std::uint32_t now_ms, Hazard* hazard) const;
  static std::int32_t place_of(double m);
  static std::uint32_t index_of(std::int32_t ix, std::int32_t iy);
  static bool is_of(const Place& place, std::int32_t ix, std::int32_t iy) {
    return place.ix == static_cast<std::int16_t>(ix) && place.iy == static_cast<std::int16_t>(iy);
  }
  bool brings_doubt_only(const Sight& sight, const Way& way, const Turn2& turn, const Eigen::Vector2d& origin_m,
                         const Sight::Return& hit, Place* place, std::uint32_t now_ms);
  Place& place_at(std::int32_t ix, std::int32_t iy);
  const Place* known_at(std::int32_t ix, std::int32_t iy) const;
  bool is_gone_through(const Sight& sight, const Way& way, const Turn2& turn, const Eigen::Vector2d& origin_m, float x,
                       float y, std::uint32_t now_ms) const;
  struct Around {
    bool is_wide, is_lasting;
  };
  Around look_around(Place* place, const Sight::Return& hit, std::uint32_t now_ms);
  bool is_thin_thing(Place* place, float by_chance, std::uint32_t now_ms);
  bool is_remembered(std::uint32_t when_ms, const Way& way, std::uint32_t now_ms) const;
  bool was_seen_with(const Place& near, const Place& place) const;
  const Place* under_body(const Place& place, const Eigen::Vector2d& away) const;
  bool walked_in(const Place& place, const Eigen::Vector2d& away) const;
  bool came_into_sight(const Place& place, const Eigen::Vector2d& away) const;
  bool has_stood(const Place& place, const Eigen::Vector2d& away) const;
  bool is_settled(const Place& place) const;
  struct LineAxis {
    std::int32_t along_x, along_y, along_most;  // a step, and so many places more or less, in sums of both axes
    std::int32_t chest_mm, deep_mm, to_sensor;  // the sign of what is nearer to the sensor
  };
  static LineAxis line_axis(const Eigen::Vector2d& away, const std::int32_t* axis);
  bool is_of_line(const Place& place, const Place& near, const Eigen::Vector2d& away, const LineAxis& axis) const;
  bool goes_on(const Place& place, const Eigen::Vector2d& away, const std::int32_t* axis_step, std::int32_t side) const;
  static Eigen::Vector2d between_mm(const Place& from, const Place& to);
  bool is_line_at(const Place& place, const Eigen::Vector2d& away, const Eigen::Vector2d& along_mm, double at) const;
  bool ends_line(const Place& place, const Eigen::Vector2d& away) const;
  bool came_alone(const Place& place) const;
  bool is_in_line(const Place& place, const Eigen::Vector2d& away) const;
  bool is_low_free(const Place& place, const Way& way) const;
  bool is_free(const Place& place, const Way& way, std::uint32_t now_ms) const;

  Span<Place> places_;
  DustRate dust_;
  std::uint32_t last_ms_ = 0;  // of the frame before
  std::uint32_t memory_ms_ = 0, delay_ms_ = 0, settle_ms_ = 0, gap_ms_ = 0;
  float drift_most_m_ = 0.0F, thing_half_m_ = 0.0F, protection_m_ = 0.0F, approach_m_s_ = 0.0F, confirm_m_ = 0.0F,
        sooner_s_ = 0.0F;
};

// Every place at most:
constexpr std::uint32_t kHazards = kPlacesAcross * kPlacesAcross;

}  // namespace pose_wall::planar
