// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/network_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace pose_wall::tools::sim {
namespace {

constexpr double kNodes_m = 0.125;
constexpr int kTileNodes = 64;
// Beyond a wall the outline is known this far: more than the relief can reach.
constexpr double kOutlineMargin_m = 1.3;
constexpr double kReliefReach_m = 1.0;
constexpr double kSmoothLining_m = 0.004;
// Props and steel sets keep away from junctions, where there is no wall behind them.
constexpr double kFromEnds_m = 4.5;

// A strip of road: all within half_width of a line. An end may be cut off square.
struct Strip {
  std::vector<Place> line;
  std::vector<double> half_width_m;
  bool is_square_begin = false, is_square_end = false;
};

// How deep in the rock a point is; below 0 in the strip. Of one piece of it.
class Piece {
 public:
  Piece(const Strip& strip, std::size_t i)
      : a_(strip.line[i]),
        along_(strip.line[i + 1] - strip.line[i]),
        half_a_m_(strip.half_width_m[i]),
        widens_m_(strip.half_width_m[i + 1] - strip.half_width_m[i]) {
    length_m_ = along_.norm();
    along_ /= std::max(length_m_, 1e-12);
    // All pieces that are round where the strip is cut off.
    const auto reaches = [&](const Place& end) { return (a_ - end).norm() < half_width_m() + 2.0 * length_m_ + 1.0; };
    const std::size_t last = strip.line.size() - 1;
    if (strip.is_square_begin && reaches(strip.line[0])) cut(strip.line[0], strip.line[0] - strip.line[1]);
    if (strip.is_square_end && reaches(strip.line[last]))
      cut(strip.line[last], strip.line[last] - strip.line[last - 1]);
  }

  double depth_m(const Place& p) const {
    const Place from = p - a_;
    const double s_m = from.dot(along_);
    const double inside_m = std::clamp(s_m, 0.0, length_m_);
    const double half_m = half_a_m_ + widens_m_ * inside_m / std::max(length_m_, 1e-12);
    double depth = (from - inside_m * along_).norm() - half_m;
    for (int i = 0; i < cuts_; ++i) depth = std::max(depth, (p - cut_at_[i]).dot(cut_out_[i]));
    return depth;
  }

  double half_width_m() const { return half_a_m_ + std::max(0.0, widens_m_); }
  Place low() const { return a_.cwiseMin(a_ + length_m_ * along_); }
  Place high() const { return a_.cwiseMax(a_ + length_m_ * along_); }

 private:
  void cut(const Place& at, const Place& out) {
    cut_at_[cuts_] = at;
    cut_out_[cuts_++] = out.normalized();
  }

  Place a_, along_;
  double length_m_ = 0.0, half_a_m_, widens_m_;
  int cuts_ = 0;
  Place cut_at_[2], cut_out_[2];
};

// Depth in the rock at the nodes of a fine grid, in tiles where there is road.
class Field {
 public:
  void add(const Strip& strip) {
    for (std::size_t i = 0; i + 1 < strip.line.size(); ++i) add(Piece(strip, i));
  }

  // Every node within the reach of the relief moves by it.
  template <typename Relief>
  void carve(Relief relief_m) {
    for (auto& [key, tile] : tiles_) {
      for (int row = 0; row < kTileNodes; ++row) {
        for (int column = 0; column < kTileNodes; ++column) {
          float& depth = tile[place_in_tile(column, row)];
          if (std::abs(depth) >= static_cast<float>(kReliefReach_m)) continue;
          depth -= static_cast<float>(relief_m(node_at(key, column, row)));
        }
      }
    }
  }

  double depth_m(const Place& p) const {
    const double u = p.x() / kNodes_m, v = p.y() / kNodes_m;
    const auto i = static_cast<std::int64_t>(std::floor(u)), j = static_cast<std::int64_t>(std::floor(v));
    const double a = u - static_cast<double>(i), b = v - static_cast<double>(j);
    const double low = value(i, j) + (value(i + 1, j) - value(i, j)) * a;
    const double high = value(i, j + 1) + (value(i + 1, j + 1) - value(i, j + 1)) * a;
    return low + (high - low) * b;
  }

