// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "estimation/uneven_plane.hpp"

#include <Eigen/LU>
#include <cmath>

#include "math/elementary.hpp"
#include "math/four_floats.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kRow = SurfacePatches::kMost;
constexpr std::uint32_t kColumns = 5;
constexpr std::uint32_t kPatchesMin = 8;
constexpr double kLengths_m[] = {0.4, 0.8, 1.6, 3.2};
// Share of the unevenness that neighbouring patches do not have in common.
constexpr double kOwnShares[] = {0.05, 0.4};
// An exactly flat surface has nothing left to scale by.
constexpr double kScaleLeast = 1e-6;
constexpr int kModelsMax = 1 + 4 * 2;
// Factors of a determinant whose logarithm is taken at once: each lies between 1e-6 and 1e6.
constexpr std::uint32_t kLogEvery = 16;

// Variance of the patches about their plane beyond their noise: a first guess, for the ratio of the two. Patches count
// by what is known of them (DerSimonian and Laird 1986), or one that is hardly seen would drown the rest.
double unevenness(Span<const SurfacePatch> patches) {
  double squares = 0.0, information = 0.0;
  for (const SurfacePatch& p : patches) {
    squares += p.residual * p.residual / p.noise_variance;
    information += 1.0 / p.noise_variance;
  }
  const double excess = squares - static_cast<double>(patches.size());
  return excess > 0.0 ? excess / information : 0.0;
}

// Sum of the first products, in eight lanes of a fixed order. Rows are zero behind what is known of them, up to a whole
// number of steps.
constexpr std::uint32_t kStep = 2 * kFour;
static_assert(kRow % kStep == 0, "rows are whole steps, and there are whole fours of them");

float dot(const float* a, const float* b, std::uint32_t count) {
  FourFloats s0{}, s1{};
  for (const float* const end = a + (count + kStep - 1) / kStep * kStep; a != end; a += kStep, b += kStep) {
    s0 += load_four(a) * load_four(b);
    s1 += load_four(a + kFour) * load_four(b + kFour);
  }
  const FourFloats sums = s0 + s1;
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

// Of four rows of a matrix with one vector: as dot(), and what the vector brings is loaded once.
struct FourSums {
  float of[kFour];
};

FourSums four_dots(const float* rows, const float* b, std::uint32_t count) {
  FourFloats s0[kFour] = {}, s1[kFour] = {};
  for (std::uint32_t k = 0; k < count; k += kStep) {
    const FourFloats b0 = load_four(b + k), b1 = load_four(b + k + kFour);
    for (std::uint32_t row = 0; row < kFour; ++row) {
      s0[row] += load_four(rows + row * kRow + k) * b0;
      s1[row] += load_four(rows + row * kRow + k + kFour) * b1;
    }
  }
  FourSums out;
  for (std::uint32_t row = 0; row < kFour; ++row) {
    const FourFloats sums = s0[row] + s1[row];
    out.of[row] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
  return out;
}

double slopes_variance(const Eigen::Matrix3d& covariance) {
  return covariance(1, 1) + covariance(2, 2);
}

}  // namespace

struct UnevenPlane::Model {
  Eigen::Vector3d correction, bias_response;
  Eigen::Matrix3d covariance;
  double log_likelihood;
  double weight;
};

struct UnevenPlane::Models {
  Model of[kModelsMax];
  int count = 0;

  // By likelihood, together 1.
  void weigh();
  UnevenFit average(double freedom) const;
};

void UnevenPlane::Models::weigh() {
  double best = of[0].log_likelihood, sum = 0.0;
  for (int k = 1; k < count; ++k) best = of[k].log_likelihood > best ? of[k].log_likelihood : best;
  for (int k = 0; k < count; ++k) {
    const double below = of[k].log_likelihood - best;
    of[k].weight = below > -50.0 ? exponential(below) : 0.0;
    sum += of[k].weight;
  }
  for (int k = 0; k < count; ++k) of[k].weight /= sum;
}

UnevenFit UnevenPlane::Models::average(double freedom) const {
  UnevenFit out;
  for (int k = 0; k < count; ++k) {
    out.correction += of[k].weight * of[k].correction;
    out.bias_response += of[k].weight * of[k].bias_response;
    out.covariance += of[k].weight * of[k].covariance;
  }
  const double mean = slopes_variance(out.covariance);
  double spread = 0.0;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d apart = of[k].correction - out.correction;
    out.covariance += of[k].weight * apart * apart.transpose();
    const double off = slopes_variance(of[k].covariance) / mean - 1.0;
    spread += of[k].weight * off * off;
  }
  // A variance from so many independent pieces is known to a relative variance of 2 / freedom.
  out.dof = 2.0 / (2.0 / freedom + spread);
  out.solved = true;
  return out;
}

void UnevenPlane::lay_out(Arena& arena) {
  correlation_ = arena.take<float>(kRow * kRow);
  factor_ = arena.take<float>(kRow * kRow);
  whitened_ = arena.take<float>(kRow * kColumns);
  matern_ = arena.take<double>(kMaternSteps + 1);
  matern_filled_ = false;
}

void UnevenPlane::fill_matern() {
  for (std::uint32_t k = 0; k <= kMaternSteps; ++k) {
    const double r = k * (1.0 / kMaternPerUnit);
    matern_[k] = (1.0 + r) * exponential(-r);
  }
  matern_filled_ = true;
}

// (1 + r) exp(-r), to 3e-5.
double UnevenPlane::matern(double r) const {
  const double place = r * kMaternPerUnit;
  if (!(place < kMaternSteps)) return 0.0;
  const auto step = static_cast<std::uint32_t>(place);
  return matern_[step] + (place - step) * (matern_[step + 1] - matern_[step]);
}

