// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a real road from a file is a scene like any other. A box has its own truth, to a millimetre, and every value
// in it is valid; openings and missing walls leave the truth of the rest as it is. A proposed path goes along the
// middle, round bends, to the road's ends. Discs about the points of a cloud give the ranges of its mesh within 3 mm. A
// glTF, which has y up, lies as its PLY does. What is no road is refused by name.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "io/csv/truth_csv.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "lab/sim/survey_line.hpp"
#include "lab/sim/survey_truth.hpp"
#include "lab/survey/survey_file.hpp"
#include "ran_command.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::test {
namespace {

using sim::Hit;
using sim::Label;
using sim::Placement;
using sim::Ray;
using sim::Vector;

constexpr double kLong_m = 30.0, kHalf_m = 2.4, kHigh_m = 3.6;  // of a roadway; half its length and width

// Walls at y = +-kHalf_m, floor at 0, roof at kHigh_m; a rule may take rays past a wall.
class Box final : public sim::RockSurface {
 public:
  explicit Box(std::function<bool(const Vector&)> is_open = {}) : is_open_(std::move(is_open)) {}
  Hit trace(const Ray& ray, double t_max_m) const override {
    Hit best;
    const auto take = [&](int axis, double at, Label label) {
      const double t = (at - ray.origin[axis]) / ray.direction[axis];
      if (!(t > 0.0 && t < best.t_m && t <= t_max_m)) return;
      if (is_open_ && is_open_(ray.at(t))) return;
      best = {t, std::abs(ray.direction[axis]), label, 0};
    };
    take(1, kHalf_m, Label::kFace), take(1, -kHalf_m, Label::kFace);
    take(2, 0.0, Label::kFloor), take(2, kHigh_m, Label::kRoof);
    return best;
  }

