// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: rays of the simulator's networks meet what trying all walls gives; networks have the planned length, hang
// together and are the same for the same seed; who comes back sees the same rock; scans and clouds agree with the rays.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lab/sim/network.hpp"
#include "lab/sim/network_people.hpp"
#include "lab/sim/network_scan.hpp"
#include "lab/sim/random.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools::sim::network_test {
namespace {

NetworkPlan plan_of(double length_m, std::uint64_t seed) {
  NetworkPlan plan;
  plan.length_m = length_m;
  if (seed % 2 == 1) plan.turn_rad = 0.4 * (static_cast<double>(seed % 9) - 4.0);
  if (seed % 3 == 0) {
    plan.prop_pitch_m = 2.5;
    plan.steel_pitch_m = 1.5;
  }
  return plan;
}

Place direction(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

// A place in the middle of some road, a little to the side.
Place somewhere(const Network& network, Random* random) {
  const std::vector<NetworkEdge>& edges = network.graph().edges;
  const NetworkEdge& edge = edges[static_cast<std::size_t>(random->uniform() * static_cast<double>(edges.size()))];
  const auto i = static_cast<std::size_t>(random->uniform() * static_cast<double>(edge.line.size()));
  return edge.line[i] + Place(random->uniform(-0.8, 0.8), random->uniform(-0.8, 0.8));
}

std::vector<WallSegment> square_room() {  // 4 m by 4 m about the origin, open inside
  const Place corner[4] = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  std::vector<WallSegment> walls;
  for (int k = 0; k < 4; ++k) walls.push_back({corner[k], corner[(k + 1) % 4]});
  return walls;
}

TEST(SimNetwork, RaysInARoomByHand) {
  const SegmentGrid room(square_room());
  EXPECT_DOUBLE_EQ(room.cast({0.5, 0}, {1, 0}, 9).range_m, 1.5);
  EXPECT_DOUBLE_EQ(room.cast({0.5, 0}, {-1, 0}, 9).range_m, 2.5);
  EXPECT_DOUBLE_EQ(room.cast({0.5, 0}, {-1, 0}, 9).cosine, 1.0);
  EXPECT_NEAR(room.cast({0, 0}, direction(M_PI / 4), 9).range_m, 2 * std::sqrt(2.0), 1e-9) << "into the corner";
  EXPECT_NEAR(room.cast({0, 0}, direction(0.3), 9).range_m, 2 / std::cos(0.3), 1e-12);
  EXPECT_NEAR(room.cast({0, 0}, direction(0.3), 9).cosine, std::cos(0.3), 1e-12);
  EXPECT_TRUE(std::isinf(room.cast({0, 0}, {1, 0}, 1.9).range_m));
  EXPECT_DOUBLE_EQ(room.cast({5, 0}, {-1, 0}, 9).range_m, std::numeric_limits<double>::infinity())
      << "from outside of the grid";
  EXPECT_LT(room.cast({2.5, 0}, {-1, 0}, 9).cosine, 0.0) << "from the rock";
  EXPECT_NEAR(room.distance_m({0.5, 1.2}, 3), 0.8, 1e-12);
  EXPECT_TRUE(std::isinf(room.distance_m({0, 0}, 1.9)));
  EXPECT_TRUE(std::isinf(SegmentGrid({}).cast({0, 0}, {1, 0}, 9).range_m));
}

TEST(SimNetwork, RaysMeetWhatTryingAllWallsGives) {
  for (const std::uint64_t seed : {1U, 3U, 6U}) {
    const Network network(plan_of(150, seed), seed);
    Random random(seed);
    for (int i = 0; i < 1500; ++i) {
      const Place from = somewhere(network, &random);
      // Every fourth along the grid's axes, or at 45 degrees.
      const double angle = i % 4 == 0 ? M_PI / 4 * std::floor(random.uniform(0, 8)) : random.uniform(-M_PI, M_PI);
      const double far_m = random.uniform(1, 60);
      const PlaneHit quick = network.cast(from, direction(angle), far_m);
      const PlaneHit slow = network.wall_grid().cast_slowly(from, direction(angle), far_m);
      ASSERT_EQ(quick.range_m, slow.range_m) << "seed " << seed << ", ray " << i;
      ASSERT_EQ(quick.cosine, slow.cosine);
    }
  }
}

TEST(SimNetwork, HasThePlannedLengthAndHangsTogether) {
  std::size_t threes = 0, fours = 0, loops = 0, ends = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const double planned_m = seed % 5 == 0 ? 100 : (seed % 7 == 0 ? 3000 : 500);
    const NetworkGraph graph = draw_network(plan_of(planned_m, seed), seed);
    double length_m = 0.0;
    for (const NetworkEdge& edge : graph.edges) {
      double line_m = 0.0;
      for (std::size_t i = 1; i < edge.line.size(); ++i) line_m += (edge.line[i] - edge.line[i - 1]).norm();
      EXPECT_NEAR(line_m, edge.length_m, 0.05);
      EXPECT_EQ(edge.line.front(), graph.nodes[edge.from].at);
      EXPECT_EQ(edge.line.back(), graph.nodes[edge.to].at);
      EXPECT_EQ(edge.line.size(), edge.half_width_m.size());
      length_m += edge.length_m;
    }
    EXPECT_NEAR(graph.length_m, length_m, 1e-9);
    EXPECT_NEAR(graph.length_m, planned_m, std::max(30.0, 0.12 * planned_m)) << "seed " << seed;
    for (std::uint32_t node = 1; node < graph.nodes.size(); ++node) {
      ASSERT_FALSE(graph.route(0, node).legs.empty()) << "seed " << seed << ", node " << node;
    }
    threes += graph.count_nodes(3);
    fours += graph.count_nodes(4);
    ends += graph.count_nodes(1);
    loops += graph.edges.size() + 1 - graph.nodes.size();
  }
  EXPECT_GT(threes, 300U);
  EXPECT_GT(fours, 30U);
  EXPECT_GT(ends, 200U);
  EXPECT_GT(loops, 200U);
}

// An opening that the graph does not know would make a closed loop look wrong.
TEST(SimNetwork, RoadsMeetAtTheirNodesOnly) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    NetworkPlan plan = plan_of(400, seed);
    plan.bend_m = 3.0 * static_cast<double>(seed % 5);
    const NetworkGraph graph = draw_network(plan, seed);
    for (const NetworkEdge& a : graph.edges) {
      for (const NetworkEdge& b : graph.edges) {
        const bool is_joined = a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
        if (is_joined || (a.road >= 0 && a.road == b.road)) continue;
        for (std::size_t i = 0; i < a.line.size(); ++i) {
          for (std::size_t k = 0; k < b.line.size(); ++k) {
            ASSERT_GT((a.line[i] - b.line[k]).norm() - a.half_width_m[i] - b.half_width_m[k], 1.0) << "seed " << seed;
          }
        }
      }
    }
  }
}

