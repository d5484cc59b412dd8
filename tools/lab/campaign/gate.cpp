// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/gate.hpp"

#include <cmath>

#include "io/numbers/angles.hpp"
#include "lab/campaign/faults.hpp"

namespace pose_wall::tools::campaign {
namespace {

void demand_finished(Faults& faults, std::size_t runs, std::size_t planned) {
  faults.demand(runs == planned, "the campaign is not finished: runs done {} of {}", runs, planned);
}

void demand_bounds(Faults& faults, const Card& card) {
  const FrameCounts& nominal = card.nominal.frames;
  const FrameCounts& adversarial = card.adversarial.frames;
  faults.demand(card.judged.frames.frames + card.mine.frames.frames > 0,
                "no frame was judged: unobservable classes prove nothing");
  faults.demand(card.mine.frames.misleading == 0,
                "mine classes: misleading frames: {} of {}, valid beyond the alert limit; none is allowed",
                card.mine.frames.misleading, card.mine.frames.frames);
  faults.demand(card.judged.frames.misleading == 0,
                "misleading frames: {} of {}, valid beyond the alert limit; none is allowed",
                card.judged.frames.misleading, card.judged.frames.frames);
  faults.demand(nominal.raw_beyond_protection == 0,
                "nominal classes: frames with a raw error beyond the protection level: {} of {}; none is allowed",
                nominal.raw_beyond_protection, nominal.frames);
  faults.demand(nominal.value_beyond_protection == 0,
                "nominal classes: frames with a value error beyond the protection level: {} of {}; none is allowed",
                nominal.value_beyond_protection, nominal.frames);
  const auto demand_rare = [&](const char* what, std::size_t events) {
    faults.demand(
        rate(events, adversarial.frames) < kAdversarialRateMax,
        "adversarial classes: frames with a {} error beyond the protection level: {} of {}, a rate of {:.1e}; it "
        "must be below {:.0e}",
        what, events, adversarial.frames, rate(events, adversarial.frames), kAdversarialRateMax);
  };
  demand_rare("raw", adversarial.raw_beyond_protection);
  demand_rare("value", adversarial.value_beyond_protection);
}

void demand_work_left(Faults& faults, const std::string& name, const FrameCounts& frames, double allowed) {
  const auto limited = static_cast<double>(frames.work_limited);
  faults.demand(limited <= allowed,
                "{}: frames ended by the work budget (work_max): {} of {}; at most {:.4g} % are allowed", name,
                frames.work_limited, frames.frames, 100.0 * allowed / static_cast<double>(frames.frames));
}

// A class has few runs, and a kind many classes: a road that is always too dear must not hide among them. One run of a
// class may be lost, as for its floors.
void demand_budget(Faults& faults, const Card& card) {
  const auto share_of = [](const FrameCounts& frames) { return kWorkLimitedMax * static_cast<double>(frames.frames); };
  for (const Totals* totals : {&card.mine, &card.nominal, &card.adversarial, &card.judged}) {
    const std::string name = totals == &card.judged ? "all classes" : fmt::format("{} classes", totals->name);
    if (totals->classes > 0) demand_work_left(faults, name, totals->frames, share_of(totals->frames));
  }
  for (const ClassCard& one : card.classes) {
    if (one.scene->kind == sim::SceneKind::kUnobservable) continue;
    const double of_one_run = static_cast<double>(one.frames.frames) / static_cast<double>(one.draws);
    demand_work_left(faults, fmt::format("{} {}", one.scene->name, one.sensor), one.frames,
                     share_of(one.frames) + of_one_run);
  }
}

void demand_sigma(Faults& faults, const Card& card) {
  if (card.nominal.straight_runs < kRunsForMeanZ2) return;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const double z2 = card.nominal.straight[q].mean_z2();
    faults.demand(z2 >= kMeanZ2Min && z2 <= kMeanZ2Max,
                  "nominal classes: mean z² of {} is {:.2f}; it must be within {:g} and {:g}",
                  pose_wall_quantity_name(q), z2, kMeanZ2Min, kMeanZ2Max);
  }
}

void demand_floors(Faults& faults, const std::string& name, const SevenStatistics& quantities,
                   const ValidCounts& counts) {
  const std::vector<QuantityGroup> groups = grouped(quantities);
  for (std::size_t group = 0; group < kGroups; ++group) {
    const ValidCount& count = counts[group];
    faults.demand(count.holds(), "{}: {} valid in {:.4g} % of {} values; the floor is {:.4g} %", name,
                  groups[group].name, 100.0 * count.share(), count.values(), 100.0 * count.floor());
  }
}

void demand_valid_shares(Faults& faults, const Card& card) {
  for (const KindCard& row : card.kinds) {
    demand_floors(faults, fmt::format("{} classes, sensor {}", sim::scene_kind_name(row.kind), row.sensor),
                  row.quantities, row.valid);
  }
  for (const ClassCard& one : card.classes) {
    demand_floors(faults, fmt::format("{} {}", one.scene->name, one.sensor), one.quantities, valid_counts(one));
  }
}

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

double rate(std::size_t events, std::size_t frames) {
  return frames == 0 ? 0.0 : static_cast<double>(events) / static_cast<double>(frames);
}

std::vector<std::string> gate_faults(const Card& card) {
  Faults faults;
  demand_finished(faults, card.runs, card.manifest.runs);
  demand_bounds(faults, card);
  demand_budget(faults, card);
  demand_sigma(faults, card);
  demand_valid_shares(faults, card);
  return faults.take();
}

std::vector<std::string> class_faults(const MotionClassCard& one) {
  Faults faults;
  demand_levels(faults, one);
  demand_states(faults, one);
  demand_small_errors(faults, one);
  return faults.take();
}

std::vector<std::string> gate_faults(const MotionCard& card) {
  Faults faults;
  demand_finished(faults, card.runs, card.manifest.runs);
  faults.demand(!card.classes.empty(), "no frame was judged");
  const RoughTotals rough = rough_totals(card);
  const auto demand_z2 = [&](const char* what, double z2) {
    faults.demand(rough.runs < kRunsForMotionZ2 || (z2 >= kMeanZ2Min && z2 <= kMeanZ2Max),
                  "rough rock: mean z² along of the {} is {:.2f}; it must be within {:g} and {:g}", what, z2,
                  kMeanZ2Min, kMeanZ2Max);
  };
  demand_z2("step", rough.along_step.mean_z2());
  demand_z2("pose", rough.along_pose.mean_z2());
  for (const MotionClassCard& one : card.classes) {
    for (const std::string& fault : class_faults(one)) {
      faults.demand(false, "{} {}: {}", one.kind->name, one.sensor, fault);
    }
  }
  return faults.take();
}

}  // namespace pose_wall::tools::campaign
