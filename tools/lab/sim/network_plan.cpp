// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "lab/sim/network_graph.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr double kLineStep_m = 0.8;
// Two junctions of a road are this far apart, or one.
constexpr double kOneJunction_m = 9.0;
// A heading goes this far beyond the last cross road.
constexpr double kHeading_m = 6.0;
// Between the middles of cross roads.
constexpr double kPillar_m = 11.0;

void demand_of_plan(bool is_kept, const char* rule) {
  if (!is_kept) throw std::invalid_argument(std::string("network plan: ") + rule);
}

void check(const NetworkPlan& plan) {
  demand_of_plan(plan.length_m >= 60.0 && plan.length_m <= 20000.0, "length_m must be from 60 to 20000");
  demand_of_plan(plan.roads >= 0 && plan.roads <= 6, "roads must be from 0 to 6");
  demand_of_plan(plan.spacing_m == 0.0 || (plan.spacing_m >= 16.0 && plan.spacing_m <= 60.0),
                 "spacing_m must be 16 to 60");
  demand_of_plan(plan.crosscut_m == 0.0 || (plan.crosscut_m >= 16.0 && plan.crosscut_m <= 20000.0),
                 "crosscut_m from 16");
  demand_of_plan(plan.width_min_m >= 2.5 && plan.width_max_m <= 8.0 && plan.width_min_m <= plan.width_max_m,
                 "widths must be from 2.5 to 8");
  demand_of_plan(plan.roughness_m >= 0.0 && plan.roughness_m <= 0.3 && plan.wave_m >= 0.0 && plan.wave_m <= 0.3,
                 "relief must be from 0 to 0.3");
  demand_of_plan(plan.bend_m >= 0.0 && plan.bend_m <= 12.0 && std::abs(plan.turn_rad) <= 4.5,
                 "bend_m to 12, turn_rad to 4.5");
  demand_of_plan(plan.height_m >= 2.0 && plan.height_m <= 8.0, "height_m must be from 2 to 8");
}

// Roads on straight lines, to be bent at the end: along is x, across is y.
class Drawing {
 public:
  Drawing(const NetworkPlan& plan, std::uint64_t seed, std::uint64_t attempt)
      : plan_(plan), mould_(plan, seed), random_(seed, 0x9e7 + (attempt << 16)), width_noise_(seed ^ 0x51dfu, 14.0) {
    const double common_m = draw_width();
    for (int road = 0; road < mould_.roads(); ++road) {
      road_width_m_.push_back(plan_.alike || plan_.twin_rock ? common_m : draw_width());
    }
    stations_.resize(static_cast<std::size_t>(mould_.roads()));
  }

  NetworkGraph draw() {
    const double pitch_m = plan_.crosscut_m > 0.0 ? plan_.crosscut_m : random_.uniform(28.0, 60.0);
    double along_m = kHeading_m + random_.uniform(0.0, 6.0);
    const double for_columns_m = plan_.length_m * (1.0 - drift_share());
    add_column(along_m, pitch_m, true);
    while (mould_.roads() > 1) {
      along_m += pitch_m * random_.uniform(0.85, 1.15);
      const double cross_m = plan_.crosscuts * (mould_.roads() - 1) * mould_.spacing_m();
      if (mould_.roads_together() * (along_m + kHeading_m) + crosscuts_m_ + cross_m > for_columns_m) break;
      add_column(along_m, pitch_m, false);
    }
    add_drifts(end_of_roads_m());
    const double end_m = end_of_roads_m();
    for (int road = 0; road < mould_.roads(); ++road) add_road(road, end_m);
    return std::move(graph_);
  }

 private:
  double draw_width() { return random_.uniform(plan_.width_min_m, plan_.width_max_m); }
  double across_m(int road) const { return road * mould_.spacing_m(); }

  // Of all length that blind drifts take: one of 13.5 m every two distances, on both sides.
  double drift_share() const {
    if (plan_.dead_ends_m <= 0.0) return 0.0;
    const double per_m = 13.5 / plan_.dead_ends_m;
    return per_m / (per_m + mould_.roads_together());
  }

  double end_of_roads_m() const {
    const double even_m = (plan_.length_m - crosscuts_m_ - drifts_m_) / mould_.roads_together();
    return std::max(last_m_ + kHeading_m, even_m);
  }

  std::uint32_t add_node(const Place& straight) {
    graph_.nodes.push_back({mould_.bent(straight), {}});
    return static_cast<std::uint32_t>(graph_.nodes.size() - 1);
  }

  // The junction of a road at this place, or the one that is close by.
  std::uint32_t station(int road, double* along_m) {
    auto& stations = stations_[static_cast<std::size_t>(road)];
    for (const auto& [at_m, node] : stations) {
      if (std::abs(at_m - *along_m) >= kOneJunction_m) continue;
      *along_m = at_m;
      return node;
    }
    return stations[*along_m] = add_node({*along_m, across_m(road)});
  }

