// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/motion_card.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/numbers/quantile.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// The last one, or a new one: records come class by class.
MotionClassCard& motion_class_of(MotionCard& card, const MotionRecord& record) {
  if (!card.classes.empty()) {
    MotionClassCard& last = card.classes.back();
    if (last.kind->name == record.run.scene && last.sensor == record.run.sensor) return last;
  }
  const MotionClass& kind = motion_class_of_record(record.run.scene);
  MotionClassCard& one = card.classes.emplace_back();
  one.kind = &kind;
  one.sensor = record.run.sensor;
  return one;
}

void add_if_number(double number, std::vector<double>* to) {
  if (std::isfinite(number)) to->push_back(number);
}

void add_rows(const MotionRecord& record, MotionClassCard* one) {
  for (std::size_t i = 0; i < record.table.rows.size(); ++i) {
    const MotionRow& row = record.table.rows[i];
    ++one->frames;
    one->ms_sum += std::isfinite(row.total_ms) ? row.total_ms : 0.0;
    one->ms_worst = std::fmax(one->ms_worst, row.total_ms);
    if (i == 0) continue;
    ++one->judged;
    ++one->states[row.along_state.value_or(POSE_WALL_ALONG_MEASURED + 1)];
    add_if_number(record.contrast[i], &one->contrast);
    add_if_number(record.patches[i], &one->patches);
  }
}

void add_along(const MotionComparison& c, const Run& run, MotionClassCard* one, std::vector<MotionEvent>* events) {
  const double error_m = std::abs(c.travel[0].at_end);
  one->along_m.push_back(error_m);
  constexpr double kDriven_m = 0.05;
  if (c.way_m > kDriven_m) one->along_share.push_back(error_m / c.way_m);
  const double excess = error_m / allowed_along_m(*one, c.way_m);
  if (!std::isfinite(excess)) return;
  one->along_excess = std::max(one->along_excess, excess);
  if (excess > 1.0) events->push_back({"error along", excess, run, c.last_frame, false});
}

void add_misleading(const char* what, const Misleading& misleading, const Run& run, std::vector<MotionEvent>* events) {
  if (misleading.misleading > 0) {
    events->push_back({what, misleading.worst_excess, run, misleading.worst_frame, true});
  }
}

void add_comparison(const MotionComparison& c, const Run& run, MotionClassCard* one, std::vector<MotionEvent>* events) {
  add_along(c, run, one, events);
  one->across_m = std::max(one->across_m, c.travel[1].largest);
  one->up_m = std::max(one->up_m, c.travel[2].largest);
  one->turn_rad = std::max(one->turn_rad, c.turn.largest);
  one->poses.merge(c.misleading_poses);
  one->steps.merge(c.misleading_steps);
  add_misleading("misleading pose", c.misleading_poses, run, events);
  add_misleading("misleading step", c.misleading_steps, run, events);
  for (std::size_t d = 0; d < c.pose.size(); ++d) {
    one->pose[d].merge(c.pose[d]);
    one->step[d].merge(c.step[d]);
  }
}

bool has_pose(const MotionRecord& record) {
  return std::any_of(record.table.rows.begin(), record.table.rows.end(),
                     [](const MotionRow& row) { return row.T_start_base.has_value(); });
}

}  // namespace

Spread spread_of(const std::vector<double>& numbers) {
  return {quantile(numbers, 0.05), quantile(numbers, 0.5), quantile(numbers, 0.95)};
}

double MotionClassCard::share(std::uint32_t state) const {
  return judged > 0 ? static_cast<double>(states[state]) / static_cast<double>(judged) : kNothing;
}

void MotionCard::add(const MotionRecord& record) {
  MotionClassCard& one = motion_class_of(*this, record);
  ++runs;
  ++one.runs;
  add_rows(record, &one);
  if (has_pose(record)) {
    add_comparison(compare_motion(record.table, record.truth), record.run, &one, &events);
  } else {
    ++one.runs_without_pose;
  }
}

double allowed_along_m(const MotionClassCard& one, double way_m) {
  const MotionLimits& limits = one.kind->limits;
  const double share = has_few_points(one.sensor) ? limits.along_share_few : limits.along_share;
  return std::isfinite(share) ? std::max(limits.along_m, share * way_m) : kNothing;
}

RoughTotals rough_totals(const MotionCard& card) {
  RoughTotals totals;
  for (const MotionClassCard& one : card.classes) {
    if (!one.kind->rough) continue;
    totals.runs += one.runs;
    totals.along_step.merge(one.step[POSE_WALL_MOTION_ALONG]);
    totals.along_pose.merge(one.pose[POSE_WALL_MOTION_ALONG]);
  }
  return totals;
}

}  // namespace pose_wall::tools::campaign
