// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The table of keys and the table of scenes: every entry can be set, and what cannot be is refused with a reason.

#include "lab/sim/parameters.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "lab/sim/check_setup.hpp"
#include "lab/sim/scenes.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::sim {
namespace {

std::string refusal(const std::string& assignment) {
  SceneSetup setup;
  return test::said_by<std::invalid_argument>([&] { set_parameter(setup, assignment); });
}

TEST(SimParameters, NamesAndFieldsAreOwnedByOneRowEach) {
  SceneSetup setup;
  std::set<std::string> names;
  std::set<const double*> fields;
  for (const Parameter& p : parameters()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_TRUE(fields.insert(&p.field(setup)).second) << p.name;
  }
}

TEST(SimParameters, DefaultsAreInRangeAndReadBack) {
  SceneSetup setup;
  for (const Parameter& p : parameters()) {
    const double value = p.field(setup);
    EXPECT_NO_THROW(set_parameter(setup, p.name, parameter_text(p, value))) << p.name;
    EXPECT_DOUBLE_EQ(p.field(setup), value) << p.name;
  }
}

TEST(SimParameters, RefusalsSayWhatIsAllowed) {
  EXPECT_NE(refusal("widht_m=3").find("did you mean 'width_m'"), std::string::npos);
  EXPECT_NE(refusal("width_m=0.1").find("0.5 to 1000 m"), std::string::npos);
  EXPECT_NE(refusal("width_m=nan").find("outside"), std::string::npos);
  EXPECT_NE(refusal("width_m=wide").find("not a number"), std::string::npos);
  EXPECT_NE(refusal("pipe_side=lef").find("did you mean 'left'"), std::string::npos);
  EXPECT_NE(refusal("width_m").find("KEY=VALUE"), std::string::npos);
  EXPECT_EQ(refusal("forward_axis=-Y"), "");
}

TEST(SimScenes, UnknownNamesAreRefusedWithTheNearest) {
  EXPECT_THROW(make_setup("clean", "vlp17x", false, 1), std::invalid_argument);
  const std::string said = test::said_by<std::invalid_argument>([] { make_setup("steel_set", "vlp16", false, 1); });
  EXPECT_NE(said.find("did you mean 'steel_sets'"), std::string::npos) << said;
}

TEST(SimScenes, RandomSizesStayInRangeDifferBySeedAndRepeat) {
  for (const SceneChoice& scene : scenes()) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      SceneSetup setup = make_setup(scene.name, "vlp16", true, seed);
      SceneSetup again = make_setup(scene.name, "vlp16", true, seed);
      EXPECT_NO_THROW(checked(setup)) << scene.name;
      for (const Parameter& p : parameters()) {
        EXPECT_GE(p.field(setup), p.minimum) << scene.name << " " << p.name;
        EXPECT_LE(p.field(setup), p.maximum) << scene.name << " " << p.name;
        EXPECT_EQ(p.field(setup), p.field(again)) << scene.name << " " << p.name;
      }
    }
  }
  SceneSetup a = make_setup("rough", "vlp16", true, 1);
  EXPECT_NE(a.rock.roughness_m, make_setup("rough", "vlp16", true, 2).rock.roughness_m);
}

TEST(SimScenes, EachSaysWhatIsRightInIt) {
  for (const SceneChoice& scene : scenes()) EXPECT_STRNE(scene.expected, "") << scene.name;
}

TEST(SimScenes, TheMachineStandsInNothing) {
  SceneSetup setup;
  setup.objects.conveyor_side = kSideLeft;
  setup.machine.lateral_m = 0.9;
  EXPECT_NO_THROW(checked(setup));
  setup.machine.lateral_m = 1.0;
  EXPECT_THROW(checked(setup), std::invalid_argument);
  setup.objects.conveyor_side = kSideRight;
  EXPECT_NO_THROW(checked(setup));
}

// By its place on the machine, whichever way that is turned; not of a wall that is not there.
TEST(SimScenes, TheSensorIsNotInTheRock) {
  SceneSetup setup;
  setup.mount.mount_y_m = 2.4;
  EXPECT_NO_THROW(checked(setup));
  setup.mount.mount_y_m = 2.6;
  EXPECT_THROW(checked(setup), std::invalid_argument);
  setup.road.walls = kSideRight;
  EXPECT_NO_THROW(checked(setup));
  setup = SceneSetup{};
  setup.mount.mount_x_m = 4.0;
  EXPECT_NO_THROW(checked(setup));
  setup.machine.turned_left_deg = 60.0;
  EXPECT_THROW(checked(setup), std::invalid_argument);
  setup = SceneSetup{};
  setup.mount.mount_z_m = setup.road.height_m - setup.machine.base_height_m + 0.1;
  EXPECT_THROW(checked(setup), std::invalid_argument);
  setup.mount.mount_z_m = -setup.machine.base_height_m - 0.1;
  EXPECT_THROW(checked(setup), std::invalid_argument);
}

TEST(SimScenes, ContradictionsAreNamed) {
  SceneSetup setup;
  setup.road.arch_springing_m = 1.5;
  setup.road.lean_left_deg = 3.0;
  const std::string said = test::said_by<std::invalid_argument>([&] { checked(setup); });
  EXPECT_NE(said.find("lean_left_deg"), std::string::npos) << said;
}

}  // namespace
}  // namespace pose_wall::tools::sim
