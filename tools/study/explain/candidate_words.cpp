// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/candidate_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/language/language.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

constexpr std::size_t kToldMax = 3;
// A plane with a smaller share of the strongest one's score is only counted.
constexpr double kToldShare = 0.2;

double number(const pose_wall_config& config, const char* key) {
  double value = 0.0;
  pose_wall_config_get_number(&config, key, &value);
  return value;
}

bool is_floor(const pose_wall_trace_candidate& c) {
  return c.subject == POSE_WALL_TRACE_FLOOR;
}

// The machine's forward axis in the levelled frame, in plan.
std::array<double, 2> forward_level(const pose_wall_config& config, const pose_wall_result& result) {
  char axis[POSE_WALL_TEXT_MAX] = "+X";
  pose_wall_config_get_text(&config, "forward_axis", axis, sizeof axis);
  const std::size_t column = axis[1] == 'Y' ? 1 : 0;
  const double sign = axis[0] == '-' ? -1.0 : 1.0;
  return {sign * result.R_level_base[column], sign * result.R_level_base[3 + column]};
}

// How the plane runs against the machine: 0 along it, left is positive.
double turn_rad(const pose_wall_trace_candidate& c, const std::array<double, 2>& forward) {
  std::array<double, 2> along = {-c.normal[1], c.normal[0]};
  const double dot = forward[0] * along[0] + forward[1] * along[1];
  const double cross = forward[0] * along[1] - forward[1] * along[0];
  return dot >= 0.0 ? std::atan2(cross, dot) : std::atan2(-cross, -dot);
}

std::string where_text(const pose_wall_trace_candidate& c, const std::array<double, 2>& forward) {
  if (!is_floor(c)) return say("at {}, turned by {}", metres(c.d_m), degrees(turn_rad(c, forward)));
  const std::string height = metres(std::fabs(c.height_m)), tilt = degrees(c.tilt_rad);
  return c.height_m < 0.0 ? say("{} above the sensor, tilted by {}", height, tilt)
                          : say("{} below the sensor, tilted by {}", height, tilt);
}

std::string shows_text(const pose_wall_trace_candidate& c) {
  if (is_floor(c)) {
    return c.area_m2 > 0.0 ? say("{:.2f} m² of open ground", c.area_m2)
                           : say("{} of the points tried", per_cent(c.support));
  }
  return c.area_m2 > 0.0 ? say("{} long, {:.2f} m²", metres(c.length_m), c.area_m2) : tr("nothing solid");
}

std::string faults_text(const pose_wall_config& config, const pose_wall_trace_candidate& c) {
  std::vector<std::string> faults;
  if ((c.reasons & POSE_WALL_R_WALL_FEW_INLIERS) != 0) {
    faults.push_back(
        say("{:.0f} points; wall_inlier_min requires {:.0f}", c.inliers, number(config, "wall_inlier_min")));
  }
  if ((c.reasons & POSE_WALL_R_WALL_SHORT) != 0) {
    faults.push_back(say("wall_length_min requires {}", metres(number(config, "wall_length_min"))));
  }
  if ((c.reasons & POSE_WALL_R_WALL_SEEN_THROUGH) != 0) {
    faults.push_back(say("{} of it is seen through", per_cent(c.seen_through)));
  }
  if ((c.reasons & POSE_WALL_R_WALL_LEANS) != 0) {
    faults.push_back(say("leans {}; wall_lean_max_deg allows {}°", degrees(std::fabs(c.tilt_rad)),
                         number(config, "wall_lean_max_deg")));
  }
  return clauses(faults);
}

std::string out_of_range_text(const pose_wall_config& config, const pose_wall_trace_candidate& c) {
  if (!is_floor(c)) {
    const bool is_side = c.subject == POSE_WALL_TRACE_LEFT || c.subject == POSE_WALL_TRACE_RIGHT;
    const double yaw_max_deg = number(config, "yaw_max_deg");
    return is_side ? say("runs too far across the machine (yaw_max_deg is {}°, and the search adds a few)", yaw_max_deg)
                   : say("runs too far along the machine (yaw_max_deg is {}°, and the search adds a few)", yaw_max_deg);
  }
  const double lowest = number(config, "ground_height_min"), highest = number(config, "ground_height_max");
  if (c.height_m > highest) return say("ground_height_max allows {}", metres(highest));
  if (c.height_m < 0.0) return tr("no floor is above the sensor");
  if (c.height_m < lowest) return say("ground_height_min requires {}", metres(lowest));
  return say("ground_tilt_max_deg allows {}°", number(config, "ground_tilt_max_deg"));
}

