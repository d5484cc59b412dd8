// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/road_memory.hpp"

#include <cmath>

#include "base/estimation/protection.hpp"
#include "base/math/finite.hpp"

namespace pose_wall {
namespace {

// Two walls that run apart are judged by the same (quality.cpp): by more than two deviations they are known less well
// than they seem (Birge 1932), and by more than three, 0.3 % of cases, they are two things.
constexpr double kLikelyInSigmas = 2.0, kApartInSigmas = 3.0;
// As often a jump has to come again (kConfirmations in temporal.cpp).
constexpr std::uint32_t kContradictionsMost = 3;
// What differs from frame to frame is learnt over 16 of them, as in motion (scan_motion).
constexpr double kPerFrame = 1.0 / 16.0;
// A scatter of 16 frames is known to a fifth; so all of it is never noise, and no look without rock.
constexpr double kNoiseMost = 0.5;
// Variances of looks are averaged over so many frames, 13 m at 1 m/s and 10 Hz, and over so many looks at other rock.
constexpr std::uint32_t kFramesMost = 128;
constexpr double kLooksMost = 5.0;  // variances fade twice as fast as errors: in 13 m over 5 m
// Variances with eight degrees of freedom each differ by more than this in 5 % of cases: F-distribution.
constexpr double kUnlike = 4.0;

double square(double x) {
  return x * x;
}

// A look's random part as a variance with its degrees of freedom, and the other parts.
struct Look {
  double value, dof, variance;
  ProtectionParts bound;

  Look(const Measurement& m, const Settings& s)
      : value(m.raw),
        dof(m.dof),
        variance(square(m.protection[POSE_WALL_PART_RANDOM] / protection_factor(s.protection_sigmas, m.dof))),
        bound(m.protection) {
    bound[POSE_WALL_PART_RANDOM] = 0.0;
  }
};

// The variance of 1 - share of the memory and share of a look.
struct Mixture {
  double of_memory, of_look, of_both;

  double variance(double share) const {
    return square(1.0 - share) * of_memory + square(share) * of_look + 2.0 * share * (1.0 - share) * of_both;
  }

