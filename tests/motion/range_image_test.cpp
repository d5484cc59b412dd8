// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a point comes into the row of its ring or elevation and the column of its azimuth, in base; what is no
// return, too near, too far or of the body comes into none; motion is taken out of a scan by its times, whatever they
// count in, and by times that make no scan not at all.

#include "motion/range_image.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "motion/boxes.hpp"

namespace pose_wall::motion::test {
namespace {

constexpr double kPi_rad = M_PI;

struct Seen {
  double azimuth_rad, elevation_rad, range_m;
  std::uint16_t ring;
  double time_s;
};

// 32 bytes a point: x y z, ring, time of any type.
class Recorded {
 public:
  explicit Recorded(const std::vector<Seen>& seen) : bytes_(seen.size() * kStep) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Seen& s = seen[i];
      const double flat = s.range_m * std::cos(s.elevation_rad);
      put_xyz(i, static_cast<float>(flat * std::cos(s.azimuth_rad)), static_cast<float>(flat * std::sin(s.azimuth_rad)),
              static_cast<float>(s.range_m * std::sin(s.elevation_rad)));
      std::memcpy(&bytes_[i * kStep + 12], &s.ring, sizeof s.ring);
    }
    pose_wall_cloud_xyz32(&cloud, bytes_.data(), static_cast<std::uint32_t>(seen.size()), kStep, 0);
  }
  void put_xyz(std::size_t i, float x, float y, float z) {
    const float xyz[3] = {x, y, z};
    std::memcpy(&bytes_[i * kStep], xyz, sizeof xyz);
  }
  Recorded& with_ring() {
    cloud.ring = {12, POSE_WALL_FIELD_UINT16};
    return *this;
  }
  template <typename Time>
  Recorded& with_time(std::uint32_t type, const std::vector<Time>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) std::memcpy(&bytes_[i * kStep + 16], &times[i], sizeof(Time));
    cloud.time = {16, type};
    return *this;
  }

  pose_wall_cloud cloud{};

 private:
  static constexpr std::uint32_t kStep = 32;
  std::vector<unsigned char> bytes_;
};

class Image : public ::testing::Test {
 protected:
  const RangeImage& of(const Recorded& recorded, const Twist& twist = {}) {
    EXPECT_EQ(pose_wall_cloud_check(&recorded.cloud), POSE_WALL_OK);
    project(recorded.cloud, mount_, twist, image_.get(), &print_);
    return *image_;
  }
  Eigen::Vector3d point(std::uint32_t i) { return image_->point(i).cast<double>(); }

  Mount mount_;
  Laid<RangeImage> image_;
  CloudPrint print_;
};

// Of one point in each of eight rings, an eighth of a turn apart.
TEST_F(Image, RowsAreRingsAndColumnsAreDirections) {
  std::vector<Seen> seen;
  for (std::uint16_t ring = 0; ring < 8; ++ring) seen.push_back({-3.0 + 0.75 * ring, 0.05 * ring, 5.0, ring, 0.0});
  of(Recorded(seen).with_ring());
  ASSERT_EQ(image_->count, 8U);
  EXPECT_EQ(image_->rows, 8U);
  EXPECT_EQ(image_->columns, kImageColumnsLeast);
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(image_->row_of(i), static_cast<std::int32_t>(i));
    const double column = (seen[i].azimuth_rad + kPi_rad) / (2.0 * kPi_rad) * image_->columns;
    EXPECT_NEAR(image_->column_of(i), column, 1.5);
    EXPECT_EQ(image_->at(image_->row_of(i), image_->column_of(i)), i);
    EXPECT_NEAR(static_cast<double>(image_->range[i]), 5.0, 1e-5);
  }
  EXPECT_EQ(image_->at(-1, 0), kNoPoint);
  EXPECT_EQ(image_->at(4, 0), kNoPoint);
  const std::int32_t all = static_cast<std::int32_t>(image_->columns), first = image_->column_of(0);
  EXPECT_EQ(image_->at(0, first + all), 0U) << "columns go round";
  EXPECT_EQ(image_->at(0, first - all), 0U);
}

TEST_F(Image, ManyRingsShareRows) {
  std::vector<Seen> seen;
  for (std::uint16_t ring = 0; ring < 128; ++ring) seen.push_back({0.02 * ring, 0.0, 4.0, ring, 0.0});
  of(Recorded(seen).with_ring());
  EXPECT_EQ(image_->rows, kImageRowsMost);
  EXPECT_EQ(image_->columns, kImageCells / kImageRowsMost);
  ASSERT_EQ(image_->count, 128U);
  for (std::uint32_t i = 0; i < 128; ++i) EXPECT_EQ(image_->row_of(i), static_cast<std::int32_t>(i / 2));
}