  void add_column(double along_m, double pitch_m, bool is_first) {
    double stagger_m = 0.0;
    bool any = false;
    for (int road = 0; road + 1 < mould_.roads(); ++road) {
      const bool is_last_chance = road + 2 == mould_.roads() && !any;
      const bool is_there = random_.chance(plan_.crosscuts);
      const bool is_staggered = random_.chance(plan_.staggered), is_oblique = random_.chance(plan_.oblique);
      const double shift_m = random_.uniform(9.5, 13.0) * (random_.chance(0.5) ? 1.0 : -1.0);
      const double slant_m = random_.uniform(0.1, 0.2) * pitch_m * (random_.chance(0.5) ? 1.0 : -1.0);
      const double width_m = random_.uniform(plan_.width_min_m, 0.5 * (plan_.width_min_m + plan_.width_max_m));
      const double bow_m = random_.uniform(-1.5, 1.5);
      // The first column joins all roads.
      if (!is_there && !is_first && !is_last_chance) continue;
      any = true;
      stagger_m = is_staggered && stagger_m == 0.0 && road > 0 ? shift_m : 0.0;
      const double from_m = std::max(along_m + stagger_m, kHeading_m);
      const double to_m = std::max(from_m + (is_oblique ? std::clamp(slant_m, -12.0, 12.0) : 0.0), kHeading_m);
      if (is_clear(road, from_m, to_m)) {
        add_crosscut(road, from_m, to_m, width_m, bow_m);
      } else if (is_clear(road, along_m, along_m)) {
        add_crosscut(road, along_m, along_m, width_m, bow_m);
      }
    }
    last_m_ = std::max(last_m_, along_m);
    for (const auto& stations : stations_) {
      if (!stations.empty()) last_m_ = std::max(last_m_, stations.rbegin()->first);
    }
  }

  // Beside all cross roads between the same two roads, with a pillar between.
  bool is_clear(int road, double from_m, double to_m) const {
    return std::all_of(crosscuts_.begin(), crosscuts_.end(), [=](const Crosscut& other) {
      const double a = from_m - other.from_m, b = to_m - other.to_m;
      return other.road != road || (a * b > 0.0 && std::abs(a) >= kPillar_m && std::abs(b) >= kPillar_m);
    });
  }

  void add_crosscut(int road, double from_m, double to_m, double width_m, double bow_m) {
    const std::uint32_t from = station(road, &from_m), to = station(road + 1, &to_m);
    const Place a(from_m, across_m(road)), b(to_m, across_m(road + 1));
    add_edge(from, to, a, b, width_m, bow_m, -1);
    crosscuts_.push_back({road, from_m, to_m});
    crosscuts_m_ += graph_.edges.back().length_m;
  }

  // Blind drifts lead out of the outer roads.
  void add_drifts(double end_m) {
    if (plan_.dead_ends_m <= 0.0) return;
    for (const int side : {-1, 1}) {
      const int road = side < 0 ? 0 : mould_.roads() - 1;
      for (double along_m = random_.uniform(0.5, 1.0) * plan_.dead_ends_m; along_m < end_m - kHeading_m;
           along_m += random_.uniform(1.0, 3.0) * plan_.dead_ends_m) {
        const double length_m = random_.uniform(7.0, 20.0);
        const double slant_m = random_.uniform(-0.4, 0.4) * length_m;
        const double width_m = random_.uniform(plan_.width_min_m, plan_.width_max_m);
        if (is_taken(road, along_m)) continue;
        const std::uint32_t from = station(road, &along_m);
        const Place a(along_m, across_m(road)), b(along_m + slant_m, across_m(road) + side * length_m);
        add_edge(from, add_node(b), a, b, width_m, 0.0, -1);
        drifts_m_ += graph_.edges.back().length_m;
      }
    }
  }

  bool is_taken(int road, double along_m) const {
    const auto& stations = stations_[static_cast<std::size_t>(road)];
    return std::any_of(stations.begin(), stations.end(),
                       [along_m](const auto& station) { return std::abs(station.first - along_m) < kOneJunction_m; });
  }

  void add_road(int road, double end_m) {
    auto& stations = stations_[static_cast<std::size_t>(road)];
    const bool is_even = plan_.alike || plan_.twin_rock;
    const double from_m = is_even ? 0.0 : random_.uniform(0.0, 4.0);
    const double to_m = end_m + (is_even ? 0.0 : random_.uniform(-1.0, 1.0) * std::min(4.0, end_m - last_m_ - 4.0));
    stations[from_m] = add_node({from_m, across_m(road)});
    stations[to_m] = add_node({to_m, across_m(road)});
    for (auto next = std::next(stations.begin()); next != stations.end(); ++next) {
      const auto last = std::prev(next);
      add_edge(last->second, next->second, {last->first, across_m(road)}, {next->first, across_m(road)},
               road_width_m_[static_cast<std::size_t>(road)], 0.0, road);
    }
  }

