// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: no start of the grid fits better than its bound says, whatever the map and the scan. The search finds the
// start that all of them, looked at one by one, would give. What it takes stays below what the header promises.

#include "motion/wide_start.hpp"

#include <gtest/gtest.h>
#include <random>

#include "motion/frame_steps.hpp"
#include "motion/pipeline.hpp"

namespace pose_wall::motion::test {
namespace {

// A room drawn by chance, its map from a few places, and a scan from another place, or of another room.
class Drawn {
  std::mt19937 random_;  // first: the reach is drawn by it

 public:
  explicit Drawn(std::uint32_t seed) : random_(seed) {
    const BoxRoom room = draw_room(seed);
    Scanner scanner;
    scanner.lines = 48;
    scanner.columns = 360;
    scanner.noise_m = 0.01;
    pipeline.map->clear();
    for (std::uint32_t i = 0; i <= seed % 4; ++i) {
      const Pose at = pose_of(0.5 * i, 0.05 * i, 0.0, 0.0, 0.0, 0.02 * i);
      scanner.seed = 10 * seed + i;
      pipeline.see(scan_of(room, at, scanner), at);
      pipeline.take_in(at);
    }
    const double aside_m = std::min(reach.place_m, room.width_m - 1.0);
    const Pose truth = pose_of(between(-1.0, 1.0) * std::min(reach.place_m, room.length_m - 1.5),
                               between(-1.0, 1.0) * aside_m, 0.0, 0.0, 0.0, between(-1.0, 1.0) * reach.yaw_rad);
    elsewhere = seed % 5 == 4;
    scanner.seed = 10 * seed + 9;
    pipeline.see(scan_of(elsewhere ? draw_room(seed + 1) : room, truth, scanner), Pose{});
  }

  double between(double least, double most) {
    return least + (most - least) * (static_cast<double>(random_()) / 4294967296.0);
  }

  Pipeline pipeline;
  WideReach reach = {between(0.1, 0.25), between(0.6, 1.8)};
  bool elsewhere = false;

