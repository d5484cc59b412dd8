// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_holes.hpp"

#include <cmath>

namespace pose_wall {
namespace {

// A sensor of 2 degrees between its lines (VLP-16) hits every row of this height within this reach.
constexpr double kReach_m = 3.5;
constexpr double kRow_m = 0.15;
constexpr double kColumn_m = 0.2;
constexpr std::uint32_t kColumns = 36;
constexpr std::uint32_t kRowsMax = 32;
// So many columns side by side with next to nothing on the plane are an opening.
constexpr std::uint32_t kOpening = 5;
// Columns to look for the plane to each side.
constexpr std::uint32_t kAround = 7;
constexpr double kSolidShare = 0.25;
constexpr double kTiny = 1e-9;
constexpr double kSteepest = 1e3;
// What lies this near to the plane may be the wall's own roughness.
constexpr double kWellOff_m = 0.3;
// Rays that run along the plane say nothing about it.
constexpr double kTowards_m = 0.3;

class AnswerGrid {
 public:
  // Heights from the sensor's; away_m: horizontal distance of the plane from the sensor.
  AnswerGrid(double low_m, double high_m, double away_m)
      : low_m_(low_m),
        away_m_(away_m),
        row_m_((high_m - low_m) / kRowsMax > kRow_m ? (high_m - low_m) / kRowsMax : kRow_m) {
    rows_ = static_cast<std::uint32_t>((high_m - low_m) / row_m_);
    for (double& slope : lowest_) slope = kSteepest;
    for (double& slope : highest_) slope = -kSteepest;
  }

  enum Answer : std::uint8_t { kNone, kBefore, kBehind, kOnPlane };  // the greater one counts

  // A ray that meets the plane beside_m from the sensor along the road, up_m above the sensor.
  void add(double beside_m, double up_m, Answer answer) {
    const double place = beside_m / kColumn_m + kColumns / 2;
    if (!(place >= 0.0 && place < kColumns)) return;
    const auto column = static_cast<std::uint32_t>(place);
    const double slope = up_m / distance_m(beside_m);
    lowest_[column] = slope < lowest_[column] ? slope : lowest_[column];
    highest_[column] = slope > highest_[column] ? slope : highest_[column];
    const double row = (up_m - low_m_) / row_m_;
    if (!(row >= 0.0 && row < rows_)) return;
    Answer& best = answers_[static_cast<std::uint32_t>(row) * kColumns + column];
    best = answer > best ? answer : best;
  }

  WallHoles holes() const {
    Shares solid, gap;
    std::uint32_t gap_columns = 0, solid_columns = 0;
    const auto close_gap = [&] {
      // Through an opening the road beyond is seen.
      if (gap_columns >= kOpening) gap.behind = 0.0;
      solid.add(gap);
      gap = Shares{};
      gap_columns = 0;
    };
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const Shares here = shares(column);
      if (!(here.all() > 0.0)) continue;  // hidden, or out of sight
      if (here.on_plane < kSolidShare * here.all()) {
        ++gap_columns;
        gap.add(here);
      } else {
        close_gap();
        ++solid_columns;
        solid.add(here);
      }
    }
    // Where hardly anything is solid, it is no opening in a wall: there is none.
    if (solid_columns < kOpening) gap_columns = 0;
    close_gap();
    WallHoles out;
    if (!(solid.all() > 0.0)) return out;
    out.silent = solid.silent / (solid.silent + solid.on_plane + kTiny);
    out.open = (solid.silent + solid.behind) / solid.all();
    return out;
  }

 private:
  struct Column {
    double low_m, high_m;
  };

  struct Shares {
    double silent = 0.0, behind = 0.0, on_plane = 0.0;
    double all() const { return silent + behind + on_plane; }
    void add(const Shares& other) {
      silent += other.silent;
      behind += other.behind;
      on_plane += other.on_plane;
    }
  };

  double distance_m(double beside_m) const { return std::sqrt(beside_m * beside_m + away_m_ * away_m_); }

  bool on_plane(std::uint32_t column) const {
    for (std::uint32_t row = 0; row < rows_; ++row) {
      if (answers_[row * kColumns + column] == kOnPlane) return true;
    }
    return false;
  }

  struct Sight {
    double lowest = 0.0, highest = 0.0;  // slopes
  };

  // The sensor looks everywhere between its lowest and its highest ray. A column without the plane borrows from those
  // to both sides that have it: what is dark all over shows no rays at all.
  Sight sight(std::uint32_t column) const {
    if (on_plane(column)) return {lowest_[column], highest_[column]};
    std::uint32_t before = column, after = column;
    while (before > 0 && column - before <= kAround && !on_plane(before)) --before;
    while (after + 1 < kColumns && after - column <= kAround && !on_plane(after)) ++after;
    if (!on_plane(before) || !on_plane(after)) return {};
    const double share = static_cast<double>(column - before) / static_cast<double>(after - before);
    return {lowest_[before] + share * (lowest_[after] - lowest_[before]),
            highest_[before] + share * (highest_[after] - highest_[before])};
  }

  Shares shares(std::uint32_t column) const {
    const Sight in_sight = sight(column);
    const double distance = distance_m((column + 0.5 - kColumns / 2.0) * kColumn_m);
    Shares out;
    if (!(distance <= kReach_m)) return out;
    for (std::uint32_t row = 0; row < rows_; ++row) {
      const double from_m = low_m_ + row * row_m_;
      if (!(from_m >= in_sight.lowest * distance && from_m + row_m_ <= in_sight.highest * distance)) continue;
      const Answer answer = answers_[row * kColumns + column];
      out.silent += answer == kNone ? 1.0 : 0.0;
      out.behind += answer == kBehind ? 1.0 : 0.0;
      out.on_plane += answer == kOnPlane ? 1.0 : 0.0;
    }
    return out;
  }

