// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/uneven_plane.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kPatchesMin = 8;  // five more than the terms of a plane; swept: half nothing, twice 1 moved
// From a patch (0.5 m) to the waves that a first radius (3 m) shows; longer ones are the surface's own slope. Twice as
// long each time, as their likelihoods are averaged.
constexpr double kLengths_m[] = {0.4, 0.8, 1.6, 3.2};
// Of errors_of(), the shorter ones: a wall that waves over 3.2 m bends, and a test for bends sees it.
constexpr std::uint32_t kLengthsOfErrors = 3;  // swept: half 18 won, twice fails
// Share of the unevenness that neighbouring patches do not share: little, or nearly half. The smaller one keeps the
// covariance positive definite in floats.
constexpr double kOwnShares[] = {0.05, 0.4};
// An exactly flat surface has nothing left to scale by: a thousandth of the expected errors is kept.
constexpr double kScaleLeast = 1e-6;
constexpr float kNowhere_m = 1e6F;  // beyond every correlation
// Factors of a determinant whose logarithm is taken at once: variances in m², not below 1e-12, so that their product
// lies within a double's 1e-308 to 1e308.
constexpr std::uint32_t kLogEvery = 4;  // rows of four

// Variance of the patches about their plane beyond their noise: a first guess for the ratio of the two. Patches count
// by their information (DerSimonian and Laird 1986), or one that is hardly seen would drown the rest.
double unevenness(Span<const SurfacePatch> patches) {
  double squares = 0.0, information = 0.0;
  for (const SurfacePatch& p : patches) {
    squares += p.residual * p.residual / p.noise_variance;
    information += 1.0 / p.noise_variance;
  }
  const double excess = squares - static_cast<double>(patches.size());
  return excess > 0.0 ? excess / information : 0.0;
}

// Variance of both slopes together.
double slopes_of(const Eigen::Matrix3d& covariance) {
  return covariance(1, 1) + covariance(2, 2);
}

}  // namespace

struct UnevenPlane::Model {
  Eigen::Vector3d correction, bias_response;
  Eigen::Matrix3d covariance;
  double log_likelihood;
  double scale;  // of the variances
  // Of predict(): the region's plane is of_seen + of_endless times the endless one, with what else is unknown.
  Eigen::Vector3d of_seen, bias_of_seen;
  Eigen::Matrix3d of_endless, unknown, about_endless;

  template <typename EndlessPlane>
  void stand_on(const EndlessPlane& endless) {
    correction = of_seen + of_endless * endless.correction;
    bias_response = bias_of_seen + of_endless * endless.bias_response;
    covariance = unknown + of_endless * endless.covariance * of_endless.transpose();
  }
};

// By the number of the model: without waves, then wave by wave.
struct UnevenPlane::Models {
  WaveEvidence evidence;
  Model of[kWaveModels];

  void count(std::uint32_t number) {
    evidence.exists = evidence.solved[number] = true;
    evidence.log_likelihood[number] = static_cast<float>(of[number].log_likelihood);
  }
  UnevenFit average(double freedom, double sigmas) const;
  Eigen::Matrix3d average(Eigen::Matrix3d Model::*of_model) const;
  // Of predict(): of a plane that is known from elsewhere, which moves the region's by so much.
  UnevenFit standing_on(const UnevenFit& endless, const Eigen::Matrix3d& moves, double freedom, double sigmas);
};

UnevenFit UnevenPlane::Models::average(double freedom, double sigmas) const {
  UnevenFit out;
  double weights[kWaveModels], slopes[kWaveModels] = {};
  out.solved = weigh_models(evidence, WaveEvidence{}, &weights);
  if (!out.solved) return out;
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    if (!evidence.solved[k]) continue;
    out.correction += weights[k] * of[k].correction;
    out.bias_response += weights[k] * of[k].bias_response;
    out.covariance += weights[k] * of[k].covariance;
    slopes[k] = slopes_of(of[k].covariance);
  }
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    if (!evidence.solved[k]) continue;
    const Eigen::Vector3d apart = of[k].correction - out.correction;
    out.covariance += weights[k] * apart * apart.transpose();
  }
  out.dof = spread_of_mixture(weights, slopes, freedom, sigmas).dof;
  return out;
}

Eigen::Matrix3d UnevenPlane::Models::average(Eigen::Matrix3d Model::*of_model) const {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  double weights[kWaveModels];
  if (!weigh_models(evidence, WaveEvidence{}, &weights)) return out;
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    if (evidence.solved[k]) out += weights[k] * of[k].*of_model;
  }
  return out;
}

