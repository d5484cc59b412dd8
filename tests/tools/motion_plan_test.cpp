// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the classes of motion give the roads and the ways of moving that they name, for every sensor and many seeds;
// plans are the same each time, and long enough. Does not prove: that the classes suffice.

#include "lab/campaign/motion_classes.hpp"
#include "lab/campaign/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "lab/sim/check_setup.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/simulator.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr std::uint64_t kSeeds = 20;

void for_draws(const char* name, const std::function<void(const sim::SceneSetup&)>& expect) {
  const MotionClass* const one = find_motion_class(name);
  ASSERT_NE(one, nullptr) << name;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) expect(make_motion_setup(*one, "vlp16", seed));
}

TEST(MotionClasses, EveryClassDrawsSoundRoadsThatNeverComeAgain) {
  std::set<std::string> names;
  for (const MotionClass& one : motion_classes()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_NE(sim::find_scene(one.scene), nullptr) << one.name;
    for (const sim::SensorModel& model : sim::sensor_models()) {
      for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const sim::SceneSetup setup = make_motion_setup(one, model.sensor.name, seed);
        EXPECT_NO_THROW(sim::checked(setup)) << one.name << " " << seed;
        EXPECT_EQ(setup.rock.rock_repeats, 0.0) << one.name;
        EXPECT_TRUE(one.length != MotionLength::kWay || setup.machine.speed_mps >= 0.05) << one.name;
      }
    }
  }
}

TEST(MotionClasses, EveryClassAsksForSomethingOfItsStatesOrIsHonestAlone) {
  for (const MotionClass& one : motion_classes()) {
    const MotionLimits& l = one.limits;
    EXPECT_LE((l.measured_min > 0.0) + (l.told_min > 0.0) + (l.unobservable_min > 0.0), 1) << one.name;
    EXPECT_TRUE(std::isnan(l.along_share) || l.measured_min > 0.0) << one.name << ": a limit for what is not measured";
  }
}

TEST(MotionClasses, MoveAsTheyAreCalled) {
  for_draws("creeping", [](const auto& s) { EXPECT_NEAR(s.machine.speed_mps / s.sequence.rate_hz, 0.005, 1e-12); });
  for (const char* name : {"standing", "smooth_standing"}) {
    for_draws(name, [](const auto& s) {
      const sim::Placement first = sim::place(s, sim::pose_at(s, 0.0)), later = sim::place(s, sim::pose_at(s, 77.7));
      EXPECT_EQ((first.origin_road - later.origin_road).norm(), 0.0);
      EXPECT_EQ((first.R_road_base - later.R_road_base).norm(), 0.0);
    });
  }
  for_draws("reversing", [](const auto& s) {
    const double turn_s = s.machine.speed_change_at_s;
    EXPECT_GT(turn_s, 0.0);
    EXPECT_NEAR(sim::pose_at(s, 2.0 * turn_s).along_m, 0.0, 1e-9);
    EXPECT_GT(sim::pose_at(s, turn_s).along_m, 0.5);
  });
  for_draws("stopping", [](const auto& s) {
    EXPECT_NEAR(sim::pose_at(s, 5.0).along_m, sim::pose_at(s, 60.0).along_m, 1e-12);
    EXPECT_GT(sim::pose_at(s, 5.0).along_m, 0.5);
  });
  for_draws("turning", [](const auto& s) {
    EXPECT_EQ(s.machine.speed_mps, 0.0);
    EXPECT_GE(std::abs(s.machine.turn_rate_dps), 2.0);
  });
  for_draws("distorted_turn", [](const auto& s) {
    EXPECT_EQ(std::abs(s.machine.turn_rate_dps), 10.0);
    EXPECT_EQ(s.sequence.scan_s, 0.1);
  });
  for_draws("distorted", [](const auto& s) {
    EXPECT_EQ(s.machine.speed_mps, 1.5);
    EXPECT_EQ(s.sequence.scan_s, 0.1);
  });
  for (const char* name : {"rate_2hz", "sets_2hz"}) {
    for_draws(name, [](const auto& s) { EXPECT_EQ(s.sequence.rate_hz, 2.0); });
  }
}

TEST(MotionClasses, AHallIsClosedBeyondWhereTheMachineGets) {
  for (const char* name : {"hall", "hall_2hz", "hall_people"}) {
    const double seconds = find_motion_class(name)->seconds_max;
    for_draws(name, [&](const auto& s) {
      EXPECT_GE(s.road.face_distance_m, s.machine.speed_mps * seconds + 2.0) << name;
      EXPECT_GE(s.road.width_m, 14.0) << name;
    });
  }
}