TEST_F(Image, WithoutRingsRowsAreElevations) {
  std::vector<Seen> seen;
  for (int k = 0; k <= 100; ++k) seen.push_back({0.05 * k - 2.5, -0.5 + 0.01 * k, 4.0, 0, 0.0});
  of(Recorded(seen));
  ASSERT_EQ(image_->count, 101U);
  EXPECT_EQ(image_->row_of(0), 0);
  EXPECT_EQ(image_->row_of(100), static_cast<std::int32_t>(image_->rows) - 1);
  for (std::uint32_t i = 1; i <= 100; ++i) EXPECT_GE(image_->row_of(i), image_->row_of(i - 1)) << i;
}

TEST_F(Image, RowsAndPaddingOfAnOrganisedCloudAreRead) {
  std::vector<Seen> seen;
  for (std::uint16_t k = 0; k < 12; ++k) seen.push_back({0.3 * k - 2.0, 0.1 * (k / 4), 3.0, k, 0.0});
  Recorded flat(seen), rows(seen);
  of(flat.with_ring());
  const std::uint32_t count = image_->count;
  std::vector<Eigen::Vector3d> expected;
  for (std::uint32_t i = 0; i < count; ++i) expected.push_back(point(i));
  rows.with_ring().cloud.width = 4;
  rows.cloud.height = 3;
  rows.cloud.row_step = 4 * 32;
  of(rows);
  ASSERT_EQ(image_->count, count);
  for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(point(i), expected[i]);
}

TEST_F(Image, MorePointsThanCellsAreThinnedEvenly) {
  std::vector<Seen> seen;
  for (int column = 0; column < 4096; ++column) {
    for (std::uint16_t ring = 0; ring < 64; ++ring) {
      seen.push_back({2.0 * kPi_rad * (column + 0.5) / 4096 - kPi_rad, 0.01 * ring - 0.3, 6.0, ring, 0.0});
    }
  }
  const RangeImage& image = of(Recorded(seen).with_ring());
  EXPECT_LE(image.count, kImageCells);
  EXPECT_GT(image.count, kImageCells / 2) << "half of the cells stay empty";
  std::uint32_t by_row[64] = {}, by_quarter[4] = {};
  for (std::uint32_t i = 0; i < image.count; ++i) {
    ++by_row[image.row_of(i)];
    ++by_quarter[4 * static_cast<std::uint32_t>(image.column_of(i)) / image.columns];
  }
  for (const std::uint32_t n : by_row) EXPECT_NEAR(n, image.count / 64.0, 0.1 * image.count / 64.0);
  for (const std::uint32_t n : by_quarter) EXPECT_NEAR(n, image.count / 4.0, 0.05 * image.count / 4.0);
}

TEST_F(Image, NoReturnsComeIntoNoCell) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const float bad[][3] = {{kNan, 1.0F, 0.0F},  {1.0F, kNan, 0.0F},  {1.0F, 1.0F, kNan},    {kInf, 0.0F, 0.0F},
                          {-kInf, kInf, 0.0F}, {0.0F, 0.0F, 0.0F},  {1e30F, 0.0F, 0.0F},   {3e38F, 3e38F, 3e38F},
                          {0.29F, 0.0F, 0.0F}, {0.0F, 30.1F, 0.0F}, {1e-40F, 1e-40F, 0.0F}};
  Recorded recorded(std::vector<Seen>(std::size(bad) + 1, Seen{1.0, 0.0, 5.0, 0, 0.0}));
  for (std::size_t i = 0; i < std::size(bad); ++i) recorded.put_xyz(i, bad[i][0], bad[i][1], bad[i][2]);
  EXPECT_EQ(of(recorded).count, 1U);
  EXPECT_EQ(of(recorded.with_ring()).count, 1U);
}

TEST_F(Image, ARingThatIsNoneComesIntoNoCell) {
  Recorded recorded(std::vector<Seen>{{0.0, 0.0, 5.0, 3, 0.0}, {1.0, 0.1, 5.0, 4, 0.0}});
  recorded.with_time<float>(POSE_WALL_FIELD_FLOAT32, {std::nanf(""), 7.0F});
  recorded.cloud.time = {};
  recorded.cloud.ring = {16, POSE_WALL_FIELD_FLOAT32};
  EXPECT_EQ(of(recorded).count, 1U) << "NaN";
  recorded.with_time<float>(POSE_WALL_FIELD_FLOAT32, {-1.0F, 7.0F});
  recorded.cloud.time = {};
  EXPECT_EQ(of(recorded).count, 1U) << "negative";
  recorded.with_time<float>(POSE_WALL_FIELD_FLOAT32, {0.0F, 1e9F});
  recorded.cloud.time = {};
  EXPECT_EQ(of(recorded).count, 2U) << "no rings at all: rows by elevation";
}

