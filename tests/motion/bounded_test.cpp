// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: no frame after a silence takes more than three ordinary frames, however long the silence was, and whether the
// scan is of another place, turned, tilted or thinned. Counted in steps, which are the same on every machine.
//
//   POSE_WALL_HISTORIES=2000 pose_wall_motion_tests --gtest_filter=Bounded.*   # so many histories, and the dearest one
//   POSE_WALL_HISTORY=17 pose_wall_motion_tests --gtest_filter=Bounded.*       # one of them, for callgrind

#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "motion/boxes.hpp"
#include "motion/frame_steps.hpp"
#include "motion/odometry.hpp"

namespace pose_wall::motion::test {
namespace {

using pose_wall::test::Points;

constexpr std::uint32_t kPlaces = 6, kDriven = 9, kSilences = 3;
constexpr std::int64_t kPeriod_ns = 100000000;

class Chance {
 public:
  explicit Chance(std::uint32_t seed) : random_(seed) {}
  double between(double least, double most) {
    return least + (most - least) * (static_cast<double>(random_()) / 4294967296.0);
  }
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }

 private:
  std::mt19937 random_;
};

// A road of rough walls, or a hall, as 64 rings of 1024 columns see it. Rock by sines: quick, and comes again nowhere.
struct Place {
  explicit Place(std::uint32_t number) : chance(number + 1) {
    half_m = chance.between(1.5, 4.0);
    roof_m = chance.between(1.6, 3.5);
    ends_m = number % 3 == 2 ? chance.between(3.0, 9.0) : 1e9;
    rough_m = number % 6 == 4 ? 0.0 : chance.between(0.3, 1.0);
    for (std::uint32_t i = 0; i < kDriven; ++i) scans.push_back(scan(0.05 * i));
  }

  Points scan(double along_m) {
    Points out;
    for (int ring = 0; ring < 64; ++ring) {
      for (int column = 0; column < 1024; ++column) {
        const double up = (-22.5 + 45.0 * ring / 63) * M_PI / 180.0, azimuth = 2.0 * M_PI * column / 1024;
        const Eigen::Vector3d ray(std::cos(up) * std::cos(azimuth), std::cos(up) * std::sin(azimuth), std::sin(up));
        const double end_m = ray.x() > 0.0 ? ends_m - along_m : ends_m + along_m;
        const double others_m =
            std::min(std::fabs((ray.z() < 0.0 ? 1.2 : roof_m) / ray.z()), std::fabs(end_m / ray.x()));
        double range = half_m / std::fabs(ray.y());
        for (int round = 0; round < 3 && rough_m > 0.0 && range < 40.0; ++round) {
          range = (half_m - rock(range * ray.x() + along_m, range * ray.z(), ray.y() > 0.0)) / std::fabs(ray.y());
        }
        range = std::min(range, others_m) + chance.between(-0.015, 0.015);
        if (!(range < 60.0)) continue;
        const Eigen::Vector3f p = (range * ray).cast<float>();
        out.push_back({p.x(), p.y(), p.z()});
      }
    }
    return out;
  }
  double rock(double x, double z, bool left) const {
    const double side = left ? 2.0 : 0.0;
    return rough_m * (0.12 * std::sin(2.1 * x + 1.3 * z + side) + 0.08 * std::sin(5.3 * x - 3.1 * z + side) +
                      0.05 * std::sin(11.7 * x + 7.0 * z));
  }

  Chance chance;
  double half_m, roof_m, ends_m, rough_m;
  std::vector<Points> scans;
};

Points changed(const Points& scan, const Eigen::Matrix3d& R, double kept, Chance* chance) {
  Points out;
  const Eigen::Matrix3f turn = R.cast<float>();
  for (const auto& p : scan) {
    if (kept < 1.0 && chance->between(0.0, 1.0) > kept) continue;
    // With noise of its own, or a scan of the way would come again bit for bit.
    const float noise = 1.0F + 1e-4F * static_cast<float>(chance->between(-1.0, 1.0));
    const Eigen::Vector3f q = noise * turn * Eigen::Vector3f(p[0], p[1], p[2]);
    out.push_back({q.x(), q.y(), q.z()});
  }
  return out;
}

struct Cost {
  double ordinary = 0.0, dearest = 0.0;
  std::uint32_t wide = 0;
};

class Bounded : public ::testing::Test {
 protected:
  Bounded() {
    for (std::uint32_t i = 0; i < kPlaces; ++i) places_.emplace_back(i);
  }

