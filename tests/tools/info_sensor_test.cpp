// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: rings, class, ranges, rate and stamps are the same in `info` and in `doctor`; rings are counted right in
// clouds that are tilted, moved by de-skew or not about the sensor's origin, and are not known where nothing shows
// them. Does not prove: the count for sensors whose rings are spaced unevenly (they are not known).

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/numbers/angles.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/simulator.hpp"
#include "ran_command.hpp"
#include "study/info/sensor_look.hpp"
#include "study/info/stamp_steps.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

using Move = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

// What the sensor looks like after its points were moved.
SensorFacts facts_of(const char* sensor, const Move& move) {
  sim::SceneSetup setup;
  setup.sensor = sim::find_sensor(sensor)->sensor;
  for (const char* setting : {"face_distance_m=12", "base_height_m=1.4"}) sim::set_parameter(setup, setting);
  const sim::Simulator simulator(setup, 7);
  SensorLook look;
  for (std::uint32_t f = 0; f < 3; ++f) {
    const sim::Frame frame = simulator.render(f);
    std::vector<float> xyz_m;
    for (std::size_t i = 0; i < frame.count(); ++i) {
      const float* p = &frame.xyz_intensity[4 * i];
      const Eigen::Vector3f moved = move(Eigen::Vector3f(p[0], p[1], p[2]).cast<double>()).cast<float>();
      xyz_m.insert(xyz_m.end(), {moved.x(), moved.y(), moved.z()});
    }
    look.add(xyz_m, {});
  }
  return look.facts();
}

Eigen::Vector3d as_it_is(const Eigen::Vector3d& p) {
  return p;
}

Eigen::Vector3d leaning(const Eigen::Vector3d& p) {
  return Eigen::AngleAxisd(6.0 / kDegPerRad, Eigen::Vector3d::UnitX()) * p;
}

// Leaning, 0.1 m above the sensor's origin, and turned back by a motion of 3 degrees over the scan.
Eigen::Vector3d moved(const Eigen::Vector3d& p) {
  const double of_scan = std::atan2(p.y(), p.x()) / (2.0 * M_PI);
  const Eigen::AngleAxisd lean(4.0 / kDegPerRad, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd turned(of_scan * 3.0 / kDegPerRad, Eigen::Vector3d::UnitY());
  return lean * (turned * p) + Eigen::Vector3d(0.1 * of_scan, 0.0, 0.1);
}

TEST(SensorLook, RingsAreCountedInCloudsThatWereMoved) {
  const struct {
    const char* sensor;
    std::size_t rings;
  } cases[] = {{"vlp16", 16}, {"os1-64", 64}, {"os0-128", 128}};
  for (const auto& [sensor, rings] : cases) {
    const SensorFacts straight = facts_of(sensor, as_it_is);
    EXPECT_EQ(straight.rings, rings) << sensor;
    EXPECT_EQ(straight.model, sensor);
    EXPECT_FALSE(straight.rings_are_told);
    EXPECT_EQ(rings_text(straight), "about " + std::to_string(rings));
    const std::size_t of_moved = facts_of(sensor, moved).rings;
    EXPECT_TRUE(of_moved == rings || of_moved == 0) << sensor << ": " << of_moved << "; not known, rather than wrong";
    EXPECT_EQ(facts_of(sensor, leaning).rings, rings) << sensor;
  }
}

// On a vehicle that hides its lowest ring.
TEST(SensorLook, AnEndOfTheViewMayBeHidden) {
  std::vector<float> xyz_m;
  for (int ring = 1; ring < 16; ++ring) {
    const double elevation = (-15.0 + 2.0 * ring) / kDegPerRad;
    for (int column = 0; column < 360; ++column) {
      const double azimuth = column / kDegPerRad;
      for (const double part :
           {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)}) {
        xyz_m.push_back(static_cast<float>(10.0 * part));
      }
    }
  }
  SensorLook look;
  look.add(xyz_m, {16, "field ring"});
  EXPECT_EQ(look.facts().model, "vlp16");
  EXPECT_EQ(look.facts().config, "vlp16");
}

TEST(SensorLook, APatternHasNoRings) {
  const SensorFacts facts = facts_of("mid360", as_it_is);
  EXPECT_EQ(facts.rings, 0U);
  EXPECT_EQ(facts.model, "mid360");
  EXPECT_EQ(facts.config, "mid360");
  EXPECT_EQ(rings_text(facts), "not known");
}

