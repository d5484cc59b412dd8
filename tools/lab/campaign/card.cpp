// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"

namespace pose_wall::tools::campaign {
namespace {

SevenStatistics empty_statistics(const AlertLimits& limits) {
  SevenStatistics seven;
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) seven.emplace_back(is_angle(q), limit_of(q, limits));
  return seven;
}

void merge(SevenStatistics& into, const SevenStatistics& other) {
  for (std::size_t q = 0; q < into.size(); ++q) into[q].merge(other[q]);
}

void count_reasons(ClassCard& card, const QuantityRecord& record) {
  if (!std::isfinite(record.judged_truth(0.0)) || record.measured.state == POSE_WALL_VALID) return;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((record.reasons >> bit & 1U) != 0) ++card.reasons[bit];
  }
}

void add_run(ClassCard& card, const RunRecord& record, const AlertLimits& limits) {
  const bool is_straight = has_straight_scans(record.run.settings);
  ++card.draws;
  if (is_straight) ++card.straight_runs;
  card.is_cut = card.is_cut || is_cut(record.run);
  for (const FrameRecord& frame : record.frames) {
    card.frames.add(frame, limits);
    if (!is_in_shares(frame)) continue;  // what is wrong there is wrong all the same
    for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const double truth = frame.quantity[q].judged_truth(limit_of(q, limits));
      card.quantities[q].add(frame.quantity[q].measured, truth);
      if (is_straight) card.straight[q].add(frame.quantity[q].measured, truth);
      if (card.scene->kind == sim::SceneKind::kMine) {
        card.by_road[q].add(frame.quantity[q].measured, frame.quantity[q].truth);
        card.by_survey[q].add(frame.quantity[q].measured, frame.quantity[q].surveyed);
      }
      count_reasons(card, frame.quantity[q]);
    }
  }
  card.times.add(record, limits);
}

void add_to_diagrams(Card& card, const RunRecord& record) {
  for (const FrameRecord& frame : record.frames) {
    for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const QuantityRecord& v = frame.quantity[q];
      const double error = judge(frame, q, card.manifest.limits).value_error;
      if (!std::isfinite(error)) continue;
      if (is_angle(q)) {
        card.angles.add(std::abs(error) * kDegPerRad, v.measured.protection_level * kDegPerRad);
      } else {
        card.distances.add(std::abs(error), v.measured.protection_level);
      }
    }
  }
}

Card empty_card(const Manifest& manifest) {
  const AlertLimits& limits = manifest.limits;
  const auto none = [&limits](const char* name) {
    return Totals{name, 0, 0, {}, empty_statistics(limits), 0, empty_statistics(limits)};
  };
  return {manifest,
          0,
          {},
          none("mine"),
          none("nominal"),
          none("adversarial"),
          none("both"),
          none("unobservable"),
          {},
          {},
          {},
          {},
          {},
          picture::StanfordCounts(picture::angle_scale(limits.angle_rad * kDegPerRad)),
          picture::StanfordCounts(picture::distance_scale(limits.distance_m))};
}

// The last one, or a new one: records come class by class.
ClassCard& class_of(Card& card, const RunRecord& record) {
  if (!card.classes.empty()) {
    ClassCard& last = card.classes.back();
    if (last.scene->name == record.run.scene && last.sensor == record.run.sensor) return last;
  }
  ClassCard& one = card.classes.emplace_back();
  one.scene = scene_of(record.run.scene);
  one.sensor = record.run.sensor;
  one.quantities = empty_statistics(card.manifest.limits);
  one.straight = one.by_road = one.by_survey = one.quantities;
  if (one.scene == nullptr) {
    throw std::runtime_error(fmt::format("a record of the scene '{}', which does not exist", record.run.scene));
  }
  return one;
}

constexpr std::array kToldKinds = {sim::SceneKind::kMine, sim::SceneKind::kNominal, sim::SceneKind::kAdversarial};

// By the ideal road, for which the levels are made.
bool is_judged(sim::SceneKind kind) {
  return kind == sim::SceneKind::kNominal || kind == sim::SceneKind::kAdversarial;
}

Totals& totals_for(Card& card, sim::SceneKind kind) {
  if (kind == sim::SceneKind::kMine) return card.mine;
  if (kind == sim::SceneKind::kNominal) return card.nominal;
  return kind == sim::SceneKind::kAdversarial ? card.adversarial : card.unobservable;
}

// The row for this sensor, behind those of its kind that are there.
KindCard& kind_row(std::vector<KindCard>& rows, sim::SceneKind kind, const std::string& sensor,
                   const AlertLimits& limits) {
  for (KindCard& row : rows) {
    if (row.kind == kind && row.sensor == sensor) return row;
  }
  return rows.emplace_back(KindCard{kind, sensor, 0, empty_statistics(limits), {}});
}

void add_class(KindCard& row, const ClassCard& one) {
  row.runs += one.draws;
  merge(row.quantities, one.quantities);
  const ValidCounts counts = valid_counts(one);
  for (std::size_t group = 0; group < kGroups; ++group) row.valid[group].merge(counts[group]);
}

std::vector<KindCard> kind_cards(const std::vector<ClassCard>& classes, const AlertLimits& limits) {
  std::vector<KindCard> rows;
  for (const sim::SceneKind kind : kToldKinds) {
    std::vector<KindCard> of_kind;
    KindCard all{kind, "all", 0, empty_statistics(limits), {}};
    for (const ClassCard& one : classes) {
      if (one.scene->kind != kind) continue;
      add_class(kind_row(of_kind, kind, one.sensor, limits), one);
      add_class(all, one);
    }
    if (of_kind.size() > 1) of_kind.push_back(all);
    rows.insert(rows.end(), of_kind.begin(), of_kind.end());
  }
  return rows;
}