std::string fate_text(const pose_wall_config& config, const pose_wall_trace_candidate& c, double best_score_m2) {
  const double share = best_score_m2 > 0.0 ? c.score_m2 / best_score_m2 : 0.0;
  switch (c.fate) {
    case POSE_WALL_TRACE_CHOSEN:
      return tr("chosen");
    case POSE_WALL_TRACE_RIVAL:
      return say("a rival, {} of the best", per_cent(share));
    case POSE_WALL_TRACE_WEAKER:
      return share < 1.0 ? say("weaker, {} of the best", per_cent(share)) : tr("passed its own gates");
    case POSE_WALL_TRACE_GATES_FAILED:
      return faults_text(config, c);
    case POSE_WALL_TRACE_OUT_OF_RANGE:
      return out_of_range_text(config, c);
    case POSE_WALL_TRACE_UNSUPPORTED:
      return tr("points do not support it better than chance");
    case POSE_WALL_TRACE_REPEATS:
      return tr("the same as another one");
    case POSE_WALL_TRACE_MUCH_BELOW:
      return tr("too much is seen below it: a deck, a bench or a table");
    default:
      return tr("seen through open floor: a reflection");
  }
}

bool is_itself(const pose_wall_trace_candidate& a, const pose_wall_trace_candidate& b) {
  return std::equal(a.normal, a.normal + 3, b.normal) && !(a.d_m < b.d_m) && !(b.d_m < a.d_m);
}

// The planes ahead may be weighed twice, and a rejected surface may be drawn many times.
bool is_told_already(const pose_wall_trace_candidate& c, const std::vector<PlaneWords>& told) {
  constexpr double kSame_m = 0.1, kSameCosine = 0.9986;  // 3 degrees
  const auto is_same = [&](const PlaneWords& t) {
    const pose_wall_trace_candidate& o = t.candidate;
    if (o.fate != c.fate) return false;
    if (is_itself(o, c)) return true;
    const bool is_nothing =
        c.fate == POSE_WALL_TRACE_OUT_OF_RANGE || (c.fate == POSE_WALL_TRACE_UNSUPPORTED && !is_floor(c));
    if (!is_nothing) return false;
    if (is_floor(c)) return std::fabs(o.height_m - c.height_m) < kSame_m;
    const double cosine = o.normal[0] * c.normal[0] + o.normal[1] * c.normal[1] + o.normal[2] * c.normal[2];
    return std::fabs(o.d_m - c.d_m) < kSame_m && cosine > kSameCosine;
  };
  return std::any_of(told.begin(), told.end(), is_same);
}

std::string considered(std::size_t others) {
  return others == 1 ? say("{} other plane was considered", others) : say("{} other planes were considered", others);
}

}  // namespace

std::vector<PlaneWords> planes_of(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes,
                                  std::uint32_t subject) {
  std::vector<pose_wall_trace_candidate> candidates = notes.candidates(subject);
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [](const auto& c) { return c.fate == POSE_WALL_TRACE_REPEATS; }),
                   candidates.end());
  const std::array<double, 2> forward = forward_level(config, result);
  double best_m2 = 0.0;
  for (const auto& c : candidates) best_m2 = std::max(best_m2, c.score_m2);
  std::vector<PlaneWords> out;
  out.reserve(candidates.size());
  for (const auto& c : candidates) {
    if (is_told_already(c, out)) continue;
    out.push_back({c, where_text(c, forward), shows_text(c), fate_text(config, c, best_m2)});
  }
  return out;
}

std::string others_sentence(const std::vector<PlaneWords>& planes) {
  std::vector<std::string> told;
  std::size_t others = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const PlaneWords& p = planes[i];
    if (i == 0 || p.candidate.fate == POSE_WALL_TRACE_CHOSEN) continue;
    ++others;
    const bool is_weak = p.candidate.score_m2 < kToldShare * planes.front().candidate.score_m2;
    if (told.size() < kToldMax && !is_weak) told.push_back(say("{} ({}): {}", p.where, p.shows, p.fate));
  }
  if (others == 0) return "";
  if (told.empty()) return say("{}, and much weaker.", considered(others));
  if (others > told.size()) told.push_back(say("and {} more", others - told.size()));
  return say("{}: {}.", considered(others), clauses(told));
}

}  // namespace pose_wall::tools::explain