TEST(SensorLook, OneClassOfRingsAndView) {
  SensorLook look;
  // 128 rings from -22.5 to 22.5 degrees, 10 m away: an OS1-128, which is none of the four that are simulated.
  std::vector<float> xyz_m;
  for (int ring = 0; ring < 128; ++ring) {
    const double elevation = (-22.5 + 45.0 * ring / 127.0) / kDegPerRad;
    for (int column = 0; column < 360; ++column) {
      const double azimuth = column / kDegPerRad;
      for (const double part :
           {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)}) {
        xyz_m.push_back(static_cast<float>(10.0 * part));
      }
    }
  }
  look.add(xyz_m, {128, "field ring"});
  const SensorFacts facts = look.facts();
  EXPECT_EQ(facts.model, "os1-128");
  EXPECT_EQ(class_text(facts), "OS1-128; the defaults are made for it");
  EXPECT_EQ(rings_text(facts), "128");
  EXPECT_EQ(rings_source_text(facts), "by the field ring");
  EXPECT_NEAR(facts.ranges.median_m, 10.0, 0.02);
}

TEST(StampSteps, AStampThatRepeatsDoesNotGoBack) {
  const std::int64_t ms = 1'000'000;
  const StampSteps steps = look_at_steps({0, 100 * ms, 200 * ms, 200 * ms, 300 * ms, 250 * ms, 600 * ms});
  EXPECT_EQ(steps.still, 1U);
  EXPECT_EQ(steps.back, 1U);
  EXPECT_EQ(steps.gaps, 1U);
  EXPECT_NEAR(steps.longest_s, 0.35, 1e-9);
  EXPECT_NEAR(steps.rate_hz, 10.0, 1e-9);
  EXPECT_EQ(look_at_steps({}).rate_hz, 0.0);
}

struct Both {
  nlohmann::json info, doctor;
};

Both look_with_both(const std::string& input) {
  Both both;
  both.info = nlohmann::json::parse(command({"info", "-q", "--json", input}).printed).at(0);
  both.doctor = nlohmann::json::parse(command({"doctor", "-q", "--json", input}).printed);
  return both;
}

void expect_agreement(const Both& both) {
  const nlohmann::json &info = both.info.at("sensor"), &doctor = both.doctor.at("sensor");
  for (const char* member :
       {"class", "config", "rings", "rings_certain", "returns_per_frame", "elevation_min_deg", "elevation_max_deg"}) {
    EXPECT_EQ(info.at(member), doctor.at(member)) << member;
  }
  EXPECT_EQ(both.info.at("ranges_m").at("median"), doctor.at("range_median_m"));
  if (both.info.at("stamps").is_null()) return;
  const nlohmann::json &stamps = both.info.at("stamps"), &frames = both.doctor.at("frames");
  EXPECT_NEAR(1.0 / stamps.at("interval_s").get<double>(), frames.at("rate_hz").get<double>(), 1e-9);
  EXPECT_EQ(stamps.at("gaps"), frames.at("gaps"));
  EXPECT_EQ(stamps.at("still"), frames.at("still"));
  EXPECT_EQ(stamps.at("backwards"), frames.at("back"));
}

TEST(InfoAndDoctor, AgreeOnTheSensorAndItsStamps) {
  const TempFolder folder;
  for (const char* setting : {"unit_scale=1", "unit_scale=1000"}) {
    const std::string road = folder.file(setting);
    ASSERT_EQ(
        command({"sim", "-q", "--sensor", "os1-64", "--frames", "3", "--set", setting, "--output", road}).exit_status,
        0);
    const Both both = look_with_both(road + "/frames");
    expect_agreement(both);
    EXPECT_EQ(both.info.at("sensor").at("rings"), 64);
    EXPECT_EQ(both.info.at("sensor").at("config"), "os1-64");
  }
  // The last was in millimetres: both doubt the unit, in the same words.
  const std::string frames = folder.file("unit_scale=1000/frames");
  const std::string info = command({"info", "-q", frames}).printed, doctor = command({"doctor", "-q", frames}).printed;
  const std::size_t from = info.find("half of the points lie beyond");
  ASSERT_NE(from, std::string::npos) << info;
  EXPECT_TRUE(contains(doctor, info.substr(from, info.find('\n', from) - from))) << doctor;
}

TEST(InfoAndDoctor, AgreeOnRecordedFrames) {
  const char* const data = std::getenv("POSE_WALL_DATA");
  const std::string folder = data == nullptr ? "" : data;
  if (!std::filesystem::exists(folder + "/hall_walk_os0")) GTEST_SKIP() << "POSE_WALL_DATA names no folder with it";
  struct {
    const char* input;
    std::size_t rings;
    const char* kind;
  } const cases[] = {{"/corridor_vlp16", 16, "vlp16"},
                     {"/hall_walk_os0", 64, "os0-64"},
                     {"/packets/OS-1-128_v2.3.0_1024x10_lb_n3.pcap", 128, "os1-128"}};
  for (const auto& [input, rings, kind] : cases) {
    const Both both = look_with_both(folder + input);
    expect_agreement(both);
    EXPECT_EQ(both.info.at("sensor").at("rings"), rings) << input;
    EXPECT_EQ(both.info.at("sensor").at("class"), kind) << input;
  }
}

}  // namespace
}  // namespace pose_wall::tools