TEST_F(Image, TheMountTakesPointsToBaseAndTheBodyOut) {
  mount_.R_base_lidar = turn_by({0.0, 0.0, kPi_rad / 2});
  mount_.sensor_base_m = {1.0, 0.0, 0.5};
  const Recorded recorded({{0.0, 0.0, 2.0, 0, 0.0}, {kPi_rad / 2, 0.0, 2.0, 1, 0.0}});
  of(recorded);
  ASSERT_EQ(image_->count, 2U);
  EXPECT_LT((point(0) - Eigen::Vector3d(1.0, 2.0, 0.5)).norm(), 1e-6);
  EXPECT_LT((point(1) - Eigen::Vector3d(-1.0, 0.0, 0.5)).norm(), 1e-6);
  mount_.body[2] = {0.9, 1.1, 1.9, 2.1, 0.4, 0.6};
  of(recorded);
  ASSERT_EQ(image_->count, 1U);
  EXPECT_LT((point(0) - Eigen::Vector3d(-1.0, 0.0, 0.5)).norm(), 1e-6) << "the other is of the body";
}

// ------------------------------------------------------------------------------------------ de-skew

// Where a point that was seen at t lies in base as that stood at 0: a machine that drives v and turns about z.
Eigen::Vector3d exact(const Eigen::Vector3d& p, double v_m_s, double turn_rad_s, double t) {
  const double angle = turn_rad_s * t;
  const Eigen::Vector3d moved =
      std::fabs(turn_rad_s) > 1e-9
          ? Eigen::Vector3d(v_m_s * std::sin(angle) / turn_rad_s, v_m_s * (1.0 - std::cos(angle)) / turn_rad_s, 0.0)
          : Eigen::Vector3d(v_m_s * t, 0.0, 0.0);
  return turn_by({0.0, 0.0, angle}) * p + moved;
}

class Deskew : public Image {
 protected:
  static constexpr int kPoints = 100;
  Deskew() {
    for (int i = 0; i < kPoints; ++i) {
      seen_.push_back({0.06 * i - 3.0, 0.005 * i - 0.2, 4.0 + 0.05 * i, static_cast<std::uint16_t>(i % 16), 0.001 * i});
    }
  }
  template <typename Time>
  Recorded with(std::uint32_t type, double per_second, double from = 0.0) {
    std::vector<Time> times;
    for (const Seen& s : seen_) times.push_back(static_cast<Time>(from + s.time_s * per_second));
    Recorded recorded(seen_);
    recorded.with_time(type, times);
    return recorded;
  }
  // The largest distance from the exact places.
  double off_m(const Recorded& recorded, double v_m_s, double turn_rad_s) {
    Twist twist;
    twist.velocity_m_s = {v_m_s, 0.0, 0.0};
    twist.turn_rad_s = {0.0, 0.0, turn_rad_s};
    of(recorded, twist);
    EXPECT_EQ(image_->count, static_cast<std::uint32_t>(kPoints));
    double worst = 0.0;
    for (std::uint32_t i = 0; i < image_->count; ++i) {
      const Seen& s = seen_[i];
      const double flat = s.range_m * std::cos(s.elevation_rad);
      const Eigen::Vector3d p(flat * std::cos(s.azimuth_rad), flat * std::sin(s.azimuth_rad),
                              s.range_m * std::sin(s.elevation_rad));
      worst = std::max(worst, (point(i) - exact(p, v_m_s, turn_rad_s, s.time_s)).norm());
    }
    return worst;
  }

  std::vector<Seen> seen_;
};

constexpr double kTurn_rad_s = 10.0 * kPi_rad / 180.0;

