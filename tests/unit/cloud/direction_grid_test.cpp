// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every return is counted once, in the cell whose range of directions holds it; columns are as wide as they
// say; full cells stay full; axes, poles and rays of any length have a cell.

#include "cloud/direction_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kRows = DirectionGrid::kRows, kColumns = DirectionGrid::kColumns;

class Counted {
 public:
  Counted() { grid_->clear(); }
  DirectionGrid* operator->() { return grid_.get(); }
  std::uint64_t all() {
    std::uint64_t sum = 0;
    for (std::uint32_t column = 0; column < kColumns; ++column) sum += of_column(column);
    return sum;
  }
  std::uint64_t of_column(std::uint32_t column) {
    std::uint64_t sum = 0;
    for (std::uint32_t row = 0; row < kRows; ++row) sum += grid_->count(row, column);
    return sum;
  }

 private:
  test::Placed<DirectionGrid> grid_;
};

Eigen::Vector3d middle_of(std::uint32_t row, std::uint32_t column) {
  const double up = DirectionGrid::up(row), flat = std::sqrt(1.0 - up * up);
  const DirectionGrid::Column c = DirectionGrid::column(column);
  return {c.x * flat, c.y * flat, up};
}

TEST(DirectionGrid, TheMiddleOfACellIsInTheCell) {
  Counted grid;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      for (const double range_m : {1e-6, 0.3, 30.0, 1e6}) grid->add(range_m * middle_of(row, column), 1);
      ASSERT_EQ(grid->count(row, column), 4U) << row << " " << column;
    }
  }
  EXPECT_EQ(grid.all(), 4U * kRows * kColumns);
}

TEST(DirectionGrid, ColumnsAreUnitVectorsAroundTheCircleOfAWidthFromOneToTwo) {
  double last_rad = -1.0, width_rad = 0.0;
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    const DirectionGrid::Column c = DirectionGrid::column(column);
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
      grid->add({flat * std::cos(azimuth_rad), flat * std::sin(azimuth_rad), up}, 1);
    }
    EXPECT_EQ(grid.all(), static_cast<std::uint64_t>(kRays));
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const double expected = kRays * DirectionGrid::column(column).width * (4.0 / kColumns) / (2.0 * M_PI);
      const auto count = static_cast<double>(grid.of_column(column));
      EXPECT_NEAR(count, expected, kDeviations * std::sqrt(expected)) << column << " at " << up;
    }
  }
}

TEST(DirectionGrid, RowsHoldEqualPartsOfTheSphere) {
  constexpr int kRays = 200000;
  test::Noise noise(2);
  Counted grid;
  for (int i = 0; i < kRays; ++i) grid->add({noise.normal(1.0), noise.normal(1.0), noise.normal(1.0)}, 1);
  const double expected = static_cast<double>(kRays) / kRows;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    double sum = 0.0;
    for (std::uint32_t column = 0; column < kColumns; ++column) sum += grid->count(row, column);
    EXPECT_NEAR(sum, expected, 5.0 * std::sqrt(expected)) << row;
  }
}

TEST(DirectionGrid, FullCellsStayFull) {
  Counted grid;
  const Eigen::Vector3d ray(1.0, 2.0, -0.5);
  for (int i = 0; i < 65534; ++i) grid->add(ray, 1);
  EXPECT_EQ(grid.all(), 65534U);
  grid->add(ray, 1);
  EXPECT_EQ(grid.all(), 65535U);
  grid->add(ray, 1);
  grid->add(ray, 1000000);
  EXPECT_EQ(grid.all(), 65535U);
  grid->clear();
  EXPECT_EQ(grid.all(), 0U);
}

TEST(DirectionGrid, AxesAndPolesHaveACell) {
  Counted grid;
  const std::uint32_t level = kRows / 2;
  grid->add({1, 0, 0}, 1);
  grid->add({0, 1, 0}, 1);
  grid->add({-1, 0, 0}, 1);
  grid->add({0, -1, 0}, 1);
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) EXPECT_EQ(grid->count(level, quarter * kColumns / 4), 1U);
  grid->add({0, 0, 1}, 1);
  grid->add({0, 0, -1}, 1);
  EXPECT_EQ(grid->count(kRows - 1, 0), 1U);
  EXPECT_EQ(grid->count(0, 0), 1U);
  // A hair before the end of the circle, and zeros of either sign.
  grid->add({1.0, -1e-20, 0.0}, 1);
  grid->add({-0.0, -0.0, 5.0}, 1);
  grid->add({-0.0, 1.0, -0.0}, 1);
  grid->add({1e30, 1e30, 1e30}, 1);
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
    store_four(DirectionGrid::cells_of(load_four(&x[k]), load_four(&y[k]), load_four(&z[k]), load_four(&norm2[k])),
               &cells[k]);
  }
  std::uint32_t others = 0;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const std::uint32_t one = DirectionGrid::cell_of(
        Eigen::Vector3d(static_cast<double>(x[k]), static_cast<double>(y[k]), static_cast<double>(z[k])));
    others += static_cast<std::uint32_t>(cells[k]) != one ? 1U : 0U;
  }
  EXPECT_LE(others, 2U);
}

TEST(DirectionGrid, OfFourCellsOneWithReturnsIsEnough) {
  for (std::uint32_t column = 0; column < 12; ++column) {
    Counted grid;
    grid->add(3 * DirectionGrid::kColumns + column, 1);
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
        const FourInts cells = DirectionGrid::cells_of(load_four(xs), load_four(ys), load_four(zs), load_four(norm2));
        for (std::uint32_t lane = 0; lane < kFour; ++lane) {
          ASSERT_GE(cells[lane], 0);
          ASSERT_LT(cells[lane], static_cast<std::int32_t>(DirectionGrid::kColumns * DirectionGrid::kRows));
        }
      }
    }
  }
}

}  // namespace
}  // namespace pose_wall
