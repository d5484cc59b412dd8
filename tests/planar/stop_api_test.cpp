// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "planar/encounter/standing.hpp"
#include "pose_wall_planar.h"
#include "support/aligned_block.hpp"

namespace {

using namespace pose_wall::test;

TEST(StopApi, AClearRoadBecomesGoAndAPersonAheadStops) {
  Standing standing(plain_road());
  const auto clear = standing.frames(30);
  EXPECT_EQ(clear.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_GO));
  EXPECT_DOUBLE_EQ(clear.allowed_speed_m_s, 1.0);
  EXPECT_EQ(clear.reasons, 0U);
  standing.world().things.push_back(round_thing(3.2, 0.2, 0.2, -0.1, 1.7));
  const auto stopped = standing.frame();
  EXPECT_EQ(stopped.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  EXPECT_NE(stopped.reasons & POSE_WALL_PLANAR_STOP_R_THING, 0U);
  EXPECT_NEAR(stopped.nearest_m[0], 3.05, 0.2);
  EXPECT_NEAR(stopped.nearest_distance_m, 0.8, 0.2);
  EXPECT_NE(stopped.nearest_height & POSE_WALL_PLANAR_STOP_HIGH, 0U);
  EXPECT_DOUBLE_EQ(stopped.allowed_speed_m_s, 0.0);
  // Gone, and clear for restart_s.
  standing.world().things.clear();
  standing.frame();
  EXPECT_EQ(standing.frames(1).state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  EXPECT_EQ(standing.frames(12).state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_GO));
}

TEST(StopApi, TheSmallestThingStopsAndIsCalledLow) {
  Standing standing(plain_road());
  standing.frames(30);
  standing.world().things.push_back(round_thing(2.25 + 1.3, 0.3, 0.15, -0.1, 0.27));
  const auto result = standing.frames(3);
  EXPECT_LT(result.stop_speed_m_s, 0.9);
  EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_THING, 0U);
  EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_LOW, 0U);
  EXPECT_EQ(result.nearest_height, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_LOW));
}

// A low thing that the machine has come near to is below its rays. After its memory has ended nobody confirms it away,
// until it is seen gone. Without it the same drive ends with go.
TEST(StopApi, ALowThingBelowTheRaysOutlastsItsMemoryAndALook) {
  constexpr double kMemory_s = 4.0, kConfirm_m = 2.5, kThing_m = 2.25 + 1.8, kDrive_m = 1.4;
  constexpr int kForgotten = 45, kSettled = 30;  // frames that take longer than the memory, and for walls to settle
  for (const bool is_there : {false, true}) {
    Standing standing(plain_road(), kConfirm_m, kMemory_s);
    if (is_there) standing.world().things.push_back(round_thing(kThing_m, 0.3, 0.15, -0.1, 0.27));
    const auto far = standing.frames(kSettled);
    EXPECT_EQ((far.reasons & POSE_WALL_PLANAR_STOP_R_LOW) != 0, is_there);
    standing.drive(kDrive_m);
    const auto forgotten = standing.frames(kForgotten);
    EXPECT_EQ(forgotten.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
    EXPECT_EQ(forgotten.reasons & POSE_WALL_PLANAR_STOP_R_LOW, 0U);
    standing.confirm();
    const auto looked = standing.frames(15);
    EXPECT_EQ(looked.state != static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP), !is_there);
    EXPECT_EQ((looked.reasons & POSE_WALL_PLANAR_STOP_R_BLIND) != 0, is_there);
    if (!is_there) continue;
    EXPECT_NEAR(looked.nearest_m[0], kThing_m - kDrive_m, 0.3);
    standing.world().things.clear();
    standing.drive(-kDrive_m);
    standing.frames(5);
    standing.drive(kDrive_m);
    standing.confirm();
    EXPECT_NE(standing.frames(kSettled).state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP))
        << "it was seen gone";
  }
}

// Who has stood for long may walk off at any moment, even with the back to a wall. A wall does not.
TEST(StopApi, APersonWhoStandsBesideTheWayKeepsTheMachineSlow) {
  for (const double y : {1.7, 2.75}) {
    World world = plain_road();
    world.things.push_back(round_thing(1.8 + 0.77 * y, y, 0.2, -0.1, 1.7));
    Standing standing(world);
    const auto result = standing.frames(40);
    EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_NEARING, 0U) << y;
    // Stands in 0.45 s + v / a, while the person comes near at 1.6 m/s.
    EXPECT_LE(1.6 * (0.45 + result.stop_speed_m_s), y - 0.2 - 0.6) << y;
    EXPECT_GT(result.nearest_age_s, 1.0);
  }
}

