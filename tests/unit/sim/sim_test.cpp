// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The simulator's frames against numbers worked out by hand, and its promises: determinism, finite points, no scene
// that cannot be rendered. Truth has a file of its own, sim_truth_test.cpp.

#include "lab/sim/simulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lab/sim/parameters.hpp"
#include "lab/sim/pose.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools::sim {
namespace {

SceneSetup quiet_setup() {
  SceneSetup setup;
  setup.sensor.range_noise_m = 0.0;
  return setup;
}

// Points of a frame in base, with their labels.
struct Points {
  std::vector<Vector> base;
  std::vector<Label> labels;
  explicit Points(const SceneSetup& setup, std::uint32_t index = 0, std::uint64_t seed = 1) {
    const Frame frame = Simulator(setup, seed).render(index);
    for (std::size_t i = 0; i < frame.count(); ++i) {
      const float* p = &frame.xyz_intensity[4 * i];
      base.push_back(R_base_lidar(setup.mount) * Vector(p[0], p[1], p[2]) + lidar_origin_base(setup.mount));
    }
    labels = frame.labels;
  }
  std::vector<Vector> of(Label label) const {
    std::vector<Vector> chosen;
    for (std::size_t i = 0; i < base.size(); ++i) {
      if (labels[i] == label) chosen.push_back(base[i]);
    }
    return chosen;
  }
  std::size_t count(Label label) const {
    return static_cast<std::size_t>(std::count(labels.begin(), labels.end(), label));
  }
};

TEST(SimRender, CleanRoadHasItsPlanesWhereTheyBelong) {
  SceneSetup setup = quiet_setup();
  setup.machine.lateral_m = 0.5;
  const Points points(setup);
  for (const Vector& p : points.of(Label::kFloor)) EXPECT_NEAR(p.z(), -1.4, 1e-5);
  for (const Vector& p : points.of(Label::kRoof)) EXPECT_NEAR(p.z(), 2.1, 1e-5);
  for (const Vector& p : points.of(Label::kWallLeft)) EXPECT_NEAR(p.y(), 2.0, 1e-5);
  for (const Vector& p : points.of(Label::kWallRight)) EXPECT_NEAR(p.y(), -3.0, 1e-5);
  EXPECT_GT(points.count(Label::kFloor), 5000u);
  EXPECT_GT(points.count(Label::kWallLeft), 20000u);
}

TEST(SimRender, SameSeedSameBitsAnotherSeedOthers) {
  const SceneSetup setup = make_setup("nominal", "vlp16", true, 7);
  const Frame a = Simulator(setup, 7).render(3);
  const Simulator again(setup, 7);
  again.render(0);
  EXPECT_EQ(a.xyz_intensity, again.render(3).xyz_intensity);
  EXPECT_NE(a.xyz_intensity, again.render(4).xyz_intensity);
  EXPECT_NE(a.xyz_intensity, Simulator(setup, 8).render(3).xyz_intensity);
}

TEST(SimRender, EverySceneOnEverySensorIsFiniteAndFull) {
  for (const SceneChoice& scene : scenes()) {
    for (const SensorModel& model : sensor_models()) {
      SceneSetup setup = make_setup(scene.name, model.sensor.name, false, 1);
      setup.sensor.columns = std::ceil(setup.sensor.columns / 8.0);
      const Frame frame = Simulator(setup, 1).render(12);
      const std::size_t beams = beams_of(setup.sensor, 0).size();
      EXPECT_EQ(frame.xyz_intensity.size(), 4 * frame.count());
      EXPECT_GT(frame.count(), beams / 10) << scene.name << " " << model.sensor.name;
      EXPECT_LE(frame.count(), 2 * beams) << scene.name << " " << model.sensor.name;
      EXPECT_TRUE(std::all_of(frame.xyz_intensity.begin(), frame.xyz_intensity.end(),
                              [](float x) { return std::isfinite(x) && std::abs(x) < 1e6f; }))
          << scene.name << " " << model.sensor.name;
    }
  }
}

TEST(SimRender, RoughnessHasItsSize) {
  SceneSetup setup = quiet_setup();
  setup.rock.roughness_m = 0.05;
  double sum = 0.0;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const Vector& p : Points(setup, 0, seed).of(Label::kWallLeft)) {
      if (std::abs(p.x()) > 6.0) continue;
      sum += p.y() - 2.5;
      squares += std::pow(p.y() - 2.5, 2);
      ++count;
    }
  }
  EXPECT_NEAR(sum / static_cast<double>(count), 0.0, 0.015);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), 0.05, 0.008);
}