  double low_m_, away_m_, row_m_;
  std::uint32_t rows_;
  double lowest_[kColumns], highest_[kColumns];  // slopes of the rays
  Answer answers_[kRowsMax * kColumns] = {};
};

// What is seen above the plane's points, column by column.
class TopView {
 public:
  void hit(double beside_m, double up_m) {
    const std::uint32_t c = column(beside_m);
    if (c < kColumnsMax && up_m > top_[c]) top_[c] = up_m;
  }
  // After all hits. A ray that meets the plane's prolongation: ends before or behind it.
  void pass(double beside_m, double up_m, bool behind) {
    const std::uint32_t c = column(beside_m);
    // Further up, a sensor that looks up sees the roof over itself.
    if (!(c < kColumnsMax && up_m > top_[c] + kClear_m && up_m < top_[c] + kAbove_m)) return;
    ++(behind ? behind_[c] : before_[c]);
  }
  double overtopped() const {
    double seen = 0.0, over = 0.0;
    for (std::uint32_t c = 0; c < kColumnsMax; ++c) {
      if (before_[c] + behind_[c] < kRaysMin) continue;
      seen += 1.0;
      over += behind_[c] > before_[c] ? 1.0 : 0.0;
    }
    return seen >= kSeenMin ? over / seen : 0.0;
  }

  TopView() {
    for (double& top : top_) top = -kSteepest;
  }

 private:
  static constexpr std::uint32_t kColumnsMax = 32;
  static constexpr double kWidth_m = 0.5;
  static constexpr double kClear_m = 0.1;
  static constexpr double kAbove_m = 0.5;
  static constexpr std::uint32_t kRaysMin = 4;
  static constexpr double kSeenMin = 4.0;

  static std::uint32_t column(double beside_m) {
    const double place = beside_m / kWidth_m + kColumnsMax / 2;
    return place >= 0.0 && place < kColumnsMax ? static_cast<std::uint32_t>(place) : kColumnsMax;
  }

  double top_[kColumnsMax];
  std::uint32_t before_[kColumnsMax] = {}, behind_[kColumnsMax] = {};
};

// Where the ray to a point meets the plane.
struct Crossing {
  bool towards = false;
  double beside_m, up_m, distance2_m2, beyond_m;  // beyond: how far behind the plane the ray ends
};

Crossing crossing_of(const Eigen::Vector3d& ray, const Plane& wall, double sensor_inside_m,
                     const Eigen::Vector3d& along_level) {
  Crossing out;
  const double r = sensor_inside_m + wall.n.dot(ray);
  out.towards = sensor_inside_m - r > kTowards_m;
  if (!out.towards) return out;
  const Eigen::Vector3d to_plane = ray * (sensor_inside_m / (sensor_inside_m - r));
  out.beside_m = along_level.dot(to_plane);
  out.up_m = to_plane.z();
  out.distance2_m2 = to_plane.squaredNorm();
  out.beyond_m = -r;
  return out;
}

double overtopped_share(const WallScene& scene, const Plane& wall, double sensor_inside_m,
                        const Eigen::Vector3d& along_level, double hit_m) {
  TopView view;
  for (std::uint32_t i = 0; i < scene.band_level.count; ++i) {
    const Crossing c = crossing_of(scene.band_level.at(i) - scene.sensor_level_m, wall, sensor_inside_m, along_level);
    if (c.towards && std::fabs(c.beyond_m) <= hit_m) view.hit(c.beside_m, c.up_m);
  }
  for (const PointSet* points : {&scene.band_level, &scene.beyond_level}) {
    for (std::uint32_t i = 0; i < points->count; ++i) {
      const Crossing c = crossing_of(points->at(i) - scene.sensor_level_m, wall, sensor_inside_m, along_level);
      if (c.towards && std::fabs(c.beyond_m) > kWellOff_m) view.pass(c.beside_m, c.up_m, c.beyond_m > 0.0);
    }
  }
  return view.overtopped();
}

}  // namespace

WallHoles find_holes(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double hit_m) {
  const Eigen::Vector3d& sensor = scene.sensor_level_m;
  const double sensor_inside_m = wall.signed_distance(sensor);
  const double flat = std::sqrt(wall.n.x() * wall.n.x() + wall.n.y() * wall.n.y());
  if (!(sensor_inside_m > 0.0)) return {};
  AnswerGrid grid(scene.z_min_level_m - sensor.z(), scene.z_max_level_m - sensor.z(), sensor_inside_m / flat);
  for (const PointSet* points : {&scene.band_level, &scene.beyond_level}) {
    for (std::uint32_t i = 0; i < points->count; ++i) {
      const Crossing c = crossing_of(points->at(i) - sensor, wall, sensor_inside_m, along_level);
      if (!c.towards || !(c.distance2_m2 <= kReach_m * kReach_m)) continue;
      const AnswerGrid::Answer answer = c.beyond_m > hit_m    ? AnswerGrid::kBehind
                                        : c.beyond_m < -hit_m ? AnswerGrid::kBefore
                                                              : AnswerGrid::kOnPlane;
      grid.add(c.beside_m, c.up_m, answer);
    }
  }
  WallHoles holes = grid.holes();
  holes.overtopped = overtopped_share(scene, wall, sensor_inside_m, along_level, hit_m);
  return holes;
}

}  // namespace pose_wall