  // Drives, and then falls silent again and again: 0.1 s to 10 min, each time with another surprise.
  Cost live(std::uint32_t number) {
    Chance chance(1000 + number);
    odometry_->open(Mount{}, MotionSettings{2.0, 0.5 * M_PI, 0.2, 4.89, Eigen::Vector3d::UnitX()});
    const Place& home = places_[chance.below(kPlaces)];
    std::int64_t stamp_ns = 0;
    Cost cost;
    for (std::uint32_t i = 0; i < kDriven; ++i) {
      const double steps = give(home.scans[i], stamp_ns += kPeriod_ns, &cost);
      if (i >= kDriven - 4) cost.ordinary += 0.25 * steps;  // a keyframe among them
    }
    for (std::uint32_t i = 0; i < kSilences; ++i) {
      const Place& there = chance.below(3) == 0 ? home : places_[chance.below(kPlaces)];
      const double turn_rad = chance.below(3) == 0 ? 0.0 : chance.between(-M_PI, M_PI);
      const double tilt_rad = chance.below(4) == 0 ? chance.between(-0.3, 0.3) : 0.0;
      const double kept = chance.below(3) == 0 ? std::pow(10.0, chance.between(-2.0, 0.0)) : 1.0;
      const Pose pose = pose_of(0.0, 0.0, 0.0, tilt_rad, -tilt_rad, turn_rad);
      stamp_ns += static_cast<std::int64_t>(1e9 * std::pow(10.0, chance.between(-1.0, std::log10(600.0))));
      for (int again = 0; again < 2; ++again, stamp_ns += kPeriod_ns) {
        const Points scan = changed(there.scans[chance.below(kDriven)], pose.R, kept, &chance);
        cost.dearest = std::max(cost.dearest, give(scan, stamp_ns, &cost));
      }
    }
    return cost;
  }

  double give(const Points& points, std::int64_t stamp_ns, Cost* cost) {
    pose_wall_motion_result result{};
    odometry_->process(pose_wall::test::cloud_of(points, stamp_ns), &result);
    cost->wide += result.wide_start;
    if (tells_) std::printf("%llu\n", static_cast<unsigned long long>(odometry_->steps()));
    return static_cast<double>(odometry_->steps());
  }

  std::vector<Place> places_;
  Laid<Odometry> odometry_;
  bool tells_ = false;
};

TEST_F(Bounded, AFrameAfterASilenceTakesAtMostThreeOrdinaryOnes) {
  const char* const one = std::getenv("POSE_WALL_HISTORY");
  const char* const many = std::getenv("POSE_WALL_HISTORIES");
  const std::uint32_t first = one != nullptr ? static_cast<std::uint32_t>(std::atoi(one)) : 0;
  const std::uint32_t count = one != nullptr ? 1 : many != nullptr ? static_cast<std::uint32_t>(std::atoi(many)) : 12;
  tells_ = one != nullptr;
  double worst = 0.0;
  std::uint32_t worst_of = 0, wide = 0;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Cost cost = live(i);
    wide += cost.wide;
    EXPECT_LE(cost.dearest, 3.0 * cost.ordinary) << "history " << i;
    if (cost.dearest / cost.ordinary <= worst) continue;
    worst = cost.dearest / cost.ordinary;
    worst_of = i;
  }
  EXPECT_TRUE(one != nullptr || wide > count) << "the histories are to need wide starts";
  if (many != nullptr || one != nullptr) {
    std::printf("%u histories, %u wide starts, dearest: history %u, %.2f ordinary frames\n", count, wide, worst_of,
                worst);
  }
}

}  // namespace
}  // namespace pose_wall::motion::test
