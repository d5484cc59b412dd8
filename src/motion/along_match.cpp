// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/along_match.hpp"

#include <cmath>

#include "base/estimation/small_cholesky.hpp"
#include "base/math/finite.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall::motion {
namespace {

// Of the curve against the rows' levels. Levels and curve follow from each other, and settle in a few rounds: with 6
// the sweep measured as many frames as with 1.
constexpr int kRounds = 3;
constexpr double kNobodyKnows = 1e3;  // cost of a shift at which the map knows no row
// Common to all ranges of a sensor, at most (range_bias_max of the engine). Map and scan hold it alike but for how they
// were met, and that is a pattern which travels with the machine.
constexpr float kRangeBias_m = 0.03F;
// A third of the 10 cm in which rock of half a metre's roughness length bends the curve.
constexpr double kFineReach_m = 0.036;

float unknown() {
  return static_cast<float>(not_a_number());
}
bool is_known(float value) {
  return value == value;
}

// Squared deviations: more is of another surface.
float outlier2() {
  return static_cast<float>(limit_of<gate::OUTLIER>());
}

float incidence_of(const Eigen::Vector3f& ray, const Eigen::Vector3f& normal) {
  return ray.dot(normal) / std::sqrt(ray.squaredNorm());
}

using Rest = Eigen::Matrix<double, kRest, 1>;
using RestByRest = Eigen::Matrix<double, kRest, kRest>;

class CurveBuilder {
 public:
  CurveBuilder(const Scan& scan, const Alignment& alignment, double reach_m, std::uint32_t shifts,
               CurveScratch* scratch)
      : scan_(scan), alignment_(alignment), shifts_(shifts), step_m_(2.0 * reach_m / (shifts - 1)), s_(scratch) {}

  double shift_m(std::uint32_t k) const { return step_m_ * (static_cast<double>(k) - 0.5 * (shifts_ - 1)); }
  // Parabolas of the rows, summed by halves of the patches: f = slope x + bend x^2 / 2. And the patches' squared
  // slopes.
  struct Parabolas {
    double slope[2] = {}, bend[2] = {}, slope_squares = 0.0;
  };
  Parabolas parabolas() {
    Parabolas sum;
    s_->gain.first(patches_).fill(0.0F);
    double x2 = 0.0, x4 = 0.0;
    for (std::uint32_t k = 0; k < shifts_; ++k) {
      const double x = shift_m(k);
      x2 += x * x;
      x4 += x * x * x * x;
    }
    const double spread = x4 - x2 * x2 / shifts_;
    for (std::uint32_t row = 0; row < rows_; ++row) {
      double own = 0.0, own_bend = 0.0;
      bool whole = true;
      for (std::uint32_t k = 0; k < shifts_ && whole; ++k) {
        const double x = shift_m(k), c = static_cast<double>(s_->misfit[k * kRowsMost + row]);
        whole = is_known(s_->misfit[k * kRowsMost + row]);
        own += x * c / x2;
        own_bend += 2.0 * (x * x - x2 / shifts_) * c / spread;
      }
      if (!whole) continue;
      const int half = half_of(row);
      sum.slope[half] += own;
      sum.bend[half] += own_bend;
      s_->gain[s_->patch[row]] += static_cast<float>(own);
    }
    for (std::uint32_t p = 0; p < patches_; ++p) {
      const double g = static_cast<double>(s_->gain[p]);
      sum.slope_squares += g * g;
    }
    return sum;
  }
  double step_m() const { return step_m_; }
  std::uint32_t rows() const { return rows_; }

  // Misfits at every shift, and how each goes with the rest, of at most so many observations.
  void measure(std::uint32_t rows_most) {
    rows_ = 0;
    const std::uint32_t count = scan_.observation.size();
    const std::uint32_t stride = count / rows_most + 1;
    const Eigen::Vector3f axis[3] = {alignment_.axes.along.cast<float>(), alignment_.axes.left.cast<float>(),
                                     alignment_.axes.up.cast<float>()};
    const LocalPose local(alignment_.pose, scan_.map->corner());
    for (std::uint32_t i = 0; i < count && rows_ < rows_most; i += stride) {
      if (measure_row(scan_.observation[i], local, axis)) ++rows_;
    }
    fill_up();
    number_patches();
  }

