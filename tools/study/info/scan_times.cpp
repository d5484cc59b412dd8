// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/scan_times.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "io/frames/field_value.hpp"
#include "io/frames/point_position.hpp"
#include "io/frames/told_rings.hpp"
#include "io/numbers/angles.hpp"
#include "study/info/scan_turn.hpp"
#include "study/info/stamp_steps.hpp"
#include "study/info/usable_times.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kReturnsLeast = 1000;  // judgement, 2026-11-27: of 180 moments
// Without rings of its own, a cloud's are told by elevation: nearer ones are one ring then.
constexpr double kProxyRing_rad = 0.25 * kRadPerDeg;
// Rings about the sensor's own centre and axis lie flat: within 0.2 deg in five recordings of others. A centre 0.2 m
// beside the origin makes 0.34 deg and more (simulated VLP-16; other sensors more). Measured 2026-11-27.
constexpr double kLeanMost_rad = 0.3 * kRadPerDeg;
// Where every column looks a little beside the next, a moment's directions still agree to 4 %: beams within 8 deg of
// the sensor's azimuth, moments of 2 deg, and a lean of 20 deg.
constexpr double kOffMomentMost = 0.3;
constexpr double kOffTurnMost = 0.05;      // of the returns: blooming and echoes are off their beams, too
constexpr double kOrderLeast = -0.9;       // correlation: drivers write points as they come
constexpr double kSpanRoom = 0.1;          // of the time between stamps, which hosts give by a clock of their own
constexpr double kTurnLeast_s = 0.025;     // makers give 20 Hz at most (VLP-16, OS1, XT32: data sheets); twice that
constexpr std::size_t kRingsLeast = 8;     // a sensor that turns; Livox sensors have up to 6 lines
constexpr double kRoundLeast_deg = 270.0;  // sensors that sweep to and fro see less
constexpr double kFaultyLeast = 0.2;       // share of the scans: single ones may be broken

struct Returns {
  std::vector<TimedReturn> all;
  std::vector<double> places;  // in the order of storage
  bool has_rings = false;
};

// Without its ring; nothing where the point is no return, or has no time.
std::optional<TimedReturn> timed_return(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column) {
  const Eigen::Vector3d p = point_position(cloud, row, column);
  const double time = field_value(cloud, row, column, cloud.time);
  if (!p.allFinite() || p.isZero(0.0) || !std::isfinite(time)) return std::nullopt;
  TimedReturn one;
  one.across_m = std::hypot(p.x(), p.y());
  one.azimuth_rad = std::atan2(p.y(), p.x());
  one.elevation_rad = std::atan2(p.z(), one.across_m);
  one.time_s = time;
  return one;
}

// Where rings and places of storage stand in a cloud.
struct Storage {
  std::optional<pose_wall_field> ring;
  bool rows_are_rings = false, is_upright = false;

  std::uint32_t ring_of(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column,
                        double elevation_rad) const {
    double told = (elevation_rad + M_PI) / kProxyRing_rad;
    if (ring) {
      told = field_value(cloud, row, column, *ring);
    } else if (rows_are_rings) {
      told = static_cast<double>(is_upright ? row : column);
    }
    return static_cast<std::uint32_t>(std::clamp(std::isfinite(told) ? told : 0.0, 0.0, 1e6));
  }

  double place_of(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column) const {
    if (cloud.height == 1 || cloud.width == 1) return static_cast<double>(row + column);
    return static_cast<double>(is_upright ? column : row);
  }
};

Returns returns_with_times(const Frame& frame) {
  const pose_wall_cloud& cloud = frame.cloud;
  Storage storage;
  // Else the rows of the cloud are the rings, or its columns.
  storage.ring = told_ring_field(frame);
  storage.rows_are_rings = !storage.ring && told_rings(frame).count > 0;
  storage.is_upright = cloud.height <= cloud.width;
  Returns out;
  out.has_rings = storage.ring || storage.rows_are_rings;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      std::optional<TimedReturn> one = timed_return(cloud, row, column);
      if (!one) continue;
      one->ring = storage.ring_of(cloud, row, column, one->elevation_rad);
      out.all.push_back(*one);
      out.places.push_back(storage.place_of(cloud, row, column));
    }
  }
  return out;
}

// Of times and places, -1 to 1; 1 where it does not show.
double order_of(const Returns& returns) {
  double t = 0.0, p = 0.0, tt = 0.0, pp = 0.0, tp = 0.0;
  for (std::size_t i = 0; i < returns.all.size(); ++i) {
    const double time = returns.all[i].time_s, place = returns.places[i];
    t += time, p += place, tt += time * time, pp += place * place, tp += time * place;
  }
  const auto n = static_cast<double>(returns.all.size());
  const double spread = (n * tt - t * t) * (n * pp - p * p);
  return spread > 0.0 ? (n * tp - t * p) / std::sqrt(spread) : 1.0;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Note = ScanTimeLook::Note;
using Rule = std::function<bool(const Note&)>;

double median_by(const std::vector<Note>& notes, const Rule& rule, double Note::*member) {
  std::vector<double> values;
  for (const Note& note : notes) {
    if (rule(note)) values.push_back(note.*member);
  }
  return median_of(std::move(values));
}

// The cloud's axes are the sensor's, for sure.
bool is_flat(const Note& note) {
  return note.has_rings && !note.leans;
}

bool is_of_turn(const Note& note) {
  return note.turn_s > 0.0 && note.off_moment <= kOffMomentMost;
}

// More turns in a scan than any sensor makes, and about as many as there are rings.
bool is_by_row(const Note& note, std::size_t rings) {
  if (!is_of_turn(note) || note.turn_s >= kTurnLeast_s) return false;
  return std::fabs(note.spread_s / note.turn_s / static_cast<double>(rings) - 1.0) < 0.25;  // empty rings are left out
}

// A scan of a whole turn takes a stamp's step, or some steps fewer where frames were left out; one of a part does not
// take longer than a step.
bool is_span_wrong(const Note& note, double step_s) {
  if (!is_of_turn(note)) return false;
  if (note.turn_s < kTurnLeast_s) return true;
  if (step_s <= 0.0) return false;
  if (note.spread_s > (1.0 + kSpanRoom) * step_s) return true;
  if (!is_flat(note)) return false;  // about another centre a turn is not steady
  if (note.sweep_rad < kRoundLeast_deg * kRadPerDeg) return false;
  const double turns = step_s / note.turn_s;
  return std::fabs(turns / std::max(1.0, std::round(turns)) - 1.0) > kSpanRoom;
}

}  // namespace