  // With the least k sqrt(variance) + share * slope: a parabola under the root, and a line.
  double best_share(double k, double slope) const {
    const double a = of_memory + of_look - 2.0 * of_both, half_b = of_both - of_memory;
    const double steep = k * k * a - slope * slope;
    if (!(a > 0.0 && steep > 0.0)) return slope < 0.0 ? 1.0 : 0.0;
    const double least = larger(0.0, of_memory - half_b * half_b / a);
    const double share = -half_b / a - slope * std::sqrt(least / (a * steep));
    return share > 1.0 ? 1.0 : larger(0.0, share);
  }
};

// How well looks of this road are known. One that is unlike those before begins anew.
void learn_from(const Look& look, double new_rock, RoadMemory* m) {
  const bool alike = look.variance <= kUnlike * m->usual_variance && m->usual_variance <= kUnlike * look.variance;
  if (!alike) m->frames = 0;
  const double looks = m->looks + new_rock * (2.0 - new_rock);  // of variances
  m->looks = m->frames == 0 ? 1.0 : looks < kLooksMost ? looks : kLooksMost;
  if (m->frames < kFramesMost) ++m->frames;
  const double share = 1.0 / m->frames;
  m->usual_variance += share * (look.variance - m->usual_variance);
  m->usual_dof += share * (look.dof - m->usual_dof);
}

// Of a look, stretched by the degrees of freedom of all that are alike. Of this look and the mean of all the rougher
// counts.
double stretched_variance(const Look& look, const RoadMemory& m, const Settings& s) {
  const double k = s.protection_sigmas, by = protection_factor(k, m.looks * m.usual_dof) / k;
  return larger(look.variance, m.usual_variance) * square(by);
}

void begin_with(const Look& look, const Settings& s, RoadMemory* m) {
  m->exists = true;
  m->value = look.value;
  m->bound = look.bound;
  m->last_share = m->weight = m->weight_here = m->looks_here = 1.0;
  m->way_sigma = 0.0;
  m->frames = 0;
  m->noise = 0.0;
  m->contradicted = 0;
  learn_from(look, 0.0, m);
  m->variance = stretched_variance(look, *m, s);
  m->with_rock = std::sqrt(m->variance);
}

// False if the look contradicts the memory. Whatever differs by more than chance stays in doubt for some frames.
bool agrees(const Look& look, double variance, RoadMemory* m) {
  constexpr double kMost = 2.0 * kApartInSigmas;  // further is another surface, whatever the distance
  const double apart_m = larger(0.0, std::fabs(look.value - m->value) - m->bound[POSE_WALL_PART_AGE]);
  const double apart = apart_m / std::sqrt(variance + larger(look.variance, m->usual_variance));
  const double faded = 1.0 + (1.0 - kPerFrame) * (m->stretch - 1.0);
  m->stretch = larger(faded, (apart < kMost ? apart : kMost) / kLikelyInSigmas);
  return apart <= kApartInSigmas;
}

// The deviation that the rock in view gives to a look. The rest is noise: half of what two looks differ by, but for
// what places and new rock explain. A look that was contradicted tells none.
double rock_sigma(double difference, double explained, double variance, RoadMemory* m) {
  if (m->contradicted == 0) m->noise += kPerFrame * (0.5 * square(difference) - explained - m->noise);
  const double most = kNoiseMost * variance;
  return std::sqrt(variance - (m->noise < most ? larger(0.0, m->noise) : most));
}

// What a look tells of a surface's form holds for what comes next as well: no memory makes a road straight that bends
// ahead, and no wall is one because there was one. But a machine stands on the floor that it has seen before itself,
// and that answers whether another one may carry it.
ProtectionParts with_what_is_new(const ProtectionParts& memory, const ProtectionParts& look, std::uint32_t quantity) {
  ProtectionParts out = memory;
  for (const pose_wall_part part : {POSE_WALL_PART_BEND, POSE_WALL_PART_RIVAL, POSE_WALL_PART_EXTRAPOLATION}) {
    if (quantity < POSE_WALL_YAW && part != POSE_WALL_PART_BEND) continue;
    out[part] = larger(memory[part], look[part]);
  }
  return out;
}

ProtectionParts mixed(const ProtectionParts& memory, const ProtectionParts& look, double share) {
  ProtectionParts out;
  out.add(memory, 1.0 - share);
  out.add(look, share);
  return out;
}

// The share by which a look stays in the memory. The best one for this frame would be greedy, since it forgets rock
// that lies behind and will be worth more once this rock is behind, too. In the best mean over a way each look counts
// by the rock that it shows for the first time, and the first one whole (Gauss and Markov, errors that fade as
// exponentials do). Looks at the same rock share that evenly. A look in doubt counts less.
double lasting_share(double in_doubt, double new_rock, double k, RoadMemory* m) {
  m->weight += new_rock;
  m->weight_here += new_rock;
  m->looks_here += 1.0;
  const double here = m->weight_here < m->weight ? m->weight_here : m->weight;
  const double share = larger(new_rock, here / m->looks_here) / m->weight;
  const double trust = 1.0 - in_doubt / (k * std::sqrt(m->variance));
  return trust < 1.0 ? share * larger(0.0, trust) : share;
}

void take_in(const Look& look, double share, double variance, double rock, RoadMemory* m) {
  m->value += share * (look.value - m->value);
  m->bound = mixed(m->bound, look.bound, share);
  m->variance = Mixture{m->variance, variance, rock * m->with_rock}.variance(share);
  m->with_rock = (1.0 - share) * m->with_rock + share * rock;
  m->way_sigma *= 1.0 - share;
  m->last_share = share;
}

}  // namespace

void carry_on(const Change& change, std::uint32_t q, const Settings& s, RoadMemory* m) {
  m->exists = m->exists && change.by_places[q];
  if (!m->exists) return;
  const double per_level = 1.0 / s.protection_sigmas, same = 1.0 - change.new_rock[q];
  const double of_last_place = m->last_share * per_level * change.place_level_before[q];
  const double more = square(per_level) * change.drift2[q] + square(of_last_place);
  m->value += change.carry[q];
  m->variance += more;
  m->way_sigma += per_level * change.by_way[q];
  m->bound[POSE_WALL_PART_AGE] += change.growth[q] - change.by_way[q];
  m->with_rock *= same;
  m->weight /= 1.0 + m->weight * more / m->usual_variance;  // information that is lost
  m->weight_here *= same;
  m->looks_here *= same * same;
  m->last_share = 0.0;
}

Recalled look_again(const Measurement& measured, double last_raw, const Change& change, std::uint32_t q,
                    const Settings& s, RoadMemory* m) {
  const Look look(measured, s);
  const Recalled alone = {measured.raw, measured.protection};
  if (!m->exists || !(look.variance > 0.0)) {
    begin_with(look, s, m);
    m->stretch = 1.0;
    m->exists = look.variance > 0.0 && !measured.stale;
    return alone;
  }
  const double k = s.protection_sigmas, of_place = square(change.place_level[q] / k);
  const double here = m->variance + of_place + square(m->way_sigma);
  if (!agrees(look, here, m)) {
    if (++m->contradicted >= kContradictionsMost) begin_with(look, s, m);
    return alone;
  }
  learn_from(look, change.new_rock[q], m);
  const double variance = stretched_variance(look, *m, s);
  const double rock = rock_sigma(look.value - last_raw, of_place + change.new_rock[q] * variance, variance, m);
  m->contradicted = 0;
  const Mixture mixture = {here, variance, rock * m->with_rock};
  const ProtectionParts remembered = with_what_is_new(m->bound, look.bound, q);
  const double of_look = look.bound.sum(), of_memory = remembered.sum();
  const double best = mixture.best_share(k, of_look - of_memory);
  Recalled now = {m->value + best * (look.value - m->value), mixed(remembered, look.bound, best)};
  now.protection[POSE_WALL_PART_RANDOM] = k * m->stretch * std::sqrt(mixture.variance(best));
  const bool helps = k * m->stretch * std::sqrt(here) + of_memory < measured.protection.sum();
  const double doubt = of_look - m->bound.sum();
  take_in(look, helps ? lasting_share(doubt, change.new_rock[q], k, m) : best, variance, rock, m);
  return now.protection.sum() < measured.protection.sum() ? now : alone;
}

void round_off(RoadMemory* m) {
  const auto round = [](double* number) { *number = static_cast<double>(static_cast<float>(*number)); };
  for (double* number : {&m->value, &m->variance, &m->way_sigma, &m->with_rock, &m->last_share, &m->stretch, &m->noise,
                         &m->weight, &m->weight_here, &m->looks_here, &m->usual_variance, &m->usual_dof, &m->looks}) {
    round(number);
  }
  for (double& part : m->bound.of) round(&part);
}

}  // namespace pose_wall