// However thin, and with the back flush to the wall: a chest stands out by more than a wall's tips.
TEST(StopApi, APersonFlushWithTheWallMayWalkOff) {
  for (const double radius : {0.17, 0.2, 0.25}) {
    World world = plain_road();
    world.half_width_m = 2.4;
    world.things.push_back(round_thing(4.0, 2.4 - radius, radius, -0.1, 1.7));
    Standing standing(world);
    standing.frames(40);
    for (int k = 0; k < 60; ++k) {
      const auto result = standing.frame();
      EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_NEARING, 0U) << radius << " " << k;
      EXPECT_LE(1.6 * (0.45 + result.stop_speed_m_s), 2.4 - 2.0 * radius - 0.6) << radius << " " << k;
    }
  }
}

// Who stands for long between others who only pass by is no wall.
TEST(StopApi, PassersByMakeNoWallOfAPerson) {
  World world = plain_road();
  world.things.push_back(round_thing(4.5, 1.7, 0.2, -0.1, 1.7));
  Standing standing(world);
  const double alone_m_s = standing.frames(40).stop_speed_m_s;
  for (const double x : {3.5, 4.0, 5.0, 5.5}) {
    standing.world().things.push_back(round_thing(x, 1.7, 0.2, -0.1, 1.7));
  }
  standing.frames(10);
  standing.world().things.resize(1);
  standing.frames(5);
  for (int k = 0; k < 10; ++k) {
    const auto result = standing.frame();
    EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_NEARING, 0U) << k;
    EXPECT_LE(result.stop_speed_m_s, alone_m_s + 0.05) << k;  // a level
  }
}

// With slack for its lateness and for the size of a place, a driver who follows the allowed speed is slowed by what
// lies in the way before it is stopped. Without any it is stopped at more speed.
TEST(StopApi, SlackIsWhatADriverNeedsToSlowDownInTime) {
  const auto stopped_at_m_s = [](double slack_s) {
    double most_m_s = 0.0;
    for (const double x : {9.0, 9.35, 9.7, 10.05}) {
      pose_wall::test::Plan plan;
      plan.world.wall_wave_m = 0.02, plan.world.face_m = 1000.0, plan.world.half_width_m = 2.8;
      plan.world.things.push_back(round_thing(x, 0.1, 0.3, -0.1, 0.27));
      plan.sensor = Sensor(Pattern::vlp16, 2.0, 1.45, 0.0, 0.18, 1.25, 600);
      plan.lasts_s = 25.0;
      pose_wall_planar_stop_settings settings = encounter_settings();
      settings.slack_s = slack_s;
      StopUnderTest stop;
      Draw draw(6);
      const auto out = pose_wall::test::Encounter(plan, settings, &stop, &draw).run();
      EXPECT_FALSE(out.contact) << slack_s << " " << x;
      most_m_s = std::fmax(most_m_s, out.top_stop_m_s);
    }
    return most_m_s;
  };
  const double with = stopped_at_m_s(0.7), without = stopped_at_m_s(0.0);
  EXPECT_LT(with, 0.1);
  EXPECT_GT(without, 0.2);
}

// On clear roads with rough rock nothing stops the machine: neither where the memory of walls ends behind it, nor where
// tips stand alone in sight, nor where a place straight ahead lies between two columns of rays.
TEST(StopApi, ARoughRoadIsNoPerson) {
  struct Road {
    double wave_m, length_m, half_width_m;
  };
  for (const Road& rough : {Road{0.115, 2.5, 2.7}, Road{0.1, 1.4, 2.3}, Road{0.07, 1.47, 2.83}, Road{0.0, 1.0, 2.2}}) {
    pose_wall::test::Plan plan;
    plan.world.wall_wave_m = rough.wave_m, plan.world.wall_length_m = rough.length_m;
    plan.world.half_width_m = rough.half_width_m, plan.world.face_m = 1000.0;
    plan.sensor = Sensor(Pattern::vlp16, 2.0, 1.45, 0.0, 0.18, 1.25, 600);
    plan.lasts_s = 30.0;
    const pose_wall_planar_stop_settings settings = encounter_settings();
    StopUnderTest stop;
    Draw draw(6);
    const auto out = pose_wall::test::Encounter(plan, settings, &stop, &draw).run();
    EXPECT_EQ(out.stops, 0U) << rough.wave_m << " " << rough.length_m;
    EXPECT_GT(out.moved_m, 15.0) << rough.wave_m << " " << rough.length_m;
  }
}

