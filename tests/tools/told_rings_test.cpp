// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: rings are counted by the field that numbers them, whatever it is called, else by the rows of a cloud that has
// as many as a sensor may have rings; what tells nothing is not guessed at.

#include "io/frames/told_rings.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace pose_wall::tools {
namespace {

// 640 points in these rows; of each, two bytes that count up to `values`.
Frame frame_of(std::uint32_t rows, const std::string& field, std::uint32_t values) {
  constexpr std::uint32_t kPoints = 640, kStep = 2;
  Frame frame;
  frame.bytes.resize(kPoints * kStep);
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const auto value = static_cast<std::uint16_t>(i % values);
    std::memcpy(frame.bytes.data() + std::size_t{i} * kStep, &value, kStep);
  }
  frame.cloud.data = frame.bytes.data();
  frame.cloud.width = kPoints / rows;
  frame.cloud.height = rows;
  frame.cloud.point_step = kStep;
  frame.fields.push_back({field, {0, POSE_WALL_FIELD_UINT16}});
  return frame;
}

TEST(ToldRings, TheFieldThatNumbersThemComesFirst) {
  const ToldRings by_field = told_rings(frame_of(16, "ring", 32));
  EXPECT_EQ(by_field.count, 32U);
  EXPECT_EQ(by_field.by, "field ring");
  EXPECT_EQ(told_rings(frame_of(1, "channel", 5)).by, "field channel");
}

TEST(ToldRings, ElseTheRowsOfTheCloud) {
  const ToldRings by_rows = told_rings(frame_of(16, "other", 32));
  EXPECT_EQ(by_rows.count, 16U);
  EXPECT_EQ(by_rows.by, "rows of the cloud");
  EXPECT_EQ(told_rings(frame_of(40, "other", 32)).count, 16U) << "columns and rows changed places";
  EXPECT_EQ(told_rings(frame_of(16, "ring", 500)).by, "rows of the cloud") << "no sensor has 500 rings";
}

TEST(ToldRings, ElseNothing) {
  for (const std::uint32_t rows : {1U, 10U}) {
    EXPECT_EQ(told_rings(frame_of(rows, "other", 32)).count, 0U) << rows;
    EXPECT_EQ(told_rings(frame_of(rows, "other", 32)).by, "") << rows;
  }
}

}  // namespace
}  // namespace pose_wall::tools
