// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/survey_line.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/numbers/angles.hpp"
#include "lab/sim/middle_of.hpp"

namespace pose_wall::tools::sim {
namespace {

// Judgement, 2026-11, on a gallery of 5 m with crosscuts.
constexpr int kAround = 72;              // rays of a look around, 5 degrees apart
constexpr double kFar_m = 15.0;          // wider than half a road; what is further counts as that far
constexpr double kDrop_m = 6.0;          // a floor is no further below
constexpr double kNarrow_m = 0.8;        // to a wall on either side: no road is narrower
constexpr double kRoomMost_m = 2.0;      // more to the nearest wall is no better a beginning
constexpr double kClimbMost = 0.5;       // of a step: steeper than any decline
constexpr double kAsideMost = 0.3;       // of a step, towards the middle
constexpr double kEnd_m = 2.5;           // ahead: the road ends
constexpr double kTurnMost_deg = 40.0;   // from step to step
constexpr double kTurnCost_m_deg = 0.1;  // of a turn, against the way that is free ahead
constexpr double kBesides_m = 4.0;       // a wall further aside is an opening
constexpr double kSearch_m = 1.0;        // between places that may be the beginning
constexpr double kUpLeast = 0.87;        // cosine of 30 degrees: no road is steeper
constexpr std::size_t kStarts = 12;      // that are tried, at least kStartsApart_m apart
constexpr double kStartsApart_m = 15.0;  // a crosscut and the road that it leaves are two
constexpr std::size_t kStepsMost = 5000;
constexpr double kEndTurn_deg = 10.0;
constexpr std::size_t kEndSteps = 3;  // to kEnd_m from the end

struct Standpoint {
  Vector at;  // in the sensor's height
  Vector up;  // of the floor there
};

class Walker {
 public:
  Walker(const RockSurface& rock, double step_m, double height_m) : rock_(rock), step_m_(step_m), height_m_(height_m) {}

  // On the floor below, as most of some probes tell: a foot or a stone is none.
  std::optional<Standpoint> stand(const Vector& above) const {
    constexpr double kProbe_m = 0.6;  // half a track
    constexpr int kProbes = 8, kLeast = 5;
    Matrix A = Matrix::Zero();
    Vector b = Vector::Zero();
    int count = 0;
    for (int k = 0; k < kProbes; ++k) {
      const double azimuth = 2.0 * M_PI * k / kProbes;
      const Vector from = above + kProbe_m * Vector(std::cos(azimuth), std::sin(azimuth), 0.0);
      const Hit hit = rock_.trace({from, -Vector::UnitZ()}, kDrop_m);
      if (hit.label != Label::kFloor) continue;
      const Vector row(1.0, from.x() - above.x(), from.y() - above.y());
      A += row * row.transpose();
      b += (from.z() - hit.t_m) * row;
      ++count;
    }
    if (count < kLeast) return std::nullopt;
    const Vector plane = A.ldlt().solve(b);
    const Vector up = Vector(-plane[1], -plane[2], 1.0).normalized();
    if (!(up.z() >= kUpLeast)) return std::nullopt;
    return Standpoint{Vector(above.x(), above.y(), plane[0]) + height_m_ * up, up};
  }

  // The median of a few rays side by side and one above the other, over holes and pillars.
  double free_m(const Vector& from, double azimuth_rad) const {
    std::array<double, 9> ways{};
    std::size_t count = 0;
    for (const double aside_deg : {-4.0, 0.0, 4.0}) {
      for (const double above_m : {-0.3, 0.0, 0.4}) {
        const double azimuth = azimuth_rad + aside_deg * kRadPerDeg;
        const Ray ray{from + above_m * Vector::UnitZ(), Vector(std::cos(azimuth), std::sin(azimuth), 0.0)};
        const Hit hit = rock_.trace(ray, kFar_m);
        ways[count++] = hit.label == Label::kNone ? kFar_m : hit.t_m;
      }
    }
    return middle_of(&ways);
  }

