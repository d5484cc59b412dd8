// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the C ABI of localisation refuses what its header says, changes nothing then, and finds a place in a map of
// keyframes and in one of cells.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "pose_wall_planar_localise.h"

namespace pose_wall::planar::localise_api_test {
namespace {

struct Free {
  void operator()(unsigned char* p) const { std::free(p); }
};

class Opened {
 public:
  // map_is_whole 1: a chamber with smooth walls can be unique.
  explicit Opened(std::uint32_t map_is_whole = 1) {
    pose_wall_planar_localise_settings settings;
    EXPECT_EQ(pose_wall_planar_localise_settings_init(&settings), POSE_WALL_OK);
    settings.tiles_most = 64;
    settings.work = 1000000000;
    settings.map_is_whole = map_is_whole;
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_planar_localise_memory_needed(&settings, &bytes), POSE_WALL_OK);
    block_.reset(static_cast<unsigned char*>(std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, bytes)));
    std::memset(block_.get(), 0xA5, bytes);
    EXPECT_EQ(pose_wall_planar_localise_open(&settings, block_.get(), bytes - 1, &own_), POSE_WALL_E_BLOCK_SMALL);
    EXPECT_EQ(pose_wall_planar_localise_open(&settings, block_.get(), bytes, &own_), POSE_WALL_OK);
  }
  pose_wall_planar_localise* get() const { return own_; }

 private:
  std::unique_ptr<unsigned char, Free> block_;
  pose_wall_planar_localise* own_ = nullptr;
};

// A chamber of 12 x 7 m with a niche, a slanted wall and a pillar: no two places of it look alike.
double range_at(double x, double y, double angle) {
  const double walls[][4] = {{-6, -3.5, 6, -3.5},  {6, -3.5, 6, 1},       {6, 1, 4.5, 1},    {4.5, 1, 4.5, 3.5},
                             {4.5, 3.5, -2, 3.5},  {-2, 3.5, -2, 5},      {-2, 5, -4, 5},    {-4, 5, -4, 3.5},
                             {-4, 3.5, -4.5, 3.5}, {-4.5, 3.5, -6, -3.5}, {-1, -1, 0, -1.4}, {0, -1.4, 0, -0.4},
                             {0, -0.4, -1, -1}};
  double best = 1e9;
  const double dx = std::cos(angle), dy = std::sin(angle);
  for (const auto& w : walls) {
    const double ex = w[2] - w[0], ey = w[3] - w[1], det = dx * ey - dy * ex;
    if (std::abs(det) < 1e-12) continue;
    const double t = ((w[0] - x) * ey - (w[1] - y) * ex) / det, u = ((w[0] - x) * dy - (w[1] - y) * dx) / det;
    if (t > 0 && u >= 0 && u <= 1) best = std::min(best, t);
  }
  return best;
}

constexpr int kBeams = 720;

pose_wall_planar_scan scan_from(double x, double y, double yaw, std::vector<float>* ranges) {
  ranges->resize(kBeams);
  for (int k = 0; k < kBeams; ++k) {
    (*ranges)[static_cast<std::size_t>(k)] = static_cast<float>(range_at(x, y, yaw - M_PI + k * 2 * M_PI / kBeams));
  }
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof(scan);
  scan.beams = kBeams;
  scan.stamp_ns = 5;
  scan.angle_min_rad = -M_PI;
  scan.angle_step_rad = 2 * M_PI / kBeams;
  scan.range_max_m = 30.0;
  scan.sigma_m = 0.02;
  scan.range_m = ranges->data();
  return scan;
}

void add_chamber(pose_wall_planar_localise* own) {
  const pose_wall_planar_pose places[] = {{2, 0, 0}, {-4, 0, 0}, {-3, 3, 0}, {0.5, -2, 0}, {-2, -2.5, 0}};
  for (const pose_wall_planar_pose& at : places) {
    std::vector<float> xy;
    for (int k = 0; k < kBeams; ++k) {
      const double angle = k * 2 * M_PI / kBeams, range = range_at(at.x_m, at.y_m, angle);
      xy.push_back(static_cast<float>(range * std::cos(angle)));
      xy.push_back(static_cast<float>(range * std::sin(angle)));
    }
    ASSERT_EQ(pose_wall_planar_localise_add(own, &at, xy.data(), kBeams), POSE_WALL_OK);
  }
}