 private:
  std::function<bool(const Vector&)> is_open_;
};

Placement turned(double x_m, double y_m, double z_m, double roll, double pitch, double yaw) {
  return {sim::rotation_z(yaw) * sim::rotation_y(pitch) * sim::rotation_x(roll), {x_m, y_m, z_m}};
}

void expect_truth_of_box(const TruthRow& row, const Placement& base, double within) {
  const Vector up = base.R_road_base.transpose() * Vector::UnitZ(), ahead = base.R_road_base.col(0);
  EXPECT_NEAR(row.value[0], std::atan2(up.y(), up.z()), within);
  EXPECT_NEAR(row.value[1], std::atan2(-up.x(), std::hypot(up.y(), up.z())), within);
  EXPECT_NEAR(row.value[2], -std::atan2(ahead.y(), ahead.x()), within);
  for (int k = 0; k < 4; ++k) {
    const double y_m = base.origin_road.y() + (k % 2 == 0 ? 2.0 : -2.0) * ahead.y();
    EXPECT_NEAR(row.value[static_cast<std::size_t>(3 + k)], k < 2 ? kHalf_m - y_m : kHalf_m + y_m, within) << k;
  }
}

TEST(SurveyTruth, OfABoxIsItsOwn) {
  for (const double yaw : {-0.2, 0.0, 0.15}) {
    for (const double roll : {-0.05, 0.04}) {
      const Placement base = turned(1.0, 0.3, 1.4, roll, 0.03, yaw);
      expect_truth_of_box(survey_truth(Box(), base, {}), base, 1e-6);
    }
  }
}

TEST(SurveyTruth, ACrosscutIsNoWallAndMovesNone) {
  const Box rock([](const Vector& p) { return p.y() > 0.0 && p.x() > 1.5 && p.z() > 0.0 && p.z() < kHigh_m; });
  const Placement base = turned(0.0, 0.1, 1.3, 0.01, -0.02, 0.05);
  expect_truth_of_box(survey_truth(rock, base, {}), base, 1e-6);
}

TEST(SurveyTruth, AWallThatIsMostlyOpenHasNone) {
  const Box rock([](const Vector& p) { return p.y() > 0.0 && p.x() > -1.0 && p.z() > 0.0 && p.z() < kHigh_m; });
  const TruthRow row = survey_truth(rock, turned(0.0, 0.0, 1.3, 0.0, 0.0, 0.0), {});
  EXPECT_TRUE(std::isnan(row.value[3]) && std::isnan(row.value[4]));
  EXPECT_NEAR(row.value[5], kHalf_m, 1e-6);
  EXPECT_NEAR(row.value[2], 0.0, 1e-6) << "yaw by the other wall";
}

TEST(SurveyTruth, NothingIsKnownWithoutAFloor) {
  const Box rock([](const Vector& p) { return p.z() < 0.01; });
  const TruthRow row = survey_truth(rock, turned(0.0, 0.0, 1.3, 0.0, 0.0, 0.0), {});
  for (const double value : row.value) EXPECT_TRUE(std::isnan(value));
}

TEST(Survey, BetweenTwoPosesItIsBetween) {
  const sim::Survey survey{nullptr, {turned(0, 0, 1, 0, 0, 0), turned(1, 0, 1, 0, 0, 0.2)}};
  EXPECT_NEAR(survey.at(0.25).origin_road.x(), 0.25, 1e-12);
  EXPECT_NEAR(std::atan2(survey.at(0.25).R_road_base(1, 0), survey.at(0.25).R_road_base(0, 0)), 0.05, 1e-9);
  EXPECT_EQ(survey.at(-3.0).origin_road.x(), 0.0);
  EXPECT_EQ(survey.at(7.0).origin_road.x(), 1.0);
}

TEST(SurveyLine, GoesAlongTheMiddleOfABoxToBothEnds) {
  const Box rock([](const Vector& p) { return std::abs(p.x()) > 20.0; });
  const auto path = sim::propose_path(rock, {-20.0, -kHalf_m, 0.0}, {20.0, kHalf_m, kHigh_m}, 1.0, 1.3);
  ASSERT_GT(path.size(), 30U);
  for (const Placement& p : path) {
    EXPECT_NEAR(p.origin_road.y(), 0.0, 0.1);
    EXPECT_NEAR(p.origin_road.z(), 1.3, 1e-9);
    EXPECT_NEAR(std::abs(p.R_road_base(0, 0)), 1.0, 0.01);
  }
  EXPECT_NEAR((path.front().origin_road - path.back().origin_road).norm(), static_cast<double>(path.size() - 1), 0.5);
}

// Between two circles, once round: it ends where it began.
class RingRoad final : public sim::RockSurface {
 public:
  Hit trace(const Ray& ray, double t_max_m) const override {
    Hit best;
    const double from_m = ray.origin.head<2>().norm();
    if (from_m < 17.5 || from_m > 22.5) return best;  // in the rock
    const auto take = [&](double t, Label label) {
      if (t > 1e-9 && t < best.t_m && t <= t_max_m) best = {t, 1.0, label, 0};
    };
    take(-ray.origin.z() / ray.direction.z(), Label::kFloor);
    take((kHigh_m - ray.origin.z()) / ray.direction.z(), Label::kRoof);
    for (const double radius_m : {17.5, 22.5}) {
      const double a = ray.direction.head<2>().squaredNorm(), b = ray.origin.head<2>().dot(ray.direction.head<2>());
      const double root = b * b - a * (ray.origin.head<2>().squaredNorm() - radius_m * radius_m);
      if (!(a > 0.0 && root > 0.0)) continue;
      for (const double sign : {-1.0, 1.0}) take((-b + sign * std::sqrt(root)) / a, Label::kFace);
    }
    return best;
  }
};

TEST(SurveyLine, FollowsABendAndEndsWhereItBegan) {
  const auto path = sim::propose_path(RingRoad(), {-22.0, -22.0, 0.0}, {22.0, 22.0, kHigh_m}, 1.0, 1.3);
  ASSERT_GT(path.size(), 115U);
  EXPECT_LT(path.size(), 135U) << "a circle of 20 m is 126 m long";
  for (const Placement& p : path) EXPECT_NEAR(p.origin_road.head<2>().norm(), 20.0, 0.3);
}

TEST(SurveyLine, NoRoadHasNone) {
  EXPECT_TRUE(sim::propose_path(Box([](const Vector&) { return true; }), {-5, -5, 0}, {5, 5, 3}, 1.0, 1.3).empty());
}

struct SurveyFiles : testing::Test {
  const TempFolder folder;

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder.file(name), std::ios::binary) << text;
    return folder.file(name);
  }
  std::string box_obj() {
    std::string text;
    for (const double x : {-kLong_m, kLong_m}) {
      for (const double y : {-kHalf_m, kHalf_m}) {
        for (const double z : {0.0, kHigh_m}) text += fmt::format("v {} {} {}\n", x, y, z);
      }
    }
    for (const char* face : {"1 5 7 3", "2 4 8 6", "1 2 6 5", "3 7 8 4"}) text += fmt::format("f {}\n", face);
    return write("box.obj", text);
  }
  std::string path_of(const std::vector<Placement>& path) { return write("path.tum", survey_path_text(path)); }
};

