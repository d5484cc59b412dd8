// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/packets/turn_assembler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// A turn has 1,800 firings of a VLP-16 at 600 turns a minute, 4,400 of an HDL-32E at 300; more means that no wrap was
// seen.
constexpr std::size_t kFiringsMax = 20'000;
// What falls back by less is late, by more begins a turn. A field of view that is narrower sees no two walls; 30
// degrees are three packets of the sensor whose packets hold most of a turn (a VLP-16 at 1,200 turns a minute: 9.6).
constexpr double kLateMost_deg = 30.0;
// Of the fastest and the slowest head: 1,200 and 300 turns a minute.
constexpr std::int64_t kFastestTurn_ns = 50'000'000, kSlowestTurn_ns = 200'000'000;
// How long a turn that lacks its end waits for it: two packets of that sensor, which is 5.6 ms at 600 turns a minute.
constexpr double kWait_deg = 20.0;
// Three packets of the smallest firings, 24 each, and as many again.
constexpr std::size_t kLateFiringsMax = 150;
// An HDL-32E at 1,200 turns a minute, two returns: 0.7 degrees from pair to pair; a VLP-16: 0.8; a QT64: 1.2.
constexpr double kPacketHole_deg = 2.0;
constexpr double kHoleSteps = 3.0;  // of two lost blocks; none is lost within a packet

// A capture's clock may have gone back within a turn.
std::uint32_t time_within(std::int64_t since_ns, std::uint32_t after_ns) {
  const std::int64_t most = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(since_ns, 0, most - after_ns)) + after_ns;
}

}  // namespace

double turned_deg(double from_deg, double to_deg) {
  const double turn_deg = to_deg - from_deg;
  return turn_deg < 0.0 ? turn_deg + 360.0 : turn_deg;
}

PacketSteps::PacketSteps(const std::vector<double>& azimuths_deg, double known_deg) : step_deg_(known_deg) {
  for (std::size_t i = 1; i < azimuths_deg.size(); ++i) {
    steps_deg_.push_back(turned_deg(azimuths_deg[i - 1], azimuths_deg[i]));
  }
  if (steps_deg_.empty()) return;
  std::vector<double> sorted = steps_deg_;
  std::sort(sorted.begin(), sorted.end());
  const double middle_deg = sorted[(sorted.size() - 1) / 2];
  // Of three and more at most one is a hole.
  if (sorted.size() > 2 || !is_hole(middle_deg, known_deg)) step_deg_ = middle_deg;
}

// A head that turns the other way falls back by little.
bool PacketSteps::is_hole(double step_deg, double usual_deg) {
  const double hole_deg = std::max(kPacketHole_deg, kHoleSteps * usual_deg);
  return step_deg > hole_deg && step_deg < 360.0 - hole_deg;
}

double PacketSteps::after_deg(std::size_t block) const {
  if (steps_deg_.empty()) return step_deg_;
  const std::size_t step = std::min(block, steps_deg_.size() - 1);  // behind the last block as before it
  return is_hole(steps_deg_[step], step_deg_) ? step_deg_ : steps_deg_[step];
}

double PacketSteps::in_holes_ns(std::size_t block, double block_ns) const {
  double hole_deg = 0.0;
  for (std::size_t i = block; i < steps_deg_.size(); ++i) {
    if (is_hole(steps_deg_[i], step_deg_)) hole_deg += steps_deg_[i] - step_deg_;
  }
  return step_deg_ > 0.0 ? hole_deg / step_deg_ * block_ns : 0.0;
}

std::int64_t TurnAssembler::packet_moment_ns(std::int64_t arrival_ns, std::optional<std::int64_t> clock_ns,
                                             std::int64_t modulus_ns, const PacketSteps& steps, double block_ns,
                                             ClockIs clock_is) {
  const double since_begin_ns = clock_is == ClockIs::kOfBegin ? steps.in_holes_ns(0, block_ns) : 0.0;
  return clock_.moment_ns(arrival_ns - std::llround(since_begin_ns), clock_ns, modulus_ns);
}

void TurnAssembler::append(Turn* turn, const Firing& firing) {
  turn->moments.push_back({firing.azimuth_deg, firing.time_ns});
  turn->points.insert(turn->points.end(), firing.points.begin(), firing.points.end());
}

// Its time is by its neighbours: where no clock runs it is that of its arrival, which is later.
void TurnAssembler::insert_late(Turn* turn, const Firing& firing) {
  std::vector<Moment>& moments = turn->moments;
  const auto next = std::lower_bound(moments.begin(), moments.end(), firing.azimuth_deg,
                                     [](const Moment& m, double azimuth_deg) { return m.azimuth_deg < azimuth_deg; });
  const bool is_there = next != moments.end() && next->azimuth_deg == firing.azimuth_deg;
  if (is_there || turn->late == kLateFiringsMax || moments.size() < 2) return;
  ++turn->late;
  const auto after = next == moments.end() ? next - 1 : next == moments.begin() ? next + 1 : next;
  const Moment a = *(after - 1), b = *after;
  const double part =
      a.azimuth_deg < b.azimuth_deg ? (firing.azimuth_deg - a.azimuth_deg) / (b.azimuth_deg - a.azimuth_deg) : 0.0;
  const auto time_ns = a.time_ns + std::llround(part * static_cast<double>(b.time_ns - a.time_ns));
  const auto points_at = static_cast<std::ptrdiff_t>(firing.points.size()) * (next - moments.begin());
  moments.insert(next, {firing.azimuth_deg, time_ns});
  turn->points.insert(turn->points.begin() + points_at, firing.points.begin(), firing.points.end());
}