TEST(SimRender, RoughRockHasNoHoles) {
  SceneSetup setup = quiet_setup();
  setup.rock.roughness_m = 0.05;
  setup.floor.floor_roughness_m = 0.03;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Points points(setup, 0, seed);
    for (const Vector& p : points.base) {
      EXPECT_LE(std::abs(p.y()), 2.5 + 3.5 * 0.05 + 1e-3);
      EXPECT_LE(p.z(), 2.1 + 3.5 * 0.05 + 1e-3);
      EXPECT_GE(p.z(), -1.4 - 3.5 * 0.03 - 1e-3);
    }
  }
}

TEST(SimRender, RoughnessStaysWhereItIsWhileTheMachineMoves) {
  SceneSetup setup = quiet_setup();
  setup.rock.roughness_m = 0.05;
  setup.machine.speed_mps = 1.0;
  const std::vector<Vector> first = Points(setup, 0).of(Label::kWallLeft);
  const std::vector<Vector> later = Points(setup, 10).of(Label::kWallLeft);
  double worst = 0.0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < first.size(); i += 97) {
    if (std::abs(first[i].x()) > 3.0) continue;
    for (const Vector& p : later) {
      const Vector gap = p + Vector(1.0, 0.0, 0.0) - first[i];
      if (std::hypot(gap.x(), gap.z()) > 0.004) continue;
      worst = std::max(worst, std::abs(gap.y()));
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 10u);
  EXPECT_LT(worst, 0.006);
}

TEST(SimRender, GhostsLieBelowTheFloorAtTheMirroredPlace) {
  SceneSetup setup = quiet_setup();
  setup.floor.puddle_coverage = 1.0;
  setup.floor.puddle_ghost = 1.0;
  const Points points(setup);
  EXPECT_GT(points.count(Label::kGhost), 3000u);
  EXPECT_EQ(points.count(Label::kFloor), 0u);
  // A wall's mirror image is the wall prolonged downwards; the roof's lies as deep below the floor as it is high.
  for (const Vector& p : points.of(Label::kGhost)) {
    EXPECT_LT(p.z(), -1.4);
    EXPECT_TRUE(std::abs(std::abs(p.y()) - 2.5) < 1e-4 || std::abs(p.z() + 1.4 + 3.5) < 1e-4);
  }
}

TEST(SimRender, SteelSetsStandOutByTheirDepthAtTheirPitch) {
  SceneSetup setup = quiet_setup();
  setup.rock.steel_pitch_m = 0.8;
  const Points points(setup);
  EXPECT_GT(points.count(Label::kSteel), 5000u);
  for (const Vector& p : points.of(Label::kSteel)) {
    if (p.z() > 1.9) continue;
    EXPECT_LE(std::abs(std::remainder(p.x(), 0.8)), 0.06 + 1e-4);
    EXPECT_GE(std::abs(p.y()), 2.38 - 1e-4);
    EXPECT_LE(std::abs(p.y()), 2.5 + 1e-4);
  }
}

TEST(SimRender, CrosscutIsABoxBehindTheWall) {
  SceneSetup setup = quiet_setup();
  setup.openings = {kSideLeft, 2.0, 4.0, 6.0, 3.5};
  setup.openings.widening_side = setup.openings.narrow_side = kSideNone;
  const Points points(setup);
  EXPECT_GT(points.count(Label::kOpening), 1000u);
  for (const Vector& p : points.of(Label::kWallLeft)) EXPECT_TRUE(p.x() < 1e-3 || p.x() > 4.0 - 1e-3);
  for (const Vector& p : points.of(Label::kOpening)) {
    EXPECT_GE(p.y(), 2.5 - 1e-4);
    EXPECT_TRUE(std::abs(p.x()) < 1e-3 || std::abs(p.x() - 4.0) < 1e-3 || std::abs(p.y() - 8.5) < 1e-3);
  }
}

// Sides slanted by 40 degrees through the mouth's edges at x = 0 and 4, the back 6 m behind the wall.
TEST(SimRender, ObliqueCrosscutHasSlantedSidesAndLetsNoBeamThrough) {
  for (const double slant : {40.0, -40.0}) {
    SceneSetup setup = quiet_setup();
    setup.openings.crosscut_side = kSideRight;
    setup.openings.crosscut_at_m = 2.0;
    setup.openings.crosscut_depth_m = 6.0;
    setup.openings.crosscut_oblique_deg = slant;
    const Points points(setup);
    const double shift = std::tan(slant * kRadPerDeg);
    EXPECT_GT(points.count(Label::kOpening), 1000u);
    for (const Vector& p : points.of(Label::kOpening)) {
      const double depth = -p.y() - 2.5;
      const double along = p.x() - depth * shift;
      EXPECT_TRUE(std::abs(along) < 1e-3 || std::abs(along - 4.0) < 1e-3 || std::abs(depth - 6.0) < 1e-3) << p;
      EXPECT_TRUE(along > -1e-3 && along < 4.0 + 1e-3 && depth > -1e-3 && depth < 6.0 + 1e-3) << p;
    }
  }
}

