// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/doubts/sight_lines.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall {
namespace {

constexpr std::uint32_t kRows = DirectionGrid::kRows;        // of the directions' grid
constexpr std::uint32_t kColumns = DirectionGrid::kColumns;  // of the directions' grid
constexpr double kExpectedRank = 0.75;  // the upper quartile: half of the directions may be dark, blocked or hidden
constexpr double kAnswersShare = 0.5;  // of the quartile; less is dark or half hidden; swept: half nothing, twice 1 won
// A row with fewer expects nothing; swept: half and twice change nothing.
constexpr std::uint32_t kSeenMin = kColumns / 8;
constexpr double kEmptyShare = 0.05;  // a column with fewer returns is empty; swept: half and twice change nothing
// 14 degrees, as a post or a cabin blocks; swept: half and twice change nothing.
constexpr std::uint32_t kBlockedColumns = 5;
constexpr int kSectorsForgiven = 2;  // two are the machine's, more the road's; swept: half 4 lost, twice nothing

struct Sector {
  std::uint32_t from = 0, columns = 0;
};

// The widest run of empty columns, around the circle.
Sector widest_sector(const bool (&empty)[kColumns]) {
  Sector widest;
  for (std::uint32_t from = 0; from < kColumns; ++from) {
    if (!empty[from] || (empty[(from + kColumns - 1) % kColumns] && from > 0)) continue;
    Sector here{from, 0};
    while (here.columns < kColumns && empty[(from + here.columns) % kColumns]) ++here.columns;
    if (here.columns > widest.columns) widest = here;
  }
  return widest;
}

// Cosine from the normal; flatter rays smear over cells; swept: half and twice change nothing.
constexpr double kTowardsMin = 0.2;

}  // namespace

void ExpectedReturns::look_at(const DirectionGrid& returns_lidar) {
  for (std::uint32_t column = 0; column < kColumns; ++column) width_[column] = Directions::width(column);
  for (std::uint32_t row = 0; row < kRows; ++row) {
    double counts[kColumns];
    std::uint32_t seen = 0;
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t count = returns_lidar.count(row, column);
      if (count > 0) counts[seen++] = count / width_[column];
    }
    per_width_[row] = 0.0;
    if (seen < kSeenMin) continue;
    double* const rank = counts + static_cast<std::uint32_t>(kExpectedRank * seen);
    std::nth_element(counts, rank, counts + seen);
    // The mean of those that answer at all. Where returns come by chance the quartile itself is more than is expected.
    const double answers_from = kAnswersShare * *rank;
    double answers = 0.0, widths = 0.0;
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const double count = returns_lidar.count(row, column);
      if (!(count >= answers_from * width_[column])) continue;
      answers += count;
      widths += width_[column];
    }
    per_width_[row] = answers / widths;
  }
}

void SeenColumns::look_at(const DirectionGrid& returns_lidar, const ExpectedReturns& expected) {
  bool empty[kColumns];
  for (std::uint32_t c = 0; c < kColumns; ++c) {
    double count = 0.0, all = 0.0;
    for (std::uint32_t row = 0; row < kRows; ++row) {
      count += returns_lidar.count(row, c);
      all += expected.at(row, c);
    }
    empty[c] = !(count > kEmptyShare * all);
  }
  for (bool& seen : is_seen) seen = true;
  for (int forgiven = 0; forgiven < kSectorsForgiven; ++forgiven) {
    const Sector sector = widest_sector(empty);
    for (std::uint32_t k = 0; k < sector.columns; ++k) {
      const std::uint32_t c = (sector.from + k) % kColumns;
      empty[c] = false;
      is_seen[c] = sector.columns < kBlockedColumns;
    }
  }
}

SightLines::SightLines(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level)
    : inside_m_(wall.signed_distance(scene.sensor_level_m)), sensor_z_level_m_(scene.sensor_level_m.z()) {
  const Eigen::Matrix3d R_lidar_level = (scene.R_level_base * scene.extrinsic.R_base_lidar).transpose();
  n_lidar_ = R_lidar_level * wall.n;
  along_lidar_ = R_lidar_level * along_level;
  up_lidar_ = R_lidar_level.col(2);
  for (std::uint32_t c = 0; c < DirectionGrid::kColumns; ++c) column_[c] = Directions::column(c);
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    up_[row] = scene.returns_lidar.rows.up(row);
    flat_[row] = std::sqrt(1.0 - up_[row] * up_[row]);
  }
}

SightLines::Crossing SightLines::at(std::uint32_t row, std::uint32_t column) const {
  return within(kReach_m, kTowardsMin, row, column);
}

bool SightLines::looks_towards(std::uint32_t column) const {
  constexpr double kLittleLess = 0.99;  // rounding may make a ray a little longer than 1
  // For the row that looks most towards the plane.
  const double flat = -(n_lidar_.x() * column_[column].x + n_lidar_.y() * column_[column].y);
  const double most2 = (flat > 0.0 ? flat * flat : 0.0) + n_lidar_.z() * n_lidar_.z();
  return most2 > kLittleLess * kTowardsMin * kTowardsMin;
}

SightLines::Crossing SightLines::far(std::uint32_t row, std::uint32_t column) const {
  return within(kFarReach_m, 0.0, row, column);
}

SightLines::Crossing SightLines::within(double reach_m, double towards_min, std::uint32_t row,
                                        std::uint32_t column) const {
  const Eigen::Vector3d ray = ray_lidar(row, column);
  const double towards = -n_lidar_.dot(ray);
  if (!(towards > towards_min && inside_m_ <= reach_m * towards)) return {false, 0.0, 0.0};
  const double range_m = inside_m_ / towards;
  return {true, range_m * along_lidar_.dot(ray), sensor_z_level_m_ + range_m * up_lidar_.dot(ray)};
}

SightLines::Zone SightLines::zone(std::uint32_t row, std::uint32_t column) const {
  // 37 degrees about the road, where all may be too far; swept: half and twice change nothing.
  constexpr double kAlongCos = 0.8;
  // 20 degrees: steeper rays meet roof or floor, not the other wall.
  constexpr double kUpSine = 0.34;  // swept: half and twice change nothing
  const Eigen::Vector3d ray = ray_lidar(row, column);
  if (std::fabs(along_lidar_.dot(ray)) > kAlongCos) return kAlong;
  const double up = up_lidar_.dot(ray);
  if (std::fabs(up) <= kUpSine) return kBeside;
  return up > 0.0 ? kAbove : kBelow;
}

std::uint32_t SightLines::column_away() const {
  std::uint32_t best = 0;
  double best_away = -2.0;
  for (std::uint32_t column = 0; column < DirectionGrid::kColumns; ++column) {
    const Directions::Column& c = column_[column];
    const double away = n_lidar_.x() * c.x + n_lidar_.y() * c.y;
    if (away > best_away) {
      best_away = away;
      best = column;
    }
  }
  return best;
}

}  // namespace pose_wall
