// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/choose/choose.hpp"

#include <cmath>

#include "engine/gates/gate.hpp"

namespace pose_wall {
namespace {

// 4 degrees: walls of one road rarely differ by more.
constexpr double kParallelScale_rad = 0.07;  // swept: half and twice change nothing
// Half as strong a wall, not parallel, doubts the first; swept: half nothing, twice 2 won.
constexpr double kDoubtShare = 0.5;
constexpr double kAcrossCos = 0.7;  // 45 degrees: planes turned further from the side walls stand across the road

struct Pair {
  const WallCandidate* a = nullptr;
  const WallCandidate* b = nullptr;
  double score = 0.0;
};

bool may_be_pair(const WallCandidate& a, const WallCandidate& b, const Settings& s) {
  return passes<gate::PAIR_PARALLEL>(std::fabs(a.plane.n.dot(b.plane.n)), s);
}

// Parallel pairs only; the nearer to parallel, the better.
Pair best_pair(const WallCandidates& as, const WallCandidates& bs, const Settings& s) {
  POSE_WALL_NOTE(const trace::Silence until_chosen);
  Pair best;
  double best_likely = 0.0;
  for (std::uint32_t i = 0; i < as.count; ++i) {
    if (as.item[i].failed != 0) continue;
    for (std::uint32_t j = 0; j < bs.count; ++j) {
      if (bs.item[j].failed != 0 || !may_be_pair(as.item[i], bs.item[j], s)) continue;
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

// The best plane that is long enough by itself.
const WallCandidate* best_single(const WallCandidates& list, const Settings& s) {
  POSE_WALL_NOTE(const trace::Silence until_chosen);
  return list.strongest_of([&](std::uint32_t i) {
    return list.item[i].failed == 0 && passes<gate::WALL_LENGTH_ALONE>(list.item[i].evidence.length_m, s);
  });
}

// Why a side has no wall: the gates that its strongest plane fails.
std::uint32_t why_none(const WallCandidates& list, const Settings& s) {
  Verdict why;
  const WallCandidate* const best = list.strongest();
  if (best != nullptr) {
    why.reasons = best->failed;
    demand<gate::WALL_LENGTH_ALONE>(&why, best->evidence.length_m, s);
  }
  demand<gate::WALL_CHOSEN>(&why, false);
  return why.reasons;
}

// True if a plane lies parallel behind another one. A vehicle or a curtain hides most of the wall behind it, so little
// of that wall is enough for a doubt.
bool lies_behind(const Plane& plane, const Plane& other) {
  constexpr double kParallelCos = 0.995;  // planes within 5.7 degrees are parallel; swept: half 4 lost, twice 4 won
  constexpr double kBehind_m = 0.2;       // more than lies on a wall (15 cm); swept: half 1 lost, twice 2 won
  return plane.n.dot(other.n) > kParallelCos && plane.d > other.d + kBehind_m;
}

// Length by which a plane goes on past the ends of another one, both ends together.
double past_ends_m(const WallEvidence& plane, const WallEvidence& other) {
  const double before_m = other.along_min_m - plane.along_min_m, after_m = plane.along_max_m - other.along_max_m;
  return (before_m > 0.0 ? before_m : 0.0) + (after_m > 0.0 ? after_m : 0.0);
}

// Both ends together; more is a wall that the plane hides; swept: half nothing, twice 1 won.
constexpr double kPastEndsMin_m = 3.0;
// A wall beside a crosscut's mouth shows it; without, a short plane is a rival as well
// (WallSelect.AWallThatGoesOnBesideWhatItsOpeningShowsIsARival); swept: half and twice change nothing.
constexpr double kGoesOnLengthMin_m = 3.0;
constexpr double kBesideWall_m = 4.0;  // things along a wall are nearer; a mouth's end was 15 m off (seed 642)

// A curtain or a long vehicle ends, and the wall behind it goes on. Through an opening in a wall the plane behind shows
// only between the wall's own parts.
bool goes_on_behind(const WallCandidate& rival, const WallCandidate& chosen) {
  return lies_behind(rival.plane, chosen.plane) && rival.plane.d <= chosen.plane.d + kBesideWall_m &&
         past_ends_m(rival.evidence, chosen.evidence) >= kPastEndsMin_m;
}

// The other way round: the chosen plane shows through an opening of a wall that goes on to both sides, like the end of
// a crosscut. A plane less than kBesideWall_m before it may be props, and no wall.
bool goes_on_before(const WallCandidate& rival, const WallCandidate& chosen) {
  return lies_behind(chosen.plane, rival.plane) && chosen.plane.d > rival.plane.d + kBesideWall_m &&
         rival.evidence.length_m >= kGoesOnLengthMin_m &&
         past_ends_m(rival.evidence, chosen.evidence) >= kPastEndsMin_m;
}

// A plane before the chosen one that stops nearly all rays is no row of props, however little of it is solid. It is
// rather the wall, with ghosts of a wet or shining face behind it, or a mesh. Counts rays, not cells: few ghosts far
// apart fill as many cells as many points close together.
bool stops_before(const WallCandidate& rival, const WallCandidate& chosen) {
  constexpr double kStopsMin = 0.75;  // props and conveyors stop fewer rays; swept: half 4 lost, twice 1 won
  return rival.evidence.stopped >= kStopsMin && lies_behind(chosen.plane, rival.plane);
}

// Share of a plane's solid area that does not belong to the chosen wall, which runs elsewhere. What does is no evidence
// for another wall: a plane through the machine's end of a wall, turned by two degrees, holds most of the same points.
double own_share(const WallCandidate& rival, const WallCandidate& chosen, const Settings& s) {
  const double near_m = on_wall_m(s);
  double all = 0.0, own = 0.0;
  for (std::uint32_t column = 0; column < kWallColumns; ++column) {
    const double rows = rival.evidence.solid_rows[column];
    const double middle_m = wall_column_from_m(column) + 0.5 * kWallColumn_m;
    const Eigen::Vector3d place_m = middle_m * rival.along_level - rival.plane.d * rival.plane.n;
    all += rows;
    own += std::fabs(chosen.plane.signed_distance(place_m)) > near_m ? rows : 0.0;
  }
  return all > 0.0 ? own / all : 1.0;
}

// True if a plane shows too little of its own, beside the chosen one, to be the wall as well.
bool is_weaker(const WallCandidate& rival, const WallCandidate& chosen, const Settings& s) {
  const double share = rival.evidence.score_m2 / chosen.evidence.score_m2;
  if (goes_on_behind(rival, chosen) || goes_on_before(rival, chosen)) return passes<gate::WALL_RIVAL_ENDS>(share, s);
  if (stops_before(rival, chosen)) return passes<gate::WALL_RIVAL_STOPS>(share, s);
  if (lies_behind(rival.plane, chosen.plane)) return passes<gate::WALL_RIVAL_BEHIND>(share, s);
  return passes<gate::WALL_RIVAL>(own_share(rival, chosen, s) * share, s);
}

// All planes that may be the wall as well. Planes with few points count here: they are enough for a doubt.
std::uint32_t rivals_of(const WallCandidates& list, const WallCandidate& chosen, const Settings& s) {
  POSE_WALL_NOTE(const trace::Silence until_chosen);
  std::uint32_t rivals = 0;
  for (std::uint32_t i = 0; i < list.count; ++i) {
    const WallCandidate& c = list.item[i];
    if (&c == &chosen || (c.failed & ~static_cast<std::uint32_t>(POSE_WALL_R_WALL_FEW_INLIERS)) != 0) continue;
    if (!is_weaker(c, chosen, s)) rivals |= 1U << i;
  }
  return rivals;
}

void refuse_both(const Verdict& verdict, WallChoice* out) {
  for (Verdict& of_side : out->verdict) of_side.add(verdict);
}

#ifdef POSE_WALL_TRACE
// Notes why the strongest planes of both sides that pass their own gates are no pair.
void note_pair(const Pair& pair, const WallCandidates* const (&lists)[2], const Settings& s) {
  const auto strongest_good = [](const WallCandidates& list) {
    return list.strongest_of([&list](std::uint32_t i) { return list.item[i].failed == 0; });
  };
  const WallCandidate* const a = pair.a != nullptr ? pair.a : strongest_good(*lists[0]);
  const WallCandidate* const b = pair.b != nullptr ? pair.b : strongest_good(*lists[1]);
  if (a != nullptr && b != nullptr) may_be_pair(*a, *b, s);
}
#endif

Pair choose_pair(const WallCandidates* const (&lists)[2], const Settings& s) {
  POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_WALLS));
  const Pair pair = best_pair(*lists[0], *lists[1], s);
  POSE_WALL_NOTE(note_pair(pair, lists, s));
  return pair;
}

// Notes that this side's wall makes no pair with the longest wall of the other side.
void add_no_pair(int side, WallChoice* out) {
  POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
  Verdict no_pair;
  demand<gate::WALLS_PARALLEL>(&no_pair, false);
  out->verdict[side].reasons |= no_pair.reasons;
}

// Without a parallel pair: one wall alone, unless the other side's plane doubts it.
void choose_single(const WallCandidates* const (&lists)[2], const Settings& s, WallChoice* out) {
  const WallCandidate* best[2] = {best_single(*lists[0], s), best_single(*lists[1], s)};
  if (best[0] != nullptr && best[1] != nullptr) {
    const double a = best[0]->evidence.score_m2, b = best[1]->evidence.score_m2;
    const int weaker = a < b ? 0 : 1;
    add_no_pair(weaker, out);
    best[weaker] = nullptr;
    if ((a < b ? a / b : b / a) >= kDoubtShare) {
      add_no_pair(1 - weaker, out);
      best[1 - weaker] = nullptr;
      for (Verdict& verdict : out->verdict) verdict.refused = true;
    }
  }
  for (int side = 0; side < 2; ++side) out->side[side] = best[side];
}

// A side without a wall gets its reason, a side with a wall its best rival.
void say_why_or_rival(const WallCandidates* const (&lists)[2], const Settings& s, WallChoice* out) {
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
    Verdict& verdict = out->verdict[side];
    if (out->side[side] == nullptr) {
      if (!verdict.refused) verdict.reasons |= why_none(*lists[side], s);
      verdict.refused = true;
    } else {
      out->rivals[side] = rivals_of(*lists[side], *out->side[side], s);
      POSE_WALL_NOTE(const WallCandidate* const rival = out->strongest_rival(side, *lists[side]));
      POSE_WALL_NOTE(if (rival != nullptr) is_weaker(*rival, *out->side[side], s));
    }
  }
}

// Planes across the road.
WallCandidates across(const WallCandidates& list, const WallChoice& sides) {
  WallCandidates out = list;
  const Plane& side = (sides.side[0] != nullptr ? sides.side[0] : sides.side[1])->plane;
  for (std::uint32_t i = 0; i < out.count; ++i) {
    WallCandidate& c = out.item[i];
    if (!(std::fabs(c.plane.n.dot(side.n)) < kAcrossCos)) c.failed |= POSE_WALL_R_WALL_NOT_FOUND;
  }
  return out;
}

}  // namespace

WallChoice choose_walls(const WallCandidates& left, const WallCandidates& right, const Settings& settings) {
  WallChoice out;
  const WallCandidates* const lists[2] = {&left, &right};
  const Pair pair = choose_pair(lists, settings);
  if (pair.a != nullptr) {
    out.side[0] = pair.a;
    out.side[1] = pair.b;
  } else {
    choose_single(lists, settings, &out);
  }
  for (const WallCandidate* c : out.side) out.score_m2 += c != nullptr ? c->evidence.score_m2 : 0.0;
  say_why_or_rival(lists, settings, &out);
  return out;
}

void refuse_if_across(const WallCandidates& ahead, const WallCandidates& behind, const Settings& settings,
                      WallChoice* choice) {
  POSE_WALL_NOTE(const trace::About about(POSE_WALL_TRACE_WALLS));
  Verdict verdict;
  // Without a chosen side any pair is better.
  const Pair pair = choice->any() ? best_pair(across(ahead, *choice), across(behind, *choice), settings)
                                  : best_pair(ahead, behind, settings);
  if (choice->any() || pair.a != nullptr) demand<gate::ACROSS>(&verdict, pair.score / choice->score_m2, settings);
  refuse_both(verdict, choice);
}

}  // namespace pose_wall
