// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/slam/pose_graph.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/math/random.hpp"

namespace {

using namespace pose_wall;
using namespace pose_wall::planar;

class Graph {
 public:
  explicit Graph(std::uint32_t poses_most) {
    Arena measure(nullptr);
    PoseGraph().lay_out(measure, poses_most);
    block_.assign(measure.bytes() + 64, 0xA5);
    const auto at = reinterpret_cast<std::uintptr_t>(block_.data());
    Arena arena(block_.data() + (64 - at % 64) % 64);
    graph_.lay_out(arena, poses_most);
  }
  double settle(std::vector<Pose2>* poses, const std::vector<Edge>& edges) const {
    double moved_m = 1.0;
    for (int round = 0; round < 12 && moved_m > 1e-9; ++round) {
      moved_m = graph_
                    .improve(Span<Pose2>(poses->data(), static_cast<std::uint32_t>(poses->size())),
                             Span<const Edge>(edges.data(), static_cast<std::uint32_t>(edges.size())))
                    .moved_m;
    }
    return moved_m;
  }

 private:
  std::vector<unsigned char> block_;
  PoseGraph graph_;
};

Edge edge_of(std::uint32_t from, std::uint32_t to, const Pose2& step, double weight = 100.0) {
  Edge edge;
  edge.from = from;
  edge.to = to;
  edge.step = step;
  edge.information = weight * Eigen::Matrix3d::Identity();
  edge.is_closure = to != from + 1;
  return edge;
}

// A square driven once around, with a drift in each step.
struct Square {
  std::vector<Pose2> truth, poses;
  std::vector<Edge> edges;

  explicit Square(std::uint32_t side) {
    truth.push_back({});
    poses.push_back({});
    for (std::uint32_t k = 0; k < 4 * side; ++k) {
      const Pose2 step{1.0, 0.0, (k + 1) % side == 0 ? kPi / 2.0 : 0.0};
      const Pose2 measured{1.02, 0.01, step.yaw_rad + 0.01};
      truth.push_back(compose(truth.back(), step));
      poses.push_back(compose(poses.back(), measured));
      edges.push_back(edge_of(k, k + 1, measured));
    }
  }
};

TEST(PoseGraph, WithoutClosuresPosesStayAsTheChainSays) {
  Square square(10);
  const std::vector<Pose2> before = square.poses;
  Graph(64).settle(&square.poses, square.edges);
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(square.poses[k].x_m, before[k].x_m, 1e-6) << k;
}

TEST(PoseGraph, AClosureSharesTheDriftOutOverTheLoop) {
  Square square(10);
  const std::uint32_t last = static_cast<std::uint32_t>(square.poses.size() - 1);
  const Pose2 open = between(square.truth[last], square.poses[last]);
  ASSERT_GT(open.place().norm(), 1.0);
  square.edges.push_back(edge_of(0, last, square.truth[last], 1e4));
  EXPECT_LT(Graph(64).settle(&square.poses, square.edges), 1e-6);
  EXPECT_LT((square.poses[last].place() - square.truth[last].place()).norm(), 0.05);
  for (std::size_t k = 0; k < square.poses.size(); ++k) {
    EXPECT_LT((square.poses[k].place() - square.truth[k].place()).norm(), 0.6) << k;
  }
}

// Gauss and Newton on the whole, by a dense matrix: the same minimum.
TEST(PoseGraph, TheResultIsAMinimumOfTheSumOfSquares) {
  Random random(5);
  const auto noise = [&](double size) { return size * (static_cast<double>(random.below(2001)) / 1000.0 - 1.0); };
  std::vector<Pose2> truth{{}}, poses{{}};
  std::vector<Edge> edges;
  for (std::uint32_t k = 0; k < 40; ++k) {
    const Pose2 step{1.0, noise(0.2), noise(0.5)};
    const Pose2 measured{step.x_m + noise(0.05), step.y_m + noise(0.05), step.yaw_rad + noise(0.02)};
    truth.push_back(compose(truth.back(), step));
    poses.push_back(compose(poses.back(), measured));
    edges.push_back(edge_of(k, k + 1, measured));
  }
  for (std::uint32_t k = 0; k < 10; ++k) {
    const std::uint32_t from = random.below(20), to = 22 + random.below(18);
    const Pose2 step = between(truth[from], truth[to]);
    edges.push_back(edge_of(from, to, {step.x_m + noise(0.02), step.y_m + noise(0.02), step.yaw_rad + noise(0.01)}));
  }
  Graph(64).settle(&poses, edges);
  const auto cost = [&](const std::vector<Pose2>& at) {
    double sum = 0.0;
    for (const Edge& edge : edges) {
      const Eigen::Vector3d error = error_of(edge, at[edge.from], at[edge.to]);
      sum += error.dot(edge.information * error);
    }
    return sum;
  };
  const double least = cost(poses);
  for (std::size_t k = 1; k < poses.size(); ++k) {
    for (int member = 0; member < 3; ++member) {
      for (const double shift : {-1e-3, 1e-3}) {
        std::vector<Pose2> moved = poses;
        (member == 0 ? moved[k].x_m : member == 1 ? moved[k].y_m : moved[k].yaw_rad) += shift;
        EXPECT_GT(cost(moved), least) << k << " " << member;
      }
    }
  }
}

TEST(PoseGraph, AClosureTakenBackPullsNoMore) {
  Square square(10);
  const std::uint32_t last = static_cast<std::uint32_t>(square.poses.size() - 1);
  const std::vector<Pose2> before = square.poses;
  square.edges.push_back(edge_of(0, last, {30.0, 30.0, 1.0}, 0.0));
  Graph(64).settle(&square.poses, square.edges);
  EXPECT_NEAR(square.poses[last].x_m, before[last].x_m, 1e-6);
}

}  // namespace