  void add_edge(std::uint32_t from, std::uint32_t to, const Place& a, const Place& b, double width_m, double bow_m,
                int road) {
    const Place across = Place(a.y() - b.y(), b.x() - a.x()).normalized();
    const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kLineStep_m)));
    NetworkEdge edge;
    edge.from = from;
    edge.to = to;
    edge.road = road;
    for (int i = 0; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / pieces;
      const Place straight = a + share * (b - a) + bow_m * std::sin(M_PI * share) * across;
      const bool is_even = plan_.alike || plan_.twin_rock;
      const Place told(straight.x(), is_even && road >= 0 ? 0.0 : straight.y());
      edge.line.push_back(mould_.bent(straight));
      edge.half_width_m.push_back(0.5 * (width_m + plan_.width_wave_m * width_noise_.at(told)));
      if (i > 0) edge.length_m += (edge.line.back() - edge.line[edge.line.size() - 2]).norm();
    }
    // A bent road begins and ends at its nodes to the last bit.
    edge.line.front() = graph_.nodes[from].at;
    edge.line.back() = graph_.nodes[to].at;
    const auto index = static_cast<std::uint32_t>(graph_.edges.size());
    graph_.nodes[from].edges.push_back(index);
    graph_.nodes[to].edges.push_back(index);
    graph_.edges.push_back(std::move(edge));
  }

  struct Crosscut {
    int road;  // and the next one
    double from_m, to_m;
  };

  const NetworkPlan& plan_;
  RoadMould mould_;
  Random random_;
  PlaneNoise width_noise_;
  std::vector<double> road_width_m_;
  std::vector<std::map<double, std::uint32_t>> stations_;  // of each road: junctions by where they are
  std::vector<Crosscut> crosscuts_;
  NetworkGraph graph_;
  double last_m_ = 0.0;
  double crosscuts_m_ = 0.0;
  double drifts_m_ = 0.0;
};

// Rock that stands between two roads at the least, relief apart.
constexpr double kPillarLeast_m = 1.2;

bool is_beside(const NetworkEdge& a, const NetworkEdge& b, double reach_m) {
  const auto box = [](const NetworkEdge& edge, Place* low, Place* high) {
    *low = *high = edge.line.front();
    for (const Place& p : edge.line) {
      *low = low->cwiseMin(p);
      *high = high->cwiseMax(p);
    }
  };
  Place low_a, high_a, low_b, high_b;
  box(a, &low_a, &high_a);
  box(b, &low_b, &high_b);
  const auto apart = [reach_m](const Place& low, const Place& high) { return (low - high).maxCoeff() > reach_m; };
  return !apart(low_a, high_b) && !apart(low_b, high_a);
}

// Whether they run into each other although they share no node.
bool breaks_through(const NetworkEdge& a, const NetworkEdge& b) {
  const bool is_joined = a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
  const bool is_one_road = a.road >= 0 && a.road == b.road;
  if (is_joined || is_one_road || !is_beside(a, b, 8.0 + kPillarLeast_m)) return false;
  for (std::size_t i = 0; i < a.line.size(); ++i) {
    for (std::size_t k = 0; k < b.line.size(); ++k) {
      const double pillar_m = (a.line[i] - b.line[k]).norm() - a.half_width_m[i] - b.half_width_m[k];
      if (pillar_m < kPillarLeast_m) return true;
    }
  }
  return false;
}

// Without the cross roads and drifts that break through where the graph has no junction. Nodes that only they had go,
// too.
NetworkGraph without_breaks(const NetworkGraph& drawn) {
  std::vector<NetworkEdge> kept;
  const auto is_crossing = [](const NetworkEdge& edge) { return edge.road < 0; };
  std::copy_if(drawn.edges.begin(), drawn.edges.end(), std::back_inserter(kept), std::not_fn(is_crossing));
  for (const NetworkEdge& edge : drawn.edges) {
    const auto meets = [&edge](const NetworkEdge& other) { return breaks_through(edge, other); };
    if (is_crossing(edge) && std::none_of(kept.begin(), kept.end(), meets)) kept.push_back(edge);
  }
  NetworkGraph graph;
  std::map<std::uint32_t, std::uint32_t> names;
  const auto renamed = [&](std::uint32_t node) {
    const auto [entry, is_new] = names.try_emplace(node, static_cast<std::uint32_t>(graph.nodes.size()));
    if (is_new) graph.nodes.push_back({drawn.nodes[node].at, {}});
    return entry->second;
  };
  for (NetworkEdge& edge : kept) {
    edge.from = renamed(edge.from);
    edge.to = renamed(edge.to);
    const auto index = static_cast<std::uint32_t>(graph.edges.size());
    graph.nodes[edge.from].edges.push_back(index);
    graph.nodes[edge.to].edges.push_back(index);
    graph.length_m += edge.length_m;
    graph.edges.push_back(std::move(edge));
  }
  return graph;
}

