// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every return is counted once, in the cell whose range of directions holds it; columns are as wide as they
// say; full cells stay full; axes, poles and rays of any length have a cell. No border of rows parts a ring of a sparse
// sensor, near or far, and the rows of a dense one are even.

#include "engine/cloud/direction_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kSlices = Directions::kSlices, kColumns = Directions::kColumns;

class Counted {
 public:
  Counted() { clear(); }
  void clear() { grid_->clear(); }
  const DirectionSlices* operator->() { return grid_.get(); }
  const DirectionSlices& operator*() { return *grid_; }
  void add_to(std::uint32_t cell, std::uint32_t returns) { grid_->add(cell, returns); }
  void add(const Eigen::Vector3d& ray, std::uint32_t returns) { grid_->add(Directions::cell_of(ray), returns); }
  std::uint64_t all() {
    std::uint64_t sum = 0;
    for (std::uint32_t column = 0; column < kColumns; ++column) sum += of_column(column);
    return sum;
  }
  std::uint64_t of_column(std::uint32_t column) {
    std::uint64_t sum = 0;
    for (std::uint32_t row = 0; row < kSlices; ++row) sum += grid_->count(row, column);
    return sum;
  }

 private:
  test::Placed<DirectionSlices> grid_;
};

Eigen::Vector3d middle_of(std::uint32_t row, std::uint32_t column) {
  const double up = Directions::up(row), flat = std::sqrt(1.0 - up * up);
  const Directions::Column c = Directions::column(column);
  return {c.x * flat, c.y * flat, up};
}

TEST(DirectionGrid, TheMiddleOfACellIsInTheCell) {
  Counted grid;
  for (std::uint32_t row = 0; row < kSlices; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      for (const double range_m : {1e-6, 0.3, 30.0, 1e6}) grid.add(range_m * middle_of(row, column), 1);
      ASSERT_EQ(grid->count(row, column), 4U) << row << " " << column;
    }
  }
  EXPECT_EQ(grid.all(), 4U * kSlices * kColumns);
}

TEST(DirectionGrid, ColumnsAreUnitVectorsAroundTheCircleOfAWidthFromOneToTwo) {
  double last_rad = -1.0, width_rad = 0.0;
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    const Directions::Column c = Directions::column(column);
    EXPECT_NEAR(std::hypot(c.x, c.y), 1.0, 1e-12);
    EXPECT_GE(c.width, 1.0);
    EXPECT_LE(c.width, 2.0);
    const double azimuth_rad = std::fmod(std::atan2(c.y, c.x) + 2.0 * M_PI, 2.0 * M_PI);
    EXPECT_GT(azimuth_rad, last_rad) << "from +X over +Y";
    last_rad = azimuth_rad;
    width_rad += c.width * (4.0 / kColumns);  // a step along the square, seen from its centre
  }
  EXPECT_NEAR(width_rad, 2.0 * M_PI, 1e-3);
}

// Also near the poles, where a circle of directions is short.
TEST(DirectionGrid, RaysEvenInAzimuthFillColumnsByTheirWidth) {
  constexpr int kRays = 400000;
  constexpr double kDeviations = 5.0;  // of 128 columns, none by chance
  for (const double up : {-0.9, 0.0, 0.3, 0.99}) {
    test::Noise noise(1);
    Counted grid;
    for (int i = 0; i < kRays; ++i) {
      const double azimuth_rad = noise.uniform(-M_PI, M_PI), flat = std::sqrt(1.0 - up * up);
      grid.add({flat * std::cos(azimuth_rad), flat * std::sin(azimuth_rad), up}, 1);
    }
    EXPECT_EQ(grid.all(), static_cast<std::uint64_t>(kRays));
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const double expected = kRays * Directions::column(column).width * (4.0 / kColumns) / (2.0 * M_PI);
      const auto count = static_cast<double>(grid.of_column(column));
      EXPECT_NEAR(count, expected, kDeviations * std::sqrt(expected)) << column << " at " << up;
    }
  }
}

TEST(DirectionGrid, RowsHoldEqualPartsOfTheSphere) {
  constexpr int kRays = 200000;
  test::Noise noise(2);
  Counted grid;
  for (int i = 0; i < kRays; ++i) grid.add({noise.normal(1.0), noise.normal(1.0), noise.normal(1.0)}, 1);
  const double expected = static_cast<double>(kRays) / kSlices;
  for (std::uint32_t row = 0; row < kSlices; ++row) {
    double sum = 0.0;
    for (std::uint32_t column = 0; column < kColumns; ++column) sum += grid->count(row, column);
    EXPECT_NEAR(sum, expected, 5.0 * std::sqrt(expected)) << row;
  }
}

