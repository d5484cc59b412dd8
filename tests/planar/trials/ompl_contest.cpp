// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The planner beside three of OMPL on drawn grids, BIT*, RRT*, and RRT-Connect with shortening: same footprint, same
// sweeps, same cost. A motion of OMPL turns on the spot, drives straight forwards or backwards, and turns on the spot:
// chains of these come as near to any way of the machine as one likes. Usage: ompl_contest [first seed] [seeds]
// [seconds of processor time for each of the three]

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "trial_task.hpp"

namespace ob = ompl::base;
namespace og = ompl::geometric;
using pose_wall::planar::Pose2;
using pose_wall::planar::wrapped;

namespace {

constexpr double kTurn_m_rad = 0.5;

Pose2 pose_of(const ob::State* state) {
  const auto* s = state->as<ob::SE2StateSpace::StateType>();
  return {s->getX(), s->getY(), s->getYaw()};
}

struct Motion {
  double first_rad, along_m, last_rad, yaw_rad, cost_m;
};

Motion motion(const Pose2& a, const Pose2& b) {
  Motion best{};
  best.cost_m = 1e9;
  for (const int gear : {1, -1}) {
    const double yaw = pose_wall::planar::route::driving_yaw(a.place(), b.place(), gear, a.yaw_rad);
    const double length = (b.place() - a.place()).norm();
    const double first = wrapped(yaw - a.yaw_rad), last = wrapped(b.yaw_rad - yaw);
    const double cost = length + kTurn_m_rad * (std::abs(first) + std::abs(last));
    if (cost < best.cost_m) best = {first, gear * length, last, yaw, cost};
  }
  return best;
}

// Poses between two lie on the motion.
class TurnDriveSpace : public ob::SE2StateSpace {
 public:
  TurnDriveSpace() { setSubspaceWeight(1, kTurn_m_rad); }
  void interpolate(const ob::State* from, const ob::State* to, double t, ob::State* out) const override {
    const Pose2 a = pose_of(from), b = pose_of(to);
    const Motion m = motion(a, b);
    double cost = t * m.cost_m;
    const double first = kTurn_m_rad * std::abs(m.first_rad), along = std::abs(m.along_m);
    Pose2 at = a;
    if (cost < first) {
      at.yaw_rad += m.first_rad * cost / first;
    } else if (cost < first + along) {
      const double part = (cost - first) / along;
      at = {a.x_m + part * (b.x_m - a.x_m), a.y_m + part * (b.y_m - a.y_m), m.yaw_rad};
    } else {
      const double last = kTurn_m_rad * std::abs(m.last_rad);
      const double part = last > 1e-9 ? (cost - first - along) / last : 1.0;
      at = {b.x_m, b.y_m, m.yaw_rad + part * m.last_rad};
    }
    auto* s = out->as<StateType>();
    s->setXY(at.x_m, at.y_m);
    s->setYaw(wrapped(at.yaw_rad));
  }
};

class Validator : public ob::MotionValidator {
 public:
  Validator(const ob::SpaceInformationPtr& si, pose_wall::planar::route::Sweeps* sweeps)
      : ob::MotionValidator(si), sweeps_(sweeps) {}
  bool checkMotion(const ob::State* s1, const ob::State* s2) const override {
    const Pose2 a = pose_of(s1), b = pose_of(s2);
    const Motion m = motion(a, b);
    return sweeps_->is_straight_free({a.x_m, a.y_m, m.yaw_rad}, m.along_m) && sweeps_->is_turn_free(a, m.first_rad) &&
           sweeps_->is_turn_free({b.x_m, b.y_m, m.yaw_rad}, m.last_rad);
  }
  bool checkMotion(const ob::State* s1, const ob::State* s2, std::pair<ob::State*, double>& last) const override {
    last.second = 0.0;
    return checkMotion(s1, s2);
  }

