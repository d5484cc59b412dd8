// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/motion_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace pose_wall::tools {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Vector3d rotation_vector(const Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

// Row 0 points along, row 1 to the left across, row 2 up; all in base of the first frame.
Matrix3d road_rows(Vector3d along, const Vector3d& up) {
  along.normalize();
  const Vector3d across = up.cross(along).normalized();
  Matrix3d rows;
  rows << along.transpose(), across.transpose(), along.cross(across).transpose();
  return rows;
}

// Rows of both that belong together, in the table's order, and both paths from the first that have a pose in both.
class MotionComparer {
 public:
  MotionComparer(const MotionTable& table, const PoseTruth& truth) : table_(table), truth_(truth) {
    match();
    lay_together();
  }

  MotionComparison take() {
    compare_poses();
    compare_steps();
    compare_segments();
    return std::move(out_);
  }

 private:
  struct Pair {
    const MotionRow* row;
    std::size_t index;                   // of the row
    std::optional<Isometry3d> measured;  // base in base of the first frame
    Isometry3d truth;
    double path_m;  // true, from the first on
  };

  void match() {
    const RowPairs pairs = pair_rows(table_.keys, truth_.keys);
    if (pairs.rows.empty()) {
      throw CsvError(fmt::format("no row in common: {} motion rows and {} truth rows share no {}", table_.rows.size(),
                                 truth_.T_world_base.size(), pairs.by));
    }
    out_.matched_by = pairs.by;
    out_.matched = pairs.rows.size();
    out_.other_stamps = pairs.other_stamps;
    out_.table_rows_alone = table_.rows.size() - pairs.rows.size();
    out_.truth_rows_alone = truth_.T_world_base.size() - pairs.rows.size();
    truth_of_.assign(table_.rows.size(), nullptr);
    along_of_.assign(table_.rows.size(), nullptr);
    for (const auto& [row, truth_row] : pairs.rows) {
      ++out_.states[table_.rows[row].along_state.value_or(POSE_WALL_ALONG_MEASURED + 1)];
      const std::optional<Isometry3d>& pose = truth_.T_world_base[truth_row];
      if (pose) truth_of_[row] = &*pose;
      if (!truth_.along_world.empty()) along_of_[row] = &truth_.along_world[truth_row];
    }
  }

  void lay_together() {
    std::size_t first = 0;
    const auto has_both = [this](std::size_t i) { return truth_of_[i] != nullptr && table_.rows[i].T_start_base; };
    while (first < table_.rows.size() && !has_both(first)) ++first;
    if (first == table_.rows.size()) throw CsvError("no row has a pose in the motion table and one in the truth");
    T_first_world_ = truth_of_[first]->inverse();
    const Isometry3d T_first_start = table_.rows[first].T_start_base->inverse();
    out_.true_place_start_m.assign(table_.rows.size(), std::nullopt);
    double path_m = 0.0;
    for (std::size_t i = first; i < table_.rows.size(); ++i) {
      if (truth_of_[i] == nullptr) continue;
      const Isometry3d truth = T_first_world_ * *truth_of_[i];
      if (!pairs_.empty()) path_m += (truth.translation() - pairs_.back().truth.translation()).norm();
      out_.true_place_start_m[i] = *table_.rows[first].T_start_base * truth.translation();
      const std::optional<Isometry3d>& pose = table_.rows[i].T_start_base;
      pairs_.push_back({&table_.rows[i], i, std::nullopt, truth, path_m});
      if (pose) pairs_.back().measured = T_first_start * *pose;
    }
    R_road_first_ = road();
  }

  // In base of the first frame: of the simulator's road; else from the first place to the furthest.
  Matrix3d road() {
    const Matrix3d R_first_world = T_first_world_.linear();
    out_.along_is_road = truth_.world_is_road;
    if (truth_.world_is_road) return road_rows(R_first_world.col(0), R_first_world.col(2));
    const auto distance = [](const Pair& pair) { return pair.truth.translation().norm(); };
    const auto furthest = std::max_element(pairs_.begin(), pairs_.end(),
                                           [&](const Pair& a, const Pair& b) { return distance(a) < distance(b); });
    const Vector3d up = R_first_world.col(2), way = furthest->truth.translation();
    const Vector3d level = way - up.dot(way) * up;
    constexpr double kStanding_m = 1e-6;
    return road_rows(level.norm() > kStanding_m ? level : Vector3d(R_first_world.col(0)), up);
  }

  // At a row of the table.
  Matrix3d road_at(std::size_t i) const {
    if (along_of_[i] == nullptr) return R_road_first_;
    const Matrix3d R_first_world = T_first_world_.linear();
    return road_rows(R_first_world * *along_of_[i], R_first_world.col(2));
  }

  static void judge(const Directions& errors, const Directions& sigma, const Directions& level,
                    std::array<DirectionErrors, POSE_WALL_MOTION_DIRECTIONS>* to) {
    for (std::size_t d = 0; d < errors.size(); ++d) (*to)[d].add(errors[d], sigma[d], level[d]);
  }

  static void count_misleading(const MotionRow& row, double along_error_m, double along_level_m, Misleading* to) {
    if (row.along_state == POSE_WALL_ALONG_MEASURED) to->add(along_error_m, along_level_m, row.frame);
  }

  static Directions joined(const Vector3d& way, const Vector3d& turn) {
    return {way.x(), way.y(), way.z(), turn.x(), turn.y(), turn.z()};
  }