  // Subtracts the best fit of the rest at each shift from the misfits. The fit follows the shifts from the middle
  // outwards, so that each shift is judged by the misfits that the rest leaves. In a bend the far rows are beyond any
  // cap before.
  void fit_the_rest() {
    const std::int32_t middle = static_cast<std::int32_t>(shifts_ / 2), end = static_cast<std::int32_t>(shifts_);
    const Rest by = fit_at(middle, Rest::Zero());
    for (const std::int32_t side : {-1, 1}) {
      Rest before = by, last = by;
      for (std::int32_t k = middle + side; k >= 0 && k < end; k += side) {
        const Rest now = fit_at(k, 2.0 * last - before);
        before = last;
        last = now;
      }
    }
  }

  void square() {
    const float most = outlier2();
    for (std::uint32_t k = 0; k < shifts_; ++k) {
      for (std::uint32_t row = 0; row < rows_; ++row) {
        float& c = s_->misfit[k * kRowsMost + row];
        if (is_known(c)) c = c * c < most ? c * c : most;
      }
    }
  }

  // Costs by shift, each row about its own level: which rows the map knows at a shift is a pattern of the sensor's
  // rings and decides nothing. Gives the mean level.
  double curve(double (&f)[kShiftsMost]) {
    for (double& value : f) value = 0.0;
    double level = 0.0;
    for (int round = 0; round < kRounds; ++round) {
      double sum[kShiftsMost] = {}, known[kShiftsMost] = {}, levels = 0.0;
      level = 0.0;
      for (std::uint32_t row = 0; row < rows_; ++row) {
        double own;
        if (!level_of(row, f, &own)) continue;
        level += own;
        levels += 1.0;
        for (std::uint32_t k = 0; k < shifts_; ++k) {
          const float c = s_->misfit[k * kRowsMost + row];
          if (is_known(c)) sum[k] += static_cast<double>(c) - own, known[k] += 1.0;
        }
      }
      for (std::uint32_t k = 0; k < shifts_; ++k) f[k] = known[k] > 0.0 ? sum[k] / known[k] : kNobodyKnows;
      level = levels > 0.0 ? level / levels : 0.0;
    }
    return level;
  }

  // By how much each tile's rows fit better at one shift than at another, or than at all others (kElsewhere): the sum
  // over its standard error. Under no evidence it is a standard normal number, however uneven the tiles are (self-
  // normalised sums: de la Pena, Lai and Shao 2009). Tiles that face along are asked apart as well: in a hall they are
  // few, and all others only add their noise, but must not contradict. Where both kinds tell, their sum does
  // (Stouffer). The largest of three such numbers is more than a limit three times as often.
  static constexpr std::uint32_t kElsewhere = 0xFFFF;
  struct Vote {
    std::uint32_t rows;  // known at both
    double deviations;
  };
  Vote agreement(std::uint32_t best, std::uint32_t other) {
    std::uint32_t rows = 0;
    s_->gain.first(patches_).fill(0.0F);
    for (std::uint32_t row = 0; row < rows_; ++row) {
      const float here = s_->misfit[best * kRowsMost + row];
      if (!is_known(here)) continue;
      const float there = other == kElsewhere ? mean_away_from(best, row) : s_->misfit[other * kRowsMost + row];
      if (!is_known(there)) continue;
      s_->gain[s_->patch[row]] += there - here;
      ++rows;
    }
    double sum[2] = {}, squares[2] = {1e-9, 1e-9};  // of tiles along the road, and of those that face along
    for (std::uint32_t p = 0; p < patches_; ++p) {
      // By its root, with its sign: one prop that stands out of the rock is one patch's word, too.
      const double g = static_cast<double>(s_->gain[p]), size = std::fabs(g);
      if (!(size > 0.0)) continue;
      sum[s_->faces[p]] += g > 0.0 ? std::sqrt(size) : -std::sqrt(size);
      squares[s_->faces[p]] += size;
    }
    return {rows, deviations_of(sum, squares)};
  }

 private:
  static double deviations_of(const double (&sum)[2], const double (&squares)[2]) {
    const double of_all = (sum[0] + sum[1]) / std::sqrt(squares[0] + squares[1]);
    const double of_rest = sum[0] / std::sqrt(squares[0]), of_faces = sum[1] / std::sqrt(squares[1]);
    if (of_faces == 0.0 || of_rest == 0.0) return of_all;  // there is one kind
    const double of_both = larger(of_all, (of_faces + of_rest) / std::sqrt(2.0));
    return of_rest < -limit_of<gate::EXCLUDED>() ? of_both : larger(of_both, of_faces);
  }