TEST(SimNetwork, RefusesPlansOutsideTheirLimits) {
  const auto refused = [](auto change) {
    NetworkPlan plan;
    change(&plan);
    EXPECT_THROW(draw_network(plan, 1), std::invalid_argument);
  };
  refused([](NetworkPlan* plan) { plan->length_m = 10; });
  refused([](NetworkPlan* plan) { plan->length_m = std::nan(""); });
  refused([](NetworkPlan* plan) { plan->roads = 7; });
  refused([](NetworkPlan* plan) { plan->spacing_m = 5; });
  refused([](NetworkPlan* plan) { plan->width_max_m = 3; });
  refused([](NetworkPlan* plan) { plan->roughness_m = 2; });
}

TEST(SimNetwork, TheOutlineOfTheRockIsClosed) {
  for (const std::uint64_t seed : {2U, 5U, 9U}) {
    const Network network(plan_of(300, seed), seed);
    std::map<std::pair<double, double>, int> ends;
    for (const WallSegment& wall : network.walls()) {
      ++ends[{wall.a.x(), wall.a.y()}];
      --ends[{wall.b.x(), wall.b.y()}];
      EXPECT_LT((wall.b - wall.a).norm(), wall.kind == WallKind::kRock ? 0.2 : 0.8);
    }
    for (const auto& [place, count] : ends) ASSERT_EQ(count, 0) << place.first << " " << place.second;
  }
}

