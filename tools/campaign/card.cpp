// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/card.hpp"

#include <cmath>

#include "campaign/classes.hpp"

namespace pose_wall::tools::campaign {
namespace {

constexpr double kDegPerRad = 57.29577951308232;

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

void add_class(Totals& totals, const ClassCard& card) {
  ++totals.classes;
  totals.frames.merge(card.frames);
  merge(totals.quantities, card.quantities);
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

Card make_card(const Manifest& manifest, const std::vector<RunRecord>& records, std::size_t events_max) {
  const AlertLimits& limits = manifest.limits;
  const Totals none{0, {}, empty_statistics(limits)};
  Card card{manifest,
            records.size(),
            {},
            none,
            none,
            none,
            worst_events(records, limits, events_max),
            picture::StanfordCounts(picture::angle_scale(limits.angle_rad * kDegPerRad)),
            picture::StanfordCounts(picture::distance_scale(limits.distance_m))};
  for (const RunRecord& record : records) {
    const bool is_new = card.classes.empty() || card.classes.back().scene != record.run.scene ||
                        card.classes.back().sensor != record.run.sensor;
    if (is_new) {
      card.classes.emplace_back();
      card.classes.back().scene = record.run.scene;
      card.classes.back().sensor = record.run.sensor;
      card.classes.back().quantities = empty_statistics(limits);
    }
    add_run(card.classes.back(), record, limits);
    add_to_diagrams(card, record);
  }
  for (const ClassCard& one : card.classes) {
    add_class(is_nominal(one.scene) ? card.nominal : card.adversarial, one);
    add_class(card.all, one);
  }
  return card;
}

}  // namespace pose_wall::tools::campaign