TEST_F(Deskew, WhateverTheTimesCountIn) {
  const double undone_m = off_m(Recorded(seen_), 1.0, kTurn_rad_s);
  EXPECT_GT(undone_m, 0.1) << "there is something to undo";
  EXPECT_LT(off_m(with<std::uint32_t>(POSE_WALL_FIELD_UINT32, 1e9), 1.0, kTurn_rad_s), 1e-3);
  EXPECT_LT(off_m(with<std::uint32_t>(POSE_WALL_FIELD_UINT32, 1e9, 3e9), 1.0, kTurn_rad_s), 1e-3) << "from 3 s on";
  EXPECT_LT(off_m(with<std::uint32_t>(POSE_WALL_FIELD_UINT32, 1e6), 1.0, kTurn_rad_s), 1e-3) << "us";
  EXPECT_LT(off_m(with<float>(POSE_WALL_FIELD_FLOAT32, 1.0), 1.0, kTurn_rad_s), 1e-3) << "s";
  EXPECT_LT(off_m(with<float>(POSE_WALL_FIELD_FLOAT32, 1.0, -0.1), 1.0, kTurn_rad_s), 1e-3) << "before the stamp";
  EXPECT_LT(off_m(with<double>(POSE_WALL_FIELD_FLOAT64, 1e3), 1.0, kTurn_rad_s), 1e-3) << "ms";
  EXPECT_LT(off_m(with<double>(POSE_WALL_FIELD_FLOAT64, 1.0, 1.7e9), 1.0, kTurn_rad_s), 1e-3) << "of the day";
  EXPECT_LT(off_m(with<double>(POSE_WALL_FIELD_FLOAT64, 1e9, 1.7e18), 1.0, kTurn_rad_s), 1e-3) << "of the day, ns";
}

TEST_F(Deskew, OfOneMotionAloneIsExact) {
  const Recorded recorded = with<double>(POSE_WALL_FIELD_FLOAT64, 1.0);
  EXPECT_LT(off_m(recorded, 2.0, 0.0), 1e-5);
  EXPECT_LT(off_m(recorded, 0.0, kTurn_rad_s), 5e-5);
  EXPECT_LT(off_m(recorded, 0.0, 0.0), 1e-5);
}

// At the top speed and the top turn of the defaults: two orders of the exponential leave 2 cm 9 m away.
TEST_F(Deskew, OfAQuickTurnLeavesCentimetres) {
  EXPECT_LT(off_m(with<double>(POSE_WALL_FIELD_FLOAT64, 1.0), 2.0, 0.5 * kPi_rad), 0.03);
}

TEST_F(Deskew, ByTimesThatMakeNoScanDoesNothing) {
  const auto untouched = [this](const Recorded& recorded) {
    Twist twist;
    twist.velocity_m_s = {1.0, 0.0, 0.0};
    of(Recorded(seen_), twist);
    std::vector<Eigen::Vector3d> expected;
    for (std::uint32_t i = 0; i < image_->count; ++i) expected.push_back(point(i));
    of(recorded, twist);
    for (std::uint32_t i = 0; i < image_->count; ++i) {
      if (point(i) != expected[i]) return false;
    }
    return image_->count == expected.size();
  };
  EXPECT_TRUE(untouched(with<float>(POSE_WALL_FIELD_FLOAT32, 0.0))) << "all alike";
  EXPECT_TRUE(untouched(with<double>(POSE_WALL_FIELD_FLOAT64, 0.0, 1.7e9))) << "all alike";
  EXPECT_TRUE(untouched(with<double>(POSE_WALL_FIELD_FLOAT64, 1e13))) << "a million years";
  std::mt19937_64 random(5);
  std::vector<double> bits(kPoints);
  for (double& b : bits) {
    const std::uint64_t word = random();
    std::memcpy(&b, &word, sizeof b);
  }
  bits[3] = std::nan("");
  bits[4] = std::numeric_limits<double>::infinity();
  bits[5] = -bits[4];
  EXPECT_TRUE(untouched(Recorded(seen_).with_time(POSE_WALL_FIELD_FLOAT64, bits))) << "bits by chance";
}

// One time that is wrong moves its own point at most so far as the machine goes in a scan.
TEST_F(Deskew, OneWrongTimeSpoilsNoOtherPoint) {
  std::vector<double> times;
  for (const Seen& s : seen_) times.push_back(s.time_s);
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300, 5.0}) {
    times[50] = wrong;
    Recorded recorded(seen_);
    recorded.with_time(POSE_WALL_FIELD_FLOAT64, times);
    Twist twist;
    twist.velocity_m_s = {1.0, 0.0, 0.0};
    of(recorded, twist);
    ASSERT_EQ(image_->count, static_cast<std::uint32_t>(kPoints));
    for (std::uint32_t i = 0; i < image_->count; ++i) EXPECT_TRUE(point(i).allFinite()) << wrong;
  }
}

}  // namespace
}  // namespace pose_wall::motion::test
