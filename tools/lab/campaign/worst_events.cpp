// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/worst_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pose_wall::tools::campaign {
namespace {

double ratio(double error, double bound) {
  const double r = std::abs(error) / bound;
  return std::isfinite(r) ? r : std::numeric_limits<double>::infinity();
}

constexpr std::int64_t kPeriodOfRun_ns = 100000000;

// Of one run and quantity.
class WorstOfRun {
 public:
  WorstOfRun(const Run& run, std::uint32_t quantity, const AlertLimits& limits)
      : run_(run), quantity_(quantity), limits_(limits) {}

  void add(const FrameRecord& frame) {
    stamps_are_steady_ = stamps_are_steady_ && (!last_ns_ || frame.stamp_ns - *last_ns_ == kPeriodOfRun_ns);
    last_ns_ = frame.stamp_ns;
    const Judged judged = judge(frame, quantity_, limits_);
    const double limit = limit_of(quantity_, limits_);
    const double level = frame.quantity[quantity_].measured.protection_level;
    if (judged.misleading) keep(Breach::kMisleading, judged.value_error, limit, frame);
    if (judged.value_beyond_protection) keep(Breach::kValueBeyondProtection, judged.value_error, level, frame);
    if (judged.raw_beyond_protection) keep(Breach::kRawBeyondProtection, judged.raw_error, level, frame);
  }

  void append_to(std::vector<WorstEvent>& events) const {
    const auto gravest =
        std::find_if(worst_.begin(), worst_.end(), [](const auto& event) { return event.has_value(); });
    if (gravest != worst_.end()) events.push_back(**gravest);
  }

 private:
  void keep(Breach breach, double error, double bound, const FrameRecord& frame) {
    const double excess = ratio(error, bound);
    std::optional<WorstEvent>& worst = worst_[static_cast<std::size_t>(breach)];
    if (worst && worst->excess >= excess) return;
    const QuantityRecord& v = frame.quantity[quantity_];
    worst = WorstEvent{breach, excess, run_, frame.frame, quantity_, error, v.measured, v.reasons, stamps_are_steady_};
  }

  const Run& run_;
  std::uint32_t quantity_;
  const AlertLimits& limits_;
  std::optional<std::int64_t> last_ns_;
  bool stamps_are_steady_ = true;
  std::array<std::optional<WorstEvent>, 3> worst_;  // by breach, the gravest first
};

}  // namespace

const char* breach_name(Breach breach) {
  if (breach == Breach::kMisleading) return "misleading";
  return breach == Breach::kValueBeyondProtection ? "value > protection" : "raw > protection";
}

std::vector<WorstEvent> worst_events(const std::vector<const RunRecord*>& records, const AlertLimits& limits,
                                     std::size_t events_max) {
  std::vector<WorstEvent> events;
  for (const RunRecord* record : records) {
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      WorstOfRun worst(record->run, q, limits);
      for (const FrameRecord& frame : record->frames) worst.add(frame);
      worst.append_to(events);
    }
  }
  keep_worst(events_max, &events);
  return events;
}

}  // namespace pose_wall::tools::campaign