  void compare_poses() {
    out_.first_frame = pairs_.front().row->frame;
    for (const Pair& pair : pairs_) {
      if (!pair.measured) continue;
      const Vector3d way = road_at(pair.index) * (pair.measured->translation() - pair.truth.translation());
      const Vector3d turn = rotation_vector(pair.measured->linear() * pair.truth.linear().transpose());
      out_.last_frame = pair.row->frame;
      out_.way_m = pair.path_m;
      out_.true_along_m = R_road_first_.row(0).dot(pair.truth.translation());
      out_.measured_along_m = R_road_first_.row(0).dot(pair.measured->translation());
      for (Eigen::Index k = 0; k < 3; ++k) out_.travel[static_cast<std::size_t>(k)].add(way[k], pair.row->frame);
      out_.turn.add(turn.norm(), pair.row->frame);
      if (&pair == &pairs_.front()) continue;  // laid on each other: no error, and no proof
      judge(joined(way, turn), pair.row->sigma, pair.row->level, &out_.pose);
      count_misleading(*pair.row, way.x(), pair.row->level[POSE_WALL_MOTION_ALONG], &out_.misleading_poses);
    }
  }

  // A step is from the last frame that had a pose.
  void compare_steps() {
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      const MotionRow& row = table_.rows[i];
      if (!row.along_state || *row.along_state == POSE_WALL_ALONG_LOST) continue;
      const std::optional<std::size_t> before = std::exchange(last, i);
      if (!before || !row.T_last_base || truth_of_[i] == nullptr || truth_of_[*before] == nullptr) continue;
      const Isometry3d truth = truth_of_[*before]->inverse() * *truth_of_[i];
      const Matrix3d R_first_last = (T_first_world_ * *truth_of_[*before]).linear();
      const Vector3d way = road_at(*before) * R_first_last * (row.T_last_base->translation() - truth.translation());
      const Vector3d turn = R_first_last * rotation_vector(row.T_last_base->linear() * truth.linear().transpose());
      judge(joined(way, turn), row.step_sigma, row.step_level, &out_.step);
      count_misleading(row, way.x(), row.step_level[POSE_WALL_MOTION_ALONG], &out_.misleading_steps);
    }
  }

  void compare_segments() {
    SegmentDrift& drift = out_.drift;
    std::size_t to = 0;
    double sum = 0.0;
    for (std::size_t from = 0; from < pairs_.size(); ++from) {
      while (to < pairs_.size() && pairs_[to].path_m - pairs_[from].path_m < kSegment_m - kRounding_m) ++to;
      if (to == pairs_.size()) break;
      const Pair &a = pairs_[from], &b = pairs_[to];
      if (!a.measured || !b.measured) continue;
      const Isometry3d error = (a.truth.inverse() * b.truth).inverse() * (a.measured->inverse() * *b.measured);
      const double share = error.translation().norm() / (b.path_m - a.path_m);
      sum += share;
      ++drift.count;
      if (share < drift.worst) continue;
      drift.worst = share;
      drift.worst_from_frame = a.row->frame;
    }
    drift.mean = drift.count > 0 ? sum / static_cast<double>(drift.count) : kUnknown;
    if (drift.count == 0) drift.worst = kUnknown;
  }

  // A path of a hundred steps of a tenth may add up to a hair less than its length.
  static constexpr double kRounding_m = 1e-6;

  const MotionTable& table_;
  const PoseTruth& truth_;
  std::vector<const Isometry3d*> truth_of_;  // by the table's rows; nullptr: none
  std::vector<const Vector3d*> along_of_;    // likewise: the road's direction there
  std::vector<Pair> pairs_;
  Isometry3d T_first_world_ = Isometry3d::Identity();
  Matrix3d R_road_first_ = Matrix3d::Identity();
  MotionComparison out_;
};

}  // namespace

void DirectionErrors::add(double error, double sigma, double level) {
  ++count_;
  sum_of_squares_ += error * error;
  largest_ = std::max(largest_, std::abs(error));
  beyond_ += std::abs(error) <= level ? 0U : 1U;
  if (!std::isfinite(sigma) || sigma <= 0.0) return;
  ++with_z_;
  sum_z2_ += (error / sigma) * (error / sigma);
}

void DirectionErrors::merge(const DirectionErrors& other) {
  count_ += other.count_;
  beyond_ += other.beyond_;
  with_z_ += other.with_z_;
  sum_of_squares_ += other.sum_of_squares_;
  sum_z2_ += other.sum_z2_;
  largest_ = std::max(largest_, other.largest_);
}

void Misleading::add(double error, double level, std::uint64_t frame) {
  ++measured;
  if (std::abs(error) <= level) return;
  ++misleading;
  const double ratio = std::abs(error) / level;
  const double excess = std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
  if (excess <= worst_excess) return;
  worst_excess = excess;
  worst_frame = frame;
}

void Misleading::merge(const Misleading& other) {
  measured += other.measured;
  misleading += other.misleading;
  if (other.worst_excess <= worst_excess) return;
  worst_excess = other.worst_excess;
  worst_frame = other.worst_frame;
}

double DirectionErrors::rmse() const {
  return count_ > 0 ? std::sqrt(sum_of_squares_ / static_cast<double>(count_)) : kUnknown;
}

double DirectionErrors::largest() const {
  return count_ > 0 ? largest_ : kUnknown;
}

double DirectionErrors::mean_z2() const {
  return with_z_ > 0 ? sum_z2_ / static_cast<double>(with_z_) : kUnknown;
}

void TravelError::add(double error, std::uint64_t frame) {
  at_end = error;
  if (std::abs(error) <= largest) return;
  largest = std::abs(error);
  largest_at_frame = frame;
}

MotionComparison compare_motion(const MotionTable& table, const PoseTruth& truth) {
  return MotionComparer(table, truth).take();
}

}  // namespace pose_wall::tools