TEST(SimNetwork, OpenIsWhatTheWallsEnclose) {
  const std::uint64_t seed = 6;
  const Network network(plan_of(200, seed), seed);
  Random random(seed);
  std::size_t open = 0;
  for (int i = 0; i < 600; ++i) {
    const Place p = somewhere(network, &random) + Place(random.uniform(-6, 6), random.uniform(-6, 6));
    // The winding of rock and of things about the place: once about an open one.
    double rock_rad = 0.0, things_rad = 0.0;
    for (const WallSegment& wall : network.walls()) {
      const Place a = wall.a - p, b = wall.b - p;
      (wall.kind == WallKind::kRock ? rock_rad : things_rad) += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    const bool is_open = rock_rad > M_PI && things_rad > -M_PI;
    ASSERT_EQ(network.is_open(p), is_open) << p.transpose();
    open += is_open ? 1U : 0U;
  }
  EXPECT_GT(open, 150U);
  EXPECT_LT(open, 450U);
}

TEST(SimNetwork, RoadsAreOpenAlongTheirMiddles) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Network network(plan_of(400, seed), seed);
    for (const NetworkEdge& edge : network.graph().edges) {
      for (std::size_t i = 4; i + 4 < edge.line.size(); ++i) {
        ASSERT_TRUE(network.is_open(edge.line[i])) << "seed " << seed;
        const double clear_m = network.clearance_m(edge.line[i], 5.0);
        EXPECT_GT(clear_m, edge.half_width_m[i] - 1.2);
      }
    }
  }
}

TEST(SimNetwork, TheSameSeedGivesTheSameBits) {
  const auto bits = [](std::uint64_t seed) {
    const Network network(plan_of(300, 6), seed);
    std::vector<double> numbers;
    for (const WallSegment& wall : network.walls()) {
      numbers.insert(numbers.end(), {wall.a.x(), wall.a.y(), wall.b.x(), wall.b.y()});
    }
    return numbers;
  };
  const std::vector<double> first = bits(17);
  EXPECT_EQ(first, bits(17));
  EXPECT_NE(first, bits(18));
}

