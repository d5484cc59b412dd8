// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a floor is ground up to ten degrees and not beyond, below the sensor and not above; a cluster of 29 points is
// dropped and one of 30 is kept, also round the back of the image and across a missing line; curvature tells edges
// from planes, and the hidden side of an edge is neither.

#include "motion/segmentation.hpp"

#include <gtest/gtest.h>

#include "motion/boxes.hpp"
#include "motion/features.hpp"

namespace pose_wall::motion::test {
namespace {

class Segmented : public ::testing::Test {
 protected:
  void take(const pose_wall::test::Points& points) {
    project(pose_wall::test::cloud_of(points, 0), mount_, Twist{}, image_.get(), &print_);
    found_ = segment(R_map_base_, mount_, scratch_.get(), image_.get());
  }
  // A patch of the image, by hand: rows x columns, all in one range.
  void begin_image(std::uint32_t rows, std::uint32_t columns) {
    image_->rows = rows;
    image_->columns = columns;
    image_->count = 0;
    image_->cell.first(rows * columns).fill(kNoPoint);
  }
  void put(std::uint32_t row, std::uint32_t column, double range_m) {
    const double azimuth = 2.0 * M_PI * (column + 0.5) / image_->columns - M_PI, elevation = 0.01 * row + 0.2;
    const std::uint32_t k = image_->count++;
    image_->x[k] = static_cast<float>(range_m * std::cos(elevation) * std::cos(azimuth));
    image_->y[k] = static_cast<float>(range_m * std::cos(elevation) * std::sin(azimuth));
    image_->z[k] = static_cast<float>(range_m * std::sin(elevation));
    image_->range[k] = static_cast<float>(range_m);
    image_->flags[k] = 0;
    image_->place[k] = static_cast<std::uint16_t>(row * image_->columns + column);
    image_->cell[image_->place[k]] = static_cast<std::uint16_t>(k);
  }
  Segments segment_it() { return segment(R_map_base_, mount_, scratch_.get(), image_.get()); }
  std::uint32_t kept() const {
    std::uint32_t n = 0;
    for (std::uint32_t i = 0; i < image_->count; ++i) n += (image_->flags[i] & kKept) != 0 ? 1U : 0U;
    return n;
  }