void ScanTimeLook::add(const Frame& frame) {
  // As the engine takes them, of all points: those without a return count, too.
  const TimeFault unusable = unusable_times(frame);
  if (unusable != TimeFault::kNone) {
    Note unread;
    unread.is_type = unusable == TimeFault::kType;
    unread.is_one = unusable == TimeFault::kOne;
    unread.is_unit_unknown = unusable == TimeFault::kUnit;
    notes_.push_back(unread);
    return;
  }
  if (frame.cloud.time.type == POSE_WALL_FIELD_NONE) return;
  Returns returns = returns_with_times(frame);
  if (returns.all.size() < kReturnsLeast) return;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const TimedReturn& one : returns.all) {
    least = std::min(least, one.time_s);
    most = std::max(most, one.time_s);
  }
  Note note;
  const double unit_s = time_unit_s(most - least);
  note.is_one = most == least;
  note.is_unit_unknown = !note.is_one && unit_s == 0.0;
  if (unit_s > 0.0) {
    for (TimedReturn& one : returns.all) one.time_s = (one.time_s - least) * unit_s;
    note.spread_s = (most - least) * unit_s;
    const Turn turn = turn_of(returns.all, note.spread_s);
    note.off_moment = turn.off_moment;
    note.off_turn = turn.off_turn;
    note.sweep_rad = std::fabs(turn.rate_rad_s) * note.spread_s;
    note.turn_s = turn.rate_rad_s != 0.0 ? 2.0 * M_PI / std::fabs(turn.rate_rad_s) : 0.0;
    note.order = order_of(returns);
    note.has_rings = returns.has_rings;
    note.leans = returns.has_rings && lean_rad(returns.all) > kLeanMost_rad;
    if (is_of_turn(note)) note.moved_m_s = moved_m_s(returns.all, turn, note.spread_s).value_or(0.0);
  }
  notes_.push_back(note);
}

ScanTimeFacts ScanTimeLook::facts(const SensorFacts& sensor, const std::vector<std::int64_t>& stamps_ns) const {
  ScanTimeFacts facts;
  facts.scans = notes_.size();
  facts.rings = sensor.rings;
  if (notes_.empty()) return facts;
  const StampSteps steps = look_at_steps(stamps_ns);
  facts.step_s = steps.rate_hz > 0.0 ? 1.0 / steps.rate_hz : 0.0;
  facts.spread_s = median_by(
      notes_, [](const Note& note) { return note.spread_s > 0.0; }, &Note::spread_s);
  facts.turn_s = median_by(notes_, is_of_turn, &Note::turn_s);
  const bool turns = sensor.rings >= kRingsLeast && sensor.azimuth_span_deg >= kRoundLeast_deg;
  const std::pair<TimeFault, Rule> rules[] = {
      {TimeFault::kType, [](const Note& n) { return n.is_type; }},
      {TimeFault::kOne, [](const Note& n) { return n.is_one; }},
      {TimeFault::kUnit, [](const Note& n) { return n.is_unit_unknown; }},
      {TimeFault::kNoTurn, [&](const Note& n) { return turns && !n.leans && n.off_moment > kOffMomentMost; }},
      {TimeFault::kByRow, [&](const Note& n) { return turns && is_by_row(n, sensor.rings); }},
      {TimeFault::kUneven,
       [&](const Note& n) { return turns && is_flat(n) && is_of_turn(n) && n.off_turn > kOffTurnMost; }},
      {TimeFault::kBackward, [&](const Note& n) { return turns && is_of_turn(n) && n.order < kOrderLeast; }},
      {TimeFault::kSpan, [&](const Note& n) { return turns && is_span_wrong(n, facts.step_s); }},
      {TimeFault::kMoved, [&](const Note& n) { return turns && is_flat(n) && n.moved_m_s > 0.0; }},
  };
  for (const auto& [fault, rule] : rules) {
    const auto faulty = static_cast<std::size_t>(std::count_if(notes_.begin(), notes_.end(), rule));
    if (static_cast<double>(faulty) < kFaultyLeast * static_cast<double>(notes_.size()) || faulty == 0) continue;
    facts.fault = fault;
    facts.faulty = faulty;
    facts.share = median_by(notes_, rule, fault == TimeFault::kNoTurn ? &Note::off_moment : &Note::off_turn);
    facts.moved_m_s = median_by(notes_, rule, &Note::moved_m_s);
    break;
  }
  return facts;
}

}  // namespace pose_wall::tools