TEST(StopApi, SilenceStops) {
  Standing standing(plain_road());
  standing.frames(30);
  EXPECT_EQ(standing.tick_after(200000000).state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_GO));
  const auto stale = standing.tick_after(260000000);
  EXPECT_EQ(stale.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  EXPECT_NE(stale.reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
  EXPECT_DOUBLE_EQ(stale.allowed_speed_m_s, 0.0);
  EXPECT_EQ(standing.frame().state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));  // not at once
}

TEST(StopApi, BeforeTheFirstFrameItIsStopped) {
  Standing standing(plain_road());
  const auto result = standing.tick_after(1);
  EXPECT_EQ(result.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
}

TEST(StopApi, AFrozenFrameAnOldOneAndOneOfTheFutureStop) {
  Standing standing(plain_road());
  standing.frames(30);
  const auto frozen = standing.again();
  EXPECT_EQ(frozen.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  EXPECT_NE(frozen.reasons & POSE_WALL_PLANAR_STOP_R_FROZEN, 0U);
  standing.frames(30);
  const auto at = [&](std::int64_t stamp_ns, std::int64_t now_ns) {
    standing.scan().points()[0] += 0.01F;
    const pose_wall_cloud cloud = standing.scan().cloud(stamp_ns);
    EXPECT_EQ(pose_wall_planar_stop_process(standing.stop().get(), &cloud, &standing.motion(), now_ns,
                                            &standing.stop().result()),
              POSE_WALL_OK);
    return standing.stop().result();
  };
  const std::int64_t last = standing.stamp_ns();
  EXPECT_NE(at(last - 1, last + 1000).reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
  EXPECT_NE(at(last + 2, last + 400000000).reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
  const auto future = at(last + 900000000, last + 400000001);
  EXPECT_NE(future.reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
  EXPECT_EQ(future.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
}

constexpr std::uint32_t kStop = POSE_WALL_PLANAR_STOP_STOP, kGo = POSE_WALL_PLANAR_STOP_GO;

TEST(StopApi, TheHeartDoesNotBeatWhileTheClockStandsAndThenItStops) {
  Standing standing(plain_road());
  const std::uint32_t beat = standing.frames(30).heartbeat;
  for (int k = 1; k < 100; ++k) {  // a clock in coarse steps
    const auto result = standing.tick_after(1000000);
    ASSERT_EQ(result.heartbeat, beat) << k;
    ASSERT_EQ(result.state, kGo) << k;
  }
  const auto stands = standing.tick_after(1000000);
  EXPECT_EQ(stands.state, kStop);
  EXPECT_NE(stands.reasons & POSE_WALL_PLANAR_STOP_R_STALE, 0U);
  EXPECT_EQ(stands.heartbeat, beat);
  EXPECT_EQ(standing.tick_after(1000001).heartbeat, beat + 1);
  EXPECT_EQ(standing.tick_after(1000000).heartbeat, beat + 1);  // a little back is no beat
  EXPECT_EQ(standing.frames(30).state, kGo);
}

TEST(StopApi, AClockThatIsSetBackIsToldAndTheStopGoesOnByItselfWithoutOldKnowledge) {
  constexpr std::int64_t kHour_ns = 3600 * std::int64_t{1000000000};
  for (const bool ticks : {false, true}) {
    Standing standing(plain_road());
    ASSERT_EQ(standing.frames(30).state, kGo);
    standing.set_clock(-kHour_ns);
    const auto told = ticks ? standing.tick_after(1000000) : standing.frame();
    EXPECT_EQ(told.state, kStop);
    EXPECT_NE(told.reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
    // What someone saw before nobody knows any more: the places without a ray are blind.
    const auto after = standing.frames(30);
    EXPECT_EQ(after.reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
    EXPECT_EQ(after.state, kStop);
    EXPECT_NE(after.reasons & POSE_WALL_PLANAR_STOP_R_BLIND, 0U);
    standing.confirm();
    EXPECT_EQ(standing.frames(30).state, kGo);
  }
}

TEST(StopApi, StampsThatGoBackAloneAreOneLateFrameOrAClock) {
  Standing standing(plain_road());
  ASSERT_EQ(standing.frames(30).state, kGo);
  const auto at = [&](std::int64_t stamp_ns) {
    standing.take();
    const pose_wall_cloud cloud = standing.scan().cloud(stamp_ns);
    standing.set_clock(10000000);
    EXPECT_EQ(pose_wall_planar_stop_process(standing.stop().get(), &cloud, &standing.motion(),
                                            standing.stamp_ns() + 2000000, &standing.stop().result()),
              POSE_WALL_OK);
    return standing.stop().result();
  };
  const std::int64_t last = standing.stamp_ns();
  EXPECT_NE(at(last - 50000000).reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
  EXPECT_EQ(standing.frames(30).state, kGo);  // one late frame: nothing is forgotten
  const std::int64_t then = standing.stamp_ns();
  EXPECT_NE(at(then - 50000000).reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
  EXPECT_NE(at(then - 50000000).reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);  // the same once more is no clock
  const auto second = at(then - 40000000);
  EXPECT_EQ(second.reasons & POSE_WALL_PLANAR_STOP_R_INVALID, 0U);
  EXPECT_EQ(second.state, kStop);
  EXPECT_EQ(second.frames, 1U);
  EXPECT_EQ(standing.frames(30).state, kStop);  // forgotten
}

TEST(StopApi, ACoveredSensorADirtySectorAndALongPuddleAreBlind) {
  Standing covered(plain_road());
  covered.frames(30);
  covered.sensor().dropout = 1.1;
  EXPECT_EQ(covered.frame().state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  Standing dirty(plain_road());
  dirty.frames(30);
  dirty.sensor().dirt_from_rad = -0.1, dirty.sensor().dirt_to_rad = 0.2;
  const auto blind = dirty.frames(5);
  EXPECT_NE(blind.reasons & POSE_WALL_PLANAR_STOP_R_BLIND, 0U);
  EXPECT_LT(blind.stop_speed_m_s, 0.1);
  World wet = plain_road();
  wet.puddles.push_back({2.8, 7.0, -1.0, 1.0, false});
  Standing puddle(wet, 0.5);  // from 2.75 m on nobody has looked either
  const auto before = puddle.frames(30);
  EXPECT_NE(before.reasons & POSE_WALL_PLANAR_STOP_R_BLIND, 0U);
  EXPECT_LT(before.stop_speed_m_s, 0.5);
}

TEST(StopApi, ATurnAndTheWayBackAreBlindForASensorInFront) {
  Standing standing(plain_road());
  standing.frames(30);
  standing.motion().command_speed_m_s = 0.0, standing.motion().command_turn_rad_s = 0.1;
  EXPECT_NE(standing.frames(2).reasons & POSE_WALL_PLANAR_STOP_R_BLIND, 0U);
  EXPECT_EQ(standing.frame().state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  standing.motion().command_speed_m_s = -0.1, standing.motion().command_turn_rad_s = 0.0;
  EXPECT_EQ(standing.frame().state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
}

TEST(StopApi, WithoutAMotionItStops) {
  Standing standing(plain_road());
  standing.frames(30);
  standing.motion().given = 0;
  const auto result = standing.frame();
  EXPECT_EQ(result.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_MISSING, 0U);
  standing.motion().given = POSE_WALL_PLANAR_STOP_MEASURED;
  standing.motion().speed_m_s = std::nan("");
  EXPECT_NE(standing.frame().reasons & POSE_WALL_PLANAR_STOP_R_MISSING, 0U);
}

TEST(StopApi, TooFastStops) {
  World world = plain_road();
  world.things.push_back(round_thing(2.25 + 1.2, 0.0, 0.2, -0.1, 0.9));
  Standing standing(world);
  standing.frames(40);
  standing.motion().speed_m_s = standing.motion().command_speed_m_s = 0.9;
  const auto result = standing.frame();
  EXPECT_EQ(result.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP));
  EXPECT_NE(result.reasons & POSE_WALL_PLANAR_STOP_R_SPEED, 0U);
}

// Sparse returns through which rays pass: here and there they are dust, in one place they are a thing after the delay.
TEST(StopApi, DustIsNoThingAndAThinThingIsOneAfterTheDelay) {
  World dusty = plain_road();
  Standing dust(dusty);
  dust.frames(30);
  const auto frame_with = [&](Standing* standing, double x, double y) {
    // One ray of the frame ends in the air.
    standing->take();
    auto& points = standing->scan().points();
    const Eigen::Matrix3d R = standing->sensor().R();
    const Eigen::Vector3d at = R.transpose() * Eigen::Vector3d(x - 2.0, y, 0.6 - standing->sensor().z_m);
    std::size_t best = 0;
    float most = -1.0F;
    for (std::size_t k = 0; k + 3 < points.size(); k += 4) {
      const Eigen::Vector3f p(points[k], points[k + 1], points[k + 2]);
      if (!(p.norm() > 0.1F)) continue;
      const float along = p.normalized().dot(at.cast<float>().normalized());
      if (along > most) most = along, best = k;
    }
    const auto scale =
        static_cast<float>(at.norm()) / Eigen::Vector3f(points[best], points[best + 1], points[best + 2]).norm();
    for (std::size_t axis = 0; axis < 3; ++axis) points[best + axis] *= scale;
    return standing->again();
  };
  std::uint32_t things = 0;
  for (int k = 0; k < 20; ++k) {
    const auto result = frame_with(&dust, 3.0 + 0.1 * ((7 * k) % 20), -1.0 + 0.1 * ((11 * k) % 20));
    things += (result.reasons & POSE_WALL_PLANAR_STOP_R_THING) != 0 ? 1U : 0U;
  }
  EXPECT_EQ(things, 0U);
  Standing thin(plain_road());
  thin.frames(30);
  int frames = 0;
  while (frames < 10) {
    ++frames;
    if ((frame_with(&thin, 3.3, 0.15).reasons & POSE_WALL_PLANAR_STOP_R_THING) != 0) break;
  }
  EXPECT_LE(frames, 4);  // 0.3 s after the first of them
}

TEST(StopApi, GarbageGivesNoNumberThatIsNoneAndNeverGo) {
  Standing standing(plain_road());
  standing.frames(30);
  Draw draw(1);
  for (int k = 0; k < 50; ++k) {
    standing.frame();
    auto& points = standing.scan().points();
    for (float& value : points) {
      const std::uint32_t bits = (draw.below(65536) << 16U) | draw.below(65536);
      std::memcpy(&value, &bits, sizeof(value));
    }
    const auto result = standing.again();
    EXPECT_EQ(result.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP)) << k;
    EXPECT_EQ(result.allowed_speed_m_s, 0.0);
    EXPECT_TRUE(result.stop_speed_m_s >= 0.0 && result.stop_speed_m_s <= 1.0);
  }
}

TEST(StopApi, RefusedCallsChangeNothing) {
  Standing standing(plain_road());
  const auto before = standing.frames(5);
  auto& result = standing.stop().result();
  const pose_wall_cloud good = standing.scan().cloud(standing.stamp_ns() + Standing::kFrame_ns);
  const auto status_with = [&](auto change) {
    pose_wall_cloud cloud = good;
    pose_wall_planar_stop_motion motion = standing.motion();
    change(cloud, motion);
    return pose_wall_planar_stop_process(standing.stop().get(), &cloud, &motion,
                                         standing.stamp_ns() + Standing::kFrame_ns, &result);
  };
  EXPECT_EQ(status_with([](auto& c, auto&) { c.struct_size = 1; }), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(status_with([](auto& c, auto&) { c.x.type = POSE_WALL_FIELD_UINT8; }), POSE_WALL_E_CLOUD_FIELD);
  EXPECT_EQ(status_with([](auto& c, auto&) { c.z.offset = 13; }), POSE_WALL_E_CLOUD_STEP);
  EXPECT_EQ(status_with([](auto& c, auto&) { c.data_bytes -= 1; }), POSE_WALL_E_CLOUD_SIZE);
  EXPECT_EQ(status_with([](auto& c, auto&) { c.data = nullptr; }), POSE_WALL_E_NULL);
  EXPECT_EQ(status_with([](auto&, auto& m) { m.struct_size = 0; }), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(status_with([](auto&, auto& m) { m.given = 8; }), POSE_WALL_E_INPUT);
  EXPECT_EQ(std::memcmp(&before, &result, sizeof(before)), 0);
  result.struct_size = 4;
  EXPECT_EQ(status_with([](auto&, auto&) {}), POSE_WALL_E_STRUCT_SIZE);
  result.struct_size = sizeof(result);
  EXPECT_EQ(pose_wall_planar_stop_process(nullptr, &good, nullptr, 0, &result), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_stop_tick(standing.stop().get(), 0, nullptr), POSE_WALL_E_NULL);
}

TEST(StopApi, OpenRefusesWhatItCannotUse) {
  pose_wall_config config;
  ASSERT_EQ(pose_wall_config_init(&config), POSE_WALL_OK);
  AlignedBlock block(pose_wall::test::stop_bytes_needed(), Dirt::kOnes);
  EXPECT_LE(block.size(), std::uint64_t{POSE_WALL_PLANAR_STOP_BLOCK_MOST});
  pose_wall_planar_stop* stop = nullptr;
  EXPECT_EQ(pose_wall_planar_stop_open(&config, nullptr, block.data(), block.size() - 1, &stop),
            POSE_WALL_E_BLOCK_SMALL);
  EXPECT_EQ(pose_wall_planar_stop_open(nullptr, nullptr, block.data(), block.size(), &stop), POSE_WALL_E_NULL);
  pose_wall_planar_stop_settings settings = encounter_settings();
  settings.deceleration_m_s2 = std::nan("");
  EXPECT_EQ(pose_wall_planar_stop_open(&config, &settings, block.data(), block.size(), &stop), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(stop, nullptr);
  EXPECT_EQ(pose_wall_planar_stop_open(&config, nullptr, block.data(), block.size(), &stop), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_planar_stop_reset(stop), POSE_WALL_OK);
  std::memset(block.data(), 0xFF, 64);
  EXPECT_EQ(pose_wall_planar_stop_reset(stop), POSE_WALL_E_ENGINE);
}

TEST(StopApi, TheSameFramesGiveTheSameBitsWhateverTheBlockHeld) {
  const auto digest = [](Dirt dirt) {
    AlignedBlock block(pose_wall::test::stop_bytes_needed(), dirt);
    pose_wall_config config;
    (void)pose_wall_config_init(&config);
    (void)pose_wall_config_set_number(&config, "extrinsic_z", 1.5);
    (void)pose_wall_config_set_number(&config, "extrinsic_pitch", 0.5);
    pose_wall_planar_stop* stop = nullptr;
    EXPECT_EQ(pose_wall_planar_stop_open(&config, nullptr, block.data(), block.size(), &stop), POSE_WALL_OK);
    World world = plain_road();
    world.things.push_back(round_thing(5.0, 0.5, 0.2, -0.1, 1.7));
    Sensor sensor(Pattern::vlp16, 0.0, 1.5, 0.0, 0.5, 1.25, 900);
    Scan scan;
    Draw draw(4);
    std::vector<double> numbers;
    for (int k = 0; k < 12; ++k) {
      scan.take(sensor, world, 0.02 * k, 0.0, 0.0, 0.0, 0.0, &draw);
      pose_wall_planar_stop_result result{};
      result.struct_size = sizeof(result);
      const pose_wall_planar_stop_motion motion{sizeof(motion), 1, 0.2, 0.01, 0.0, 0.0};
      const pose_wall_cloud cloud = scan.cloud((k + 1) * Standing::kFrame_ns);
      EXPECT_EQ(pose_wall_planar_stop_process(stop, &cloud, &motion, cloud.stamp_ns, &result), POSE_WALL_OK);
      for (const double number :
           {result.stop_speed_m_s, result.floor_height_m, result.floor_slope[0], result.nearest_distance_m,
            static_cast<double>(result.thing_cells), static_cast<double>(result.blind_cells)}) {
        numbers.push_back(std::isnan(number) ? -1.0 : number);
      }
    }
    return numbers;
  };
  const std::vector<double> zeros = digest(Dirt::kZeros);
  EXPECT_EQ(zeros, digest(Dirt::kOnes));
  EXPECT_EQ(zeros, digest(Dirt::kRandom));
}

TEST(StopApi, NamesAreThoseOfTheHeader) {
  EXPECT_STREQ(pose_wall_planar_stop_state_name(POSE_WALL_PLANAR_STOP_GO), "go");
  EXPECT_STREQ(pose_wall_planar_stop_state_name(7), "unknown");
  EXPECT_STREQ(pose_wall_planar_stop_reason_name(1), "blind");
  EXPECT_STREQ(pose_wall_planar_stop_reason_name(POSE_WALL_PLANAR_STOP_REASON_COUNT), "unknown");
  EXPECT_STRNE(pose_wall_planar_stop_reason_text(0), "");
}

}  // namespace
