// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The integrity card: what the records of a campaign come to, per class of scenes and in total.

#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "io/picture/stanford_diagram.hpp"
#include "lab/campaign/event_times.hpp"
#include "lab/campaign/level_curve.hpp"
#include "lab/campaign/manifest.hpp"
#include "lab/campaign/record.hpp"
#include "lab/campaign/valid_floors.hpp"
#include "lab/campaign/worst_events.hpp"
#include "lab/sim/scenes.hpp"
#include "study/truth/error_statistics.hpp"

namespace pose_wall::tools::campaign {

// Frames with at least one of the seven quantities in it.
struct FrameCounts {
  std::size_t frames = 0;
  std::size_t raw_beyond_protection = 0;
  std::size_t value_beyond_protection = 0;
  std::size_t misleading = 0;
  std::size_t work_limited = 0;  // the engine ran out of its work budget

  void add(const FrameRecord& frame, const AlertLimits& limits);
  void merge(const FrameCounts& other);
};

using SevenStatistics = std::vector<ErrorStatistics>;

// Four rows of a table: roll, pitch, yaw, and the distances together.
struct QuantityGroup {
  const char* name;
  bool is_angle;
  ErrorStatistics statistics;
};
std::vector<QuantityGroup> grouped(const SevenStatistics& quantities);

// Shares of the values that have a truth.
struct StateShares {
  double valid = 0.0;
  double degraded = 0.0;
  double held = 0.0;
  double invalid = 0.0;
};
StateShares state_shares(const SevenStatistics& quantities);
StateShares state_shares(const ErrorStatistics& statistics);

// One scene as one sensor sees it.
struct ClassCard {
  const sim::SceneChoice* scene = nullptr;
  std::string sensor;
  std::size_t draws = 0;
  bool is_cut = false;  // a run is shorter than its scene asks for: no floor
  FrameCounts frames;
  SevenStatistics quantities;  // of the scene, without the way in and the first frame
  std::size_t straight_runs = 0;
  SevenStatistics straight;            // the same, of runs in whose scans no motion is
  SevenStatistics by_road, by_survey;  // of mine classes, likewise, by each truth alone
  EventTimes times;
  std::array<std::size_t, POSE_WALL_REASON_COUNT> reasons{};  // values with a truth that were not valid, by reason
};

// Of the groups of grouped(); nothing is counted for a class without a floor.
ValidCounts valid_counts(const ClassCard& one);

// The classes of one kind, as one sensor or all of them see them.
struct KindCard {
  sim::SceneKind kind;
  std::string sensor;  // "all"
  std::size_t runs = 0;
  SevenStatistics quantities;
  ValidCounts valid;  // over the classes with a floor
};

// Some frames of the classes of one kind: those that are first in their run, the later ones of machines that stand, of
// those that move, and all of them. Frames of the way in are in none.
struct FramesCard {
  sim::SceneKind kind;
  const char* name;
  std::size_t runs = 0;
  std::size_t frames = 0;
  SevenStatistics quantities;
};

struct Totals {
  const char* name;
  std::size_t classes = 0;
  std::size_t runs = 0;
  FrameCounts frames;
  SevenStatistics quantities;
  std::size_t straight_runs = 0;  // as of a class
  SevenStatistics straight;
};

void add_class(Totals& totals, const ClassCard& card);

struct Card {
  Manifest manifest;
  std::size_t runs = 0;  // with a record
  std::vector<ClassCard> classes;
  Totals mine;
  Totals nominal;
  Totals adversarial;
  Totals judged;  // nominal and adversarial: by the ideal road
  Totals unobservable;
  std::vector<KindCard> kinds;     // mine by sensor and all, then nominal, then adversarial
  std::vector<FramesCard> frames;  // likewise by kind; without empty ones
  LevelCurve nominal_curve;
  LevelCurve adversarial_curve;
  std::vector<WorstEvent> events;  // of the judged, as the diagrams
  picture::StanfordCounts angles;
  picture::StanfordCounts distances;
};

// The records in the order of read_records; those of a scene that is not in the table are refused with a
// std::runtime_error. At most `events_max` events are listed.
Card make_card(const Manifest& manifest, const std::vector<RunRecord>& records, std::size_t events_max);

}  // namespace pose_wall::tools::campaign
