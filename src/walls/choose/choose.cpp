// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/choose/choose.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "trace/trace.hpp"

namespace pose_wall {
namespace {

constexpr double kRivalShare = 0.5;
constexpr double kBehindShare = 0.3;
constexpr double kGoesOnShare = 0.05;
constexpr double kStopsShare = 0.1;
// A lone wall is solid over at least this share of its span; a boulder and a far spot in line with it are not.
constexpr double kFilledShare = 0.5;
constexpr double kParallelScale_rad = 0.07;  // 4 degrees: walls of one road rarely differ by more
// Both walls of a pair together: two flat spots of two metres each may be parallel by chance.
constexpr double kPairLengthMin_m = 6.0;
// A second wall that is not parallel casts doubt on the first unless it is this much weaker.
constexpr double kDoubtShare = 0.5;
constexpr double kSplayedCosMin = 0.8;  // 37 degrees
constexpr double kAcrossCos = 0.7;      // planes across the road are at more than 45 degrees to the side walls
constexpr double kPairShare = 0.7;
constexpr double kLoneCrossShare = 1.5;

struct Pair {
  const WallCandidate* a = nullptr;
  const WallCandidate* b = nullptr;
  double score = 0.0;
};

// Parallel pairs only; the nearer to parallel, the better.
Pair best_pair(const WallCandidates& as, const WallCandidates& bs, double parallel_cos) {
  Pair best;
  double best_likely = 0.0;
  for (std::uint32_t i = 0; i < as.count; ++i) {
    if (as.item[i].faults != 0) continue;
    for (std::uint32_t j = 0; j < bs.count; ++j) {
      if (bs.item[j].faults != 0) continue;
      const double cosine = std::fabs(as.item[i].plane.n.dot(bs.item[j].plane.n));
      if (!(cosine > parallel_cos)) continue;
      if (!(as.item[i].evidence.length_m + bs.item[j].evidence.length_m >= kPairLengthMin_m)) continue;
      const double score = as.item[i].evidence.score_m2 + bs.item[j].evidence.score_m2;
      const double apart = angle_in_plan(as.item[i].plane, bs.item[j].plane) / kParallelScale_rad;
      const double likely = score / (1.0 + apart * apart);
      if (likely <= best_likely) continue;
      best_likely = likely;
      best = {&as.item[i], &bs.item[j], score};
    }
  }
  return best;
}

// Two strong walls that are not parallel are no road with one direction; a weak plane that happens to be parallel to
// one of them does not make it one.
bool contested(const Pair& pair, const WallCandidates* const (&lists)[2], double parallel_cos) {
  const WallCandidate* const chosen[2] = {pair.a, pair.b};
  for (int side = 0; side < 2; ++side) {
    const Plane& opposite = chosen[1 - side]->plane;
    for (std::uint32_t i = 0; i < lists[side]->count; ++i) {
      const WallCandidate& c = lists[side]->item[i];
      const double cosine = std::fabs(c.plane.n.dot(opposite.n));
      if (c.faults != 0 || cosine > parallel_cos || cosine < kSplayedCosMin) continue;
      if (c.evidence.length_m >= kPairLengthMin_m &&
          chosen[side]->evidence.score_m2 < kDoubtShare * c.evidence.score_m2) {
        return true;
      }
    }
  }
  return false;
}

const WallCandidate* best_single(const WallCandidates& list, double length_min_m) {
  const WallCandidate* best = nullptr;
  for (std::uint32_t i = 0; i < list.count; ++i) {
    const WallCandidate& c = list.item[i];
    const double span_m = c.evidence.along_max_m - c.evidence.along_min_m;
    if (c.faults != 0 || !(c.evidence.length_m >= length_min_m)) continue;
    if (!(c.evidence.length_m >= kFilledShare * span_m)) continue;
    if (best == nullptr || c.evidence.score_m2 > best->evidence.score_m2) best = &c;
  }
  return best;
}

// Why a side has no wall: the gates that its best plane fails.
std::uint32_t faults_of(const WallCandidates& list, double length_min_m) {
  const WallCandidate* const best = strongest(list);
  if (best == nullptr) return POSE_WALL_R_WALL_NOT_FOUND;
  std::uint32_t reasons = POSE_WALL_R_WALL_NOT_FOUND | best->faults;
  if (!(best->evidence.length_m >= length_min_m)) reasons |= POSE_WALL_R_WALL_SHORT;
  return reasons;
}

// Whether a plane lies parallel behind another one: a vehicle or a curtain hides most of the wall behind it, and
// little of that wall is enough to doubt what stands before it.
bool lies_behind(const Plane& plane, const Plane& other) {
  constexpr double kParallelCos = 0.995;
  constexpr double kBehind_m = 0.2;
  return plane.n.dot(other.n) > kParallelCos && plane.d > other.d + kBehind_m;
}

// By how much a plane goes on past the ends of another one, both ends together.
double past_ends_m(const WallEvidence& plane, const WallEvidence& other) {
  const double before_m = other.along_min_m - plane.along_min_m, after_m = plane.along_max_m - other.along_max_m;
  return (before_m > 0.0 ? before_m : 0.0) + (after_m > 0.0 ? after_m : 0.0);
}

constexpr double kPastEndsMin_m = 3.0;
constexpr double kGoesOnLengthMin_m = 3.0;
constexpr double kBesideWall_m = 4.0;  // what stands along a wall is no further from it

// A curtain or a long vehicle ends, and the wall behind it goes on where it ends. An opening in a wall shows what lies
// behind only between the wall's own parts.
bool goes_on_behind(const WallCandidate& rival, const WallCandidate& chosen) {
  return lies_behind(rival.plane, chosen.plane) && rival.plane.d <= chosen.plane.d + kBesideWall_m &&
         past_ends_m(rival.evidence, chosen.evidence) >= kPastEndsMin_m;
}

// The other way round: what was chosen shows itself in the opening of a wall that goes on to its sides, as the end of a
// crosscut does. What goes on less than kBesideWall_m before it may be props, and no wall.
bool goes_on_before(const WallCandidate& rival, const WallCandidate& chosen) {
  return lies_behind(chosen.plane, rival.plane) && chosen.plane.d > rival.plane.d + kBesideWall_m &&
         rival.evidence.length_m >= kGoesOnLengthMin_m &&
         past_ends_m(rival.evidence, chosen.evidence) >= kPastEndsMin_m;
}

// What stands before what was chosen and stops nearly all that comes to it is no row of props, however little of it is
// solid: rather the wall, with ghosts behind it that a wet or shining face throws, or a mesh. Rays tell, not cells: few
// that lie far apart fill as many cells as many that lie close.
bool stops_before(const WallCandidate& rival, const WallCandidate& chosen) {
  constexpr double kStopsMin = 0.75;
  return rival.evidence.stopped >= kStopsMin && lies_behind(chosen.plane, rival.plane);
}

double rival_share(const WallCandidate& rival, const WallCandidate& chosen) {
  if (goes_on_behind(rival, chosen) || goes_on_before(rival, chosen)) return kGoesOnShare;
  if (stops_before(rival, chosen)) return kStopsShare;
  return lies_behind(rival.plane, chosen.plane) ? kBehindShare : kRivalShare;
}

// Few points are no excuse here: they are enough to cast doubt.
const WallCandidate* rival_of(const WallCandidates& list, const WallCandidate* chosen) {
  const WallCandidate* best = nullptr;
  for (std::uint32_t i = 0; i < list.count; ++i) {
    const WallCandidate& c = list.item[i];
    if (&c == chosen || (c.faults & ~static_cast<std::uint32_t>(POSE_WALL_R_WALL_FEW_INLIERS)) != 0) continue;
    if (!(c.evidence.score_m2 >= rival_share(c, *chosen) * chosen->evidence.score_m2)) continue;
    if (best == nullptr || c.evidence.score_m2 > best->evidence.score_m2) best = &c;
  }
  return best;
}

#ifdef POSE_WALL_TRACE
double parallel_by(const Plane& a, const Plane& b) {
  return std::fabs(a.n.dot(b.n));
}

// Of the planes that pass their own gates, the strongest of each side: why these are no pair.
void note_pair(const Pair& pair, const WallCandidates* const (&lists)[2], const Settings& s) {
  const WallCandidate* a = pair.a != nullptr ? pair.a : best_single(*lists[0], 0.0);
  const WallCandidate* b = pair.b != nullptr ? pair.b : best_single(*lists[1], 0.0);
  trace::subject(POSE_WALL_TRACE_WALLS);
  if (a == nullptr || b == nullptr) return;
  const double cosine = parallel_by(a->plane, b->plane), length_m = a->evidence.length_m + b->evidence.length_m;
  trace::gate(POSE_WALL_TRACE_PAIR_PARALLEL, cosine, s.wall_parallel_cos, cosine > s.wall_parallel_cos);
  trace::gate(POSE_WALL_TRACE_PAIR_LENGTH, length_m, kPairLengthMin_m, length_m >= kPairLengthMin_m);
  if (pair.a != nullptr) trace::gate(POSE_WALL_TRACE_PAIR_CONTESTED, !contested(pair, lists, s.wall_parallel_cos));
}

// Two that are long enough to stand alone, and are no pair.
void note_not_parallel(const WallChoice& out, const WallCandidates* const (&lists)[2], const Settings& s) {
  const WallCandidate* const a = best_single(*lists[0], s.wall_alone_length_min);
  const WallCandidate* const b = best_single(*lists[1], s.wall_alone_length_min);
  for (int side = 0; side < 2; ++side) {
    if ((out.reasons[side] & POSE_WALL_R_WALLS_NOT_PARALLEL) == 0) continue;
    trace::gate_of(trace::side_subject(side), POSE_WALL_TRACE_WALLS_PARALLEL, parallel_by(a->plane, b->plane),
                   s.wall_parallel_cos, false);
  }
}

void note_lone_across(double lone_m2, double sides_m2) {
  trace::gate_of(POSE_WALL_TRACE_WALLS, POSE_WALL_TRACE_ACROSS_ALONE, lone_m2 / sides_m2, kLoneCrossShare,
                 !(lone_m2 > kLoneCrossShare * sides_m2));
}

// As faults_of() and best_single() ask; where both sides were refused together, that is all that is said.
void note_none(const WallCandidates& list, int side, bool refused, double length_min_m) {
  const WallCandidate* const best = strongest(list);
  if (refused || best == nullptr) return;
  const WallEvidence& e = best->evidence;
  const double span_m = e.along_max_m - e.along_min_m, filled = span_m > 0.0 ? e.length_m / span_m : 0.0;
  const std::uint32_t subject = trace::side_subject(side);
  trace::gate_of(subject, POSE_WALL_TRACE_WALL_LENGTH_ALONE, e.length_m, length_min_m, e.length_m >= length_min_m);
  trace::gate_of(subject, POSE_WALL_TRACE_WALL_FILLED, filled, kFilledShare, e.length_m >= kFilledShare * span_m);
  trace::gate_of(subject, POSE_WALL_TRACE_WALL_CHOSEN, 0.0, 1.0, false);
}

void note_rival(const WallChoice& out, int side) {
  const WallCandidate* const rival = out.rival[side];
  if (rival == nullptr) return;
  const WallCandidate& chosen = *out.side[side];
  trace::gate_of(trace::side_subject(side), POSE_WALL_TRACE_WALL_RIVAL,
                 rival->evidence.score_m2 / chosen.evidence.score_m2, rival_share(*rival, chosen), false);
}
#endif

void refuse_both(std::uint32_t reason, WallChoice* out) {
  for (int side = 0; side < 2; ++side) {
    out->refused[side] = true;
    out->reasons[side] |= reason;
  }
}

// No parallel pair: one wall alone, unless the other side's plane casts doubt on it.
void choose_single(const WallCandidates* const lists[2], double length_min_m, WallChoice* out) {
  const WallCandidate* best[2] = {best_single(*lists[0], length_min_m), best_single(*lists[1], length_min_m)};
  if (best[0] != nullptr && best[1] != nullptr) {
    const double a = best[0]->evidence.score_m2, b = best[1]->evidence.score_m2;
    const int weaker = a < b ? 0 : 1;
    if ((a < b ? a / b : b / a) >= kDoubtShare) {
      refuse_both(POSE_WALL_R_WALLS_NOT_PARALLEL, out);
      return;
    }
    best[weaker] = nullptr;
    out->reasons[weaker] |= POSE_WALL_R_WALLS_NOT_PARALLEL;
  }
  for (int side = 0; side < 2; ++side) out->side[side] = best[side];
}

// Whether the planes ahead and behind make a better roadway than the chosen sides. Against one wall alone, planes of
// few points count too: they are enough to doubt which way the road runs.
bool stands_across(const WallChoice& sides, const WallCandidates& ahead, const WallCandidates& behind,
                   const Settings& s) {
  const bool alone = sides.side[0] == nullptr || sides.side[1] == nullptr;
  const Plane& side = (sides.side[0] != nullptr ? sides.side[0] : sides.side[1])->plane;
  const auto across = [&](WallCandidates list) {
    for (std::uint32_t i = 0; i < list.count; ++i) {
      WallCandidate& c = list.item[i];
      if (alone) c.faults &= ~static_cast<std::uint32_t>(POSE_WALL_R_WALL_FEW_INLIERS);
      if (!(std::fabs(c.plane.n.dot(side.n)) < kAcrossCos)) c.faults |= POSE_WALL_R_WALL_NOT_FOUND;
    }
    return list;
  };
  const WallCandidates a = across(ahead), b = across(behind);
  POSE_WALL_NOTE(const double pair = best_pair(a, b, s.wall_parallel_cos).score);
  POSE_WALL_NOTE(trace::gate_of(POSE_WALL_TRACE_WALLS, POSE_WALL_TRACE_ACROSS, pair / sides.score_m2, 1.0,
                                !(pair > sides.score_m2)));
  if (best_pair(a, b, s.wall_parallel_cos).score > sides.score_m2) return true;
  if (!alone) return false;
  for (const WallCandidate* lone : {best_single(a, s.wall_length_min), best_single(b, s.wall_length_min)}) {
    POSE_WALL_NOTE(if (lone != nullptr) note_lone_across(lone->evidence.score_m2, sides.score_m2));
    if (lone != nullptr && lone->evidence.score_m2 > kLoneCrossShare * sides.score_m2) return true;
  }
  return false;
}

// A side without a wall gets its reason, one with a wall the best that could stand in for it.
void say_why_or_rival(const WallCandidates* const (&lists)[2], const Settings& settings, WallChoice* out) {
  for (int side = 0; side < 2; ++side) {
    if (out->side[side] == nullptr) {
      POSE_WALL_NOTE(note_none(*lists[side], side, out->refused[side], settings.wall_alone_length_min));
      if (!out->refused[side]) out->reasons[side] |= faults_of(*lists[side], settings.wall_alone_length_min);
      out->refused[side] = true;
    } else {
      out->rival[side] = rival_of(*lists[side], out->side[side]);
      POSE_WALL_NOTE(note_rival(*out, side));
    }
  }
}

}  // namespace

const WallCandidate* strongest(const WallCandidates& list) {
  const WallCandidate* best = nullptr;
  for (std::uint32_t i = 0; i < list.count; ++i) {
    if (best == nullptr || list.item[i].evidence.score_m2 > best->evidence.score_m2) best = &list.item[i];
  }
  return best;
}

double angle_in_plan(const Plane& a, const Plane& b) {
  const double cross = a.n.x() * b.n.y() - a.n.y() * b.n.x(), dot = a.n.x() * b.n.x() + a.n.y() * b.n.y();
  return arc_tangent2(std::fabs(cross), std::fabs(dot));
}

WallChoice choose_walls(const WallCandidates& left, const WallCandidates& right, const Settings& settings) {
  WallChoice out;
  const WallCandidates* const lists[2] = {&left, &right};
  Pair pair = best_pair(left, right, settings.wall_parallel_cos);
  POSE_WALL_NOTE(note_pair(pair, lists, settings));
  if (pair.a != nullptr && contested(pair, lists, settings.wall_parallel_cos)) pair = Pair{};
  double alone = 0.0;
  for (const WallCandidates* list : lists) {
    const WallCandidate* lone = best_single(*list, settings.wall_alone_length_min);
    if (lone != nullptr && lone->evidence.score_m2 > alone) alone = lone->evidence.score_m2;
  }
  POSE_WALL_NOTE(if (pair.a != nullptr) trace::gate_of(POSE_WALL_TRACE_WALLS, POSE_WALL_TRACE_PAIR_SHARE,
                                                       alone > 0.0 ? pair.score / alone : 1.0, kPairShare,
                                                       pair.score >= kPairShare * alone));
  // A pair that shows much less than one wall alone is a pair by chance.
  if (pair.a != nullptr && pair.score >= kPairShare * alone) {
    out.side[0] = pair.a;
    out.side[1] = pair.b;
  } else {
    choose_single(lists, settings.wall_alone_length_min, &out);
    POSE_WALL_NOTE(note_not_parallel(out, lists, settings));
  }
  for (const WallCandidate* c : out.side) out.score_m2 += c != nullptr ? c->evidence.score_m2 : 0.0;
  say_why_or_rival(lists, settings, &out);
  return out;
}

void refuse_if_across(const WallCandidates& ahead, const WallCandidates& behind, const Settings& settings,
                      WallChoice* choice) {
  const bool across = choice->any() ? stands_across(*choice, ahead, behind, settings)
                                    : best_pair(ahead, behind, settings.wall_parallel_cos).a != nullptr;
  if (across) refuse_both(POSE_WALL_R_CROSS_ROAD, choice);
}

}  // namespace pose_wall