  // From the expected rest at this shift.
  Rest fit_at(std::int32_t shift, const Rest& expected) {
    float* const misfits = &s_->misfit[static_cast<std::uint32_t>(shift) * kRowsMost];
    take_off(expected, misfits);
    RestByRest A = RestByRest::Identity() * 1e-3;
    A(kRest - 1, kRest - 1) = 1.0;  // the range error is known to within its bound
    Rest b = Rest::Zero();
    b[kRest - 1] = -expected[kRest - 1];
    sum_up(misfits, &A, &b);
    const SmallCholesky<kRest> factor(A);
    if (!factor.solved()) return expected;
    const Rest by = factor.solve(b);
    take_off(by, misfits);
    return expected + by;
  }

  // Normal equations of the rest at one shift, four rows at once.
  void sum_up(const float* misfits, RestByRest* A, Rest* b) const {
    const FourFloats zero = all_four(0.0F);
    const float most = outlier2();
    FourFloats squares[kRest * (kRest + 1) / 2], pulls[kRest];
    for (FourFloats& four : squares) four = zero;
    for (FourFloats& four : pulls) four = zero;
    for (std::uint32_t row = 0; row < rows_; row += kFour) {
      const FourFloats misfit = load_four(misfits + row);
      const FourTruths counts = misfit * misfit < most;
      const FourFloats known = counts ? misfit : zero;
      FourFloats J[kRest];
      for (int i = 0, n = 0; i < kRest; ++i) {
        const FourFloats all = load_four(jacobian(i) + row);
        J[i] = counts ? all : zero;
        for (int j = 0; j <= i; ++j) squares[n++] += J[i] * J[j];
        pulls[i] -= J[i] * known;
      }
    }
    for (int i = 0, n = 0; i < kRest; ++i) {
      for (int j = 0; j <= i; ++j) (*A)(i, j) += sum_of_lanes(squares[n++]);
      for (int j = 0; j < i; ++j) (*A)(j, i) = (*A)(i, j);
      (*b)[i] += sum_of_lanes(pulls[i]);
    }
  }

  void take_off(const Rest& rest, float* misfits) const {
    const Eigen::Matrix<float, kRest, 1> by = rest.cast<float>();
    for (std::uint32_t row = 0; row < rows_; row += kFour) {
      FourFloats misfit = load_four(misfits + row);
      for (int i = 0; i < kRest; ++i) misfit += load_four(jacobian(i) + row) * by[i];
      store_four(misfit, misfits + row);  // unknown stays so
    }
  }

  // How rows go with the i-th of the rest.
  float* jacobian(int i) const { return &s_->jacobian[static_cast<std::uint32_t>(i) * kRowsMost]; }

  // The last four rows are whole: those behind the last are known nowhere.
  void fill_up() const {
    for (std::uint32_t row = rows_; row % kFour != 0; ++row) {
      for (std::uint32_t k = 0; k < shifts_; ++k) s_->misfit[k * kRowsMost + row] = unknown();
      for (int i = 0; i < kRest; ++i) jacobian(i)[row] = 0.0F;
    }
  }

  // Rows lie on few of a map's tiles.
  void number_patches() {
    constexpr std::uint16_t kNone = 0xFFFF;  // no row lies there; a map has fewer tiles
    const Span<std::uint16_t> patch_of = s_->patch_of.first(scan_.map->tiles());
    patch_of.fill(kNone);
    for (std::uint32_t row = 0; row < rows_; ++row) patch_of[s_->tile[row]] = 0;
    patches_ = 0;
    const Eigen::Vector3f along = alignment_.axes.along.cast<float>();
    for (std::uint32_t tile = 0; tile < patch_of.size(); ++tile) {
      if (patch_of[tile] == kNone) continue;
      s_->faces[patches_] = faces_along(scan_.map->tile(tile).normal(), along) ? 1 : 0;
      patch_of[tile] = static_cast<std::uint16_t>(patches_++);
    }
    for (std::uint32_t row = 0; row < rows_; ++row) s_->patch[row] = patch_of[s_->tile[row]];
  }

  int half_of(std::uint32_t row) const { return static_cast<int>((s_->tile[row] * 0x9E3779B1U) >> 31U); }