std::string refusal_of(const std::function<void()>& read) {
  return test::said_by<SurveyError>([&] { read(); });
}

TEST_F(SurveyFiles, APathThatIsNoneIsNamed) {
  EXPECT_NE(refusal_of([&] { read_survey_path(write("a", "# nothing\n")); }).find("no pose"), std::string::npos);
  EXPECT_NE(refusal_of([&] { read_survey_path(write("b", "0 1 2 3 4\n")); }).find("line 1"), std::string::npos);
}

#ifdef POSE_WALL_HAS_SURVEY

TEST_F(SurveyFiles, EveryValueInABoxIsValidAndTrue) {
  std::vector<Placement> path;
  for (int i = 0; i < 4; ++i) path.push_back(turned(0.2 * i, 0.2, 1.3, 0.02, -0.03, 0.04 * i - 0.06));
  const std::string road = folder.file("road");
  for (const char* sensor : {"vlp16", "os1-64"}) {
    ASSERT_EQ(command({"sim", "--surface", box_obj(), "--path", path_of(path), "--sensor", sensor, "-q", "-o", road})
                  .exit_status,
              0);
    const std::vector<TruthRow> truth = read_truth_csv(road + "/truth.csv");
    ASSERT_EQ(truth.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
      expect_truth_of_box(truth[i], path[i], 1e-4);
      const std::string out = folder.file("out.csv");
      ASSERT_EQ(
          command({"run", "-q", "-c", road + "/pose_wall.yaml", "-o", out, road + fmt::format("/frames/{:06}.pcd", i)})
              .exit_status,
          0);
      const CsvTable table = table_of(out);
      constexpr const char* kNames[] = {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"};
      for (std::size_t q = 0; q < kTruthQuantities; ++q) {
        EXPECT_EQ(table.cell(0, *table.find_column(std::string(kNames[q]) + "_state")), "valid")
            << sensor << ", " << kNames[q];
        EXPECT_NEAR(table.number(0, *table.find_column(std::string(kNames[q]) + "_raw")), truth[i].value[q], 0.004)
            << kNames[q];
      }
    }
  }
}

TEST_F(SurveyFiles, WithoutAPathItProposesOneThatCanBeGiven) {
  const std::string road = folder.file("road"), again = folder.file("again");
  ASSERT_EQ(command({"sim", "--surface", box_obj(), "--sensor", "vlp16", "-q", "-o", road}).exit_status, 0);
  const std::vector<TruthRow> truth = read_truth_csv(road + "/truth.csv");
  ASSERT_GT(truth.size(), 40U);
  EXPECT_EQ(read_survey_path(road + "/path.tum").size(), truth.size());
  ASSERT_EQ(command({"sim", "--surface", box_obj(), "--path", road + "/path.tum", "--sensor", "vlp16", "-q", "-n", "2",
                     "-o", again})
                .exit_status,
            0);
  EXPECT_NEAR(read_truth_csv(again + "/truth.csv")[1].value[3], truth[1].value[3], 1e-3);
}

TEST_F(SurveyFiles, LabelsTellFloorRoofAndWalls) {
  const SurveyRock rock = read_survey_rock(box_obj(), {});
  EXPECT_EQ(rock.about, "8 triangles");
  const sim::Simulator simulator(sim::make_setup("clean", "os1-64", false, 1), 1,
                                 {rock.rock, {turned(0.0, 0.0, 1.4, 0.0, 0.0, 0.0)}});
  const sim::Frame frame = simulator.render(0);
  ASSERT_GT(frame.count(), 50000U);
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const float y = frame.xyz_intensity[4 * i + 1], z = frame.xyz_intensity[4 * i + 2];
    const Label expected = frame.labels[i];
    const double off = expected == Label::kFloor      ? z + 1.4
                       : expected == Label::kRoof     ? z + 1.4 - kHigh_m
                       : expected == Label::kWallLeft ? y - kHalf_m
                                                      : y + kHalf_m;
    ASSERT_NEAR(off, 0.0, 0.08) << "point " << i << ", label " << static_cast<int>(expected);
  }
}

