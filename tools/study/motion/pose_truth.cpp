// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/pose_truth.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>

#include "study/motion/motion_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kTruth = "truth";
// References are written with six digits.
constexpr double kOrthonormal = 1e-3;

using Numbers = std::vector<double>;

// Nothing where one of them is empty.
std::optional<Numbers> numbers_of(const CsvTable& table, std::size_t row, const std::vector<std::size_t>& columns) {
  Numbers numbers;
  for (const std::size_t column : columns) {
    numbers.push_back(table.number(row, column));
    if (!std::isfinite(numbers.back())) return std::nullopt;
  }
  return numbers;
}

Eigen::Isometry3d pose_of_quaternion(const CsvTable& table, std::size_t row, const Numbers& n) {
  const std::optional<Eigen::Quaterniond> R = unit_quaternion(n[3], n[4], n[5], n[6]);
  if (!R) throw CsvError(fmt::format("line {}: qx, qy, qz, qw have not the length 1", table.line(row)));
  return Eigen::Translation3d(n[0], n[1], n[2]) * *R;
}

Eigen::Isometry3d pose_of_matrix(const CsvTable& table, std::size_t row, const Numbers& n) {
  Eigen::Matrix3d R;
  R << n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8];
  const bool is_rotation =
      (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kOrthonormal && R.determinant() > 0.0;
  if (!is_rotation) throw CsvError(fmt::format("line {}: r00 to r22 are no rotation", table.line(row)));
  return Eigen::Translation3d(n[9], n[10], n[11]) * Eigen::Quaterniond(R).normalized();
}

}  // namespace

PoseTruth read_pose_truth(const CsvTable& table) {
  PoseTruth truth;
  truth.keys = row_keys(table);
  const bool by_matrix = table.find_column("r00").has_value();
  truth.world_is_road = !by_matrix;
  if (!by_matrix && !table.find_column("qw")) {
    throw CsvError(
        fmt::format("the truth has no poses: neither x, y, z, qx, qy, qz, qw nor r00 ... r22, tx, ty, tz; columns: {}",
                    table.head_text()));
  }
  std::vector<std::string> names = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  if (by_matrix) names = {"r00", "r01", "r02", "r10", "r11", "r12", "r20", "r21", "r22", "tx", "ty", "tz"};
  std::vector<std::size_t> columns;
  for (const std::string& name : names) columns.push_back(demanded_column(table, kTruth, name));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::optional<Numbers> numbers = numbers_of(table, row, columns);
    if (!numbers) {
      truth.T_world_base.emplace_back();
    } else {
      truth.T_world_base.emplace_back(by_matrix ? pose_of_matrix(table, row, *numbers)
                                                : pose_of_quaternion(table, row, *numbers));
    }
  }
  return truth;
}

}  // namespace pose_wall::tools