void expect_found(pose_wall_planar_localise* own, double tolerance_m) {
  std::vector<float> ranges;
  const pose_wall_planar_scan scan = scan_from(-1.5, 1.2, 2.0, &ranges);
  pose_wall_planar_localise_result result{};
  result.struct_size = sizeof(result);
  ASSERT_EQ(pose_wall_planar_localise_process(own, &scan, nullptr, &result), POSE_WALL_OK);
  ASSERT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
  EXPECT_NEAR(result.pose.x_m, -1.5, tolerance_m);
  EXPECT_NEAR(result.pose.y_m, 1.2, tolerance_m);
  EXPECT_NEAR(result.pose.yaw_rad, 2.0, 0.01);
  EXPECT_EQ(result.stamp_ns, 5);
  EXPECT_EQ(result.reason, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_NONE});
  EXPECT_EQ(result.searches, 1U);
  EXPECT_EQ(result.candidates, 0U);
  EXPECT_EQ(result.progress, 1.0);
  for (const int k : {0, 4, 8}) EXPECT_GT(result.covariance[k], 0.0);
  EXPECT_EQ(result.covariance[1], result.covariance[3]);
}

TEST(LocaliseApi, FindsAPlaceAmongKeyframes) {
  const Opened opened;
  add_chamber(opened.get());
  ASSERT_EQ(pose_wall_planar_localise_finish(opened.get()), POSE_WALL_OK);
  expect_found(opened.get(), 0.01);
  // Again after it was forgotten, and by somebody's word.
  ASSERT_EQ(pose_wall_planar_localise_forget(opened.get()), POSE_WALL_OK);
  const pose_wall_planar_pose about{-1.4, 1.15, 2.02};
  ASSERT_EQ(pose_wall_planar_localise_place(opened.get(), &about, 0.2, 0.1), POSE_WALL_OK);
  std::vector<float> ranges;
  const pose_wall_planar_scan scan = scan_from(-1.5, 1.2, 2.0, &ranges);
  pose_wall_planar_localise_result result{};
  result.struct_size = sizeof(result);
  ASSERT_EQ(pose_wall_planar_localise_process(opened.get(), &scan, nullptr, &result), POSE_WALL_OK);
  EXPECT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
  EXPECT_NEAR(result.pose.x_m, -1.5, 0.01);
}

// A driver that hangs delivers the same scan under new stamps.
TEST(LocaliseApi, AScanThatCameBeforeLeavesThePlaceDoubtful) {
  const Opened opened;
  add_chamber(opened.get());
  ASSERT_EQ(pose_wall_planar_localise_finish(opened.get()), POSE_WALL_OK);
  expect_found(opened.get(), 0.01);
  std::vector<float> ranges;
  pose_wall_planar_scan scan = scan_from(-1.5, 1.2, 2.0, &ranges);
  pose_wall_planar_localise_result result{};
  result.struct_size = sizeof(result);
  for (int k = 1; k <= 3; ++k) {
    scan.stamp_ns += 100000000;
    ASSERT_EQ(pose_wall_planar_localise_process(opened.get(), &scan, nullptr, &result), POSE_WALL_OK);
    EXPECT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_DOUBTFUL}) << k;
    EXPECT_STREQ(pose_wall_planar_localise_reason_name(result.reason), "repeated");
  }
  for (float& range : ranges) range += 0.001F;  // another one
  scan.stamp_ns += 100000000;
  ASSERT_EQ(pose_wall_planar_localise_process(opened.get(), &scan, nullptr, &result), POSE_WALL_OK);
  EXPECT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
}