  pose_wall::Mount mount_;
  Eigen::Matrix3d R_map_base_ = Eigen::Matrix3d::Identity();
  Laid<RangeImage> image_;
  CloudPrint print_;
  Laid<SegmentScratch> scratch_;
  Segments found_;
};

// Ahead of the sensor, where the columns go straight up the slope.
double share_of_ground_ahead(const RangeImage& image) {
  double ground = 0.0, all = 0.0;
  for (std::uint32_t i = 0; i < image.count; ++i) {
    if (!(image.x[i] > 2.0F && std::fabs(image.y[i]) < 0.1F * image.x[i])) continue;
    all += 1.0;
    ground += (image.flags[i] & kGround) != 0 ? 1.0 : 0.0;
  }
  EXPECT_GT(all, 100.0);
  return ground / all;
}

pose_wall::test::Points floor_that_rises(double slope_deg, double below_m) {
  BoxRoom room;
  room.length_m = 40.0, room.width_m = 40.0, room.up_m = 40.0, room.down_m = below_m;
  const double rise = std::tan(slope_deg * M_PI / 180.0);
  room.relief = [rise](int face, double u, double) { return face == 5 ? rise * u : 0.0; };
  Scanner down;
  down.lowest_deg = -30.0, down.highest_deg = -2.0, down.range_most_m = 12.0;
  return scan_of(room, Pose{}, down);
}

TEST_F(Segmented, AFloorIsGroundUpToTenDegrees) {
  for (const double slope_deg : {0.0, 5.0, -9.0}) {
    take(floor_that_rises(slope_deg, 1.4));
    EXPECT_GT(share_of_ground_ahead(*image_), 0.95) << slope_deg;
    EXPECT_EQ(found_.ground > 0, true);
  }
  for (const double slope_deg : {-11.0, -15.0, -20.0}) {
    take(floor_that_rises(slope_deg, 1.4));
    EXPECT_LT(share_of_ground_ahead(*image_), 0.05) << slope_deg;
  }
}

// The attitude that is expected says what level is.
TEST_F(Segmented, LevelIsMeantInTheMap) {
  R_map_base_ = turn_by({0.0, -11.0 * M_PI / 180.0, 0.0});
  take(floor_that_rises(-11.0, 1.4));
  EXPECT_GT(share_of_ground_ahead(*image_), 0.95);
  take(floor_that_rises(0.0, 1.4));
  EXPECT_LT(share_of_ground_ahead(*image_), 0.05);
}

TEST_F(Segmented, AFloorAtTheSensorsHeightIsNone) {
  take(floor_that_rises(0.0, 0.2));
  EXPECT_EQ(found_.ground, 0U);
}

TEST_F(Segmented, ACountOfGroundIsThatOfItsMarks) {
  take(floor_that_rises(0.0, 1.4));
  std::uint32_t marked = 0;
  for (std::uint32_t i = 0; i < image_->count; ++i) marked += (image_->flags[i] & kGround) != 0 ? 1U : 0U;
  EXPECT_EQ(found_.ground, marked);
  EXPECT_EQ(kept() >= marked, true) << "ground is kept";
}

TEST_F(Segmented, AClusterOfThirtyPointsIsKeptAndOneOfTwentyNineIsNot) {
  for (const std::uint32_t size : {29U, 30U}) {
    begin_image(16, 1024);
    for (std::uint32_t k = 0; k < size; ++k) put(3 + k / 10, 100 + k % 10, 5.0);
    EXPECT_EQ(segment_it().clusters, size == 30U ? 1U : 0U);
    EXPECT_EQ(kept(), size == 30U ? 30U : 0U);
  }
}

TEST_F(Segmented, AClusterGoesRoundTheBackAndAcrossAMissingLine) {
  begin_image(16, 1024);
  for (std::uint32_t k = 0; k < 32; ++k) put(2 * (k % 2) + 5, (1008 + k / 2 + 8) % 1024, 5.0);  // every second row
  EXPECT_EQ(segment_it().clusters, 1U);
  EXPECT_EQ(kept(), 32U);
}

TEST_F(Segmented, TwoThingsOneBehindTheOtherAreTwo) {
  begin_image(16, 1024);
  for (std::uint32_t k = 0; k < 20; ++k) put(k / 5, 50 + k % 5, 4.0);
  for (std::uint32_t k = 0; k < 20; ++k) put(k / 5, 55 + k % 5, 8.0);
  EXPECT_EQ(segment_it().clusters, 0U) << "of 20 points each";
  EXPECT_EQ(kept(), 0U);
}

TEST_F(Segmented, AnImageOfNothingHasNothing) {
  begin_image(16, 1024);
  const Segments found = segment_it();
  EXPECT_EQ(found.ground, 0U);
  EXPECT_EQ(found.clusters, 0U);
}

// A full image of one surface: the queue holds all of it, and no more than all.
TEST_F(Segmented, AllOfTheImageIsOneCluster) {
  begin_image(64, 512);
  for (std::uint32_t row = 0; row < 64; ++row) {
    for (std::uint32_t column = 0; column < 511; ++column) put(row, column, 6.0);
  }
  EXPECT_EQ(segment_it().clusters, 1U);
  EXPECT_EQ(kept(), image_->count);
}

// ------------------------------------------------------------------------------------------ features

class Features : public Segmented {
 protected:
  // One row; beyond the step the wall is further away.
  void step(double near_m, double far_m) {
    begin_image(1, 512);
    for (std::uint32_t column = 0; column < 500; ++column) put(0, column, column < 250 ? near_m : far_m);
    for (std::uint32_t i = 0; i < image_->count; ++i) image_->flags[i] = kKept;
    counts_ = mark_features(image_.get());
  }
  bool has(std::uint32_t column, std::uint8_t flag) const { return (image_->flags[column] & flag) != 0; }

