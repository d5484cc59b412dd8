// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what is expected of a row is what most of it gives, by the width of its columns; two sectors without returns
// are out of sight if they are wide, and a third is a gap.

#include "engine/walls/doubts/sight_lines.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kOfRows = DirectionGrid::kRows, kOfColumns = DirectionGrid::kColumns;

// Rows 20 to 39 give so many returns for each width of a column, the others none.
class EvenSensor {
 public:
  explicit EvenSensor(std::uint32_t per_width) {
    returns_->clear();
    for (std::uint32_t row = 20; row < 40; ++row) {
      for (std::uint32_t column = 0; column < kOfColumns; ++column) {
        returns_->add(row * kOfColumns + column,
                      static_cast<std::uint32_t>(per_width * Directions::width(column) + 0.5));
      }
    }
  }

  void blind(std::uint32_t from, std::uint32_t columns) {
    test::Placed<DirectionGrid> left;
    left->clear();
    for (std::uint32_t row = 0; row < kOfRows; ++row) {
      for (std::uint32_t column = 0; column < kOfColumns; ++column) {
        const bool is_blind = (column + kOfColumns - from) % kOfColumns < columns;
        left->add(row * kOfColumns + column, is_blind ? 0 : returns_->count(row, column));
      }
    }
    returns_->copy(*left);
  }

  ExpectedReturns expected() {
    ExpectedReturns out;
    out.look_at(*returns_);
    return out;
  }
  std::vector<std::uint32_t> out_of_sight() {
    SeenColumns seen;
    seen.look_at(*returns_, expected());
    std::vector<std::uint32_t> out;
    for (std::uint32_t column = 0; column < kOfColumns; ++column) {
      if (!seen.is_seen[column]) out.push_back(column);
    }
    return out;
  }

 private:
  test::Placed<DirectionGrid> returns_;
};

TEST(ExpectedReturns, AreWhatMostOfARowGives) {
  EvenSensor sensor(100);
  sensor.blind(40, 60);
  const ExpectedReturns expected = sensor.expected();
  for (std::uint32_t column = 0; column < kOfColumns; ++column) {
    EXPECT_NEAR(expected.at(30, column), 100.0 * Directions::width(column), 1.0) << column;
    EXPECT_EQ(expected.at(10, column), 0.0) << "a row without returns";
  }
}

TEST(ExpectedReturns, FewColumnsTellNothing) {
  EvenSensor sensor(100);
  sensor.blind(0, kOfColumns - kOfColumns / 8 + 1);
  EXPECT_EQ(sensor.expected().at(30, 64), 0.0);
}

TEST(SeenColumns, TwoWideSectorsWithoutReturnsAreOutOfSight) {
  EvenSensor sensor(100);
  EXPECT_TRUE(sensor.out_of_sight().empty());
  sensor.blind(30, 5);
  EXPECT_EQ(sensor.out_of_sight(), (std::vector<std::uint32_t>{30, 31, 32, 33, 34}));
  sensor.blind(125, 6);  // across the seam
  EXPECT_EQ(sensor.out_of_sight(), (std::vector<std::uint32_t>{0, 1, 2, 30, 31, 32, 33, 34, 125, 126, 127}));
  sensor.blind(60, 5);
  EXPECT_EQ(sensor.out_of_sight().size(), 11U) << "the third is a gap";
}

TEST(SeenColumns, NarrowOnesAreGaps) {
  EvenSensor sensor(100);
  sensor.blind(30, 4);
  EXPECT_TRUE(sensor.out_of_sight().empty());
}

}  // namespace
}  // namespace pose_wall