// Walls without relief: the map may lack a chamber like it. Somebody who knows better may take the candidate.
TEST(LocaliseApi, AReasonStandsBesideAPlaceThatIsNotUnique) {
  const Opened opened(0);
  add_chamber(opened.get());
  ASSERT_EQ(pose_wall_planar_localise_finish(opened.get()), POSE_WALL_OK);
  std::vector<float> ranges;
  const pose_wall_planar_scan scan = scan_from(-1.5, 1.2, 2.0, &ranges);
  pose_wall_planar_localise_result result{};
  result.struct_size = sizeof(result);
  ASSERT_EQ(pose_wall_planar_localise_process(opened.get(), &scan, nullptr, &result), POSE_WALL_OK);
  EXPECT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_AMBIGUOUS});
  EXPECT_STREQ(pose_wall_planar_localise_reason_name(result.reason), "smooth");
  ASSERT_EQ(result.candidates, 1U);
  pose_wall_planar_candidate candidate{};
  candidate.struct_size = sizeof(candidate);
  ASSERT_EQ(pose_wall_planar_localise_candidate(opened.get(), 0, &candidate), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_planar_localise_place(opened.get(), &candidate.pose, 0.1, 0.05), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_planar_localise_process(opened.get(), &scan, nullptr, &result), POSE_WALL_OK);
  EXPECT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
  EXPECT_EQ(result.reason, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_NONE});
  // Another room contradicts it at once.
  std::vector<float> near(kBeams, 1.0F);
  pose_wall_planar_scan other = scan;
  other.range_m = near.data();
  ASSERT_EQ(pose_wall_planar_localise_process(opened.get(), &other, nullptr, &result), POSE_WALL_OK);
  EXPECT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_DOUBTFUL});
  EXPECT_TRUE(result.reason == POSE_WALL_PLANAR_LOCALISE_CONTRADICTED || result.reason == POSE_WALL_PLANAR_LOCALISE_FEW)
      << pose_wall_planar_localise_reason_name(result.reason);
  EXPECT_STREQ(pose_wall_planar_localise_reason_name(POSE_WALL_PLANAR_LOCALISE_REASONS), "?");
}

TEST(LocaliseApi, FindsAPlaceAmongCells) {
  const Opened opened;
  constexpr int kWidth = 280, kHeight = 200;
  std::vector<std::int8_t> cells(kWidth * kHeight, POSE_WALL_PLANAR_UNKNOWN);
  const auto cell = [&](double x, double y) -> std::int8_t& {
    return cells[static_cast<std::size_t>(std::floor((y + 4) / 0.05)) * kWidth +
                 static_cast<std::size_t>(std::floor((x + 7) / 0.05))];
  };
  for (const auto& at : {std::pair<double, double>{2, 0}, {-4, 0}, {-3, 3}, {0.5, -2}, {-2, -2.5}}) {
    for (int k = 0; k < 3000; ++k) {
      const double angle = k * 2 * M_PI / 3000, range = range_at(at.first, at.second, angle);
      for (double s = 0.0; s < range - 0.03; s += 0.04) {
        std::int8_t& free = cell(at.first + s * std::cos(angle), at.second + s * std::sin(angle));
        if (free < 0) free = 0;
      }
      cell(at.first + range * std::cos(angle), at.second + range * std::sin(angle)) = 100;
    }
  }
  pose_wall_planar_grid grid{sizeof(grid), kWidth, kHeight, 0, 0.05, -7.0, -4.0, cells.data()};
  ASSERT_EQ(pose_wall_planar_localise_add_grid(opened.get(), &grid), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_planar_localise_finish(opened.get()), POSE_WALL_OK);
  expect_found(opened.get(), 0.04);
}

