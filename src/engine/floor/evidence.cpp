// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/floor/evidence.hpp"

#include <cmath>
#include <cstring>

#include "base/estimation/near_plane.hpp"
#include "base/simd/four_floats.hpp"
#include "lidar/crossing.hpp"

namespace pose_wall {
namespace {

constexpr double kDrivingStripHalf_m = 1.0;  // the machine is 1.2 m wide; open floor in its track counts twice
constexpr double kHeightBin_m = 0.125;       // 8 m of height in 64 bins
constexpr float kHeightBins = 64.0F;         // one bit of a word each
constexpr double kBelowSensor_m = 5.5;       // sensors stand up to 3.5 m high (ground_height_max), slopes get 2 m
// A point is closed if two of the six bins above or below it hold points; one bin may be dust.
constexpr std::uint64_t kSixBins = 0x3F;  // six in a row: from 0.25 m to 1 m away
constexpr int kFirstBin = 2;              // the floor's own scatter and slope reach one bin
constexpr int kSixthBin = 7;              // kFirstBin and five more

bool two_or_more(std::uint64_t bits) {
  return (bits & (bits - 1)) != 0;
}

std::uint64_t bins_above(std::uint64_t heights, int bin) {
  const int from = bin + kFirstBin;
  return from < 64 ? (heights >> from) & kSixBins : 0;
}

std::uint64_t bins_below(std::uint64_t heights, int bin) {
  const int from = bin - kSixthBin;
  if (from >= 0) return (heights >> from) & kSixBins;
  return heights & (from > -6 ? kSixBins >> -from : 0);
}

}  // namespace

void FloorGrid::lay_out(Arena& arena) {
  eighths_ = arena.take<std::uint64_t>(kSide * kSide);
  marked_ = arena.take<std::uint8_t>(kSide * kSide);
  near_marked_ = arena.take<std::uint8_t>(kSide * kSide);
}

std::int32_t FloorGrid::cell_of(float coordinate_m) {
  // Counts from far below every coordinate, so that cutting off the fraction rounds down without a call to floor().
  // Anything further out is outside anyway.
  constexpr std::int32_t kFar = 1 << 10;
  return static_cast<std::int32_t>(coordinate_m * static_cast<float>(1.0 / kCell_m) + (kFar + kSide / 2)) - kFar;
}

FourInts FloorGrid::cells_of(FourFloats coordinates_m) {
  const FourFloats cell = coordinates_m * static_cast<float>(1.0 / kCell_m) + 0.5F * kSide, none{};
  return cut_off(smaller_of(larger_of(cell, none), all_four(kSide - 1)));
}

// The place of four points: cell and height bin as one number, or kNowhere outside the radius or the grid's height.
class FloorGrid::FourBins {
 public:
  FourBins(double radius_m, double lowest_m)
      : radius2_(static_cast<float>(radius_m * radius_m)), lowest_m_(static_cast<float>(lowest_m)) {}

  void look_at(FourFloats x, FourFloats y, FourFloats z) {
    const FourFloats bin = (z - lowest_m_) * static_cast<float>(1.0 / kHeightBin_m), none{};
    const FourFloats ix = x * static_cast<float>(1.0 / kCell_m) + 0.5F * kSide;
    const FourFloats iy = y * static_cast<float>(1.0 / kCell_m) + 0.5F * kSide;
    const FourTruths inside = (x * x + y * y <= radius2_) & (bin >= none) & (bin < all_four(kHeightBins)) &
                              (ix >= none) & (ix < all_four(kSide)) & (iy >= none) & (iy < all_four(kSide));
    const FourInts cell = cut_off(inside ? iy : none) * kSide + cut_off(inside ? ix : none);
    place = inside ? cell * kBins + cut_off(inside ? bin : none) : all_four_ints(kNowhere);
  }

  FourInts place{};

  static constexpr std::int32_t kNowhere = -1;  // outside the grid; no place is negative
  static constexpr std::int32_t kBins = static_cast<std::int32_t>(kHeightBins);  // kHeightBins as an integer