void UnevenPlane::fill_distances(Span<const SurfacePatch> patches) {
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const double du = patches[i].u - patches[j].u, dv = patches[i].v - patches[j].v;
      correlation_[j * kRow + i] = static_cast<float>(std::sqrt(du * du + dv * dv));
    }
  }
}

void UnevenPlane::fill_correlation(std::uint32_t patches, double length_m) {
  const double per_length = std::sqrt(3.0) / length_m;
  for (std::uint32_t i = 0; i < patches; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const auto distance_m = static_cast<double>(correlation_[j * kRow + i]);
      correlation_[i * kRow + j] = static_cast<float>(matern(distance_m * per_length));
    }
  }
}

// Cholesky's factor of the patches' covariance. Floats do: each patch has a part of its own in it, a twentieth at
// least. Row by row, so that sums have one order on every machine: a library that cuts matrices into blocks by the size
// of the cache does not give the same bits.
bool UnevenPlane::factor(Span<const SurfacePatch> patches, double own_share, double tau2) {
  const auto shared = static_cast<float>((1.0 - own_share) * tau2);
  const std::uint32_t n = patches.size();
  const auto covariance = [&](std::uint32_t i, std::uint32_t j) { return shared * correlation_[i * kRow + j]; };
  for (std::uint32_t first = 0; first < n; first += kFour) {
    float* const rows = &factor_[first * kRow];
    for (std::uint32_t k = 0; k < kFour * kRow; ++k) rows[k] = 0.0F;
    const std::uint32_t end = first + kFour < n ? first + kFour : n;
    // Where nothing is shared the rows hold their diagonal alone.
    for (std::uint32_t j = shared > 0.0F ? 0 : first; j < first; ++j) {
      const float* const above = &factor_[j * kRow];
      const FourSums sums = four_dots(rows, above, j);
      for (std::uint32_t i = first; i < end; ++i) {
        factor_[i * kRow + j] = (covariance(i, j) - sums.of[i - first]) * above[j];
      }
    }
    for (std::uint32_t i = first; i < end; ++i) {
      float* const row = &factor_[i * kRow];
      for (std::uint32_t j = shared > 0.0F ? first : i; j < i; ++j) {
        const float* const above = &factor_[j * kRow];
        row[j] = (covariance(i, j) - dot(row, above, j)) * above[j];
      }
      const float sum = static_cast<float>(tau2 + patches[i].noise_variance) - dot(row, row, i);
      if (!(sum > 0.0F)) return false;
      row[i] = 1.0F / std::sqrt(sum);
    }
  }
  return true;
}

bool UnevenPlane::solve(Span<const SurfacePatch> patches, Model* model) {
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  Eigen::Vector3d of_residual = Eigen::Vector3d::Zero(), of_bias = Eigen::Vector3d::Zero();
  double squares = 0.0, log_determinant = 0.0, product = 1.0;
  whitened_.fill(0.0F);
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& p = patches[i];
    const float* const row = &factor_[i * kRow];
    double y[kColumns] = {1.0, p.u, p.v, p.residual, p.bias};
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      // The row's diagonal meets a zero: nothing is whitened there yet.
      y[c] = (y[c] - static_cast<double>(dot(row, &whitened_[c * kRow], i))) * static_cast<double>(row[i]);
      whitened_[c * kRow + i] = static_cast<float>(y[c]);
    }
    const Eigen::Vector3d a(y[0], y[1], y[2]);
    g += a * a.transpose();
    of_residual += a * y[3];
    of_bias += a * y[4];
    squares += y[3] * y[3];
    product *= static_cast<double>(row[i]);
    if (i % kLogEvery != kLogEvery - 1 && i + 1 != patches.size()) continue;
    log_determinant -= 2.0 * natural_log(product);
    product = 1.0;
  }
  const double determinant = g.determinant();
  if (!(determinant > 1e-9 * g(0, 0) * g(1, 1) * g(2, 2))) return false;
  const Eigen::Matrix3d inverse = g.inverse();
  model->correction = inverse * of_residual;
  model->bias_response = inverse * of_bias;
  const double left = squares - model->correction.dot(of_residual);
  const double freedom = static_cast<double>(patches.size()) - 3.0;
  const double least = kScaleLeast * freedom;
  if (!(left > -least)) return false;
  const double scaled = left > least ? left : least;
  model->covariance = inverse * (scaled / freedom);
  model->log_likelihood = -0.5 * (log_determinant + natural_log(determinant) + freedom * natural_log(scaled));
  return true;
}

void UnevenPlane::consider(Span<const SurfacePatch> patches, double own_share, double tau2, Models* models) {
  if (factor(patches, own_share, tau2) && solve(patches, &models->of[models->count])) ++models->count;
}

UnevenFit UnevenPlane::fit(Span<const SurfacePatch> patches) {
  if (patches.size() < kPatchesMin) return {};
  const double tau2 = unevenness(patches);
  Models models;
  consider(patches, 1.0, tau2, &models);
  if (tau2 > 0.0) {
    if (!matern_filled_) fill_matern();
    fill_distances(patches);
    for (const double length_m : kLengths_m) {
      fill_correlation(patches.size(), length_m);
      for (const double share : kOwnShares) consider(patches, share, tau2, &models);
    }
  }
  if (models.count == 0) return {};
  models.weigh();
  return models.average(static_cast<double>(patches.size()) - 3.0);
}

}  // namespace pose_wall