TEST(SimRender, ObliqueFaceIsAPlaneAcrossTheRoad) {
  SceneSetup setup = quiet_setup();
  setup.road.face_distance_m = 5.0;
  setup.road.face_oblique_deg = 30.0;
  const Points points(setup);
  const Vector n(std::cos(M_PI / 6.0), std::sin(M_PI / 6.0), 0.0);
  for (const Vector& p : points.of(Label::kFace)) EXPECT_NEAR(n.dot(p), 5.0 * n.x(), 1e-4);
  EXPECT_GT(points.count(Label::kFace), 1000u);
}

TEST(SimRender, CurvedWallsAreCirclesAboutTheCentre) {
  SceneSetup setup = quiet_setup();
  setup.road.curve_radius_m = -40.0;
  const Points points(setup);
  for (const Vector& p : points.of(Label::kWallLeft)) EXPECT_NEAR(std::hypot(p.x(), p.y() + 40.0), 42.5, 1e-4);
  for (const Vector& p : points.of(Label::kWallRight)) EXPECT_NEAR(std::hypot(p.x(), p.y() + 40.0), 37.5, 1e-4);
}

TEST(SimRender, ArchAndLeaningWallsHaveTheirShape) {
  SceneSetup arch = quiet_setup();
  arch.road.arch_springing_m = 1.5;
  SceneSetup lean = quiet_setup();
  lean.road.lean_left_deg = 8.0;
  const Points arched(arch);
  const Points leaning(lean);
  for (const Vector& p : arched.of(Label::kRoof)) {
    EXPECT_NEAR(std::hypot(p.y() / 2.5, (p.z() - 0.1) / 2.0), 1.0, 1e-4);
  }
  for (const Vector& p : arched.of(Label::kWallLeft)) EXPECT_LT(p.z(), 0.1 + 1e-3);
  for (const Vector& p : leaning.of(Label::kWallLeft)) {
    EXPECT_NEAR(p.y(), 2.5 + (p.z() + 1.4) * std::tan(8.0 * kRadPerDeg), 1e-4);
  }
}

TEST(SimRender, PipeBoxAndBodySurfacesAreWhereTheyShould) {
  SceneSetup setup = quiet_setup();
  setup.objects.pipe_side = kSideLeft;
  setup.objects.pipe_count = 1.0;
  setup.objects.conveyor_side = kSideRight;
  setup.machine.body = 1.0;
  const Points points(setup);
  std::size_t pipe = 0;
  std::size_t conveyor = 0;
  for (const Vector& p : points.of(Label::kBody)) {
    EXPECT_LE(std::abs(p.x()), 2.25 + 1e-4);
    EXPECT_LE(std::abs(p.y()), 0.6 + 1e-4);
  }
  for (const Vector& p : points.of(Label::kObject)) {
    if (p.y() > 0.0) {
      EXPECT_NEAR(std::hypot(p.y() - 2.25, p.z() + 0.2), 0.10, 1e-4);
      ++pipe;
    } else {
      EXPECT_TRUE(std::abs(p.y() + 1.2) < 1e-4 || std::abs(p.z() + 0.3) < 1e-4 || std::abs(p.z() + 1.1) < 1e-4);
      ++conveyor;
    }
  }
  EXPECT_GT(pipe, 500u);
  EXPECT_GT(conveyor, 1000u);
  EXPECT_GT(points.count(Label::kBody), 1000u);
}

TEST(SimRender, BlockedSectorAndLostWallGiveNoReturn) {
  SceneSetup setup = quiet_setup();
  setup.machine.forward_axis = 2.0;  // +Y: azimuth 90 deg is base -X
  setup.faults.blocked_from_deg = 60.0;
  setup.faults.blocked_to_deg = 120.0;
  const Points blocked(setup);
  for (const Vector& p : blocked.base) EXPECT_FALSE(p.x() < 0.0 && std::abs(p.y()) < 0.57 * std::abs(p.x()));

  SceneSetup lost = quiet_setup();
  lost.faults.lost_side = kSideRight;
  EXPECT_GT(Points(lost, 9).count(Label::kWallRight), 20000u);
  EXPECT_EQ(Points(lost, 10).count(Label::kWallRight), 0u);
  EXPECT_GT(Points(lost, 20).count(Label::kWallRight), 20000u);
}

