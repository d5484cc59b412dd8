// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pose_wall {

// Cholesky's factor of a small symmetric positive definite matrix, in a few lines. Eigen's are made for matrices of
// every size and kind, and take a compiler a third of a minute.
template <int kSize>
class SmallCholesky {
 public:
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  // solved() is false if the matrix is not positive definite in doubles.
  explicit SmallCholesky(const Matrix& m) {
    constexpr double kLeast = 1e-13;  // share of its diagonal that a pivot must keep: rounding leaves some 1e-16 a term
    solved_ = true;
    for (int i = 0; i < kSize; ++i) {
      for (int j = 0; j < i; ++j) factor_(i, j) = left_of(m, i, j) / factor_(j, j);
      const double pivot = left_of(m, i, i);
      solved_ = solved_ && pivot > kLeast * m(i, i);
      factor_(i, i) = std::sqrt(pivot > 0.0 ? pivot : 1.0);
    }
  }

  bool solved() const { return solved_; }

  Vector solve(Vector b) const {
    for (int i = 0; i < kSize; ++i) {
      for (int j = 0; j < i; ++j) b[i] -= factor_(i, j) * b[j];
      b[i] /= factor_(i, i);
    }
    for (int i = kSize - 1; i >= 0; --i) {
      for (int j = i + 1; j < kSize; ++j) b[i] -= factor_(j, i) * b[j];
      b[i] /= factor_(i, i);
    }
    return b;
  }

 private:
  double left_of(const Matrix& m, int i, int j) const {
    double left = m(i, j);
    for (int k = 0; k < j; ++k) left -= factor_(i, k) * factor_(j, k);
    return left;
  }

  Matrix factor_ = Matrix::Zero();  // lower triangle
  bool solved_;
};

}  // namespace pose_wall