// Hills of 10 cm and 1.5 m, as a mesh of 2 cm and as the points of it that are 8 cm apart.
double height_of(double x, double y) {
  return 0.1 * std::sin(4.19 * x) * std::cos(3.1 * y);
}
Eigen::Vector3d normal_of(double x, double y) {
  return Eigen::Vector3d(-0.1 * 4.19 * std::cos(4.19 * x) * std::cos(3.1 * y),
                         0.1 * 3.1 * std::sin(4.19 * x) * std::sin(3.1 * y), 1.0)
      .normalized();
}

TEST_F(SurveyFiles, DiscsGiveTheRangesOfTheirMesh) {
  constexpr int kSteps = 300;  // of 2 cm: 3 m to each side
  constexpr double kMesh_m = 0.02, kCloud_m = 0.08;
  std::string mesh = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      (kSteps + 1) * (kSteps + 1), 2 * kSteps * kSteps);
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const double x = kMesh_m * i - 3.0, y = kMesh_m * j - 3.0;
      mesh += fmt::format("{:.5f} {:.5f} {:.6f}\n", x, y, height_of(x, y));
    }
  }
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const int a = i * (kSteps + 1) + j, b = a + kSteps + 1;
      mesh += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, b, a + 1, a + 1, b, b + 1);
    }
  }
  std::string points;
  int count = 0;
  for (double x = -3.0; x < 3.0; x += kCloud_m) {
    for (double y = -3.0; y < 3.0; y += kCloud_m, ++count) {
      const Eigen::Vector3d n = normal_of(x, y);
      points += fmt::format("{:.5f} {:.5f} {:.6f} {:.6f} {:.6f} {:.6f}\n", x, y, height_of(x, y), n.x(), n.y(), n.z());
    }
  }
  const std::string head = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "end_header\n",
      count);
  const SurveyRock of_mesh = read_survey_rock(write("hills.ply", mesh), {});
  const SurveyRock of_cloud = read_survey_rock(write("points.ply", head + points), {});
  EXPECT_EQ(of_cloud.about, fmt::format("{} discs of 0.160 m", count));
  std::vector<double> off;
  for (double azimuth = 0.0; azimuth < 6.28; azimuth += 0.05) {
    for (double down = 0.5; down < 1.5; down += 0.05) {
      const Ray ray{{0.0, 0.0, 1.4},
                    {std::cos(azimuth) * std::cos(down), std::sin(azimuth) * std::cos(down), -std::sin(down)}};
      const Hit mesh_hit = of_mesh.rock->trace(ray, 50.0), disc_hit = of_cloud.rock->trace(ray, 50.0);
      ASSERT_EQ(mesh_hit.label, Label::kFloor);
      ASSERT_EQ(disc_hit.label, Label::kFloor);
      off.push_back(std::abs(mesh_hit.t_m - disc_hit.t_m));
    }
  }
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], 0.002);
  EXPECT_LT(off[off.size() * 95 / 100], 0.003);
  std::printf("discs against their mesh: median %.2f mm, 95 %% %.2f mm, worst %.2f mm\n", 1e3 * off[off.size() / 2],
              1e3 * off[off.size() * 95 / 100], 1e3 * off.back());
}