  // Marching squares; the open side lies to the left. In the order of tiles and cells.
  std::vector<WallSegment> outline() const {
    std::vector<std::int64_t> keys;
    for (const auto& entry : tiles_) keys.push_back(entry.first);
    std::sort(keys.begin(), keys.end());
    std::vector<WallSegment> walls;
    for (const std::int64_t key : keys) {
      for (int row = 0; row < kTileNodes; ++row) {
        for (int column = 0; column < kTileNodes; ++column) {
          outline_of(column_of(key) * kTileNodes + column, row_of(key) * kTileNodes + row, &walls);
        }
      }
    }
    return walls;
  }

 private:
  using Tile = std::array<float, kTileNodes * kTileNodes>;
  static constexpr float kFar_m = 9.0F;
  static constexpr std::int64_t kKeyRows = std::int64_t{1} << 24;

  static std::int64_t key_of(std::int64_t column, std::int64_t row) { return column * kKeyRows + row; }
  static std::int64_t row_of(std::int64_t key) { return ((key + kKeyRows / 2) & (kKeyRows - 1)) - kKeyRows / 2; }
  static std::int64_t column_of(std::int64_t key) { return (key - row_of(key)) / kKeyRows; }
  static std::size_t place_in_tile(int column, int row) {
    return static_cast<std::size_t>(row) * kTileNodes + static_cast<std::size_t>(column);
  }
  static std::int64_t tile_of(std::int64_t node) {
    return node >= 0 ? node / kTileNodes : -((kTileNodes - 1 - node) / kTileNodes);
  }

  struct NodeRange {
    std::int64_t first, last;

    // Counted from the tile's own first one.
    NodeRange in_tile(std::int64_t tile) const {
      return {std::max<std::int64_t>(first - tile * kTileNodes, 0),
              std::min<std::int64_t>(last - tile * kTileNodes, kTileNodes - 1)};
    }
  };

  static Place node_at(std::int64_t key, int column, int row) {
    return {kNodes_m * static_cast<double>(column_of(key) * kTileNodes + column),
            kNodes_m * static_cast<double>(row_of(key) * kTileNodes + row)};
  }

  void add(const Piece& piece) {
    const double reach_m = piece.half_width_m() + kOutlineMargin_m;
    const Place low = (piece.low() - Place::Constant(reach_m)) / kNodes_m;
    const Place high = (piece.high() + Place::Constant(reach_m)) / kNodes_m;
    const auto node = [](double at) { return static_cast<std::int64_t>(std::floor(at)); };
    const NodeRange columns{node(low.x()), node(high.x()) + 1}, rows{node(low.y()), node(high.y()) + 1};
    for (std::int64_t row = tile_of(rows.first); row <= tile_of(rows.last); ++row) {
      for (std::int64_t column = tile_of(columns.first); column <= tile_of(columns.last); ++column) {
        const auto [entry, is_new] = tiles_.try_emplace(key_of(column, row));
        if (is_new) entry->second.fill(kFar_m);
        add(piece, columns.in_tile(column), rows.in_tile(row), entry->first, &entry->second);
      }
    }
  }

  static void add(const Piece& piece, const NodeRange& columns, const NodeRange& rows, std::int64_t key, Tile* tile) {
    for (auto row = static_cast<int>(rows.first); row <= static_cast<int>(rows.last); ++row) {
      for (auto column = static_cast<int>(columns.first); column <= static_cast<int>(columns.last); ++column) {
        float& depth = (*tile)[place_in_tile(column, row)];
        depth = std::min(depth, static_cast<float>(piece.depth_m(node_at(key, column, row))));
      }
    }
  }

  double value(std::int64_t i, std::int64_t j) const {
    const auto tile = tiles_.find(key_of(tile_of(i), tile_of(j)));
    if (tile == tiles_.end()) return static_cast<double>(kFar_m);
    return static_cast<double>(tile->second[place_in_tile(static_cast<int>(i - tile_of(i) * kTileNodes),
                                                          static_cast<int>(j - tile_of(j) * kTileNodes))]);
  }

  // Corners against the clock: 0 at (i, j), 1 at (i + 1, j), 2, 3 at (i, j + 1). Side k lies between corner k and the
  // next.
  struct Square {
    std::int64_t i, j;
    double depth_m[4];

    bool is_open(int corner) const { return depth_m[corner % 4] < 0.0; }