UnevenFit UnevenPlane::Models::standing_on(const UnevenFit& endless, const Eigen::Matrix3d& moves, double freedom,
                                           double sigmas) {
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    if (evidence.solved[k]) of[k].stand_on(endless);
  }
  UnevenFit out = average(freedom, sigmas);
  const double by_endless = slopes_of(moves * endless.covariance * moves.transpose());
  const double by_rest = larger(slopes_of(out.covariance) - by_endless, 0.0);
  out.dof = sum_of({by_rest, out.dof}, {by_endless, endless.dof}).dof;
  return out;
}

void UnevenPlane::lay_out(Arena& arena) {
  values_ = arena.take<Values>(SurfacePatches::kMost);
  u_m_ = arena.take<float>(SurfacePatches::kMost);
  v_m_ = arena.take<float>(SurfacePatches::kMost);
  neighbours_ = arena.take<std::uint16_t>(SurfacePatches::kMost * kNeighbours);
  predicts_ = arena.take<FourFloats>(kWaves * kFours * kNeighbours);
  left_ = arena.take<FourFloats>(kWaves * kFours);
  passed_ = arena.take<FourFloats>(SurfacePatches::kMost);
  matern_ = arena.take<float>(kMaternSteps + 1);
  matern_filled_ = false;
}

void UnevenPlane::fill_matern() {
  for (std::uint32_t k = 0; k <= kMaternSteps; ++k) {
    const double r = k * (1.0 / kMaternPerUnit);
    matern_[k] = static_cast<float>((1.0 + r) * exponential(-r));
  }
  matern_filled_ = true;
}

// (1 + r) exp(-r), to 3e-5.
FourFloats UnevenPlane::matern(FourFloats r) const {
  const FourFloats place = r * static_cast<float>(kMaternPerUnit), none{};
  const FourTruths near = place < all_four(kMaternSteps);
  const FourInts step = cut_off(near ? place : none);
  FourFloats below, above;
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    const float* const at = &matern_[static_cast<std::uint32_t>(step[lane])];
    below[lane] = at[0];
    above[lane] = at[1];
  }
  const FourFloats part = place - __builtin_convertvector(step, FourFloats);
  return near ? below + part * (above - below) : none;
}

// Whether one of the patches from the first on lies within so many square metres of patch i.
bool UnevenPlane::any_of_four_is_nearer(std::uint32_t i, std::uint32_t first, float m2) const {
  const FourFloats du = load_four(&u_m_[first]) - u_m_[i], dv = load_four(&v_m_[first]) - v_m_[i];
  return any_of(du * du + dv * dv <= all_four(m2));
}

// The nearest of the patches before each, by insertion; of equally near ones the first. From the last one back, since
// patches come row by row and the near ones are found at once. The others are passed over four at a time.
void UnevenPlane::find_neighbours(std::uint32_t patches, std::uint32_t seen) {
  for (std::uint32_t i = 0; i < patches; ++i) {
    u_m_[i] = values_[i].of[1];
    v_m_[i] = values_[i].of[2];
    float nearest_m2[kNeighbours];
    std::uint16_t* const of = &neighbours_[i * kNeighbours];
    std::uint32_t found = 0;
    // What is not seen stands behind all that is.
    const std::uint32_t first = i > kLookBack && i < seen ? i - kLookBack : 0;
    for (std::uint32_t j = i; j > first;) {
      const bool full = found == kNeighbours;
      if (full && j >= first + kFour && !any_of_four_is_nearer(i, j - kFour, nearest_m2[kNeighbours - 1])) {
        j -= kFour;
        continue;
      }
      --j;
      const float du = u_m_[i] - u_m_[j], dv = v_m_[i] - v_m_[j], m2 = du * du + dv * dv;
      if (full && !(m2 <= nearest_m2[kNeighbours - 1])) continue;
      std::uint32_t place = full ? kNeighbours - 1 : found++;
      for (; place > 0 && m2 <= nearest_m2[place - 1]; --place) {
        nearest_m2[place] = nearest_m2[place - 1];
        of[place] = of[place - 1];
      }
      nearest_m2[place] = m2;
      of[place] = static_cast<std::uint16_t>(j);
    }
    for (; found < kNeighbours; ++found) of[found] = kNone;
  }
}

