// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/gate.hpp"

#include "campaign/faults.hpp"

namespace pose_wall::tools::campaign {
namespace {

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

}  // namespace

double rate(std::size_t events, std::size_t frames) {
  return frames == 0 ? 0.0 : static_cast<double>(events) / static_cast<double>(frames);
}

std::vector<std::string> gate_faults(const Card& card) {
  Faults faults;
  faults.demand(card.runs == card.manifest.runs, "the campaign is not finished: runs done {} of {}", card.runs,
                card.manifest.runs);
  demand_bounds(faults, card);
  demand_budget(faults, card);
  demand_sigma(faults, card);
  demand_valid_shares(faults, card);
  return faults.take();
}

}  // namespace pose_wall::tools::campaign
