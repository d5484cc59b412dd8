// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/motion_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "angles.hpp"
#include "campaign/faults.hpp"

namespace pose_wall::tools::campaign {
namespace {

void demand_states(Faults& faults, const MotionClassCard& one) {
  const MotionLimits& limits = one.kind->limits;
  const auto demand = [&faults](const std::string& states, double share, double least) {
    faults.demand(std::isnan(least) || share >= least, "{} in {:.4g} % of the frames; at least {:g} % is required",
                  states, 100.0 * share, 100.0 * least);
  };
  const double measured = one.share(POSE_WALL_ALONG_MEASURED), lost = one.share(POSE_WALL_ALONG_LOST);
  demand("measured", measured, limits.measured_min);
  demand("measured or ambiguous", measured + one.share(POSE_WALL_ALONG_AMBIGUOUS), limits.told_min);
  demand("unobservable", one.share(POSE_WALL_ALONG_UNOBSERVABLE), limits.unobservable_min);
  faults.demand(lost <= kMotionLostMax, "lost in {:.4g} % of the frames; at most {:g} % is allowed", 100.0 * lost,
                100.0 * kMotionLostMax);
  faults.demand(one.states.back() == 0, "{} frames could not be read", one.states.back());
  faults.demand(one.runs_without_pose == 0, "{} of {} runs have no pose at all", one.runs_without_pose, one.runs);
}

void demand_small_errors(Faults& faults, const MotionClassCard& one) {
  const MotionLimits& limits = one.kind->limits;
  faults.demand(one.along_excess <= 1.0, "error along is {:.3g} times the allowed one", one.along_excess);
  const auto demand = [&faults](const char* what, double error, double limit, const char* unit) {
    faults.demand(std::isnan(limit) || error <= limit, "{} is {:.4g} {}; at most {:g} {} is allowed", what, error, unit,
                  limit, unit);
  };
  demand("error across", one.across_m, limits.across_m, "m");
  demand("error up", one.up_m, limits.across_m, "m");
  demand("error of the turn", one.turn_rad * kDegPerRad, limits.turn_deg, "degrees");
}

void demand_levels(Faults& faults, const MotionClassCard& one) {
  const auto demand_none = [&faults](const char* what, const Misleading& misleading) {
    faults.demand(misleading.misleading == 0, "misleading {}: {} of {} measured ones; none is allowed", what,
                  misleading.misleading, misleading.measured);
  };
  demand_none("steps", one.steps);
  demand_none("poses", one.poses);
  const auto demand_within = [&faults](const char* what, const DirectionTotals& directions) {
    for (std::uint32_t d = 0; d < directions.size(); ++d) {
      faults.demand(directions[d].beyond() == 0, "{} beyond its level, {}: {} of {}; none is allowed", what,
                    pose_wall_motion_direction_name(d), directions[d].beyond(), directions[d].count());
    }
  };
  demand_within("step", one.step);
  demand_within("pose", one.pose);
}

}  // namespace

std::vector<std::string> motion_class_faults(const MotionClassCard& one) {
  Faults faults;
  demand_levels(faults, one);
  demand_states(faults, one);
  demand_small_errors(faults, one);
  return faults.take();
}

std::vector<std::string> motion_gate_faults(const MotionCard& card) {
  Faults faults;
  faults.demand(card.runs == card.manifest.runs, "the campaign is not finished: runs done {} of {}", card.runs,
                card.manifest.runs);
  faults.demand(!card.classes.empty(), "no frame was judged");
  const RoughTotals rough = rough_totals(card);
  const auto demand_z2 = [&](const char* what, double z2) {
    faults.demand(rough.runs < kRunsForMotionZ2 || (z2 >= kMotionZ2Min && z2 <= kMotionZ2Max),
                  "rough rock: mean z² along of the {} is {:.2f}; it must be within {:g} and {:g}", what, z2,
                  kMotionZ2Min, kMotionZ2Max);
  };
  demand_z2("step", rough.along_step.mean_z2());
  demand_z2("pose", rough.along_pose.mean_z2());
  for (const MotionClassCard& one : card.classes) {
    for (const std::string& fault : motion_class_faults(one)) {
      faults.demand(false, "{} {}: {}", one.kind->name, one.sensor, fault);
    }
  }
  return faults.take();
}

}  // namespace pose_wall::tools::campaign