// Sums over patches that a model of their errors makes independent and of variance 1.
struct UnevenPlane::Whitened {
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  Eigen::Vector3d of_residual = Eigen::Vector3d::Zero(), of_bias = Eigen::Vector3d::Zero();
  double squares = 0.0, log_determinant = 0.0, product = 1.0;
  std::uint32_t factors = 0;

  // Values of four patches: 1, u, v, residual, bias. variance: of their errors.
  void add(const FourFloats (&row)[kColumns], FourFloats variance, FourTruths counts) {
    const FourFloats none{}, inverse = counts ? 1.0F / variance : none;
    for (int k = 0; k < 3; ++k) {
      const FourFloats weighted = row[k] * inverse;
      for (int l = 0; l <= k; ++l) g(k, l) += sum_of_lanes(weighted * row[l]);
      of_residual[k] += sum_of_lanes(weighted * row[3]);
      of_bias[k] += sum_of_lanes(weighted * row[4]);
    }
    squares += sum_of_lanes(row[3] * row[3] * inverse);
    const FourFloats factor = counts ? variance : all_four(1.0F);
    product *= static_cast<double>(factor[0]) * static_cast<double>(factor[1]) * static_cast<double>(factor[2]) *
               static_cast<double>(factor[3]);
    if (++factors % kLogEvery == 0) take_logarithm();
  }
  void take_logarithm() {
    log_determinant += natural_log(product);
    product = 1.0;
  }
  bool solve(double patches, Model* model);
};

bool UnevenPlane::Whitened::solve(double patches, Model* model) {
  take_logarithm();
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < k; ++l) g(l, k) = g(k, l);
  }
  const double determinant = g.determinant();
  if (!(determinant > 1e-9 * g(0, 0) * g(1, 1) * g(2, 2))) return false;
  const Eigen::Matrix3d inverse = g.inverse();
  model->correction = inverse * of_residual;
  model->bias_response = inverse * of_bias;
  const double left = squares - model->correction.dot(of_residual);
  const double freedom = patches - 3.0, least = kScaleLeast * freedom;
  if (!(left > -least)) return false;
  const double scaled = left > least ? left : least;
  model->scale = scaled / freedom;
  model->covariance = inverse * model->scale;
  model->log_likelihood = -0.5 * (log_determinant + natural_log(determinant) + freedom * natural_log(scaled));
  return is_finite(model->log_likelihood);
}

// The values of four patches, in floats; of those without one, zeros that count nothing.
struct UnevenPlane::FourPatches {
  FourFloats of[kColumns] = {}, noise{};
  FourTruths counts{};

  void set(std::uint32_t lane, const Values& p) {
    counts[lane] = -1;
    for (int column = 0; column < kColumns; ++column) of[column][lane] = p.of[column];
    noise[lane] = p.noise;
  }
  FourFloats distance_m(const FourPatches& other) const {
    const FourFloats du = of[1] - other.of[1], dv = of[2] - other.of[2];
    // Beyond every correlation where there is none.
    return counts & other.counts ? root_of(du * du + dv * dv) : all_four(kNowhere_m);
  }
};

// Four patches, the neighbours of each, and how far they lie from it and from each other.
struct UnevenPlane::Neighbourhood {
  FourPatches own, near[kNeighbours];
  FourFloats to_own_m[kNeighbours], between_m[kNeighbours][kNeighbours];
};

UnevenPlane::Neighbourhood UnevenPlane::neighbourhood(std::uint32_t first, std::uint32_t patches) const {
  Neighbourhood out;
  for (std::uint32_t lane = 0; lane < kFour && first + lane < patches; ++lane) {
    out.own.set(lane, values_[first + lane]);
    for (std::uint32_t k = 0; k < kNeighbours; ++k) {
      const std::uint16_t at = neighbours_[(first + lane) * kNeighbours + k];
      if (at != kNone) out.near[k].set(lane, values_[at]);
    }
  }
  for (std::uint32_t k = 0; k < kNeighbours; ++k) {
    out.to_own_m[k] = out.near[k].distance_m(out.own);
    for (std::uint32_t l = 0; l < k; ++l) out.between_m[k][l] = out.near[k].distance_m(out.near[l]);
  }
  return out;
}