 private:
  float radius2_, lowest_m_;
};

void FloorGrid::find_open(const PointSet& points_base, double radius_m, double sensor_z_base_m,
                          Span<std::uint32_t> places, PointSet* open) {
  eighths_.fill(0);
  FourBins four(radius_m, sensor_z_base_m - kBelowSensor_m);
  constexpr auto kNowhere = static_cast<std::uint32_t>(FourBins::kNowhere);  // unsigned, like the listed places
  std::uint32_t last = kNowhere;  // points come roughly in the order of their places
  for_each_four_points(points_base, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    four.look_at(x, y, z);
    const FourInts here = counts ? four.place : all_four_ints(FourBins::kNowhere);
    store_four(here, &places[i]);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const auto place = static_cast<std::uint32_t>(here[lane]);
      if (place == last) continue;
      last = place;
      if (place != kNowhere) eighths_[place / FourBins::kBins] |= 1ULL << place % FourBins::kBins;
    }
  });
  open->count = 0;
  last = kNowhere;
  bool is_open = false;
  for (std::uint32_t i = 0; i < points_base.count; ++i) {
    const std::uint32_t place = places[i];
    if (place != last) {
      const std::uint64_t heights = place != kNowhere ? eighths_[place / FourBins::kBins] : 0;
      const int bin = static_cast<int>(place % FourBins::kBins);
      is_open = place != kNowhere && !two_or_more(bins_above(heights, bin)) && !two_or_more(bins_below(heights, bin));
      last = place;
    }
    if (!is_open) continue;
    open->add(points_base.x[i], points_base.y[i], points_base.z[i], points_base.weight[i]);
  }
}

FourTruths FloorGrid::clear_around(FourFloats x_base_m, FourFloats y_base_m, FourTruths counts) const {
  // Keeps clear of a wall's foot; 0.25 m at first; swept: half 3 lost 1 won, twice 5 lost 5 won 1 beyond.
  constexpr float kAround_m = 0.1F;
  const FourFloats none{}, x = counts ? x_base_m : none, y = counts ? y_base_m : none;
  const FourInts x_low = cells_of(x - kAround_m), x_high = cells_of(x + kAround_m);
  const FourInts y_low = cells_of(y - kAround_m) * kSide, y_high = cells_of(y + kAround_m) * kSide;
  static_assert(2.0 * kAround_m <= kCell_m, "two cells at most");
  const FourInts corners[] = {y_low + x_low, y_low + x_high, y_high + x_low, y_high + x_high};
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    bool rises = false;
    for (const FourInts& corner : corners)
      rises = rises || (marked_[static_cast<std::uint32_t>(corner[lane])] & kMarked) != 0;
    if (rises) counts[lane] = 0;
  }
  return counts;
}

void FloorGrid::clear_marks() {
  marked_.fill(0);
  near_marked_.fill(0);
  bounds_ = Bounds{};
  marked_cells_ = 0;
}

void FloorGrid::mark_cell(std::int32_t ix, std::int32_t iy) {
  marked_[index(ix, iy)] = kMarked;
  ++marked_cells_;
  bounds_.x_min = ix < bounds_.x_min ? ix : bounds_.x_min;
  bounds_.x_max = ix > bounds_.x_max ? ix : bounds_.x_max;
  bounds_.y_min = iy < bounds_.y_min ? iy : bounds_.y_min;
  bounds_.y_max = iy > bounds_.y_max ? iy : bounds_.y_max;
  const std::int32_t x_first = ix > 0 ? ix - 1 : 0, x_last = ix < kSide - 1 ? ix + 1 : ix;
  const std::int32_t y_first = iy > 0 ? iy - 1 : 0, y_last = iy < kSide - 1 ? iy + 1 : iy;
  for (std::int32_t y = y_first; y <= y_last; ++y) {
    std::memset(&near_marked_[index(x_first, y)], 1, static_cast<std::size_t>(x_last - x_first) + 1);
  }
}

