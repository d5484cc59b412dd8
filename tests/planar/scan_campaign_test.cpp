// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan_campaign.hpp"

#include <gtest/gtest.h>

namespace {

using namespace pose_wall::test;

// pose_wall_planar_scan_trial draws 100,000 of them.
TEST(ScanCampaign, NoThingIsMissedThatARayMetAndNoneIsWhereItIsClear) {
  for (const RingSensor& sensor : {kScanOs1, kScanVlp16, kScanMid360}) {
    Campaign campaign;
    CampaignRunner runner(sensor);
    for (std::uint64_t seed = 1; seed <= 120; ++seed) runner.run(seed, &campaign);
    EXPECT_EQ(campaign.missed_with_returns, 0U) << sensor.name;
    EXPECT_EQ(campaign.false_clear, 0U) << sensor.name;
    EXPECT_EQ(campaign.dark_false_clear, 0U) << sensor.name;
    EXPECT_EQ(campaign.promise_broken, 0U) << sensor.name;
    EXPECT_EQ(campaign.clear_behind, 0U) << sensor.name;
    EXPECT_LT(campaign.missed, campaign.scenes / 3) << sensor.name;
  }
}

TEST(ScanCampaign, NoDirectionIsClearThroughAThingThatSwallowsAllLight) {
  Campaign campaign;
  CampaignRunner runner(kScanOs1);
  for (std::uint64_t seed = 7; seed <= 8 * 250; seed += 8) runner.run(seed, &campaign);  // every eighth is dark
  EXPECT_EQ(campaign.scenes, 250U);
  EXPECT_EQ(campaign.dark_false_clear, 0U);
}

TEST(ScanCampaign, ASpeckOfDustInTheBeamOfAThingsOnlyHighReturnDoesNotHideIt) {
  Campaign campaign;
  CampaignRunner runner(kScanMid360);
  runner.run(302011305, &campaign);  // found among 100,000
  EXPECT_EQ(campaign.missed, 0U);
}

TEST(ScanCampaign, TheClearRangeIsOfUse) {
  // a plain road, an OS1-64: clear to 5 m and more in most directions that are not a wall
  CampaignRunner runner(kScanOs1);
  RoadScene road;
  road.left_m = road.right_m = 8.0;
  road.noise_m = kScanOs1.noise_m;
  const SeenScene seen = see(road, kScanOs1, rays_of(kScanOs1, 1), 1);
  SceneDraw draw(1);
  const pose_wall_planar_floor floor = floor_of(road, kCampaignTilt_rad, &draw);
  runner.scanner().process(cloud_of(seen.points, 0), &floor);
  std::uint32_t clear = 0;
  for (std::uint32_t b = 0; b < runner.scanner().scan().beams; ++b) {
    clear += runner.scanner().view().clear_m[b] > 6.5F && runner.scanner().view().clear_from_m[b] < 3.5F ? 1U : 0U;
  }
  EXPECT_GT(clear, runner.scanner().scan().beams * 9 / 10);
}

}  // namespace