// The model of patches without waves.
void UnevenPlane::consider_independent(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses,
                                       double tau2, Models* models) const {
  Whitened sums;
  for (std::uint32_t first = 0; first < patches.size(); first += kFour) {
    FourPatches own;
    for (std::uint32_t lane = 0; lane < kFour && first + lane < patches.size(); ++lane) {
      own.set(lane, values_[first + lane]);
    }
    sums.add(own.of, own.noise + static_cast<float>(tau2), own.counts);
  }
  Model& model = models->of[0];
  if (!sums.solve(static_cast<double>(patches.size()), &model)) return;
  models->count(0);
  if (responses.size() == 0) return;
  model.covariance.setZero();
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    const double variance = model.scale * (tau2 + patches[i].noise_variance);
    model.covariance += variance * responses[i] * responses[i].transpose();
  }
}

// Predicts each of four patches from its neighbours by their covariance, and adds what is left of it.
void UnevenPlane::predict(const Neighbourhood& at, const FourFloats (&to_own)[kNeighbours],
                          const FourFloats (&between)[kNeighbours][kNeighbours], float own_share, float tau2,
                          FourTruths seen, FourFloats* predicts, FourFloats* left, Whitened* sums) {
  const float shared = (1.0F - own_share) * tau2;
  FourFloats factor[kNeighbours][kNeighbours], inverse_pivot[kNeighbours], known[kNeighbours];
  FourFloats unknown = at.own.noise + tau2;
  for (std::uint32_t k = 0; k < kNeighbours; ++k) {
    FourFloats pivot = at.near[k].noise + tau2, to = shared * to_own[k];
    for (std::uint32_t l = 0; l < k; ++l) {
      FourFloats sum = shared * between[k][l];
      for (std::uint32_t m = 0; m < l; ++m) sum -= factor[k][m] * factor[l][m];
      factor[k][l] = sum * inverse_pivot[l];
      pivot -= factor[k][l] * factor[k][l];
      to -= factor[k][l] * known[l];
    }
    inverse_pivot[k] = 1.0F / root_of(pivot);
    known[k] = to * inverse_pivot[k];
    unknown -= known[k] * known[k];
  }
  FourFloats row[kColumns];
  for (int column = 0; column < kColumns; ++column) row[column] = at.own.of[column];
  for (std::uint32_t k = kNeighbours; k-- > 0;) {
    FourFloats part = known[k];
    for (std::uint32_t l = k + 1; l < kNeighbours; ++l) part -= factor[l][k] * known[l];
    known[k] = part * inverse_pivot[k];  // from here on, the neighbour's share in the prediction
    for (int column = 0; column < kColumns; ++column) row[column] -= known[k] * at.near[k].of[column];
    predicts[k] = known[k];
  }
  *left = unknown;
  sums->add(row, unknown, at.own.counts & seen);
}

struct UnevenPlane::WaveSums {
  Whitened of[kWaves];
};

// Predicts each patch from those before it, under every model of waves.
void UnevenPlane::sum_waves(std::uint32_t patches, std::uint32_t seen, std::uint32_t lengths, double tau2,
                            WaveSums* sums) {
  for (std::uint32_t first = 0; first < patches; first += kFour) {
    const Neighbourhood at = neighbourhood(first, patches);
    const FourTruths of_seen = first_of_four(first < seen ? seen - first : 0);
    for (std::uint32_t length = 0; length < lengths; ++length) {
      const auto per_length = static_cast<float>(std::sqrt(3.0) / kLengths_m[length]);
      FourFloats to_own[kNeighbours], between[kNeighbours][kNeighbours];
      for (std::uint32_t k = 0; k < kNeighbours; ++k) {
        to_own[k] = matern(at.to_own_m[k] * per_length);
        for (std::uint32_t l = 0; l < k; ++l) between[k][l] = matern(at.between_m[k][l] * per_length);
      }
      for (std::uint32_t share = 0; share < kShares; ++share) {
        const std::uint32_t wave = length * kShares + share, four = wave * kFours + first / kFour;
        predict(at, to_own, between, static_cast<float>(kOwnShares[share]), static_cast<float>(tau2), of_seen,
                &predicts_[four * kNeighbours], &left_[four], &sums->of[wave]);
      }
    }
  }
}

void UnevenPlane::consider_waves(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses, double tau2,
                                 Models* models) {
  const std::uint32_t lengths = responses.size() > 0 ? kLengthsOfErrors : kLengths;
  WaveSums sums;
  sum_waves(patches.size(), patches.size(), lengths, tau2, &sums);
  for (std::uint32_t wave = 0; wave < lengths * kShares; ++wave) {
    Model& model = models->of[1 + wave];
    if (!sums.of[wave].solve(static_cast<double>(patches.size()), &model)) continue;
    models->count(1 + wave);
    if (responses.size() > 0) model.covariance = model.scale * passed_on(&wave, tau2, responses);
  }
}

