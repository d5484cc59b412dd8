// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/scan_turn.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kMoments = 180;  // of a scan: 2 deg of a turn each, below the spread of the beams
// A twentieth of a turn: beams look up to 8 deg beside the sensor's azimuth (HDL-64E manual, Ouster's metadata).
constexpr double kOffTurn_rad = 18.0 * kRadPerDeg;

double wrapped_rad(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * M_PI);
}

// Directions are summed up by moment.
struct Moment {
  double cos = 0.0, sin = 0.0, count = 0.0;
  double angle() const { return std::atan2(sin, cos); }
};
using Moments = std::array<Moment, kMoments>;

Moments moments_of(const std::vector<TimedReturn>& returns, double spread_s) {
  Moments moments{};
  for (const TimedReturn& one : returns) {
    const auto at = static_cast<std::size_t>(one.time_s / spread_s * static_cast<double>(kMoments));
    Moment& moment = moments[std::min(at, kMoments - 1)];
    moment.cos += std::cos(one.azimuth_rad);
    moment.sin += std::sin(one.azimuth_rad);
    moment.count += 1.0;
  }
  return moments;
}

// By neighbouring moments: a gap without returns may hide any angle.
double first_rate(const Moments& moments, double moment_s) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < kMoments; ++k) {
    if (moments[k].count == 0.0 || moments[k - 1].count == 0.0) continue;
    steps.push_back(wrapped_rad(moments[k].angle() - moments[k - 1].angle()));
  }
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle / moment_s;
}

// A line through the moments, each with the weight of its returns; those far off it have none in the second round.
void fit_line(const Moments& moments, double moment_s, Turn* turn) {
  turn->rate_rad_s = first_rate(moments, moment_s);
  double cos = 0.0, sin = 0.0;
  const auto time_s = [moment_s](std::size_t k) { return (static_cast<double>(k) + 0.5) * moment_s; };
  for (std::size_t k = 0; k < kMoments; ++k) {
    const double off = moments[k].angle() - turn->rate_rad_s * time_s(k);
    cos += moments[k].count * std::cos(off);
    sin += moments[k].count * std::sin(off);
  }
  turn->phase_rad = std::atan2(sin, cos);
  for (int round = 0; round < 2; ++round) {
    double w = 0.0, t = 0.0, a = 0.0, tt = 0.0, ta = 0.0;
    for (std::size_t k = 0; k < kMoments; ++k) {
      const double off = wrapped_rad(moments[k].angle() - turn->phase_rad - turn->rate_rad_s * time_s(k));
      if (round > 0 && std::fabs(off) > kOffTurn_rad) continue;
      const double n = moments[k].count;
      w += n, t += n * time_s(k), a += n * off, tt += n * time_s(k) * time_s(k), ta += n * time_s(k) * off;
    }
    const double spread = w * tt - t * t;
    if (!(spread > 0.0)) return;
    turn->rate_rad_s += (w * ta - t * a) / spread;
    turn->phase_rad += (a * tt - t * ta) / spread;
  }
}

double off_line(const TimedReturn& one, const Turn& turn) {
  return wrapped_rad(one.azimuth_rad - turn.phase_rad - turn.rate_rad_s * one.time_s);
}

// What is known of a return's azimuth: first what a sound sensor may show (a rate a little other, a centre beside the
// cloud's origin, an axis that leans a little), then what a motion that was taken out leaves, by speed and turn.
constexpr int kSound = 6, kMoved = 4, kColumns = kSound + kMoved;
using SolverRow = Eigen::Matrix<double, kColumns + 1, 1>;  // and the angle itself

SolverRow solver_row(const TimedReturn& one, const Turn& turn, double middle_s) {
  const double dt = one.time_s - middle_s, c = std::cos(one.azimuth_rad), s = std::sin(one.azimuth_rad);
  const double near = 1.0 / one.across_m, up = std::tan(one.elevation_rad);
  SolverRow row;
  row << dt, near, near * s, near * c, up * c, up * s, -near * s * dt, near * c * dt, up * c * dt, up * s * dt,
      off_line(one, turn);
  return row;
}

// Each ring looks a little beside the sensor's azimuth: its mean is taken out.
std::vector<SolverRow> solver_rows(const std::vector<TimedReturn>& returns, const Turn& turn, double middle_s) {
  // Nearer things are the machine's, and steep beams turn round the axis too closely. Judgement, 2026-11-27.
  constexpr double kNearest_m = 0.5, kSteepest_rad = 1.0;
  std::map<std::uint32_t, std::pair<SolverRow, double>> means;
  std::vector<std::pair<std::uint32_t, SolverRow>> all;
  for (const TimedReturn& one : returns) {
    if (one.across_m < kNearest_m || std::fabs(one.elevation_rad) > kSteepest_rad) continue;
    const SolverRow row = solver_row(one, turn, middle_s);
    if (std::fabs(row[kColumns]) > kOffTurn_rad) continue;
    auto [mean, is_new] = means.try_emplace(one.ring, SolverRow::Zero(), 0.0);
    mean->second.first += row;
    mean->second.second += 1.0;
    all.emplace_back(one.ring, row);
  }
  std::vector<SolverRow> rows;
  rows.reserve(all.size());
  for (const auto& [ring, row] : all) rows.push_back(row - means[ring].first / means[ring].second);
  return rows;
}