  // Its mean over the shifts at which the map knows it, with the curve taken off.
  bool level_of(std::uint32_t row, const double (&f)[kShiftsMost], double* level) const {
    double sum = 0.0, n = 0.0;
    for (std::uint32_t k = 0; k < shifts_; ++k) {
      const float c = s_->misfit[k * kRowsMost + row];
      if (is_known(c)) sum += static_cast<double>(c) - f[k], n += 1.0;
    }
    *level = sum / n;
    return n > 1.0;
  }

  float mean_away_from(std::uint32_t best, std::uint32_t row) const {
    float sum = 0.0F, n = 0.0F;
    for (std::uint32_t k = 0; k < shifts_; ++k) {
      const std::uint32_t away = k > best ? k - best : best - k;
      const float c = s_->misfit[k * kRowsMost + row];
      if (away >= 3 && is_known(c)) sum += c, n += 1.0F;
    }
    return n > 0.0F ? sum / n : unknown();
  }

  bool measure_row(const Observation& o, const LocalPose& local, const Eigen::Vector3f (&axis)[3]) {
    Fit fit;
    if (!fit_observation(scan_, local, o, &fit) || fit.surface.tile->stands_free != 0) return false;
    // A surface facing along gives the way by its plane alone.
    const bool faces = faces_along(fit.normal, axis[0]);
    if (faces && !alignment_.axes.tell_along()) return false;
    const float weight = 1.0F / std::sqrt(fit.variance_m2);
    const Eigen::Vector3f lever = (fit.p - local.t).cross(fit.normal);
    for (int k = 0; k < 3; ++k) jacobian(k)[rows_] = axis[k].dot(lever) * weight;
    jacobian(3)[rows_] = axis[1].dot(fit.normal) * weight;
    jacobian(4)[rows_] = axis[2].dot(fit.normal) * weight;
    const Eigen::Vector3f ray = fit.p - local(scan_.sensor_base_m);
    const Eigen::Vector3f before = fit.p - scan_.map->seen_from(*fit.surface.tile);
    jacobian(5)[rows_] = kRangeBias_m * weight * (incidence_of(ray, fit.normal) - incidence_of(before, fit.normal));
    s_->tile[rows_] = static_cast<std::uint16_t>(scan_.map->index_of(fit.surface.tile));
    const Shifts shifts = {axis[0], static_cast<float>(shift_m(0)), static_cast<float>(step_m_), shifts_};
    const std::uint32_t known = fit_shifted(scan_, fit, shifts, faces, kRowsMost, &s_->misfit[rows_]);
    return known > shifts_ / 2;
  }

  const Scan& scan_;
  const Alignment& alignment_;
  std::uint32_t shifts_;
  double step_m_;
  CurveScratch* s_;
  std::uint32_t rows_ = 0, patches_ = 0;
};

std::uint32_t least_of(const double (&f)[kShiftsMost], std::uint32_t shifts) {
  std::uint32_t best = 0;
  for (std::uint32_t k = 1; k < shifts; ++k) {
    if (f[k] < f[best]) best = k;
  }
  return best;
}

// Of the parabola through the least and its neighbours, in steps from the least.
double vertex(const double (&f)[kShiftsMost], std::uint32_t at, std::uint32_t shifts) {
  if (at == 0 || at + 1 >= shifts) return 0.0;
  const double bend = f[at - 1] - 2.0 * f[at] + f[at + 1];
  return bend > 0.0 ? 0.5 * (f[at - 1] - f[at + 1]) / bend : 0.0;
}

double median_of(const double (&f)[kShiftsMost], std::uint32_t shifts) {
  double sorted[kShiftsMost] = {};
  for (std::uint32_t k = 0; k < shifts; ++k) {
    std::uint32_t at = k;
    for (; at > 0 && sorted[at - 1] > f[k]; --at) sorted[at] = sorted[at - 1];
    sorted[at] = f[k];
  }
  return sorted[shifts / 2];
}

// The next lowest valley that a ridge parts from the lowest.
void find_second(const double (&f)[kShiftsMost], std::uint32_t shifts, std::uint32_t best, double median, double step_m,
                 Curve* curve) {
  const double depth = median - f[best];
  for (std::uint32_t k = 1; k + 1 < shifts; ++k) {
    const std::uint32_t away = k > best ? k - best : best - k;
    if (away < 3 || !(f[k] <= f[k - 1] && f[k] <= f[k + 1]) || !(depth > 0.0)) continue;
    const double gain = (median - f[k]) / depth;
    if (!(gain > curve->second_gain)) continue;
    curve->second_gain = gain;
    curve->second_m = step_m * (static_cast<double>(k) - static_cast<double>(best));
  }
}

}  // namespace