 private:
  pose_wall::planar::route::Sweeps* sweeps_;
};

class Cost : public ob::OptimizationObjective {
 public:
  // Without the cost that is left, BIT* holds the way from the start to a sample for the whole way. It then draws only
  // samples that lie farther from the start than the goal does.
  Cost(const ob::SpaceInformationPtr& si, const ob::State* goal) : ob::OptimizationObjective(si) {
    setCostToGoHeuristic([this, goal](const ob::State* s, const ob::Goal*) { return motionCostHeuristic(s, goal); });
  }
  ob::Cost stateCost(const ob::State*) const override { return ob::Cost(0.0); }
  ob::Cost motionCost(const ob::State* a, const ob::State* b) const override {
    return ob::Cost(motion(pose_of(a), pose_of(b)).cost_m);
  }
  ob::Cost motionCostHeuristic(const ob::State* a, const ob::State* b) const override {
    const Pose2 p = pose_of(a), q = pose_of(b);
    return ob::Cost((p.place() - q.place()).norm() + kTurn_m_rad * std::abs(wrapped(p.yaw_rad - q.yaw_rad)));
  }
};

// Of the process: other work on the machine, and planners of two threads, count alike.
double cpu_s(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

ob::PlannerTerminationCondition after_processor_time(double seconds) {
  const double end_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID) + seconds;
  return ob::PlannerTerminationCondition([end_s] { return cpu_s(CLOCK_PROCESS_CPUTIME_ID) >= end_s; });
}

struct Won {
  double cost_m = std::nan(""), length_m = std::nan("");
};

Won run_ompl(const pose_wall::test::DrawnGrid& grid, pose_wall::planar::route::Sweeps* sweeps,
             const pose_wall_planar_pose& start, const pose_wall_planar_pose& goal, double seconds, int which) {
  const auto space = std::make_shared<TurnDriveSpace>();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0.0);
  bounds.setHigh(grid.width * grid.resolution_m);
  space->setBounds(bounds);
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker([sweeps](const ob::State* s) { return sweeps->is_pose_free(pose_of(s)); });
  si->setMotionValidator(std::make_shared<Validator>(si, sweeps));
  si->setup();
  ob::ScopedState<ob::SE2StateSpace> from(space), to(space);
  from->setXY(start.x_m, start.y_m);
  from->setYaw(start.yaw_rad);
  to->setXY(goal.x_m, goal.y_m);
  to->setYaw(goal.yaw_rad);
  const auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(from, to, 1e-6);
  problem->setOptimizationObjective(std::make_shared<Cost>(si, to.get()));
  ob::PlannerPtr planner;
  if (which == 0) {
    planner = std::make_shared<og::BITstar>(si);
  } else if (which == 1) {
    const auto rrt = std::make_shared<og::RRTstar>(si);
    rrt->setRange(8.0);
    rrt->setInformedSampling(false);
    planner = rrt;
  } else {
    planner = og::AnytimePathShortening::createPlanner<og::RRTConnect>(si, 1);
  }
  planner->setProblemDefinition(problem);
  planner->setup();
  planner->solve(after_processor_time(0.9 * seconds));
  Won won;
  if (!problem->hasExactSolution()) return won;
  auto* path = problem->getSolutionPath()->as<og::PathGeometric>();
  og::PathSimplifier simplifier(si, problem->getGoal(), problem->getOptimizationObjective());
  const ob::PlannerTerminationCondition end = after_processor_time(0.1 * seconds);
  while (!end) simplifier.simplify(*path, end);
  won = {0.0, 0.0};
  for (std::size_t k = 1; k < path->getStateCount(); ++k) {
    const Motion m = motion(pose_of(path->getState(k - 1)), pose_of(path->getState(k)));
    won.cost_m += m.cost_m;
    won.length_m += std::abs(m.along_m);
  }
  return won;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int k, int otherwise) {
    return static_cast<std::uint32_t>(argc > k ? std::atoi(argv[k]) : otherwise);
  };
  const std::uint32_t first = number(1, 0), seeds = number(2, 24);
  const double seconds = number(3, 60);
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(1);
  pose_wall_planar_plan_settings settings;
  (void)pose_wall_planar_plan_settings_init(&settings);
  settings.turn_cost_m_rad = kTurn_m_rad;
  settings.reverse_cost = 1.0;
  settings.cusp_cost_m = 0.0;
  pose_wall::test::TrialPlanner planner(settings);
  std::printf(
      "seed,outcome,ms,cost,length,bound,bit_cost,rrt_cost,shortened_cost,best_cost,best_length,cost_ratio,length_"
      "ratio\n");
  for (std::uint32_t seed = first; seed < first + seeds; ++seed) {
    const pose_wall::test::DrawnGrid grid = pose_wall::test::drawn_grid(seed);
    pose_wall_planar_pose start, goal;
    if (!pose_wall::test::draw_ends(grid, settings, seed, &start, &goal)) continue;
    const double begin_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    const pose_wall_planar_plan_result ours = planner.plan(grid, start, goal);
    const double ms = 1e3 * (cpu_s(CLOCK_THREAD_CPUTIME_ID) - begin_s);
    pose_wall::test::GridSweeps checker(grid, settings);
    Won won[3];
    double best_cost = 1e9, best_length = 1e9;
    for (int which = 0; which < 3; ++which) {
      won[which] = run_ompl(grid, &checker.sweeps, start, goal, seconds, which);
      if (!(won[which].cost_m < best_cost)) continue;
      best_cost = won[which].cost_m;
      best_length = won[which].length_m;
    }
    std::printf("%u,%s,%.1f,%.2f,%.2f,%.3f,%.2f,%.2f,%.2f,%.2f,%.2f,%.4f,%.4f\n", seed,
                pose_wall_planar_plan_outcome_name(ours.outcome), ms, ours.cost_m, ours.length_m, ours.bound,
                won[0].cost_m, won[1].cost_m, won[2].cost_m, best_cost, best_length, ours.cost_m / best_cost,
                ours.length_m / best_length);
    std::fflush(stdout);
  }
  return 0;
}