struct Fit {
  Eigen::Matrix<double, kColumns, 1> by = Eigen::Matrix<double, kColumns, 1>::Zero();
  double rms_rad = 0.0;
};

// By the first `columns` of them.
Fit fit_of(const std::vector<SolverRow>& rows, int columns) {
  Eigen::Matrix<double, kColumns, kColumns> A = Eigen::Matrix<double, kColumns, kColumns>::Zero();
  Eigen::Matrix<double, kColumns, 1> b = Eigen::Matrix<double, kColumns, 1>::Zero();
  for (const SolverRow& row : rows) {
    A.noalias() += row.head<kColumns>() * row.head<kColumns>().transpose();
    b += row.head<kColumns>() * row[kColumns];
  }
  Fit fit;
  fit.by.head(columns) = A.topLeftCorner(columns, columns).ldlt().solve(b.head(columns));
  double sum = 0.0;
  for (const SolverRow& row : rows) {
    const double off = row[kColumns] - row.head<kColumns>().dot(fit.by);
    sum += off * off;
  }
  fit.rms_rad = std::sqrt(sum / std::max(1.0, static_cast<double>(rows.size())));
  return fit;
}

}  // namespace

Turn turn_of(const std::vector<TimedReturn>& returns, double spread_s) {
  Turn turn;
  const Moments moments = moments_of(returns, spread_s);
  double together = 0.0;
  for (const Moment& moment : moments) together += std::hypot(moment.cos, moment.sin);
  turn.off_moment = 1.0 - together / static_cast<double>(returns.size());
  fit_line(moments, spread_s / static_cast<double>(kMoments), &turn);
  const auto off = std::count_if(returns.begin(), returns.end(), [&turn](const TimedReturn& one) {
    return std::fabs(off_line(one, turn)) > kOffTurn_rad;
  });
  turn.off_turn = static_cast<double>(off) / static_cast<double>(returns.size());
  return turn;
}

double lean_rad(const std::vector<TimedReturn>& returns) {
  struct Sums {
    double count = 0.0, sum = 0.0, squares = 0.0;
  };
  std::map<std::uint32_t, Sums> rings;
  for (const TimedReturn& one : returns) {
    Sums& ring = rings[one.ring];
    ring.count += 1.0;
    ring.sum += one.elevation_rad;
    ring.squares += one.elevation_rad * one.elevation_rad;
  }
  double within = 0.0;
  for (const auto& [number, ring] : rings) within += ring.squares - ring.sum * ring.sum / ring.count;
  return std::sqrt(std::max(0.0, within) / static_cast<double>(returns.size()));
}

std::optional<double> moved_m_s(const std::vector<TimedReturn>& returns, const Turn& turn, double spread_s) {
  constexpr std::size_t kLeast = 1000;       // returns, for eight unknowns
  constexpr double kShows_rad = 2.0e-4;      // 0.01 deg: what floats and the sensor's encoder leave of a sound scan
  constexpr double kExplained_rad = 3.5e-3;  // 0.2 deg: more that stays unexplained, and it is something else
  constexpr double kShareExplained = 0.6;    // of the squares. All three: judgement, 2026-11-27; tests/tools
  constexpr double kLeast_m_s = 0.1;         // a centimetre a scan at 10 Hz: below it costs little
  std::vector<SolverRow> rows = solver_rows(returns, turn, 0.5 * spread_s);
  if (rows.size() < kLeast) return std::nullopt;
  const Fit rough = fit_of(rows, kColumns);
  rows.erase(std::remove_if(rows.begin(), rows.end(),
                            [&rough](const SolverRow& row) {
                              return std::fabs(row[kColumns] - row.head<kColumns>().dot(rough.by)) >
                                     3.0 * rough.rms_rad + 1e-9;
                            }),
             rows.end());
  if (rows.size() < kLeast) return std::nullopt;
  const Fit sound = fit_of(rows, kSound), moved = fit_of(rows, kColumns);
  const double left = moved.rms_rad / std::max(sound.rms_rad, 1e-12);
  const double speed_m_s = std::hypot(moved.by[kSound], moved.by[kSound + 1]);
  const bool is_moved = sound.rms_rad > kShows_rad && moved.rms_rad < kExplained_rad &&
                        1.0 - left * left > kShareExplained && speed_m_s > kLeast_m_s;
  return is_moved ? std::optional<double>(speed_m_s) : std::nullopt;
}

}  // namespace pose_wall::tools