bool is_evidence(const Curve& curve) {
  return curve.told && !curve.open && passes<gate::EVIDENCE>(curve.patches);
}

void CurveScratch::lay_out(Arena& arena) {
  misfit = arena.take<float>(kShiftsMost * kRowsMost);
  jacobian = arena.take<float>(kRest * kRowsMost);
  tile = arena.take<std::uint16_t>(kRowsMost);
  patch = arena.take<std::uint16_t>(kRowsMost);
  patch_of = arena.take<std::uint16_t>(kTilesMost);
  faces = arena.take<std::uint8_t>(kRowsMost);
  gain = arena.take<float>(kRowsMost);
}

namespace {

// Walks from the best shift to both sides while the patches exclude nothing, then looks beyond.
void find_rivals(CurveBuilder* builder, std::uint32_t best, std::uint32_t shifts, Curve* out) {
  for (const int side : {-1, 1}) {
    bool apart = false;
    for (std::int32_t k = static_cast<std::int32_t>(best) + side; k >= 0 && k < static_cast<std::int32_t>(shifts);
         k += side) {
      // Planes end with their layer: where hardly a row is left, nothing is told.
      const CurveBuilder::Vote vote = builder->agreement(best, static_cast<std::uint32_t>(k));
      if (vote.rows < static_cast<std::uint32_t>(limit_of<gate::ROWS>())) continue;
      if (passes<gate::EXCLUDED>(vote.deviations)) {
        apart = true;
        continue;
      }
      const double away_m = std::fabs(builder->shift_m(static_cast<std::uint32_t>(k)) - builder->shift_m(best));
      double& furthest_m = apart ? out->apart_m : out->around_m;
      if (away_m > furthest_m) furthest_m = away_m;
    }
    out->open = out->open || !apart;
  }
}

}  // namespace

Curve match_along(const Scan& scan, const Alignment& alignment, double reach_m, std::uint32_t shifts,
                  CurveScratch* scratch, std::uint32_t rows_most) {
  Curve out;
  CurveBuilder builder(scan, alignment, reach_m, shifts, scratch);
  builder.measure(rows_most);
  if (!passes<gate::ROWS>(builder.rows())) return out;
  builder.fit_the_rest();
  builder.square();
  double f[kShiftsMost];
  const double level = builder.curve(f);
  const std::uint32_t best = least_of(f, shifts);
  const double median = median_of(f, shifts), bottom = level + f[best];
  out.told = true;
  out.bottom = bottom;
  out.best_m = builder.shift_m(best) + builder.step_m() * vertex(f, best, shifts);
  out.contrast = bottom > 0.0 ? (median - f[best]) / bottom : 0.0;
  out.patches = builder.agreement(best, CurveBuilder::kElsewhere).deviations;
  find_second(f, shifts, best, median, builder.step_m(), &out);
  find_rivals(&builder, best, shifts, &out);
  return out;
}

FinePlace refine_along(const Scan& scan, const Alignment& alignment, CurveScratch* scratch) {
  FinePlace out;
  CurveBuilder builder(scan, alignment, kFineReach_m, kFineShifts, scratch);
  builder.measure(kRowsMost);
  builder.fit_the_rest();
  builder.square();
  const CurveBuilder::Parabolas p = builder.parabolas();
  const double bend = p.bend[0] + p.bend[1];
  if (!(bend > 0.0)) return out;
  out.best_m = -(p.slope[0] + p.slope[1]) / bend;
  out.told = std::fabs(out.best_m) < kFineReach_m;
  if (!out.told) return out;
  // Two estimates of one variance: by all patches as if they were many, and by two halves however few they are. Either
  // has heavy tails, so half as much again (frames beyond five sigma: 2 of 150 in an arch without).
  constexpr double kTails = 1.5;
  const bool both = p.bend[0] > 0.0 && p.bend[1] > 0.0;
  if (both) out.halves_m = std::fabs(p.slope[0] / p.bend[0] - p.slope[1] / p.bend[1]);
  // One half that tells nothing by itself contradicts nothing: the place is known to within a step of the curve.
  const double of_halves = both ? 0.5 * out.halves_m : kCurveStep_m;
  out.sigma_m = std::sqrt(kTails * 0.5 * (p.slope_squares / (bend * bend) + of_halves * of_halves));
  return out;
}

}  // namespace pose_wall::motion