// Covariance of an estimator under a model of waves, before it is scaled. A patch's own error also
// reaches the patches that are predicted from it.
Eigen::Matrix3d UnevenPlane::passed_on(const std::uint32_t* wave, double tau2, Span<const Eigen::Vector3d> responses) {
  pass_on(0, responses, wave);
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  for (std::uint32_t i = responses.size(); i-- > 0;) {
    const Eigen::Vector3d to = passed(i);
    out += left_of(wave, tau2, i) * to * to.transpose();
  }
  return out;
}

void UnevenPlane::read(Span<const SurfacePatch> patches) {
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& p = patches[i];
    values_[i] = {{1.0F, static_cast<float>(p.u), static_cast<float>(p.v), static_cast<float>(p.residual),
                   static_cast<float>(p.bias)},
                  static_cast<float>(p.noise_variance)};
  }
}

UnevenPlane::Models UnevenPlane::models_of(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses) {
  Models models;
  if (patches.size() < kPatchesMin) return models;
  const double tau2 = unevenness(patches);
  read(patches);
  consider_independent(patches, responses, tau2, &models);
  if (tau2 > 0.0) {
    if (!matern_filled_) fill_matern();
    find_neighbours(patches.size(), patches.size());
    consider_waves(patches, responses, tau2, &models);
  }
  return models;
}

// Passes each response from the first on to the heights that predict its own; those before it have none of their own.
// wave: nullptr without waves, where no height tells of another.
void UnevenPlane::pass_on(std::uint32_t first, Span<const Eigen::Vector3d> responses, const std::uint32_t* wave) {
  for (std::uint32_t i = 0; i < responses.size(); ++i) {
    const Eigen::Vector3f to = i < first ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : responses[i].cast<float>();
    passed_[i] = FourFloats{to.x(), to.y(), to.z(), 0.0F};
  }
  for (std::uint32_t i = responses.size(); wave != nullptr && i-- > first;) {
    for (std::uint32_t k = 0; k < kNeighbours; ++k) {
      const std::uint16_t at = neighbours_[i * kNeighbours + k];
      if (at != kNone) passed_[at] += predicts_[(*wave * kFours + i / kFour) * kNeighbours + k][i % kFour] * passed_[i];
    }
  }
}

Eigen::Vector3d UnevenPlane::passed(std::uint32_t i) const {
  return {static_cast<double>(passed_[i][0]), static_cast<double>(passed_[i][1]), static_cast<double>(passed_[i][2])};
}

// Variance of a height that its neighbours leave, before it is scaled.
double UnevenPlane::left_of(const std::uint32_t* wave, double tau2, std::uint32_t i) const {
  return wave != nullptr ? static_cast<double>(left_[*wave * kFours + i / kFour][i % kFour]) : tau2;
}

// Turns a model's endless plane into the region's. What is not seen is what its neighbours predict, beside the plane.
void UnevenPlane::complete(Span<const SurfacePatch> patches, std::uint32_t seen, Span<const Eigen::Vector3d> responses,
                           const std::uint32_t* wave, double tau2, Model* model) {
  model->about_endless = model->scale * passed_on(wave, tau2, responses);
  pass_on(seen, responses, wave);
  Eigen::Matrix3d unknown = Eigen::Matrix3d::Zero();
  model->of_endless.setZero();
  model->of_seen.setZero();
  model->bias_of_seen.setZero();
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& p = patches[i];
    const Eigen::Vector3d by_waves = passed(i);
    const Eigen::RowVector3d row(1.0, p.u, p.v);
    if (i >= seen) {
      unknown += left_of(wave, tau2, i) * by_waves * by_waves.transpose();
      model->of_endless += responses[i] * row;
      continue;
    }
    model->of_endless -= by_waves * row;
    model->of_seen += p.residual * (responses[i] + by_waves);
    model->bias_of_seen += p.bias * (responses[i] + by_waves);
    unknown += p.noise_variance * responses[i] * responses[i].transpose();
  }
  model->unknown = model->scale * unknown;
  model->stand_on(Model(*model));
}