  // How much a place is like one of a road: walls around, neither too near nor missing, and one way that is long.
  double likeness(const Standpoint& place, double* azimuth_rad) const {
    std::array<double, kAround> free{};
    double near_m = kFar_m, far_m = 0.0;
    int walls = 0;
    for (int k = 0; k < kAround; ++k) {
      const double azimuth = 2.0 * M_PI * k / kAround;
      free[static_cast<std::size_t>(k)] = free_m(place.at, azimuth);
      walls += free[static_cast<std::size_t>(k)] < kFar_m ? 1 : 0;
    }
    for (int k = 0; k < kAround; ++k) {
      const auto at = [&](int i) { return free[static_cast<std::size_t>((i + kAround) % kAround)]; };
      near_m = std::min(near_m, at(k));
      const double both = std::min({at(k - 1), at(k), at(k + 1)}) +
                          std::min({at(k + kAround / 2 - 1), at(k + kAround / 2), at(k + kAround / 2 + 1)});
      if (both > far_m) far_m = both, *azimuth_rad = 2.0 * M_PI * k / kAround;
    }
    if (near_m < kNarrow_m || walls < kAround / 2) return 0.0;
    return far_m * std::min(near_m, kRoomMost_m);
  }

  // In the middle between the walls.
  Vector centred(const Vector& at, double azimuth_rad, double most_m) const {
    const Vector left(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
    const double left_m = beside_m(at, azimuth_rad, 1.0), right_m = beside_m(at, azimuth_rad, -1.0);
    if (left_m >= kBesides_m || right_m >= kBesides_m) return at;
    return at + std::clamp(0.5 * (left_m - right_m), -most_m, most_m) * left;
  }

  // Turns to where the way is free, and steps to the middle between the walls there: over a heap if need be, or aside
  // of it.
  std::optional<Standpoint> step(const Standpoint& from, double* azimuth_rad) const {
    struct Way {
      double worth_m, azimuth_rad;
    };
    std::vector<Way> ways;
    for (double turn_deg = -kTurnMost_deg; turn_deg <= kTurnMost_deg; turn_deg += 2.5) {
      const double azimuth = *azimuth_rad + turn_deg * kRadPerDeg, free = free_m(from.at, azimuth);
      if (free >= kEnd_m) ways.push_back({free - kTurnCost_m_deg * std::abs(turn_deg), azimuth});
    }
    std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.worth_m > b.worth_m; });
    for (const Way& way : ways) {
      const Vector along(std::cos(way.azimuth_rad), std::sin(way.azimuth_rad), 0.0);
      for (const double steps : {1.0, 1.5, 2.0}) {
        const Vector ahead = from.at + steps * step_m_ * along;
        const std::optional<Standpoint> place = stand(centred(ahead, way.azimuth_rad, kAsideMost * step_m_));
        // Neither a shaft nor a pile.
        if (!place || std::abs((place->at - from.at).z()) > kClimbMost * steps * step_m_) continue;
        *azimuth_rad = way.azimuth_rad;
        return place;
      }
    }
    return std::nullopt;
  }

 private:
  // To the wall of a side, over the niches of a metre.
  double beside_m(const Vector& from, double azimuth_rad, double side) const {
    std::array<double, 3> ways{};
    for (int k = 0; k < 3; ++k) {
      const double slant = (k - 1) * 15.0 * kRadPerDeg;
      ways[static_cast<std::size_t>(k)] = free_m(from, azimuth_rad + side * 0.5 * M_PI + slant) * std::cos(slant);
    }
    return middle_of(&ways);
  }