    // Where the outline crosses a side: the same bits from both squares beside.
    Place crossing(int side) const {
      const bool is_along_x = side == 0 || side == 2;
      const int from = side == 2 ? 3 : (side == 3 ? 0 : side);
      const int to = side == 2 ? 2 : (side == 3 ? 3 : side + 1);
      const double share = depth_m[from] / (depth_m[from] - depth_m[to]);
      const Place begin(static_cast<double>(i + (side == 1 ? 1 : 0)), static_cast<double>(j + (side == 2 ? 1 : 0)));
      return kNodes_m * (begin + (is_along_x ? Place(share, 0.0) : Place(0.0, share)));
    }
    WallSegment wall(int from_side, int to_side) const {
      return {crossing(from_side), crossing(to_side), WallKind::kRock};
    }
  };

  void outline_of(std::int64_t i, std::int64_t j, std::vector<WallSegment>* walls) const {
    const Square square{i, j, {value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)}};
    int changes = 0, from = 0, to = 0;
    // Against the clock, the outline enters the square where open turns to rock, and leaves it where rock turns to
    // open.
    for (int k = 0; k < 4; ++k) {
      if (square.is_open(k) == square.is_open(k + 1)) continue;
      ++changes;
      (square.is_open(k) ? from : to) = k;
    }
    if (changes == 2) walls->push_back(square.wall(from, to));
    if (changes == 4) outline_of_saddle(square, walls);
  }

  // Two open corners across from each other: the middle decides whether they are joined. If so, the outline cuts off
  // the corners of rock, else the open ones. Corner k lies between side k - 1 and side k.
  static void outline_of_saddle(const Square& square, std::vector<WallSegment>* walls) {
    const double* d = square.depth_m;
    const bool is_joined = d[0] + d[1] + d[2] + d[3] < 0.0;
    for (int k = 0; k < 4; ++k) {
      const int before = (k + 3) % 4;
      if (square.is_open(k) == is_joined) continue;
      walls->push_back(square.is_open(k) ? square.wall(k, before) : square.wall(before, k));
    }
  }

  std::unordered_map<std::int64_t, Tile> tiles_;
};

// Where along an edge, with the wall to the left of the direction of travel or to the right.
struct Station {
  Place middle, ahead, to_wall;
  double half_width_m;
};

Station station_of(const NetworkEdge& edge, double s_m, int side) {
  std::size_t i = 1;
  double before_m = 0.0;
  while (i + 1 < edge.line.size() && before_m + (edge.line[i] - edge.line[i - 1]).norm() < s_m) {
    before_m += (edge.line[i] - edge.line[i - 1]).norm();
    ++i;
  }
  const Place step = edge.line[i] - edge.line[i - 1];
  const double share = std::clamp((s_m - before_m) / step.norm(), 0.0, 1.0);
  const Place ahead = step.normalized();
  return {edge.line[i - 1] + share * step, ahead, static_cast<double>(side) * Place(-ahead.y(), ahead.x()),
          edge.half_width_m[i - 1] + share * (edge.half_width_m[i] - edge.half_width_m[i - 1])};
}

// Even steps along both walls of every edge. In pairs: opposite each other.
template <typename Visit>
void along_walls(const NetworkPlan& plan, const NetworkGraph& graph, double pitch_m, bool in_pairs, std::uint64_t seed,
                 Visit visit) {
  if (pitch_m <= 0.0) return;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const NetworkEdge& edge = graph.edges[i];
    for (const int side : {1, -1}) {
      // Alike roads draw the same numbers for the same edge of the road.
      const bool is_even = (plan.alike || plan.twin_rock) && edge.road >= 0;
      Random random(seed, (is_even ? 0x10000u : 2 * i) + (side > 0 && !in_pairs ? 1u : 0u));
      double s_m = kFromEnds_m + random.uniform(0.0, pitch_m);
      for (; s_m < edge.length_m - kFromEnds_m; s_m += pitch_m) visit(station_of(edge, s_m, side), &random);
    }
  }
}