bool is_first(const FrameRecord& frame) {
  return frame.phase == Phase::kFirst;
}

bool is_scenes(const FrameRecord& frame) {
  return is_first(frame) || is_in_shares(frame);
}

void add_frames(FramesCard& row, const RunRecord& record, bool (*counts)(const FrameRecord&)) {
  std::size_t added = 0;
  for (const FrameRecord& frame : record.frames) {
    if (!counts(frame)) continue;
    ++added;
    for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      row.quantities[q].add(frame.quantity[q].measured, frame.quantity[q].judged_truth(0.0));  // of states alone
    }
  }
  row.frames += added;
  if (added > 0) ++row.runs;
}

std::vector<FramesCard> frames_cards(const std::vector<const RunRecord*>& told, const AlertLimits& limits) {
  std::vector<FramesCard> rows;
  for (const sim::SceneKind kind : kToldKinds) {
    std::vector<FramesCard> of_kind;
    for (const char* name : {"first", "later, standing", "later, moving", "all"}) {
      of_kind.push_back({kind, name, 0, 0, empty_statistics(limits)});
    }
    for (const RunRecord* const record : told) {
      if (scene_of(record->run.scene)->kind != kind) continue;
      add_frames(of_kind[0], *record, is_first);
      add_frames(of_kind[stands(record->run.settings) ? 1 : 2], *record, is_in_shares);
      add_frames(of_kind[3], *record, is_scenes);
    }
    for (FramesCard& row : of_kind) {
      if (row.frames > 0) rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

void FrameCounts::add(const FrameRecord& frame, const AlertLimits& limits) {
  Judged any{};
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const Judged one = judge(frame, q, limits);
    any.raw_beyond_protection |= one.raw_beyond_protection;
    any.value_beyond_protection |= one.value_beyond_protection;
    any.misleading |= one.misleading;
  }
  ++frames;
  if (any.raw_beyond_protection) ++raw_beyond_protection;
  if (any.value_beyond_protection) ++value_beyond_protection;
  if (any.misleading) ++misleading;
  if (met_work_limit(frame)) ++work_limited;
}

void FrameCounts::merge(const FrameCounts& other) {
  frames += other.frames;
  raw_beyond_protection += other.raw_beyond_protection;
  value_beyond_protection += other.value_beyond_protection;
  misleading += other.misleading;
  work_limited += other.work_limited;
}

std::vector<QuantityGroup> grouped(const SevenStatistics& quantities) {
  std::vector<QuantityGroup> groups;
  for (std::uint32_t q = 0; q <= POSE_WALL_YAW; ++q) {
    groups.push_back({pose_wall_quantity_name(q), true, quantities[q]});
  }
  groups.push_back({"distances", false, quantities[POSE_WALL_D_LF]});
  for (std::size_t q = POSE_WALL_D_LB; q < quantities.size(); ++q) groups.back().statistics.merge(quantities[q]);
  return groups;
}

StateShares state_shares(const ErrorStatistics& statistics) {
  const auto share = [&statistics](std::uint32_t state) {
    return static_cast<double>(statistics.in_state(state)) / static_cast<double>(statistics.frames());
  };
  return {share(POSE_WALL_VALID), share(POSE_WALL_DEGRADED), share(POSE_WALL_HELD), share(POSE_WALL_INVALID)};
}

StateShares state_shares(const SevenStatistics& quantities) {
  ErrorStatistics whole = quantities.front();
  for (std::size_t q = 1; q < quantities.size(); ++q) whole.merge(quantities[q]);
  return state_shares(whole);
}

void add_class(Totals& totals, const ClassCard& card) {
  ++totals.classes;
  totals.runs += card.draws;
  totals.frames.merge(card.frames);
  merge(totals.quantities, card.quantities);
  totals.straight_runs += card.straight_runs;
  merge(totals.straight, card.straight);
}

Card make_card(const Manifest& manifest, const std::vector<RunRecord>& records, std::size_t events_max) {
  Card card = empty_card(manifest);
  card.runs = records.size();
  std::vector<const RunRecord*> told, judged;
  for (const RunRecord& record : records) {
    ClassCard& one = class_of(card, record);
    add_run(one, record, manifest.limits);
    if (one.scene->kind != sim::SceneKind::kUnobservable) told.push_back(&record);
    if (!is_judged(one.scene->kind)) continue;
    judged.push_back(&record);
    add_to_diagrams(card, record);
    const bool is_nominal = one.scene->kind == sim::SceneKind::kNominal;
    add_run(is_nominal ? card.nominal_curve : card.adversarial_curve, record, manifest.limits);
  }
  for (const ClassCard& one : card.classes) {
    add_class(totals_for(card, one.scene->kind), one);
    if (is_judged(one.scene->kind)) add_class(card.judged, one);
  }
  card.kinds = kind_cards(card.classes, manifest.limits);
  card.frames = frames_cards(told, manifest.limits);
  card.events = worst_events(judged, manifest.limits, events_max);
  return card;
}

ValidCounts valid_counts(const ClassCard& one) {
  ValidCounts counts;
  const ClassShares* const expected = one.is_cut ? nullptr : find_valid_shares(one.scene->name, one.sensor);
  if (expected == nullptr) return counts;
  const std::vector<QuantityGroup> groups = grouped(one.quantities);
  for (std::size_t group = 0; group < kGroups; ++group) {
    const ErrorStatistics& s = groups[group].statistics;
    counts[group].add(expected->groups[group], s.frames(), s.valid(), one.draws);
  }
  return counts;
}

}  // namespace pose_wall::tools::campaign