bool hangs_together(const NetworkGraph& graph) {
  std::vector<bool> is_reached(graph.nodes.size(), false);
  std::vector<std::uint32_t> open = {0};
  std::size_t reached = 0;
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    if (is_reached[node]) continue;
    is_reached[node] = true;
    ++reached;
    for (const std::uint32_t edge : graph.nodes[node].edges) {
      open.insert(open.end(), {graph.edges[edge].from, graph.edges[edge].to});
    }
  }
  return reached == graph.nodes.size();
}

}  // namespace

RoadMould::RoadMould(const NetworkPlan& plan, std::uint64_t seed) : bend_m_(plan.bend_m) {
  Random random(seed, 0x301d);
  const int drawn = 2 + static_cast<int>(random.uniform(0.0, 3.0));
  spacing_m_ = plan.spacing_m > 0.0 ? plan.spacing_m : random.uniform(20.0, 36.0);
  // As many as the length has room for, with the cross roads that join them.
  const double per_road_m = spacing_m_ + 2.0 * kHeading_m;
  const int room = std::max(1, static_cast<int>((0.7 * plan.length_m + spacing_m_) / per_road_m));
  roads_ = plan.roads > 0 ? plan.roads : std::min(drawn, room);
  // A network is about as long as its length divided by its roads and their cross roads.
  const double extent_m = plan.length_m / (roads_ + (roads_ > 1 ? 0.5 * (roads_ - 1) : 0.0));
  // The innermost road must have room to turn.
  const double radius_min_m = 1.5 * (roads_ - 1) * spacing_m_ + 30.0;
  if (plan.turn_rad != 0.0) {
    radius_m_ = std::copysign(std::max(radius_min_m, extent_m / std::abs(plan.turn_rad)), plan.turn_rad);
  }
  const double length_m[3] = {90.0, 140.0, 230.0};
  for (int i = 0; i < 3; ++i) {
    wave_per_m_[i] = 2.0 * M_PI / (length_m[i] * random.uniform(0.85, 1.15));
    phase_rad_[i] = random.uniform(-M_PI, M_PI);
  }
}

double RoadMould::swing_m(double along_m) const {
  double swing = 0.0;
  for (int i = 0; i < 3; ++i) swing += std::sin(wave_per_m_[i] * along_m + phase_rad_[i]);
  return 0.6 * bend_m_ * swing;
}

double RoadMould::roads_together() const {
  double roads = 0.0;
  for (int road = 0; road < roads_; ++road) {
    roads += radius_m_ == 0.0 ? 1.0 : std::abs(1.0 - road * spacing_m_ / radius_m_);
  }
  return roads;
}

Place RoadMould::bent(const Place& straight) const {
  Place p(straight.x(), straight.y() + swing_m(straight.x()));
  if (radius_m_ == 0.0) return p;
  const double angle = p.x() / radius_m_, r = radius_m_ - p.y();
  return {r * std::sin(angle), radius_m_ - r * std::cos(angle)};
}

Place RoadMould::straightened(const Place& p) const {
  Place q = p;
  if (radius_m_ != 0.0) {
    const double side = radius_m_ > 0.0 ? 1.0 : -1.0;
    double angle = std::atan2(side * p.x(), side * (radius_m_ - p.y()));
    if (angle * side < -0.5) angle += side * 2.0 * M_PI;
    q = {radius_m_ * angle, radius_m_ - side * std::hypot(p.x(), radius_m_ - p.y())};
  }
  return {q.x(), q.y() - swing_m(q.x())};
}

Place RoadMould::in_mould(const Place& p) const {
  const Place straight = straightened(p);
  const double road = std::clamp(std::round(straight.y() / spacing_m_), 0.0, roads_ - 1.0);
  return {straight.x(), straight.y() - road * spacing_m_};
}

NetworkGraph draw_network(const NetworkPlan& plan, std::uint64_t seed) {
  check(plan);
  constexpr std::uint64_t kAttempts = 50;
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    NetworkGraph graph = without_breaks(Drawing(plan, seed, attempt).draw());
    if (hangs_together(graph)) return graph;
  }
  throw std::invalid_argument("network plan: its roads leave no room for cross roads");
}

}  // namespace pose_wall::tools::sim