// A box in the plane, seen from outside.
void add_box(const Place& centre, const Place& half_along, const Place& half_across, WallKind kind,
             std::vector<WallSegment>* walls) {
  const Place corner[4] = {centre - half_along - half_across, centre + half_along - half_across,
                           centre + half_along + half_across, centre - half_along + half_across};
  const bool is_left = half_along.x() * half_across.y() - half_along.y() * half_across.x() > 0.0;
  for (int k = 0; k < 4; ++k) {
    const Place &a = corner[k], &b = corner[(k + 1) % 4];
    walls->push_back(is_left ? WallSegment{b, a, kind} : WallSegment{a, b, kind});
  }
}

void add_post(const Place& centre, double radius_m, std::vector<WallSegment>* walls) {
  constexpr int kCorners = 10;
  const auto corner = [&](int k) {
    const double angle = 2.0 * M_PI * (k % kCorners) / kCorners;
    return Place(centre + radius_m * Place(std::cos(angle), std::sin(angle)));
  };
  for (int k = 0; k < kCorners; ++k) walls->push_back({corner(k + 1), corner(k), WallKind::kProp});
}

std::vector<Strip> strips_of(const NetworkPlan& plan, const NetworkGraph& graph, std::uint64_t seed) {
  std::vector<Strip> strips;
  for (const NetworkEdge& edge : graph.edges) {
    const bool ends_here = graph.nodes[edge.to].edges.size() == 1,
               begins_here = graph.nodes[edge.from].edges.size() == 1;
    strips.push_back({edge.line, edge.half_width_m, begins_here, ends_here});
  }
  along_walls(plan, graph, plan.niche_pitch_m, false, seed ^ 0x91c4eu, [&strips](const Station& at, Random* random) {
    const double depth_m = random->uniform(0.6, 1.6), half_m = random->uniform(0.6, 1.6);
    const Place begin = at.middle + 0.5 * at.half_width_m * at.to_wall;
    const Place end = at.middle + (at.half_width_m + depth_m) * at.to_wall;
    strips.push_back({{begin, end}, {half_m, half_m}, true, true});
  });
  return strips;
}

std::vector<WallSegment> things_of(const NetworkPlan& plan, const NetworkGraph& graph, const Field& field,
                                   std::uint64_t seed) {
  std::vector<WallSegment> things;
  along_walls(plan, graph, plan.steel_pitch_m, true, seed ^ 0x57ee1u, [&](const Station& at, Random*) {
    const double into_rock_m = 0.5;
    if (!(field.depth_m(at.middle + (at.half_width_m + into_rock_m) * at.to_wall) > 0.0)) return;
    const double middle_m = at.half_width_m + 0.5 * (into_rock_m - plan.steel_depth_m);
    const double half_m = 0.5 * (into_rock_m + plan.steel_depth_m);
    add_box(at.middle + middle_m * at.to_wall, 0.07 * at.ahead, half_m * at.to_wall, WallKind::kSteel, &things);
  });
  along_walls(plan, graph, plan.prop_pitch_m, false, seed ^ 0x9409u, [&](const Station& at, Random* random) {
    const double standoff_m = random->uniform(0.3, 0.6), radius_m = random->uniform(0.08, 0.12);
    const Place centre = at.middle + (at.half_width_m - standoff_m) * at.to_wall;
    if (field.depth_m(centre) < -radius_m) add_post(centre, radius_m, &things);
  });
  return things;
}

}  // namespace

std::vector<WallSegment> network_walls(const NetworkPlan& plan, const NetworkGraph& graph, std::uint64_t seed) {
  Field field;
  for (const Strip& strip : strips_of(plan, graph, seed)) field.add(strip);
  const RoadMould mould(plan, seed);
  const PlaneNoise rough(seed ^ 0x4006u, plan.roughness_length_m), wave(seed ^ 0x3a3eu, plan.wave_length_m);
  const bool is_smooth = plan.lining == Lining::kSmooth;
  const double rough_m = is_smooth ? kSmoothLining_m : plan.roughness_m, wave_m = is_smooth ? 0.0 : plan.wave_m;
  field.carve([&](const Place& p) {
    const Place at = plan.twin_rock ? mould.in_mould(p) : p;
    return std::clamp(rough_m * rough.at(at) + wave_m * wave.at(at), -kReliefReach_m, kReliefReach_m);
  });
  std::vector<WallSegment> walls = field.outline();
  const std::vector<WallSegment> things = things_of(plan, graph, field, seed);
  walls.insert(walls.end(), things.begin(), things.end());
  return walls;
}

}  // namespace pose_wall::tools::sim