TEST(SimNetwork, WhoComesBackSeesTheSameRock) {
  const std::uint64_t seed = 4;
  const Network network(plan_of(300, seed), seed);
  Random random(seed);
  int seen_again = 0;
  for (int i = 0; i < 400; ++i) {
    const Place first = somewhere(network, &random);
    const PlaneHit hit = network.cast(first, direction(random.uniform(-M_PI, M_PI)), 20);
    if (!std::isfinite(hit.range_m)) continue;
    const WallSegment& wall = network.walls()[hit.segment];
    const Place rock = 0.5 * (wall.a + wall.b);
    const Place second = first + Place(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
    const PlaneHit again = network.cast(second, (rock - second).normalized(), 30);
    if (again.segment != hit.segment) continue;  // something stands between
    ++seen_again;
    EXPECT_NEAR(again.range_m, (rock - second).norm(), 1e-9);
  }
  EXPECT_GT(seen_again, 250);
}

TEST(SimNetwork, NoiseOfThePlaneHasItsMoments) {
  const PlaneNoise noise(3, 2.0);
  Random random(5);
  double sum = 0, squares = 0, near = 0, far = 0;
  const int count = 40000;
  for (int i = 0; i < count; ++i) {
    const Place p(random.uniform(-400, 400), random.uniform(-400, 400));
    const double value = noise.at(p);
    sum += value;
    squares += value * value;
    near += value * noise.at(p + Place(0.2, 0));
    far += value * noise.at(p + Place(4.5, 0));
  }
  EXPECT_NEAR(sum / count, 0.0, 0.03);
  EXPECT_NEAR(squares / count, 1.0, 0.04);
  EXPECT_GT(near / count, 0.9);
  EXPECT_NEAR(far / count, 0.0, 0.03);
}

TEST(SimNetwork, ParallelRoadsOfOneMouldLookAlike) {
  NetworkPlan plan;
  plan.length_m = 400;
  plan.roads = 2;
  plan.dead_ends_m = 0;
  plan.twin_rock = true;
  plan.crosscut_m = 120;
  const auto difference = [&plan](double spacing_m) {
    plan.spacing_m = spacing_m;
    const Network network(plan, 8);
    const RoadMould mould(plan, 8);
    PlanarSensor sensor;
    std::vector<float> first(360), second(360);
    double sum = 0.0;
    int beams = 0;
    for (double along_m = 30; along_m < 100; along_m += 5) {
      const Place a = mould.bent({along_m, 0}), b = mould.bent({along_m, spacing_m});
      true_scan(network, sensor, {a.x(), a.y(), 0}, first.data());
      true_scan(network, sensor, {b.x(), b.y(), 0}, second.data());
      for (std::size_t i = 0; i < 360; ++i) {
        if (!(first[i] < 8.0F && second[i] < 8.0F)) continue;
        sum += std::abs(static_cast<double>(first[i] - second[i]));
        ++beams;
      }
    }
    return sum / beams;
  };
  const double twins_m = difference(30.0);  // whole cells of the walls' grid
  plan.twin_rock = false;
  plan.alike = true;
  const double alike_m = difference(30.0);
  EXPECT_LT(twins_m, 0.01);
  EXPECT_GT(alike_m, 0.05);
  EXPECT_FALSE(Network(plan, 8).graph().alike_pairs().empty());
}

TEST(SimNetwork, AlikePairsAreAlike) {
  NetworkPlan plan = plan_of(600, 2);
  plan.alike = true;
  const NetworkGraph graph = draw_network(plan, 2);
  const std::vector<AlikePair> pairs = graph.alike_pairs(20.0);
  ASSERT_FALSE(pairs.empty());
  for (const AlikePair& pair : pairs) {
    EXPECT_NE(pair.first, pair.second);
    EXPECT_GE(pair.length_m, 20.0);
    EXPECT_LE(pair.length_m, std::min(graph.edges[pair.first].length_m, graph.edges[pair.second].length_m) + 1.0);
  }
}

TEST(SimNetwork, RoutesFollowTheEdges) {
  const NetworkGraph graph = draw_network(plan_of(500, 2), 2);
  const auto last = static_cast<std::uint32_t>(graph.nodes.size() - 1);
  const Route route = graph.route(0, last);
  ASSERT_EQ(route.legs.size(), 1U);
  double edges_m = 0.0;
  for (std::size_t i = 1; i < route.nodes.size(); ++i) {
    double best_m = std::numeric_limits<double>::infinity();
    for (const NetworkEdge& edge : graph.edges) {
      const bool joins = (edge.from == route.nodes[i] && edge.to == route.nodes[i - 1]) ||
                         (edge.to == route.nodes[i] && edge.from == route.nodes[i - 1]);
      if (joins) best_m = std::min(best_m, edge.length_m);
    }
    edges_m += best_m;
  }
  EXPECT_LT(route.length_m, edges_m) << "corners are cut, and it stops before a face";
  EXPECT_GT(route.length_m, edges_m - 8.0 - 2.0 * static_cast<double>(route.nodes.size()));
  for (std::size_t i = 1; i < route.legs[0].line.size(); ++i) {
    EXPECT_LT((route.legs[0].line[i] - route.legs[0].line[i - 1]).norm(), 0.26);
  }
  EXPECT_TRUE(graph.route(3, 3).legs.empty());
  EXPECT_THROW(graph.route_through({0, last}), std::invalid_argument);
}

TEST(SimNetwork, ATourGoesEverywhereInTime) {
  const NetworkGraph graph = draw_network(plan_of(500, 4), 4);
  const Route tour = graph.tour(0, 1500, 4);
  EXPECT_GT(tour.length_m, 1350.0) << "corners and turning places make it shorter than its edges";
  EXPECT_EQ(std::set<std::uint32_t>(tour.nodes.begin(), tour.nodes.end()).size(), graph.nodes.size());
}

TEST(SimNetwork, ScansHaveTheirNoise) {
  const Network network(plan_of(200, 3), 3);
  PlanarSensor sensor;
  sensor.noise_m = 0.03;
  sensor.dropout = 0.05;
  sensor.grazing_deg = 0.0;
  sensor.range_max_m = 12.0;
  Random random(1);
  double sum = 0, squares = 0;
  std::size_t finite = 0, unknown = 0, nothing = 0, beams = 0;
  std::vector<float> measured(360), truth(360), again(360);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Place p = somewhere(network, &random);
    if (!network.is_open(p)) continue;
    const PlanePose at{p.x(), p.y(), random.uniform(-3, 3)};
    planar_scan(network, sensor, at, i, measured.data());
    planar_scan(network, sensor, at, i, again.data());
    EXPECT_EQ(std::memcmp(measured.data(), again.data(), 360 * sizeof(float)), 0);
    true_scan(network, sensor, at, truth.data());
    for (std::size_t k = 0; k < 360; ++k) {
      ++beams;
      if (std::isnan(measured[k])) {
        ++unknown;
      } else if (std::isinf(measured[k])) {
        ++nothing;
        EXPECT_TRUE(std::isinf(truth[k]));
      } else {
        ++finite;
        const auto error = static_cast<double>(measured[k] - truth[k]);
        sum += error;
        squares += error * error;
        EXPECT_LE(measured[k], 12.0F);
      }
    }
  }
  const auto count = static_cast<double>(finite);
  EXPECT_NEAR(sum / count, 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / count), 0.03, 0.001);
  EXPECT_NEAR(static_cast<double>(unknown) / static_cast<double>(beams), 0.05, 0.01);
  EXPECT_GT(nothing, 100U);
}