  const RockSurface& rock_;
  double step_m_, height_m_;
};

bool came_back(const std::vector<Standpoint>& line, const std::vector<Standpoint>& other, const Vector& at,
               double step_m) {
  const auto is_near = [&](const Standpoint& p) { return (p.at - at).norm() < 0.7 * step_m; };
  return std::any_of(line.begin(), line.end(), is_near) || std::any_of(other.begin(), other.end(), is_near);
}

// Where a road ends, the way turns aside before it stops: that is no road any more.
void leave_ends(std::vector<Standpoint>* line) {
  const auto turns = [](const Standpoint& end, const Standpoint& next, const Standpoint& third) {
    const Vector a = (next.at - end.at).normalized(), b = (third.at - next.at).normalized();
    return a.dot(b) < std::cos(kEndTurn_deg * kRadPerDeg);
  };
  for (std::size_t k = 0; k < kEndSteps && line->size() > 3; ++k) {
    if (turns((*line)[0], (*line)[1], (*line)[2])) line->erase(line->begin());
    const std::size_t last = line->size() - 1;
    if (turns((*line)[last], (*line)[last - 1], (*line)[last - 2])) line->pop_back();
  }
}

struct Start {
  double likeness;
  Standpoint place;
  double azimuth_rad;
};

// The places most like one of a road, apart from each other, best first.
std::vector<Start> starts(const Walker& walker, const Vector& low, const Vector& high) {
  std::vector<Start> all, chosen;
  for (double x = low.x(); x <= high.x(); x += kSearch_m) {
    for (double y = low.y(); y <= high.y(); y += kSearch_m) {
      for (double z = low.z() + 1.0; z <= high.z(); z += 2.0) {
        const std::optional<Standpoint> place = walker.stand({x, y, z});
        double along_rad = 0.0;
        const double likeness = place ? walker.likeness(*place, &along_rad) : 0.0;
        if (likeness > 0.0) all.push_back({likeness, *place, along_rad});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Start& a, const Start& b) { return a.likeness > b.likeness; });
  for (const Start& start : all) {
    const auto is_near = [&](const Start& other) { return (start.place.at - other.place.at).norm() < kStartsApart_m; };
    if (chosen.size() < kStarts && std::none_of(chosen.begin(), chosen.end(), is_near)) chosen.push_back(start);
  }
  return chosen;
}

// Both ways from the middle of a place, until the road ends or comes back to itself.
std::vector<Standpoint> walk(const Walker& walker, const Start& from, double step_m) {
  Standpoint start = from.place;
  if (const auto middle = walker.stand(walker.centred(start.at, from.azimuth_rad, kBesides_m))) start = *middle;
  std::array<std::vector<Standpoint>, 2> ways;  // back, ahead
  for (std::size_t k = 0; k < ways.size(); ++k) {
    double heading_rad = from.azimuth_rad + (k == 0 ? M_PI : 0.0);
    Standpoint at = start;
    while (ways[k].size() < kStepsMost) {
      const std::optional<Standpoint> next = walker.step(at, &heading_rad);
      if (!next || came_back(ways[k], ways[1 - k], next->at, step_m)) break;
      ways[k].push_back(*next);
      at = *next;
    }
  }
  std::vector<Standpoint> line(ways[0].rbegin(), ways[0].rend());
  line.push_back(start);
  line.insert(line.end(), ways[1].begin(), ways[1].end());
  return line;
}

}  // namespace

std::vector<Placement> propose_path(const RockSurface& rock, const Vector& low, const Vector& high, double step_m,
                                    double height_m) {
  const Walker walker(rock, step_m, height_m);
  std::vector<Standpoint> line;
  for (const Start& start : starts(walker, low, high)) {
    std::vector<Standpoint> other = walk(walker, start, step_m);
    if (other.size() > line.size()) line = std::move(other);
  }
  leave_ends(&line);
  if (line.size() < 2) return {};

  std::vector<Placement> path;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector along = line[std::min(i + 1, line.size() - 1)].at - line[i > 0 ? i - 1 : 0].at;
    Matrix R;
    R.col(2) = line[i].up;
    R.col(0) = (along - along.dot(line[i].up) * line[i].up).normalized();
    R.col(1) = R.col(2).cross(R.col(0));
    path.push_back({R, line[i].at});
  }
  return path;
}

}  // namespace pose_wall::tools::sim
