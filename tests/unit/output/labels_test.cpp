// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: each point is labelled by the surface that it lies on, the floor before a wall, a wall within the band only,
// whatever the number of points; nothing lies on what was refused.

#include "engine/output/labels.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/math/rotation.hpp"
#include "pose_wall.h"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kFloorBelow_m = 1.4;

struct Seen {
  Eigen::Vector3d at;
  std::uint8_t label;
};

const Seen kSeen[] = {
    {{1.0, 0.0, -1.4}, POSE_WALL_LABEL_FLOOR},  {{1.0, 2.5, 0.0}, POSE_WALL_LABEL_LEFT},
    {{1.0, -2.0, 0.0}, POSE_WALL_LABEL_RIGHT},  {{1.0, 0.5, 0.3}, POSE_WALL_LABEL_OTHER},
    {{-3.0, 2.52, 0.9}, POSE_WALL_LABEL_LEFT},  {{-3.0, -2.02, 0.9}, POSE_WALL_LABEL_RIGHT},
    {{2.0, 2.5, 1.6}, POSE_WALL_LABEL_OTHER},   {{2.0, 2.5, -1.2}, POSE_WALL_LABEL_OTHER},
    {{2.0, 2.5, -1.38}, POSE_WALL_LABEL_FLOOR}, {{2.0, 2.7, 0.0}, POSE_WALL_LABEL_OTHER},
    {{2.0, -1.8, 0.0}, POSE_WALL_LABEL_OTHER},
};
constexpr std::uint32_t kCount = sizeof(kSeen) / sizeof(kSeen[0]);

Surfaces all() {
  Surfaces found;
  found.floor_base = {Eigen::Vector3d::UnitZ(), kFloorBelow_m};
  found.wall_level[0] = {-Eigen::Vector3d::UnitY(), 2.5};
  found.wall_level[1] = {Eigen::Vector3d::UnitY(), 2.0};
  found.has_floor = found.has_wall[0] = found.has_wall[1] = true;
  return found;
}

std::vector<std::uint8_t> labels_of(const Surfaces& found, std::uint32_t count,
                                    const Eigen::Matrix3d& R_base_level = Eigen::Matrix3d::Identity()) {
  test::OwnedPoints points(kCount);
  for (std::uint32_t i = 0; i < count; ++i) points.add(R_base_level * kSeen[i].at);
  std::vector<std::uint8_t> labels(count, 0xEE);
  label_points(points.set(), found, test::settings_with(),
               Span<std::uint8_t>(labels.data(), static_cast<std::uint32_t>(labels.size())));
  return labels;
}

TEST(Labels, EachPointHasItsSurfaces) {
  for (std::uint32_t count = 0; count <= kCount; ++count) {
    const std::vector<std::uint8_t> labels = labels_of(all(), count);
    for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(labels[i], kSeen[i].label) << i << " of " << count;
  }
}

TEST(Labels, NothingLiesOnAWallThatWasRefused) {
  for (int side = 0; side < 2; ++side) {
    Surfaces found = all();
    found.has_wall[side] = false;
    const std::uint8_t of_side = side == 0 ? POSE_WALL_LABEL_LEFT : POSE_WALL_LABEL_RIGHT;
    const std::vector<std::uint8_t> labels = labels_of(found, kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const std::uint8_t expected = kSeen[i].label == of_side ? std::uint8_t{POSE_WALL_LABEL_OTHER} : kSeen[i].label;
      EXPECT_EQ(labels[i], expected) << i;
    }
  }
}

// Heights count from the floor, of a machine that stands askew, and walls are planes of the levelled frame.
TEST(Labels, AMachineThatStandsAskewSeesTheSame) {
  const Eigen::Matrix3d R_base_level = level_rotation(Eigen::Vector3d(-0.1, 0.14, 0.98).normalized()).transpose();
  Surfaces found = all();
  found.floor_base.n = R_base_level * Eigen::Vector3d::UnitZ();
  const std::vector<std::uint8_t> labels = labels_of(found, kCount, R_base_level);
  for (std::uint32_t i = 0; i < kCount; ++i) EXPECT_EQ(labels[i], kSeen[i].label) << i;
}

// Without a floor nothing is known of heights, so of walls neither.
TEST(Labels, NothingLiesAnywhereWhereTheFloorWasRefused) {
  Surfaces found = all();
  found.has_floor = false;
  for (const std::uint8_t label : labels_of(found, kCount)) EXPECT_EQ(label, POSE_WALL_LABEL_OTHER);
}

}  // namespace
}  // namespace pose_wall