// Where nothing is missing between two turns, the first is handed on at once. Otherwise it waits for what may be late.
void TurnAssembler::begin_turn(double azimuth_deg) {
  push_waiting();
  if (turn_.has_begun) {
    turn_ns_ =
        std::clamp(turn_.moments.back().time_ns - turn_.moments.front().time_ns, kFastestTurn_ns, kSlowestTurn_ns);
  }
  const double ended_deg = turn_.moments.back().azimuth_deg;
  if (std::fabs(ended_deg - last_ended_deg_) <= 2.0 * step_deg_) ends_deg_ = ended_deg;
  if (std::fabs(azimuth_deg - last_began_deg_) <= 2.0 * step_deg_) begins_deg_ = azimuth_deg;
  const bool is_whole = ended_deg >= ends_deg_ - 2.0 * step_deg_ && azimuth_deg <= begins_deg_ + 2.0 * step_deg_;
  last_ended_deg_ = ended_deg;
  last_began_deg_ = azimuth_deg;
  // A first one that began no later than the next had all that the sensor sends.
  if (turn_.moments.front().azimuth_deg <= azimuth_deg + step_deg_) turn_.has_begun = true;
  waiting_ = std::exchange(turn_, Turn{});
  turn_.has_begun = true;
  if (is_whole) push_waiting();
}

// By time: a pause, or at least half a turn more than the azimuths say.
bool TurnAssembler::is_of_another_turn(const Firing& firing, double ahead_deg) const {
  const std::int64_t gap_ns = firing.time_ns - turn_.moments.back().time_ns;
  if (gap_ns > kPacketPause_ns || gap_ns < -kPacketPause_ns) return true;
  return ahead_deg >= 0.0 && static_cast<double>(gap_ns) > (ahead_deg + 180.0) / 360.0 * static_cast<double>(turn_ns_);
}

void TurnAssembler::add_firing(const Firing& firing, double step_deg) {
  turns_back_ = step_deg > 180.0;
  if (turns_back_) return;
  step_deg_ = step_deg;
  if (!turn_.empty() && is_of_another_turn(firing, firing.azimuth_deg - turn_.moments.back().azimuth_deg)) {
    cut_turn();
  }
  if (turn_.empty()) {
    if (firing.azimuth_deg < step_deg) turn_.has_begun = true;
    append(&turn_, firing);
    return;
  }
  const double ahead_deg = firing.azimuth_deg - turn_.moments.back().azimuth_deg;
  const bool may_be_late = firing.time_ns - turn_.moments.back().time_ns < kPacketLateMost_ns;
  if (may_be_late && ahead_deg > 360.0 - kLateMost_deg) {  // from before the border
    if (!waiting_.empty()) insert_late(&waiting_, firing);
    return;
  }
  if (may_be_late && ahead_deg < 0.0 && ahead_deg > -kLateMost_deg) {
    insert_late(&turn_, firing);
    return;
  }
  if (ahead_deg < 0.0) begin_turn(firing.azimuth_deg);
  if (turn_.moments.size() == kFiringsMax) {
    cut_turn();
  }
  append(&turn_, firing);
  if (!waiting_.empty() && firing.azimuth_deg - turn_.moments.front().azimuth_deg > kWait_deg) push_waiting();
}

void TurnAssembler::cut_turn() {
  push_waiting();
  push_turn(std::exchange(turn_, Turn{}), false);
}

void TurnAssembler::push_waiting() {
  if (waiting_.empty()) return;
  const bool has_begun = waiting_.has_begun;
  push_turn(std::exchange(waiting_, Turn{}), has_begun);
}

void TurnAssembler::push_turn(Turn turn, bool is_complete) {
  const std::size_t firings = turn.moments.size(), rings = turn.points.size() / firings;
  Scan scan;
  const std::int64_t began_ns = turn.moments.front().time_ns;
  scan.stamp_ns = began_ns + clock_.offset_ns();
  scan.rings = static_cast<std::uint32_t>(rings);
  scan.is_complete = is_complete;
  scan.points.resize(turn.points.size());
  for (std::size_t ring = 0; ring < rings; ++ring) {
    for (std::size_t i = 0; i < firings; ++i) {
      ScanPoint& point = scan.points[ring * firings + i];
      point = turn.points[i * rings + ring];
      point.t_ns = time_within(turn.moments[i].time_ns - began_ns, point.t_ns);
    }
  }
  push(std::move(scan));
}

std::string TurnAssembler::hint() const {
  return turns_back_ ? tr("the head turns the other way: its azimuth falls from firing to firing; set it to turn "
                          "clockwise, as it leaves the factory")
                     : "";
}

void TurnAssembler::finish() {
  push_waiting();
  if (turn_.empty()) return;
  const bool has_ended = turn_.moments.back().azimuth_deg > ends_deg_ - step_deg_;
  const bool has_begun = turn_.has_begun;
  push_turn(std::exchange(turn_, Turn{}), has_begun && has_ended);
}

}  // namespace pose_wall::tools
