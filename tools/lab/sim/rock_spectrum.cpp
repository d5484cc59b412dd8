// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/rock_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "lab/sim/survey_truth.hpp"

namespace pose_wall::tools::sim {
namespace {

// About half an octave apart, from what a dense scan resolves to twice what a wall is fitted over.
constexpr std::array<double, RockSpectra::kLengths> kSpectrumLengths_m = {0.1, 0.15, 0.2, 0.3, 0.5, 0.8,
                                                                          1.2, 2.0,  3.0, 4.5, 6.0, 10.0};
constexpr int kSamples = 17;                // of a stretch: sixteen steps show all that is longer than an eighth of it
constexpr std::size_t kFewestSamples = 13;  // a hole of a quarter
constexpr double kBroken_m = 0.5;           // between two samples: an opening, no rock that bulges
constexpr double kRough = 0.9;

// What the straight line through the samples' ranges leaves, by least squares. Surveys have holes, which are no
// openings: some samples may meet nothing. None where the face is broken.
std::optional<double> relief_of(const RockSurface& rock, const Vector& middle, const Vector& axis, const Vector& probe,
                                double length_m) {
  std::vector<Eigen::Vector2d> met;  // where on the stretch, and how far
  for (int i = 0; i < kSamples; ++i) {
    const double at_m = length_m * (static_cast<double>(i) / (kSamples - 1) - 0.5);
    const Hit hit = rock.trace({middle + at_m * axis, probe}, kProbe_m);
    if (hit.label == Label::kNone) continue;
    if (!met.empty() && std::abs(hit.t_m - met.back().y()) > kBroken_m) return std::nullopt;
    met.emplace_back(at_m, hit.t_m);
  }
  if (met.size() < kFewestSamples) return std::nullopt;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : met) mean += p / static_cast<double>(met.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Eigen::Vector2d& p : met) {
    const Eigen::Vector2d off = p - mean;
    xx += off.x() * off.x(), xy += off.x() * off.y(), yy += off.y() * off.y();
  }
  return std::sqrt(std::max(0.0, yy - xy * xy / xx) / static_cast<double>(met.size()));
}

}  // namespace

// A face of the road, as probes meet it: they start in a plane and go square to it.
struct RockSpectra::Face {
  Vector middle, probe;
  Vector along, across;
  double low_m, high_m;  // of what lies across
};

std::vector<ReliefAtLength> RockSpectra::Reliefs::told() const {
  std::vector<ReliefAtLength> all;
  for (std::size_t k = 0; k < kLengths; ++k) {
    std::vector<double> sorted = of_m[k];
    if (sorted.empty()) {
      all.push_back({kSpectrumLengths_m[k], kNoTruth, kNoTruth, 0, broken[k]});
      continue;
    }
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double share) {
      return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    all.push_back({kSpectrumLengths_m[k], at(0.5), at(kRough), sorted.size(), broken[k]});
  }
  return all;
}

// Stretches of every length about one place of the face: some along the road, one above the other, and some across.
void RockSpectra::measure(const RockSurface& rock, const Face& face, std::array<Reliefs, 2>* along_and_across) {
  constexpr int kRows = 5;
  const double wide_m = face.high_m - face.low_m;
  for (std::size_t k = 0; k < kLengths; ++k) {
    const double length_m = kSpectrumLengths_m[k];
    const auto add = [&](std::size_t direction, const Vector& middle, const Vector& axis) {
      Reliefs& reliefs = (*along_and_across)[direction];
      if (const auto relief = relief_of(rock, middle, axis, face.probe, length_m)) {
        reliefs.of_m[k].push_back(*relief);
      } else {
        ++reliefs.broken[k];
      }
    };
    for (int row = 0; row < kRows; ++row) {
      const double share = (row + 0.5) / kRows;
      add(0, face.middle + (face.low_m + share * wide_m) * face.across, face.along);
      if (length_m > wide_m) continue;
      add(1, face.middle + (face.low_m + 0.5 * length_m + share * (wide_m - length_m)) * face.across, face.across);
    }
  }
}

void RockSpectra::add(const RockSurface& rock, const std::vector<Placement>& path) {
  const Vector up = Vector::UnitZ();
  for (const Placement& base : path) {
    const Vector ahead = (base.R_road_base.col(0) - base.R_road_base(2, 0) * up).normalized();
    const Vector left = up.cross(ahead);
    const Hit below = rock.trace({base.origin_road, -up}, kProbe_m);
    if (below.label == Label::kNone) continue;
    for (const double side : {1.0, -1.0}) {
      measure(rock, {base.origin_road, side * left, ahead, up, kWallLow_m - below.t_m, kWallHigh_m - below.t_m},
              &walls_);
    }
    measure(rock, {base.origin_road, -up, ahead, left, -kFloorAcross_m, kFloorAcross_m}, &floor_);
    measure(rock, {base.origin_road, up, ahead, left, -kFloorAcross_m, kFloorAcross_m}, &roof_);
  }
}

std::vector<RockSpectrum> RockSpectra::told() const {
  return {{"walls", "along", walls_[0].told()}, {"walls", "up", walls_[1].told()},
          {"floor", "along", floor_[0].told()}, {"floor", "across", floor_[1].told()},
          {"roof", "along", roof_[0].told()},   {"roof", "across", roof_[1].told()}};
}

std::string spectra_rows(const std::string& road, const std::vector<RockSpectrum>& spectra) {
  std::ostringstream text;
  for (const RockSpectrum& spectrum : spectra) {
    for (const ReliefAtLength& at : spectrum.at) {
      text << road << ',' << spectrum.face << ',' << spectrum.direction << ',' << at.length_m << ',' << at.median_m
           << ',' << at.rough_m << ',' << at.stretches << ',' << at.broken << '\n';
    }
  }
  return text.str();
}

}  // namespace pose_wall::tools::sim