void FloorGrid::mark_four(FourFloats x, FourFloats y, FourTruths on) {
  if (!any_of(on)) return;
  const FourInts ix = cells_of(x), iy = cells_of(y);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if (on[lane] != 0 && marked_[index(ix[lane], iy[lane])] == 0) mark_cell(ix[lane], iy[lane]);
  }
}

template <typename IsOn>
void FloorGrid::mark_where(const PointSet& open_base, const IsOn& is_on) {
  clear_marks();
  for_each_four_points(open_base, [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    mark_four(x, y, counts & is_on(x, y, z));
  });
}

void FloorGrid::mark(const PointSet& open_base, const Plane& plane, double thresh_m) {
  const FourDistances distances(plane);
  const FourFloats most = all_four(static_cast<float>(thresh_m));
  mark_where(open_base,
             [&](FourFloats x, FourFloats y, FourFloats z) { return magnitude_of(distances.of(x, y, z)) <= most; });
}

void FloorGrid::mark_apart(const PointSet& open_base, const Plane& plane, const Plane& other, double thresh_m) {
  const FourDistances distances(plane), from_other(other);
  const FourFloats most = all_four(static_cast<float>(thresh_m));
  mark_where(open_base, [&](FourFloats x, FourFloats y, FourFloats z) {
    return (magnitude_of(distances.of(x, y, z)) <= most) & (magnitude_of(from_other.of(x, y, z)) > most);
  });
}

void FloorGrid::mark_rising(const BoundedPoints& points_base, const Plane& plane, double gate_m) {
  // What hangs higher, as the roof, stands on nothing here; swept: half 2 lost 2 won, twice 4 lost 6 won.
  constexpr float kTall = 1.0F;
  const FourDistances distances(plane);
  const FourFloats gate = all_four(static_cast<float>(gate_m));
  // The grid has no place for what lies farther away.
  constexpr auto kReach2 = static_cast<float>(0.25 * kSide * kSide * kCell_m * kCell_m);
  clear_marks();
  constexpr double kRounding_m = 1e-3;  // of floats: a block may be passed over only if none of its points rises
  const Slab rising(plane, gate_m - kRounding_m, static_cast<double>(kTall) + kRounding_m);
  for_each_four_about(points_base, rising, [&](std::uint32_t i, FourTruths counts) {
    const FourFloats x = load_four(&points_base.x[i]), y = load_four(&points_base.y[i]);
    const FourFloats height = distances.of(x, y, load_four(&points_base.z[i]));
    mark_four(x, y, counts & (height > gate) & (height < all_four(kTall)) & (x * x + y * y < all_four(kReach2)));
  });
}

FloorEvidence FloorGrid::evidence(const Axes& axes) const {
  constexpr double kCellArea_m2 = kCell_m * kCell_m;  // of a cell in plan
  FloorEvidence out;
  for (std::int32_t iy = bounds_.y_min; iy <= bounds_.y_max; ++iy) {
    for (std::int32_t ix = bounds_.x_min; ix <= bounds_.x_max; ++ix) {
      if ((marked_[index(ix, iy)] & kMarked) == 0) continue;
      const double x = (static_cast<double>(ix - kSide / 2) + 0.5) * kCell_m;
      const double y = (static_cast<double>(iy - kSide / 2) + 0.5) * kCell_m;
      const double across = axes.left_base.x() * x + axes.left_base.y() * y;
      out.area_m2 += kCellArea_m2;
      out.score_m2 += std::fabs(across) <= kDrivingStripHalf_m ? kCellArea_m2 * 2.0 : kCellArea_m2;
    }
  }
  return out;
}

bool FloorGrid::marked_near(double x_base_m, double y_base_m) const {
  const std::int32_t ix = cell_of(static_cast<float>(x_base_m)), iy = cell_of(static_cast<float>(y_base_m));
  return inside(ix, iy) && near_marked_[index(ix, iy)] != 0;
}