TEST(MotionClasses, WhoGoesAlongGoesAsFastAsTheMachine) {
  for (const char* name : {"people", "smooth_people", "hall_people"}) {
    for_draws(name, [](const auto& s) {
      EXPECT_EQ(s.objects.people_speed_mps, s.machine.speed_mps);
      EXPECT_GE(s.objects.people_side, 1.0);
    });
  }
  for_draws("convoy", [](const auto& s) { EXPECT_EQ(s.objects.vehicle_speed_mps, s.machine.speed_mps); });
}

TEST(MotionClasses, SmoothMeansThatNothingIsThereToTell) {
  for (const MotionClass& one : motion_classes()) {
    if (!(one.limits.unobservable_min > 0.0)) continue;
    for_draws(one.name, [&one](const auto& s) {
      EXPECT_EQ(s.rock.roughness_m + s.rock.wave_m + s.rock.steel_pitch_m, 0.0) << one.name;
      EXPECT_EQ(s.floor.floor_roughness_m + s.floor.hump_m + s.road.face_distance_m + s.road.rear_distance_m, 0.0);
    });
  }
}

TEST(MotionClasses, GapsAreAsLongAsTheySay) {
  const auto longest_gap_s = [](const char* name, std::uint64_t seed) {
    const sim::Simulator simulator(make_motion_setup(*find_motion_class(name), "vlp16", seed), seed);
    double longest = 0.0;
    for (std::uint32_t i = 1; i < 70; ++i) {
      longest = std::max(longest, simulator.pose(i).time_s - simulator.pose(i - 1).time_s);
    }
    return longest;
  };
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const double brief_s = longest_gap_s("gaps", seed), long_s = longest_gap_s("gaps_long", seed);
    EXPECT_TRUE(brief_s >= 1.0 && brief_s <= 3.2) << brief_s;
    EXPECT_TRUE(long_s >= 3.0 && long_s <= 30.2) << long_s;
  }
}

PlanRequest motion_request(const std::string& size) {
  PlanRequest request;
  request.motion = true;
  request.size = size;
  return request;
}

TEST(MotionPlan, HasEveryClassAndIsTheSameEachTime) {
  const auto once = make_plan(motion_request("small"));
  const auto again = make_plan(motion_request("small"));
  std::set<std::string> classes;
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].seed, again[i].seed);
    EXPECT_EQ(once[i].frames, again[i].frames);
    classes.insert(once[i].scene);
  }
  EXPECT_EQ(classes.size(), motion_classes().size());
  EXPECT_EQ(once.size(), motion_classes().size()) << "one draw of each";
}

TEST(MotionPlan, LargeIsWhatTheIssueAsks) {
  const auto runs = make_plan(motion_request("large"));
  EXPECT_GE(frames_of(runs), 30000U);
  std::set<std::string> sensors;
  std::size_t rough = 0;
  for (const auto& run : runs) {
    sensors.insert(run.sensor);
    rough += run.scene == "rough" && run.sensor == "vlp16" ? 1U : 0U;
    const MotionClass& one = *find_motion_class(run.scene);
    if (one.length != MotionLength::kWay || one.name == std::string("reversing")) continue;
    const sim::SceneSetup setup = make_motion_setup(one, run.sensor, run.seed);
    EXPECT_GE(sim::pose_at(setup, (run.frames - 1) / setup.sequence.rate_hz).along_m, 50.0 - 1e-9) << run.scene;
  }
  EXPECT_EQ(sensors.size(), 4U);
  EXPECT_EQ(rough, 20U);
}

TEST(MotionPlan, TheSizeDoesNotChangeWhatIsDrawn) {
  PlanRequest request = motion_request("small");
  request.sensors = {"vlp16"};
  request.scenes = {"dust"};
  const auto small = make_plan(request).at(0);
  request.size = "large";
  const auto large = make_plan(request).at(0);
  EXPECT_EQ(small.seed, large.seed);
  EXPECT_LT(small.frames, large.frames);
}

TEST(MotionPlan, MistypedNamesAreAnsweredWithTheNearest) {
  const auto refusal_of = [](PlanRequest request) -> std::string {
    return test::said_by<std::invalid_argument>([&] { make_plan(request); });
  };
  PlanRequest request = motion_request("small");
  request.scenes = {"smoth"};
  EXPECT_NE(refusal_of(request).find("unknown class of motion 'smoth'; did you mean 'smooth'"), std::string::npos)
      << refusal_of(request);
  EXPECT_NE(refusal_of(motion_request("smal")).find("unknown size 'smal'"), std::string::npos);
  request.scenes = {"smooth"};
  request.sensors = {"vlp61"};
  EXPECT_NE(refusal_of(request).find("unknown sensor 'vlp61'"), std::string::npos);
}

}  // namespace
}  // namespace pose_wall::tools::campaign