TEST(LocaliseApi, RefusesWhatItsHeaderSays) {
  const Opened opened;
  pose_wall_planar_localise* const own = opened.get();
  std::vector<float> ranges;
  pose_wall_planar_scan scan = scan_from(0.5, 1, 0, &ranges);
  pose_wall_planar_localise_result result{};
  result.struct_size = sizeof(result);
  EXPECT_EQ(pose_wall_planar_localise_process(own, &scan, nullptr, &result), POSE_WALL_PLANAR_E_ORDER);
  EXPECT_EQ(pose_wall_planar_localise_finish(own), POSE_WALL_PLANAR_E_ORDER);
  add_chamber(own);
  const pose_wall_planar_pose nowhere{std::nan(""), 0, 0}, here{0, 0, 0};
  float xy[2] = {1.0F, std::numeric_limits<float>::quiet_NaN()};
  EXPECT_EQ(pose_wall_planar_localise_add(own, &nowhere, xy, 1), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(pose_wall_planar_localise_add(own, &here, xy, 1), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(pose_wall_planar_localise_add(own, &here, nullptr, 1), POSE_WALL_E_NULL);
  pose_wall_planar_grid grid{sizeof(grid), 0, 1, 0, 0.05, 0, 0, reinterpret_cast<const std::int8_t*>("")};
  EXPECT_EQ(pose_wall_planar_localise_add_grid(own, &grid), POSE_WALL_PLANAR_E_GRID);
  ASSERT_EQ(pose_wall_planar_localise_finish(own), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_planar_localise_finish(own), POSE_WALL_PLANAR_E_ORDER);
  EXPECT_EQ(pose_wall_planar_localise_add(own, &here, xy, 0), POSE_WALL_PLANAR_E_ORDER);
  EXPECT_EQ(pose_wall_planar_localise_process(own, &scan, &nowhere, &result), POSE_WALL_PLANAR_E_POSE);
  result.struct_size = 3;
  EXPECT_EQ(pose_wall_planar_localise_process(own, &scan, nullptr, &result), POSE_WALL_E_STRUCT_SIZE);
  result.struct_size = sizeof(result);
  scan.beams = 0;
  EXPECT_EQ(pose_wall_planar_localise_process(own, &scan, nullptr, &result), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(pose_wall_planar_localise_process(nullptr, &scan, nullptr, &result), POSE_WALL_PLANAR_E_SCAN);
  pose_wall_planar_candidate candidate{};
  candidate.struct_size = sizeof(candidate);
  EXPECT_EQ(pose_wall_planar_localise_candidate(own, 0, &candidate), POSE_WALL_E_INDEX);
  EXPECT_EQ(pose_wall_planar_localise_place(own, &here, 2.0, 0.1), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(pose_wall_planar_localise_place(own, &nowhere, 0.1, 0.1), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(pose_wall_planar_localise_clear(nullptr), POSE_WALL_E_NULL);
  alignas(64) unsigned char garbage[256] = {};
  EXPECT_EQ(pose_wall_planar_localise_clear(reinterpret_cast<pose_wall_planar_localise*>(garbage)), POSE_WALL_E_ENGINE);
  // It still works, after blind scans of every kind.
  for (const float range : {std::numeric_limits<float>::infinity(), std::nanf(""), 0.0F, -1.0F, 0.2F}) {
    std::vector<float> blind(kBeams, range);
    scan = scan_from(0, 1, 0, &ranges);
    scan.range_m = blind.data();
    ASSERT_EQ(pose_wall_planar_localise_process(own, &scan, nullptr, &result), POSE_WALL_OK);
    EXPECT_LT(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
    EXPECT_NE(result.reason, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_NONE});
    EXPECT_TRUE(std::isnan(result.pose.x_m));
  }
  ASSERT_EQ(pose_wall_planar_localise_forget(own), POSE_WALL_OK);
  std::vector<float> good;
  scan = scan_from(-1.5, 1.2, 2.0, &good);
  ASSERT_EQ(pose_wall_planar_localise_process(own, &scan, nullptr, &result), POSE_WALL_OK);
  EXPECT_EQ(result.state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
}

}  // namespace
}  // namespace pose_wall::planar::localise_api_test
