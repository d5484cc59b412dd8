// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How well a trajectory keeps relations between its own poses that are known to be true.
//
// The measure of R. Kuemmerle, B. Steder, C. Dornhege, M. Ruhnke, G. Grisetti, C. Stachniss, A. Kleiner: "On measuring
// the accuracy of SLAM algorithms", Autonomous Robots 27(4), 2009. A relation says where the machine at t2 stood in its
// frame at t1. The error of a relation is the motion from the true to the estimated pose at t2: the length of its
// translation and its angle. It does not depend on where the trajectory begins, and an error counts where it happens.

#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

struct TimedPose {
  double t_s = 0.0;
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
};

struct Relation {
  double t1_s = 0.0, t2_s = 0.0;
  Eigen::Isometry3d T_1_2 = Eigen::Isometry3d::Identity();
  std::size_t line = 0;
};

// The message names the file and the line.
class RelationsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Lines `t x y z qx qy qz qw`, in any order of t; lines that begin with # are comments. An empty file has no poses.
std::vector<TimedPose> parse_tum(std::string_view text);
std::vector<TimedPose> read_tum(const std::filesystem::path& file);

// Lines `t1 t2 x y z roll pitch yaw`: m, rad; turned by yaw about z, then pitch about y, then roll about x.
std::vector<Relation> parse_relations(std::string_view text);
std::vector<Relation> read_relations(const std::filesystem::path& file);

// Over the errors of some relations: NaN if there are none.
struct ErrorSpread {
  double mean = 0.0;
  double sigma = 0.0;  // about the mean
  double max = 0.0;
  std::size_t max_line = 0;  // of the relations' file
};

struct RelationErrors {
  std::size_t relations = 0;
  ErrorSpread translation_m;
  ErrorSpread rotation_rad;
};

struct RelationReport {
  RelationErrors all;
  RelationErrors near;        // t2 - t1 below near_s: what a scan matcher does
  std::size_t unmatched = 0;  // without a pose close enough in time: in no figure
};

inline constexpr double kNearRelation_s = 20.0;
// Between a relation's time and the nearest pose: half a scan of an old scanner.
inline constexpr double kRelationMatch_s = 0.05;

// The poses in any order; of several with the same time the first counts.
RelationReport judge_relations(std::vector<TimedPose> poses, const std::vector<Relation>& relations,
                               double near_s = kNearRelation_s, double match_s = kRelationMatch_s);

}  // namespace pose_wall::tools