TEST(SimNetwork, AnglesOfAScan) {
  const Network network(plan_of(200, 2), 2);
  PlanarSensor sensor;
  sensor.beams = 181;
  sensor.field_deg = 180;
  EXPECT_NEAR(sensor.angle_step_rad(), M_PI / 180, 1e-15);
  const Place p = network.graph().edges[0].line[5];
  std::vector<float> scan(181);
  true_scan(network, sensor, {p.x(), p.y(), 0.4}, scan.data());
  EXPECT_EQ(scan[90], static_cast<float>(network.cast(p, direction(0.4), 30).range_m)) << "ahead";
  EXPECT_EQ(scan[180], static_cast<float>(network.cast(p, direction(0.4 + M_PI / 2), 30).range_m)) << "to the left";
}

TEST(SimNetwork, CloudsAgreeWithTheRays) {
  NetworkPlan plan = plan_of(200, 3);
  const Network network(plan, 3);
  Sensor sensor = find_sensor("os1-64")->sensor;
  sensor.range_noise_m = 0.0;
  StandingPose pose;
  const Place p = network.graph().edges[1].line[6];
  pose.at = {p.x(), p.y(), 0.7};
  pose.pitch_rad = 0.05;
  pose.roll_rad = -0.03;
  const Frame frame = network_cloud(network, sensor, pose, 0, 1);
  ASSERT_GT(frame.count(), 40000U);
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(-0.03, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  std::size_t walls = 0, floors = 0, roofs = 0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const Eigen::Vector3d in_lidar = Eigen::Map<const Eigen::Vector3f>(&frame.xyz_intensity[4 * i]).cast<double>();
    const Eigen::Vector3d at = R * in_lidar + Eigen::Vector3d(p.x(), p.y(), pose.height_m);
    if (frame.labels[i] == Label::kFloor) {
      ++floors;
      EXPECT_LE(std::abs(at.z()), network.floor().relief.reach_m() + 1e-3);
    } else if (frame.labels[i] == Label::kRoof) {
      ++roofs;
      EXPECT_LE(std::abs(at.z() - plan.height_m), network.roof().relief.reach_m() + 1e-3);
    } else {
      ++walls;
      const Place across = at.head<2>() - p;
      EXPECT_NEAR(network.cast(p, across.normalized(), 100).range_m, across.norm(), 0.002 * across.norm() + 1e-3);
    }
  }
  EXPECT_GT(walls, 10000U);
  EXPECT_GT(floors, 5000U);
  EXPECT_GT(roofs, 3000U);
}