// The region's plane through such a surface, less what is predicted of it. After pass_on().
Eigen::Matrix<double, 3, 2> UnevenPlane::missing_of_bend(Span<const SurfacePatch> patches, std::uint32_t seen,
                                                         Span<const Eigen::Vector3d> responses,
                                                         const std::uint32_t* wave) const {
  using Row = Eigen::Matrix<double, 1, 5>;  // 1, u, v, u², v²
  const auto row_of = [&](std::uint32_t i) {
    const SurfacePatch& p = patches[i];
    Row row;
    row << 1.0, p.u, p.v, p.u * p.u, p.v * p.v;
    return row;
  };
  Eigen::Matrix<double, 3, 5> squares = Eigen::Matrix<double, 3, 5>::Zero();
  Eigen::Matrix<double, 3, 2> missing = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix3d by_plane = Eigen::Matrix3d::Zero();
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    const Row row = row_of(i);
    if (i >= seen) {
      missing += responses[i] * row.tail<2>();
      by_plane += responses[i] * row.head<3>();
      continue;
    }
    missing -= passed(i) * row.tail<2>();
    by_plane -= passed(i) * row.head<3>();
    Row whitened = row;
    double left = 1.0;
    if (wave != nullptr) {
      const std::uint32_t four = *wave * kFours + i / kFour, lane = i % kFour;
      for (std::uint32_t k = 0; k < kNeighbours; ++k) {
        const std::uint16_t at = neighbours_[i * kNeighbours + k];
        if (at != kNone) whitened -= static_cast<double>(predicts_[four * kNeighbours + k][lane]) * row_of(at);
      }
      left = static_cast<double>(left_[four][lane]);
    }
    squares += whitened.head<3>().transpose() * whitened / left;
  }
  const Eigen::Matrix3d inverse = squares.leftCols<3>().inverse();
  missing -= by_plane * (inverse * squares.rightCols<2>());
  return missing;
}

PredictedPlane UnevenPlane::predict(Span<const SurfacePatch> patches, std::uint32_t seen,
                                    Span<const Eigen::Vector3d> responses, const UnevenFit& endless, double sigmas) {
  PredictedPlane out;
  Models models;
  const Span<const SurfacePatch> of_seen(patches.data(), seen);
  if (seen < kPatchesMin) return out;
  const double tau2 = unevenness(of_seen), freedom = static_cast<double>(seen) - 3.0;
  read(patches);
  consider_independent(of_seen, {}, tau2, &models);
  if (models.evidence.solved[0]) complete(patches, seen, responses, nullptr, tau2, &models.of[0]);
  std::uint32_t likeliest = 0;
  if (tau2 > 0.0) {
    if (!matern_filled_) fill_matern();
    find_neighbours(patches.size(), seen);
    WaveSums sums;
    sum_waves(patches.size(), seen, kLengths, tau2, &sums);
    for (std::uint32_t wave = 0; wave < kWaves; ++wave) {
      Model& model = models.of[1 + wave];
      if (!sums.of[wave].solve(static_cast<double>(seen), &model)) continue;
      models.count(1 + wave);
      complete(patches, seen, responses, &wave, tau2, &model);
      const bool likelier = !models.evidence.solved[likeliest] ||
                            models.evidence.log_likelihood[1 + wave] > models.evidence.log_likelihood[likeliest];
      if (likelier) likeliest = 1 + wave;
    }
  }
  static_cast<UnevenFit&>(out) = models.average(freedom, sigmas);
  if (!out.solved) return out;
  out.about_endless = models.average(&Model::about_endless);
  out.of_endless = models.average(&Model::of_endless);
  const std::uint32_t wave = likeliest - 1;
  pass_on(seen, responses, likeliest > 0 ? &wave : nullptr);
  out.missing_of_bend = missing_of_bend(patches, seen, responses, likeliest > 0 ? &wave : nullptr);
  if (endless.solved) out.by_endless = models.standing_on(endless, out.of_endless, freedom, sigmas);
  return out;
}

UnevenFit UnevenPlane::fit(Span<const SurfacePatch> patches, double sigmas) {
  return models_of(patches, {}).average(static_cast<double>(patches.size()) - 3.0, sigmas);
}

LinearErrors UnevenPlane::errors_of(Span<const SurfacePatch> patches, Span<const Eigen::Vector3d> responses) {
  const Models models = models_of(patches, responses);
  LinearErrors out;
  out.freedom = static_cast<double>(patches.size()) - 3.0;
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    if (models.evidence.solved[k]) out.set(k, models.of[k].log_likelihood, models.of[k].covariance);
  }
  out.weigh(WaveEvidence{});
  return out;
}

}  // namespace pose_wall