TEST(DirectionGrid, FullCellsStayFull) {
  Counted grid;
  const Eigen::Vector3d ray(1.0, 2.0, -0.5);
  for (int i = 0; i < 65534; ++i) grid.add(ray, 1);
  EXPECT_EQ(grid.all(), 65534U);
  grid.add(ray, 1);
  EXPECT_EQ(grid.all(), 65535U);
  grid.add(ray, 1);
  grid.add(ray, 1000000);
  EXPECT_EQ(grid.all(), 65535U);
  grid.clear();
  EXPECT_EQ(grid.all(), 0U);
}

TEST(DirectionGrid, AxesAndPolesHaveACell) {
  Counted grid;
  const std::uint32_t level = kSlices / 2;
  grid.add({1, 0, 0}, 1);
  grid.add({0, 1, 0}, 1);
  grid.add({-1, 0, 0}, 1);
  grid.add({0, -1, 0}, 1);
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) EXPECT_EQ(grid->count(level, quarter * kColumns / 4), 1U);
  grid.add({0, 0, 1}, 1);
  grid.add({0, 0, -1}, 1);
  EXPECT_EQ(grid->count(kSlices - 1, 0), 1U);
  EXPECT_EQ(grid->count(0, 0), 1U);
  // A hair before the end of the circle, and zeros of either sign.
  grid.add({1.0, -1e-20, 0.0}, 1);
  grid.add({-0.0, -0.0, 5.0}, 1);
  grid.add({-0.0, 1.0, -0.0}, 1);
  grid.add({1e30, 1e30, 1e30}, 1);
  EXPECT_EQ(grid.all(), 10U);
}

// Most rays are sorted many at a time, in floats: the same cells but for rays on a border.
TEST(DirectionGrid, ManyAtOnceAreSortedAsOneByOne) {
  constexpr std::uint32_t kCount = 4096;
  test::Noise noise(3);
  std::vector<float> x(kCount), y(kCount), z(kCount), norm2(kCount);
  std::vector<std::int32_t> cells(kCount);
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const double far = std::pow(10.0, noise.uniform(-3.0, 2.0));
    x[k] = static_cast<float>(far * noise.normal(1.0));
    y[k] = static_cast<float>(far * noise.normal(1.0));
    z[k] = static_cast<float>(far * noise.normal(1.0));
    norm2[k] = x[k] * x[k] + y[k] * y[k] + z[k] * z[k];
  }
  for (std::uint32_t k = 0; k < kCount; k += kFour) {
    store_four(Directions::cells_of(load_four(&x[k]), load_four(&y[k]), load_four(&z[k]), load_four(&norm2[k])),
               &cells[k]);
  }
  std::uint32_t others = 0;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const std::uint32_t one = Directions::cell_of(
        Eigen::Vector3d(static_cast<double>(x[k]), static_cast<double>(y[k]), static_cast<double>(z[k])));
    others += static_cast<std::uint32_t>(cells[k]) != one ? 1U : 0U;
  }
  EXPECT_LE(others, 2U);
}

TEST(DirectionGrid, OfFourCellsOneWithReturnsIsEnough) {
  for (std::uint32_t column = 0; column < 12; ++column) {
    Counted grid;
    grid.add_to(3 * kColumns + column, 1);
    for (std::uint32_t first = 0; first < 12; first += kFour) {
      EXPECT_EQ(grid->any_in_four(3, first), column / kFour == first / kFour) << column << " " << first;
      EXPECT_FALSE(grid->any_in_four(2, first)) << column << " " << first;
    }
  }
}

// Zero, what is next to it, and squares that are no floats.
TEST(DirectionGrid, OddRaysGetSomeCell) {
  const float odd[] = {0.0F, -0.0F, 1.0F, -1.0F, 1e-40F, 3e38F, -3e38F, -1e-20F, 4.5e-23F, -4.5e-23F, -8e-23F};
  for (const float x : odd) {
    for (const float y : odd) {
      for (const float z : odd) {
        const float xs[4] = {x, y, z, 1.0F}, ys[4] = {y, z, x, 0.0F}, zs[4] = {z, x, y, 0.0F};
        float norm2[4];
        for (int k = 0; k < 4; ++k) norm2[k] = xs[k] * xs[k] + ys[k] * ys[k] + zs[k] * zs[k];
        const FourInts cells = Directions::cells_of(load_four(xs), load_four(ys), load_four(zs), load_four(norm2));
        for (std::uint32_t lane = 0; lane < kFour; ++lane) {
          ASSERT_GE(cells[lane], 0);
          ASSERT_LT(cells[lane], static_cast<std::int32_t>(kColumns * kSlices));
        }
      }
    }
  }
}