TEST(SimNetwork, PillarsAndDarkWallsInClouds) {
  NetworkPlan plan = plan_of(200, 3);
  plan.prop_pitch_m = 0.0;  // props have the label of pillars
  const Network network(plan, 3);
  Sensor sensor = find_sensor("os1-64")->sensor;
  sensor.range_noise_m = 0.0;
  StandingPose pose;
  const Place p = network.graph().edges[1].line[6], q = network.graph().edges[1].line[8];
  pose.at = {p.x(), p.y(), 0.0};
  const Frame bare = network_cloud(network, sensor, pose, 0, 1);
  CloudScene scene;
  scene.pillars.push_back({q, 0.25, 1.75});
  const Frame with_pillar = network_cloud(network, sensor, pose, 0, 1, scene);
  std::size_t on_pillar = 0;
  for (std::size_t i = 0; i < with_pillar.count(); ++i) {
    if (with_pillar.labels[i] != Label::kObject) continue;
    ++on_pillar;
    const float* const at = &with_pillar.xyz_intensity[4 * i];
    EXPECT_NEAR((Place(static_cast<double>(at[0]), static_cast<double>(at[1])) + p - q).norm(), 0.25, 1e-4);
    EXPECT_LT(static_cast<double>(at[2]) + pose.height_m, 1.75 + 1e-4);
  }
  EXPECT_GT(on_pillar, 100U);
  CloudScene dark;
  dark.dark_at = p;
  dark.dark_radius_m = 6.0;
  EXPECT_LT(network_cloud(network, sensor, pose, 0, 1, dark).count(), bare.count() * 3 / 4);
  CloudScene lossy;
  lossy.dropout = 0.5;
  const double left = static_cast<double>(network_cloud(network, sensor, pose, 0, 1, lossy).count());
  EXPECT_NEAR(left / static_cast<double>(bare.count()), 0.5, 0.02);
  lossy.dropout = 1.0;
  EXPECT_EQ(network_cloud(network, sensor, pose, 0, 1, lossy).count(), 0U);
}

TEST(SimNetwork, PeopleStepInWaitAndKeepOff) {
  const Network network(plan_of(200, 3), 3);
  const std::vector<Place>& way = network.graph().edges[1].line;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Person> people = draw_people(network, way, 2, 4.0, false, seed);
    ASSERT_EQ(people.size(), 2U);
    Footprint machine{{way[0].x(), way[0].y(), 0.0}, 2.1, 2.4, 0.6};
    for (Person& person : people) {
      EXPECT_TRUE(network.is_open(person.at()));
      const Place before = person.at();
      machine.at = {before.x() + 20.0, before.y(), 0.0};
      person.step(machine, 0.1);
      EXPECT_EQ((person.at() - before).norm(), 0.0) << "nobody is near";
      machine.at = {before.x() + 4.5, before.y(), 0.0};
      for (int k = 0; k < 600; ++k) {
        const Place last = person.at();
        person.step(machine, 0.1);
        EXPECT_LE((person.at() - last).norm(), 0.1 * kWalkMost_mps + 1e-9);
        EXPECT_GE(machine.distance_m(person.at()), person.pillar().radius_m);
      }
    }
  }
}

TEST(SimNetwork, LossesAreDrawnOnTheWay) {
  const Network network(plan_of(200, 3), 3);
  bool is_drawn[3] = {};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Loss loss = draw_loss(network, network.graph().edges[1].line, seed);
    is_drawn[static_cast<int>(loss.kind)] = true;
    EXPECT_EQ(loss.radius_m > 0.0, loss.kind == LossKind::kDarkWall);
    EXPECT_EQ(loss.share > 0.0, loss.kind != LossKind::kDarkWall);
    EXPECT_GT(loss.lasts_s, 1.0);
    EXPECT_LT(loss.from_m, network.graph().edges[1].length_m);
  }
  EXPECT_TRUE(is_drawn[0] && is_drawn[1] && is_drawn[2]);
}

}  // namespace
}  // namespace pose_wall::tools::sim::network_test