TEST(SimRender, DustNoiseAndBiasHaveTheirSize) {
  SceneSetup setup = quiet_setup();
  setup.faults.dust = 0.3;
  setup.faults.dust_range_m = 0.4;
  const Points dusty(setup);
  // Dust nearer than the sensor can see gives no point.
  EXPECT_NEAR(static_cast<double>(dusty.count(Label::kDust)) / 65536.0, 0.3 * std::exp(-0.1 / 0.4), 0.01);

  SceneSetup noisy = quiet_setup();
  noisy.sensor.range_noise_m = 0.02;
  noisy.sensor.range_bias_m = 0.03;
  const Frame exact = Simulator(quiet_setup(), 1).render(0);
  const Frame shaken = Simulator(noisy, 1).render(0);
  ASSERT_EQ(exact.count(), shaken.count());
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < exact.count(); ++i) {
    const auto range = [i](const Frame& f) {
      return std::hypot(f.xyz_intensity[4 * i], f.xyz_intensity[4 * i + 1], f.xyz_intensity[4 * i + 2]);
    };
    const double error = static_cast<double>(range(shaken) - range(exact));
    sum += error;
    squares += error * error;
  }
  const double mean = sum / static_cast<double>(exact.count());
  EXPECT_NEAR(mean, 0.03, 5e-4);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(exact.count()) - mean * mean), 0.02, 5e-4);
}

TEST(SimRender, DustRisesEvenly) {
  SceneSetup setup = quiet_setup();
  setup.faults.dust = 0.8;
  setup.faults.dust_rise_s = 2.0;
  setup.sensor.range_floor_m = 0.0;
  setup.faults.dust_range_m = 0.05;
  for (const auto& [frame, share] : {std::pair{0u, 0.0}, {10u, 0.4}, {20u, 0.8}, {30u, 0.8}}) {
    EXPECT_NEAR(static_cast<double>(Points(setup, frame).count(Label::kDust)) / 65536.0, share, 0.01);
  }
}

TEST(SimSequence, DuplicatesComeOnceMoreStampAndTruthToo) {
  SceneSetup setup;
  setup.machine.speed_mps = 0.5;
  setup.machine.drift_mps = 0.1;
  setup.sequence.duplicate_every = 3.0;
  const Simulator simulator(setup, 1);
  EXPECT_EQ(simulator.render(2).xyz_intensity, simulator.render(3).xyz_intensity);
  EXPECT_EQ(simulator.render(2).stamp_ns, simulator.render(3).stamp_ns);
  EXPECT_EQ(simulator.truth(2).value, simulator.truth(3).value);
  EXPECT_NE(simulator.render(3).xyz_intensity, simulator.render(4).xyz_intensity);
  EXPECT_EQ(simulator.render(4).stamp_ns - simulator.render(3).stamp_ns, 100000000);
  EXPECT_EQ(simulator.render(6).xyz_intensity, simulator.render(7).xyz_intensity);
}

TEST(SimSequence, DroppedFramesLeaveAGapInStampsAndMotion) {
  SceneSetup setup;
  setup.machine.drift_mps = 0.1;
  setup.sequence.drop_every = 4.0;
  setup.sequence.drop_length = 5.0;
  const Simulator simulator(setup, 1);
  EXPECT_EQ(simulator.truth(3).stamp_ns - simulator.truth(2).stamp_ns, 100000000);
  EXPECT_EQ(simulator.truth(4).stamp_ns - simulator.truth(3).stamp_ns, 600000000);
  EXPECT_EQ(simulator.truth(5).stamp_ns - simulator.truth(4).stamp_ns, 100000000);
  EXPECT_NEAR(simulator.truth(3).value[3] - simulator.truth(4).value[3], 0.06, 1e-12);
  EXPECT_EQ(simulator.truth(8).stamp_ns - simulator.truth(0).stamp_ns, 1800000000);
}

TEST(SimSequence, FrozenFramesRepeatAndStampsGoOn) {
  SceneSetup setup;
  setup.machine.speed_mps = 0.5;
  setup.sequence.freeze_from_s = 0.3;
  setup.sequence.freeze_to_s = 0.6;
  const Simulator simulator(setup, 1);
  EXPECT_EQ(simulator.render(3).xyz_intensity, simulator.render(5).xyz_intensity);
  EXPECT_NE(simulator.render(5).xyz_intensity, simulator.render(6).xyz_intensity);
  EXPECT_EQ(simulator.render(5).stamp_ns - simulator.render(3).stamp_ns, 200000000);
}

}  // namespace
}  // namespace pose_wall::tools::sim