// Elevations of real sensors, and how far above or below the origin each laser is (makers' manuals: VLP-16 63-9243,
// VLP-32C 63-9325). Ouster's beams begin 15.8 mm beside the axis, which lifts or lowers near returns as well.
struct Rings {
  std::vector<double> elevation_deg, up_m;
  double beside_m = 0.0;
};

Rings vlp16() {
  Rings out;
  const double up_mm[] = {11.2, 9.7, 8.1, 6.6, 5.1, 3.6, 2.1, 0.7, -0.7, -2.2, -3.7, -5.1, -6.6, -8.1, -9.7, -11.2};
  for (int ring = 0; ring < 16; ++ring) {
    out.elevation_deg.push_back(-15.0 + 2.0 * ring);
    out.up_m.push_back(1e-3 * up_mm[ring]);
  }
  return out;
}

Rings even_rings(int count, double least_deg, double most_deg, double beside_m) {
  Rings out;
  for (int ring = 0; ring < count; ++ring) {
    out.elevation_deg.push_back(least_deg + (most_deg - least_deg) * ring / (count - 1));
    out.up_m.push_back(0.0);
  }
  out.beside_m = beside_m;
  return out;
}

Rings vlp32c() {
  Rings out;
  out.elevation_deg = {-25.0, -15.639, -11.31, -8.843, -7.254, -6.148, -5.333, -4.667, -4.0,   -3.667, -3.333,
                       -3.0,  -2.667,  -2.333, -2.0,   -1.667, -1.333, -1.0,   -0.667, -0.333, 0.0,    0.333,
                       0.667, 1.0,     1.333,  1.667,  2.333,  3.333,  4.667,  7.0,    10.333, 15.0};
  out.up_m.assign(out.elevation_deg.size(), 0.0);
  return out;
}

// A return of a ring, seen from the sensor's origin.
Eigen::Vector3d return_of(const Rings& rings, std::size_t ring, double azimuth_rad, double range_m) {
  const double elevation_rad = rings.elevation_deg[ring] * M_PI / 180.0;
  const double flat_m = range_m * std::cos(elevation_rad) + rings.beside_m;
  return {flat_m * std::cos(azimuth_rad), flat_m * std::sin(azimuth_rad),
          range_m * std::sin(elevation_rad) + rings.up_m[ring]};
}

// Walls of a road to both sides, 1800 columns: near beside the sensor, far along the road.
double range_to_walls_m(double azimuth_rad, double wall_m) {
  const double beside = std::fabs(std::sin(azimuth_rad));
  return beside * 80.0 < wall_m ? 80.0 : wall_m / beside;
}

void scan(const Rings& rings, double wall_m, Counted* returns) {
  constexpr int kScanColumns = 1800;
  for (std::size_t ring = 0; ring < rings.elevation_deg.size(); ++ring) {
    for (int column = 0; column < kScanColumns; ++column) {
      const double azimuth_rad = 2.0 * M_PI * column / kScanColumns;
      returns->add(return_of(rings, ring, azimuth_rad, range_to_walls_m(azimuth_rad, wall_m)), 1);
    }
  }
}

std::uint32_t row_of(const DirectionRows& rows, const Eigen::Vector3d& ray) {
  return rows.cell_of(Directions::cell_of(ray)) / kColumns;
}

// Number of rings that one border of rows parts, of a ring alone in its row.
int parted_rings(const Rings& rings, const DirectionRows& rows, double wall_m) {
  int parted = 0;
  for (std::size_t ring = 0; ring < rings.elevation_deg.size(); ++ring) {
    const std::uint32_t near = row_of(rows, return_of(rings, ring, 0.5 * M_PI, wall_m));
    const std::uint32_t far = row_of(rows, return_of(rings, ring, 0.0, 80.0));
    parted += near != far ? 1 : 0;
  }
  return parted;
}