bool FloorGrid::marked_behind(const Eigen::Vector3d& sensor_base_m, const Eigen::Vector3d& place_base_m) const {
  constexpr int kSteps = 8;        // looks 4 m behind the place, along the ray; swept: half 7 lost, twice nothing
  constexpr double kStep_m = 0.5;  // two cells: marks reach one further, so no marked cell is missed
  const double dx = place_base_m.x() - sensor_base_m.x(), dy = place_base_m.y() - sensor_base_m.y();
  const double away = std::sqrt(dx * dx + dy * dy);
  if (!(away > 0.0)) return marked_near(place_base_m.x(), place_base_m.y());
  for (int step = 0; step <= kSteps; ++step) {
    const double reach = static_cast<double>(step) * kStep_m / away;
    if (marked_near(place_base_m.x() + reach * dx, place_base_m.y() + reach * dy)) return true;
  }
  return false;
}

bool FloorGrid::much_lies_below(const Plane& plane, const BoundedPoints& points_base, double radius_m,
                                const Eigen::Vector3d& sensor_base_m, double share_max) {
  // A floor dips so far below its plane; benches lie higher; swept: half nothing, twice 1 moved.
  constexpr double kBelow_m = 0.2;
  constexpr double kFall = 0.03;  // and 3 cm more for each metre away (1.7 degrees); swept: half nothing, twice 1 moved
  const double limit2 = radius_m * radius_m, sensor_height_m = plane.signed_distance(sensor_base_m);
  const auto most = static_cast<std::uint32_t>(share_max * marked_cells_);
  std::uint32_t below = 0;
  const Slab low(plane, kAnyDepth_m, -kBelow_m);
  for_each_in_while(points_base, low, [&](std::uint32_t i, float height_m) {
    const Eigen::Vector3d p = points_base.at(i);
    const double away2 = p.head<2>().squaredNorm(), height = static_cast<double>(height_m);
    if (!(away2 <= limit2) || !(height < -(kBelow_m + kFall * std::sqrt(away2)))) return true;
    const std::int32_t ix = cell_of(points_base.x[i]), iy = cell_of(points_base.y[i]);
    if (!inside(ix, iy) || (marked_[index(ix, iy)] & kBelow) != 0) return true;
    const Eigen::Vector3d crossing = on_the_way(sensor_base_m, p, way_to_plane(sensor_height_m, height));
    if (marked_behind(sensor_base_m, crossing)) return true;
    marked_[index(ix, iy)] |= kBelow;
    ++below;
    return below <= most;
  });
  return below > most;
}

double share_seen_through(const FloorGrid& marked, const Plane& marked_plane, const Plane& below,
                          const PointSet& open_base, const Eigen::Vector3d& sensor_base_m, double thresh_m) {
  const double sensor_height_m = marked_plane.signed_distance(sensor_base_m);
  std::uint32_t on_below = 0, through = 0;
  const auto look_at = [&](const Eigen::Vector3d& p) {
    if (!(std::fabs(below.signed_distance(p)) <= thresh_m)) return;
    ++on_below;
    const double height = marked_plane.signed_distance(p);
    if (!(height < -2.0 * thresh_m)) return;
    const Eigen::Vector3d crossing = on_the_way(sensor_base_m, p, way_to_plane(sensor_height_m, height));
    if (marked.marked_near(crossing.x(), crossing.y())) ++through;
  };
  // Most points lie nowhere near the lower plane, as floats show four at a time.
  constexpr double kRounding_m = 1e-3;  // of floats of a point within range_max
  const FourDistances roughly(below);
  const FourFloats near = all_four(static_cast<float>(thresh_m + kRounding_m));
  for_each_four_points(open_base, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourTruths close = counts & (magnitude_of(roughly.of(x, y, z)) <= near);
    if (!any_of(close)) return;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (close[lane] != 0) look_at(open_base.at(i + lane));
    }
  });
  return on_below > 0 ? static_cast<double>(through) / static_cast<double>(on_below) : 0.0;
}

}  // namespace pose_wall
