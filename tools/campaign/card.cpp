// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "angles.hpp"
#include "quantities.hpp"
#include "sim/sensors.hpp"

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
  if (!std::isfinite(record.truth) || record.measured.state == POSE_WALL_VALID) return;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((record.reasons >> bit & 1U) != 0) ++card.reasons[bit];
  }
}

void add_run(ClassCard& card, const RunRecord& record, const AlertLimits& limits) {
  ++card.draws;
  for (const FrameRecord& frame : record.frames) {
    card.frames.add(frame, limits);
    for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      card.quantities[q].add(frame.quantity[q].measured, frame.quantity[q].truth);
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
  const auto none = [&limits](const char* name) { return Totals{name, 0, 0, {}, empty_statistics(limits)}; };
  return {manifest,
          0,
          {},
          none("nominal"),
          none("adversarial"),
          none("both"),
          none("unobservable"),
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
  one.scene = sim::find_scene(record.run.scene);
  one.sensor = record.run.sensor;
  one.quantities = empty_statistics(card.manifest.limits);
  if (one.scene == nullptr) {
    throw std::runtime_error(fmt::format("a record of the scene '{}', which does not exist", record.run.scene));
  }
  return one;
}

Totals& totals_for(Card& card, sim::SceneKind kind) {
  if (kind == sim::SceneKind::kNominal) return card.nominal;
  return kind == sim::SceneKind::kAdversarial ? card.adversarial : card.unobservable;
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
}

void FrameCounts::merge(const FrameCounts& other) {
  frames += other.frames;
  raw_beyond_protection += other.raw_beyond_protection;
  value_beyond_protection += other.value_beyond_protection;
  misleading += other.misleading;
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
}

Card make_card(const Manifest& manifest, const std::vector<RunRecord>& records, std::size_t events_max) {
  Card card = empty_card(manifest);
  card.runs = records.size();
  std::vector<const RunRecord*> judged;
  for (const RunRecord& record : records) {
    ClassCard& one = class_of(card, record);
    add_run(one, record, manifest.limits);
    if (one.scene->kind == sim::SceneKind::kUnobservable) continue;
    judged.push_back(&record);
    add_to_diagrams(card, record);
  }
  for (const ClassCard& one : card.classes) {
    add_class(totals_for(card, one.scene->kind), one);
    if (one.scene->kind != sim::SceneKind::kUnobservable) add_class(card.judged, one);
  }
  card.events = worst_events(judged, manifest.limits, events_max);
  return card;
}

double available_floor(const ClassCard& one) {
  const sim::SensorModel* const sensor = sim::find_sensor(one.sensor);
  const double less = sensor != nullptr ? sensor->available_less : 0.0;
  return std::max(one.scene->available_floor - less, 0.0);
}

}  // namespace pose_wall::tools::campaign
