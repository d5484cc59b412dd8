// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/fit/groove_profile.hpp"

#include <cmath>

#include "base/math/bits.hpp"
#include "base/math/finite.hpp"

namespace pose_wall {
namespace {

constexpr double kRow_m = 0.05;  // grooves between pipes are wider (seed 510); swept: half and twice change nothing
constexpr std::uint32_t kPlaces = 64;  // one bit of a word for each metre along the wall
constexpr double kPlacesMin = 4.0;  // grooves run on; fewer metres prove nothing; swept: half and twice change nothing
constexpr double kPointsMin = 8.0;  // two for each of these metres; swept: half and twice change nothing
// If rock shows between pipes, the plane is the rock's; swept: half and twice change nothing.
constexpr double kBehindMin_m = 0.04;
// Beside a groove; rock varies less along metres; swept: half and twice change nothing.
constexpr double kContrastMin_m = 0.06;
constexpr double kSureInErrors = 4.0;  // standard errors: of 64 rows none is a groove by chance
constexpr int kGroovesMin = 2;         // a heap at the foot and an arch at the top leave one between them

double at_least(double least, double error) {
  return larger(least, kSureInErrors * error);
}

}  // namespace

GrooveProfile::GrooveProfile(double z_min_m, double z_max_m, double u_middle_m)
    : z_min_(static_cast<float>(z_min_m)), u_from_(static_cast<float>(u_middle_m - 0.5 * kPlaces)) {
  const double row_m = (z_max_m - z_min_m) / kRows;
  rows_per_m_ = static_cast<float>(1.0 / (row_m > kRow_m ? row_m : kRow_m));
}

void GrooveProfile::add(FourFloats u_m, FourFloats z_m, FourFloats residual_m, FourTruths counts) {
  const FourFloats row = (z_m - z_min_) * rows_per_m_, place = u_m - u_from_, none{};
  const FourTruths inside =
      counts & (row >= none) & (row < all_four(kRows)) & (place >= none) & (place < all_four(kPlaces));
  const FourInts rows = cut_off(inside ? row : none), places = cut_off(inside ? place : none);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if (inside[lane] == 0) continue;
    const float residual = residual_m[lane];
    Row& r = rows_[static_cast<std::uint32_t>(rows[lane])];
    r.sums += FourFloats{1.0F, residual, residual * residual};
    r.places |= 1ULL << static_cast<unsigned>(places[lane]);
  }
}

bool GrooveProfile::mean_of(const Row& row, double* mean_m, double* error_m) {
  const double places = static_cast<double>(bits_in(row.places)), count = static_cast<double>(row.sums[0]);
  if (!(places >= kPlacesMin && count >= kPointsMin)) return false;
  *mean_m = static_cast<double>(row.sums[1]) / count;
  const double variance = static_cast<double>(row.sums[2]) / count - *mean_m * *mean_m;
  *error_m = std::sqrt((variance > 0.0 ? variance : 0.0) / places);
  return true;
}

bool GrooveProfile::is_grooved() const {
  int grooves = 0;
  bool in_groove = false, crest_below = false;
  double crest_m = 0.0, crest_error_m = 0.0, bottom_m = 0.0, bottom_error_m = 0.0;
  for (const Row& row : rows_) {
    double mean_m = 0.0, error_m = 0.0;
    if (!mean_of(row, &mean_m, &error_m)) continue;
    const double apart_m = at_least(kContrastMin_m, error_m + (in_groove ? bottom_error_m : crest_error_m));
    if (in_groove) {
      if (mean_m < bottom_m) {
        bottom_m = mean_m;
        bottom_error_m = error_m;
      }
      if (!(mean_m >= bottom_m + apart_m)) continue;
      ++grooves;
      in_groove = false;
      crest_m = mean_m;
      crest_error_m = error_m;
      continue;
    }
    if (!crest_below || mean_m > crest_m) {
      crest_below = true;
      crest_m = mean_m;
      crest_error_m = error_m;
    } else if (mean_m <= crest_m - apart_m && mean_m < -at_least(kBehindMin_m, error_m)) {
      in_groove = true;
      bottom_m = mean_m;
      bottom_error_m = error_m;
    }
  }
  return grooves >= kGroovesMin;
}

}  // namespace pose_wall
