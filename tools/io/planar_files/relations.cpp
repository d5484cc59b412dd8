// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/planar_files/relations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"
#include "io/planar_files/gzip_text.hpp"

namespace pose_wall::tools {
namespace {

// Trajectories are written with as few as four digits.
constexpr double kUnitLength = 1e-2;

// The numbers of each line that has any.
template <std::size_t kNumbers, typename Take>
void each_row(std::string_view text, Take take) {
  TextCursor cursor(text);
  while (std::optional<std::string_view> line = cursor.next_line()) {
    std::array<double, kNumbers> row{};
    std::size_t filled = 0;
    for (std::string_view word = take_word(*line); !word.empty(); word = take_word(*line)) {
      if (filled == 0 && word.front() == '#') break;
      const std::optional<double> number = parse_number<double>(word);
      if (!number || !std::isfinite(*number)) {
        throw RelationsError(say("line {}: '{}' is no finite number", cursor.line(), std::string(word)));
      }
      if (filled == kNumbers) throw RelationsError(say("line {}: more than {} numbers", cursor.line(), kNumbers));
      row[filled++] = *number;
    }
    if (filled == 0) continue;
    if (filled != kNumbers)
      throw RelationsError(say("line {}: {} numbers instead of {}", cursor.line(), filled, kNumbers));
    take(row, cursor.line());
  }
}

template <typename Parse>
auto in_file(const std::filesystem::path& file, Parse parse) {
  try {
    return parse(read_text_or_gzip(file));
  } catch (const std::runtime_error& error) {
    throw RelationsError(file.string() + ": " + error.what());
  }
}

Eigen::Quaterniond turn_of(double roll_rad, double pitch_rad, double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

const TimedPose* nearest(const std::vector<TimedPose>& poses, double t_s, double match_s) {
  const auto is_earlier = [](const TimedPose& pose, double t) { return pose.t_s < t; };
  const auto later = std::lower_bound(poses.begin(), poses.end(), t_s, is_earlier);
  const TimedPose* best = later == poses.end() ? nullptr : &*later;
  if (later != poses.begin()) {
    const double before_s = (later - 1)->t_s;
    const auto first_before = std::lower_bound(poses.begin(), later, before_s, is_earlier);
    const TimedPose* before = &*first_before;
    if (best == nullptr || t_s - before->t_s < best->t_s - t_s) best = before;
  }
  return best != nullptr && std::abs(best->t_s - t_s) <= match_s ? best : nullptr;
}

struct Errors {
  std::vector<double> translation_m, rotation_rad;
  std::vector<std::size_t> lines;

  void add(const Eigen::Isometry3d& error, std::size_t line) {
    translation_m.push_back(error.translation().norm());
    rotation_rad.push_back(Eigen::AngleAxisd(error.linear()).angle());
    lines.push_back(line);
  }
};

ErrorSpread spread_of(const std::vector<double>& errors, const std::vector<std::size_t>& lines) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (errors.empty()) return {kNone, kNone, kNone, 0};
  const auto count = static_cast<double>(errors.size());
  ErrorSpread spread;
  for (const double error : errors) spread.mean += error / count;
  for (const double error : errors) spread.sigma += (error - spread.mean) * (error - spread.mean) / count;
  spread.sigma = std::sqrt(spread.sigma);
  const auto worst = std::max_element(errors.begin(), errors.end());
  spread.max = *worst;
  spread.max_line = lines[static_cast<std::size_t>(worst - errors.begin())];
  return spread;
}

RelationErrors errors_of(const Errors& errors) {
  return {errors.lines.size(), spread_of(errors.translation_m, errors.lines),
          spread_of(errors.rotation_rad, errors.lines)};
}

// Poses have eight numbers, too, and four of them the length 1. Of relations so few as these a line may look so.
bool is_trajectory(std::string_view text) {
  constexpr std::size_t kLeast = 3;
  std::size_t rows = 0, unit = 0;
  each_row<8>(text, [&](const std::array<double, 8>& row, std::size_t /*line*/) {
    ++rows;
    const double length = std::sqrt(row[4] * row[4] + row[5] * row[5] + row[6] * row[6] + row[7] * row[7]);
    unit += std::abs(length - 1.0) <= kUnitLength ? 1U : 0U;
  });
  return rows >= kLeast && unit == rows;
}

}  // namespace

std::vector<TimedPose> parse_tum(std::string_view text) {
  std::vector<TimedPose> poses;
  each_row<8>(text, [&poses](const std::array<double, 8>& row, std::size_t line) {
    Eigen::Quaterniond turn(row[7], row[4], row[5], row[6]);
    if (!(std::abs(turn.norm() - 1.0) <= kUnitLength)) {
      throw RelationsError(say("line {}: qx, qy, qz, qw have not the length 1", line));
    }
    poses.push_back({row[0], Eigen::Translation3d(row[1], row[2], row[3]) * turn.normalized()});
  });
  return poses;
}

std::vector<TimedPose> read_tum(const std::filesystem::path& file) {
  return in_file(file, [](const std::string& text) { return parse_tum(text); });
}

std::vector<Relation> parse_relations(std::string_view text) {
  std::vector<Relation> relations;
  each_row<8>(text, [&relations](const std::array<double, 8>& row, std::size_t line) {
    relations.push_back(
        {row[0], row[1], Eigen::Translation3d(row[2], row[3], row[4]) * turn_of(row[5], row[6], row[7]), line});
  });
  return relations;
}

std::vector<Relation> read_relations(const std::filesystem::path& file) {
  try {
    return in_file(file, [](const std::string& text) {
      std::vector<Relation> relations = parse_relations(text);
      if (relations.empty()) throw RelationsError(tr("no line holds numbers"));
      if (is_trajectory(text)) throw RelationsError(tr("these are poses (`t x y z qx qy qz qw`), no relations"));
      return relations;
    });
  } catch (const RelationsError& error) {
    throw RelationsError(
        say("{}. Relations are lines `t1 t2 x y z roll pitch yaw`: s, m, rad", std::string(error.what())));
  }
}

RelationReport judge_relations(std::vector<TimedPose> poses, const std::vector<Relation>& relations, double near_s,
                               double match_s) {
  std::stable_sort(poses.begin(), poses.end(), [](const TimedPose& a, const TimedPose& b) { return a.t_s < b.t_s; });
  RelationReport report;
  Errors all, near;
  for (const Relation& relation : relations) {
    const TimedPose* first = nearest(poses, relation.t1_s, match_s);
    const TimedPose* second = nearest(poses, relation.t2_s, match_s);
    if (first == nullptr || second == nullptr) {
      ++report.unmatched;
      continue;
    }
    const Eigen::Isometry3d error = relation.T_1_2.inverse() * (first->T_world_base.inverse() * second->T_world_base);
    all.add(error, relation.line);
    if (std::abs(relation.t2_s - relation.t1_s) < near_s) near.add(error, relation.line);
  }
  report.all = errors_of(all);
  report.near = errors_of(near);
  return report;
}

}  // namespace pose_wall::tools