  FeatureCounts counts_;
};

// The mean of ten neighbours, of which n lie D further away: n D / (10 r).
TEST_F(Features, TheNearSideOfAStepIsAnEdge) {
  step(4.0, 5.0);
  for (const std::uint32_t k : {1U, 2U, 3U, 4U}) EXPECT_TRUE(has(250 - k, kEdge)) << k;  // 0.125, 0.1, 0.075, 0.05
  EXPECT_TRUE(has(250 - 5, kPlane)) << "0.025";
  for (std::uint32_t column = 20; column < 240; ++column) EXPECT_TRUE(has(column, kPlane)) << column;
}

TEST_F(Features, TheHiddenSideOfAStepIsNeither) {
  step(4.0, 5.0);
  for (const std::uint32_t k : {0U, 1U}) {
    EXPECT_FALSE(has(250 + k, kEdge)) << k;
    EXPECT_FALSE(has(250 + k, kPlane)) << k;
  }
  EXPECT_TRUE(has(250 + 2, kEdge)) << "three of ten lie 1 m nearer than 5 m: 0.06";
  EXPECT_TRUE(has(250 + 3, kEdge)) << "0.04";
  EXPECT_TRUE(has(250 + 4, kPlane)) << "0.02";
}

TEST_F(Features, CountsAreThoseOfTheMarks) {
  step(4.0, 6.5);
  std::uint32_t edges = 0, planes = 0;
  for (std::uint32_t i = 0; i < image_->count; ++i) {
    edges += has(i, kEdge) ? 1U : 0U;
    planes += has(i, kPlane) ? 1U : 0U;
    EXPECT_FALSE(has(i, kEdge) && has(i, kPlane));
  }
  EXPECT_EQ(counts_.edges, edges);
  EXPECT_EQ(counts_.planes, planes);
}

TEST_F(Features, WhatIsNotKeptIsNoFeature) {
  step(4.0, 4.0);
  EXPECT_GT(counts_.planes, 400U);
  for (std::uint32_t i = 0; i < image_->count; ++i) image_->flags[i] = 0;
  EXPECT_EQ(mark_features(image_.get()).planes, 0U);
}

TEST_F(Features, ANormalIsSquareToItsWallAndTowardsTheSensor) {
  BoxRoom room;
  take(scan_of(room, Pose{}));
  mark_features(image_.get());
  std::uint32_t right = 0, all = 0;
  for (std::uint32_t i = 0; i < image_->count; ++i) {
    const Eigen::Vector3f p = image_->point(i);
    const bool on_left_wall = std::fabs(p.y() - 2.5F) < 1e-3F && std::fabs(p.x()) < 4.0F && std::fabs(p.z()) < 0.8F;
    Eigen::Vector3f normal;
    if (!on_left_wall || !normal_about(*image_, i, &normal)) continue;
    ++all;
    right += (normal - Eigen::Vector3f(0.0F, -1.0F, 0.0F)).norm() < 1e-3F ? 1U : 0U;
  }
  EXPECT_GT(all, 1000U);
  EXPECT_EQ(right, all);
}

TEST_F(Features, AFacingIsTheAxisWithin53Degrees) {
  std::uint8_t facing = 99;
  EXPECT_TRUE(facing_of({0.8F, 0.6F, 0.0F}, &facing));
  EXPECT_EQ(facing, kFacesX);
  EXPECT_TRUE(facing_of({0.1F, -0.99F, 0.0F}, &facing));
  EXPECT_EQ(facing, kFacesY);
  EXPECT_TRUE(facing_of({0.0F, 0.0F, -1.0F}, &facing));
  EXPECT_EQ(facing, kFacesZ);
  EXPECT_FALSE(facing_of({0.577F, 0.577F, 0.577F}, &facing));
  EXPECT_FALSE(facing_of({std::nanf(""), 0.0F, 0.0F}, &facing));
}

TEST_F(Features, ObservationsAreSpreadOverTheSurfaces) {
  BoxRoom room;
  take(scan_of(room, Pose{}));
  mark_features(image_.get());
  Laid<ObservationScratch> scratch;
  std::vector<Observation> out(kObservationsMost);
  const std::uint32_t count = choose_observations(*image_, Pose{}, scratch.get(), {out.data(), kObservationsMost});
  EXPECT_GT(count, 1000U);
  EXPECT_LE(count, kObservationsMost);
  std::uint32_t facing[3] = {}, ahead = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    ++facing[out[i].facing];
    ahead += out[i].x > 0.0F ? 1U : 0U;
  }
  EXPECT_GT(facing[kFacesX], 20U);
  EXPECT_GT(facing[kFacesY], 200U);
  EXPECT_GT(facing[kFacesZ], 200U);
  EXPECT_NEAR(ahead, count / 2.0, 0.1 * count);
  EXPECT_EQ(choose_observations(*image_, Pose{}, scratch.get(), {out.data(), 7U}), 7U) << "no more than there is room";
  image_->count = 0;
  EXPECT_EQ(choose_observations(*image_, Pose{}, scratch.get(), {out.data(), 7U}), 0U);
}

}  // namespace
}  // namespace pose_wall::motion::test