TEST(DirectionRows, NoBorderPartsARingOfASparseSensor) {
  int parted_by_even_rows = 0;
  for (const double turned_deg : {0.0, 0.3, 0.7, 1.1, 1.6}) {
    for (const double wall_m : {1.0, 1.3, 1.6, 2.0, 2.3, 2.45, 3.0, 5.0}) {
      Rings rings = vlp16();
      for (double& elevation_deg : rings.elevation_deg) elevation_deg += turned_deg;
      Counted returns;
      scan(rings, wall_m, &returns);
      DirectionRows rows;
      parted_by_even_rows += parted_rings(rings, rows, wall_m);
      rows.learn(*returns);
      EXPECT_EQ(parted_rings(rings, rows, wall_m), 0) << wall_m << " m, rings higher by " << turned_deg << " degrees";
    }
  }
  EXPECT_GT(parted_by_even_rows, 20) << "or there was nothing to learn";
}

// Rings less than a row apart: none is parted either, though the beams begin beside the axis.
TEST(DirectionRows, NoBorderPartsARingOfAnOuster) {
  for (const double wall_m : {1.0, 1.6, 2.3, 3.0}) {
    const Rings rings = even_rings(32, -22.5, 22.5, 0.0158);
    Counted returns;
    scan(rings, wall_m, &returns);
    DirectionRows rows;
    rows.learn(*returns);
    EXPECT_EQ(parted_rings(rings, rows, wall_m), 0) << wall_m;
  }
}

// Where rings are dense in the middle, a row has several, and one more or less is no silence.
TEST(DirectionRows, RingsFarApartAreNotPartedWhereOthersAreDense) {
  for (const double wall_m : {1.0, 2.0, 3.0}) {
    Rings rings = vlp32c();
    for (std::size_t ring = 0; ring < rings.up_m.size(); ++ring) {
      rings.up_m[ring] = -0.0007 * rings.elevation_deg[ring];  // as a lens that far before the axis
    }
    Counted returns;
    scan(rings, wall_m, &returns);
    DirectionRows rows;
    rows.learn(*returns);
    for (const std::size_t ring : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{30}, std::size_t{31}}) {
      EXPECT_EQ(row_of(rows, return_of(rings, ring, 0.5 * M_PI, wall_m)),
                row_of(rows, return_of(rings, ring, 0.0, 80.0)))
          << ring << " at " << wall_m;
    }
  }
}

TEST(DirectionRows, ADenseSensorAndChanceKeepEvenRows) {
  const DirectionRows even;
  test::Noise noise(4);
  Counted dense, chance;
  scan(even_rings(128, -22.5, 22.5, 0.0158), 2.0, &dense);
  for (int i = 0; i < 20000; ++i) chance.add({noise.normal(1.0), noise.normal(1.0), noise.normal(1.0)}, 1);
  for (Counted* returns : {&dense, &chance}) {
    DirectionRows rows;
    rows.learn(**returns);
    for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
      // The field of view of the dense one ends somewhere, and its last row with it.
      if (std::fabs(Directions::up(slice)) > 0.33) continue;
      EXPECT_EQ(rows.cell_of(slice * kColumns), even.cell_of(slice * kColumns)) << slice;
    }
  }
}

TEST(DirectionRows, EveryReturnIsInOneRowAndTheRowIsWhereItsReturnsAre) {
  const Rings rings = vlp16();
  Counted returns;
  scan(rings, 1.5, &returns);
  DirectionRows rows;
  rows.learn(*returns);
  test::Placed<DirectionGrid> grid;
  rows.sum_up(*returns, grid.get());
  std::uint64_t all = 0;
  std::vector<double> seen_deg;
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    std::uint64_t of_row = 0;
    for (std::uint32_t column = 0; column < kColumns; ++column) of_row += grid->count(row, column);
    all += of_row;
    if (of_row > 0) seen_deg.push_back(std::asin(rows.up(row)) * 180.0 / M_PI);
  }
  EXPECT_EQ(all, returns.all());
  ASSERT_EQ(seen_deg.size(), 16U);
  // Half a slice, and what the lasers' places lift near returns by.
  for (std::size_t ring = 0; ring < 16; ++ring) EXPECT_NEAR(seen_deg[ring], rings.elevation_deg[ring], 0.22 + 0.45);
}

TEST(DirectionRows, FullCellsStayFullInARow) {
  Counted returns;
  const Eigen::Vector3d ray(1.0, 0.1, 0.001), above(1.0, 0.1, 0.009);
  returns.add(ray, 65535);
  returns.add(above, 65535);
  DirectionRows rows;
  test::Placed<DirectionGrid> grid;
  rows.sum_up(*returns, grid.get());
  const std::uint32_t cell = rows.cell_of(Directions::cell_of(ray));
  ASSERT_EQ(cell, rows.cell_of(Directions::cell_of(above)));
  EXPECT_EQ(grid->count(cell / kColumns, cell % kColumns), 65535U);
}

}  // namespace
}  // namespace pose_wall