 private:
  BoxRoom draw_room(std::uint32_t seed) {
    BoxRoom room;
    room.length_m = seed % 3 == 0 ? between(25.0, 60.0) : between(3.0, 12.0);
    room.width_m = between(1.5, seed % 3 == 2 ? 9.0 : 4.0);
    room.down_m = between(1.0, 1.6);
    room.up_m = between(1.5, 3.0);
    const double high_m = between(0.0, 0.12), often = between(0.8, 4.0);
    if (seed % 4 != 3) return room;  // rough rock takes long to draw
    room.relief = [=](int face, double u, double v) {
      return high_m * std::sin(often * u + 2.0 * face) * std::sin(often * v + face) +
             0.03 * std::sin(9.0 * u + face * v);
    };
    return room;
  }
};

// The best of all starts, looked at one by one.
void search_each(const ReliefMap& map, Span<const Observation> asked, const StartGrid& grid, double place_step_m,
                 Pose* pose) {
  std::vector<std::uint8_t> facing(asked.size());
  std::vector<Observation> there(asked.begin(), asked.end());
  const Pose middle = *pose;
  double best = 0.0;
  for (std::uint32_t i = 0; i < grid.starts(); ++i) {
    const Start start = grid.at(i);
    const Pose at = {grid.turn(start.yaw) * middle.R, middle.t + place_step_m * Eigen::Vector3d(start.x, start.y, 0.0)};
    find_facings(at.R, asked, {facing.data(), asked.size()});
    for (std::uint32_t k = 0; k < asked.size(); ++k) there[k].facing = facing[k];
    const double share = share_on_map(map, {there.data(), asked.size()}, at, 1) - start.cost();
    if (share > best) best = share, *pose = at;
  }
}

std::vector<Observation> chosen(Span<const Observation> all) {
  std::vector<Observation> asked;
  for (const Observation& o : all) {
    if (o.facing != kFacesZ) asked.push_back(o);
  }
  const std::size_t stride = asked.size() / kAskedMost + 1;
  for (std::size_t i = 0; i * stride < asked.size(); ++i) asked[i] = asked[i * stride];
  asked.resize((asked.size() + stride - 1) / stride);
  return asked;
}

TEST(WideStart, NoStartFitsBetterThanItsBound) {
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    Drawn drawn(seed);
    Pipeline& p = drawn.pipeline;
    std::vector<Observation> asked = chosen(p.observations);
    const Span<const Observation> all(asked.data(), static_cast<std::uint32_t>(asked.size()));
    const StartGrid grid = {3, 7, 0.2};
    Laid<StartScratch> scratch;
    Work work;
    const std::uint32_t best = count_starts(*p.map, all, Pose{}, grid, scratch.get(), &work);
    ASSERT_GT(best, 0U);
    std::vector<Observation> there = asked;
    for (std::uint32_t i = 0; i < grid.starts(); ++i) {
      const Start start = grid.at(i);
      const Pose at = {grid.turn(start.yaw), kPlaceStep_m * Eigen::Vector3d(start.x, start.y, 0.0)};
      find_facings(at.R, all, scratch->facing.first(all.size()));
      for (std::uint32_t k = 0; k < all.size(); ++k) there[k].facing = scratch->facing[k];
      const double share = share_on_map(*p.map, {there.data(), all.size()}, at, 1) - start.cost();
      ASSERT_LE(share, scratch->bound[i] * kBoundUnit) << seed << ": start " << i;
    }
    for (std::uint32_t k = 1; k < best; ++k) {
      ASSERT_GE(scratch->bound[scratch->best[k - 1]], scratch->bound[scratch->best[k]]);
    }
  }
}

TEST(WideStart, FindsWhatAllStartsOneByOneGive) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    Drawn drawn(seed);
    Pipeline& p = drawn.pipeline;
    if (drawn.elsewhere) continue;
    std::vector<Observation> asked = chosen(p.observations);
    const Span<const Observation> all(asked.data(), static_cast<std::uint32_t>(asked.size()));
    const int yaws = static_cast<int>(drawn.reach.yaw_rad / 0.035 + 0.5);
    const int places = static_cast<int>(drawn.reach.place_m / kPlaceStep_m + 0.5);
    Pose each, found;
    Work work;
    search_each(*p.map, all, {yaws, places, 0.035}, kPlaceStep_m, &each);
    search_each(*p.map, all, {3, 2, 0.01}, 0.1, &each);
    search_each(*p.map, all, {2, 1, 0.004}, 0.05, &each);
    Laid<StartScratch> scratch;
    EXPECT_TRUE(search_wide(*p.map, p.observations, drawn.reach, scratch.get(), &work, &found)) << seed;
    EXPECT_LT((found.t - each.t).norm(), 1e-9) << seed;
    EXPECT_LT(turn_of(found.R.transpose() * each.R).norm(), 1e-9) << seed;
    EXPECT_LT(work.done(), steps::kSearchMost) << seed;
  }
}

// A scan of another place, in all of the reach: the start that took three thousand million instructions.
TEST(WideStart, AnotherPlaceStaysWithinTheSteps) {
  for (const std::uint32_t seed : {4U, 9U, 14U}) {
    Drawn drawn(seed);
    ASSERT_TRUE(drawn.elsewhere);
    Laid<StartScratch> scratch;
    Work work;
    Pose found;
    static_cast<void>(
        search_wide(*drawn.pipeline.map, drawn.pipeline.observations, {7.85, 10.0}, scratch.get(), &work, &found));
    EXPECT_LT(work.done(), steps::kSearchMost) << seed;
    constexpr std::uint64_t kOneByOne = kStartsInRow * kStartsInRow * kStartsInRow * 100 * steps::kStartLookedAt;
    EXPECT_LT(50 * work.done(), kOneByOne) << "with 100 observations that answer";
  }
}

}  // namespace
}  // namespace pose_wall::motion::test
