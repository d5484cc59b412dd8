// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/far_match.hpp"

#include <cmath>

#include "base/math/finite.hpp"
#include "motion/frame_steps.hpp"

namespace pose_wall::motion {
namespace {

constexpr int kWindowsMost = 4;                       // to each side
constexpr double kWindowStep_m = 1.5 * kReachMost_m;  // each overlaps the next by a quarter

// How a curve is drawn: in steps of 25 mm by all that it takes; or in steps of 5 cm, a cell of the map, by an eighth of
// the observations. Of 210 scans of 80 roads, turned and after 0.8 to 4.5 s, an eighth measured 161, as did a quarter.
// Of half of them a sixteenth measured 77, and an eighth 79 (2026-11, simulated).
struct Drawn {
  std::uint32_t rows, shifts;
};
constexpr Drawn kFull = {kRowsMost, kShiftsMost}, kCoarse = {kRowsMost / 8, 17};

bool is_better(const Curve& curve, const Curve& than) {
  if (is_evidence(curve) != is_evidence(than)) return is_evidence(curve);
  return curve.told && (!than.told || curve.bottom < than.bottom);
}

class Windows {
 public:
  Windows(const Scan& scan, const Alignment& middle, CurveScratch* scratch, Work* work)
      : scan_(scan), middle_(middle), scratch_(scratch), work_(work) {}

  Curve draw(int window, const Drawn& drawn) const {
    Alignment there = middle_;
    there.pose.t += way_m(window) * there.axes.along;
    work_->add(steps::of_curve(scan_.observation.size(), drawn.rows, drawn.shifts));
    return match_along(scan_, there, kReachMost_m, drawn.shifts, scratch_, drawn.rows);
  }
  static double way_m(int window) { return kWindowStep_m * window; }

 private:
  const Scan& scan_;
  const Alignment& middle_;
  CurveScratch* scratch_;
  Work* work_;
};

}  // namespace

FarPlace match_far(const Scan& scan, double far_m, const Alignment& middle, CurveScratch* scratch, Work* work) {
  const double needed = far_m / (2.0 * kReachMost_m) + 1.0;
  const int windows = needed < kWindowsMost ? static_cast<int>(needed) : kWindowsMost, count = 2 * windows + 1;
  const Windows draw_window(scan, middle, scratch, work);
  Curve found[2 * kWindowsMost + 1];
  int best = 0;
  for (int k = 0; k < count; ++k) {
    found[k] = draw_window.draw(k - windows, kCoarse);
    if (is_better(found[k], found[best])) best = k;
  }
  double apart_m = 0.0;
  for (int k = 0; k < count; ++k) {
    const double away_m = Windows::way_m(k > best ? k - best : best - k);
    const bool rivals = found[k].told && passes_of<gate::RIVAL_MISFIT>(found[k].bottom, found[best].bottom);
    if (rivals && away_m > 2.0 * kReachMost_m) apart_m = away_m + kReachMost_m;
  }
  FarPlace out = {draw_window.draw(best - windows, kFull), middle.pose.t};
  out.curve.apart_m = larger(apart_m, out.curve.apart_m);
  out.t += Windows::way_m(best - windows) * middle.axes.along;
  return out;
}

}  // namespace pose_wall::motion