// glTF 2.0, one triangle on the floor: y up, so z there is -y here.
TEST_F(SurveyFiles, AGltfIsTurnedUpright) {
  // (-50, 0, 50), (50, 0, 50), (0, 0, -50), and indices 0, 1, 2 of 16 bits.
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0,2,0]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("buffers":[{"byteLength":44,"uri":"data:application/octet-stream;base64,)"
      R"(AABIwgAAAAAAAEhCAABIQgAAAAAAAEhCAAAAAAAAAAAAAEjCAAABAAIAAAA="}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36,"target":34962},)"
      R"({"buffer":0,"byteOffset":36,"byteLength":6,"target":34963}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","max":[50,0,50],"min":[-50,0,-50]},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
  const SurveyRock rock = read_survey_rock(write("floor.gltf", gltf), {});
  const Hit hit = rock.rock->trace({{1.0, 2.0, 5.0}, {0.0, 0.0, -1.0}}, 50.0);
  EXPECT_EQ(hit.label, Label::kFloor);
  EXPECT_NEAR(hit.t_m, 3.0, 1e-4) << "2 m high";
  EXPECT_EQ(rock.rock->trace({{0.0, 55.0, 5.0}, {0.0, 0.0, -1.0}}, 50.0).label, Label::kNone);
}

TEST_F(SurveyFiles, WhatIsNoSurfaceIsRefusedByName) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const auto refused = [&](const std::string& name, const std::string& text) {
    const std::string file = write(name, text);
    const std::string why = refusal_of([&] { read_survey_rock(file, {}); });
    EXPECT_NE(why.find(name), std::string::npos) << why;
    return why;
  };
  EXPECT_NE(refused("bare.ply", head + "end_header\n1 2 3\n").find("normal"), std::string::npos);
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(refused("face.ply", head + faces + "0 0 0\n3 0 0 7\n").find("face.ply"), std::string::npos)
      << "a face that names a vertex which is not there";
  EXPECT_NE(refused("noise.obj", "this is no mesh\n").find("noise.obj"), std::string::npos);
  EXPECT_NE(refused("far.obj", "v 500000 4000000 200\nv 500001 4000000 200\nv 500000 4000001 200\nf 1 2 3\n")
                .find("Subtract an offset"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { read_survey_rock(folder.file("none.ply"), {}); }).find("no such file"), std::string::npos);
  EXPECT_NE(refusal_of([&] { read_survey_rock(box_obj(), 0.1); }).find("for clouds alone"), std::string::npos);
}

TEST_F(SurveyFiles, TheVerbRefusesWhatARealRoadHasOfItsOwn) {
  const std::string path = path_of({turned(0.0, 0.0, 1.3, 0.0, 0.0, 0.0)});
  const auto errors = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"-q", "-o", folder.file("road")});
    words.insert(words.begin(), "sim");
    const Ran ran = command(words);
    EXPECT_EQ(ran.exit_status, 2) << ran.errors;
    return ran.errors;
  };
  EXPECT_NE(errors({"--path", path}).find("--surface"), std::string::npos);
  EXPECT_NE(errors({"--surface", box_obj(), "--path", path, "--set", "width_m=4"}).find("width_m"), std::string::npos);
  EXPECT_NE(errors({"--surface", box_obj(), "--path", path, "--frames", "2"}).find("1 pose"), std::string::npos);
  EXPECT_NE(errors({"--surface", box_obj(), "--path", path, "--scene", "rough"}).find("--scene"), std::string::npos);
  EXPECT_NE(errors({"--surface", box_obj(), "--path", path, "--random"}).find("--random"), std::string::npos);
  const std::string far = path_of({turned(500.0, 0.0, 1.3, 0.0, 0.0, 0.0)});
  EXPECT_NE(errors({"--surface", box_obj(), "--path", far}).find("below it"), std::string::npos);
}

#else

TEST_F(SurveyFiles, ABuildWithoutTheLibrariesSaysWhichItNeeds) {
  EXPECT_NE(refusal_of([&] { read_survey_rock(box_obj(), {}); }).find("libembree-dev"), std::string::npos);
}

#endif

}  // namespace
}  // namespace pose_wall::tools::test
