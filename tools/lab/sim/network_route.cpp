// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <stdexcept>

#include "io/numbers/angles.hpp"
#include "lab/sim/network_graph.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr double kRouteStep_m = 0.25;
// A corner is rounded over this length to both sides: a turn of 90 degrees gets a radius of about this.
constexpr double kCorner_m = 2.0;
// From a heading face to the place where the machine turns: half its length and some more.
constexpr double kTurnRoom_m = 3.2;
constexpr double kAlikeStep_m = 1.0;
constexpr double kAlikeHeading_rad = 3.0 * kRadPerDeg;
constexpr double kAlikeWidth_m = 0.3;

// Points at even steps; both ends are among them.
std::vector<Place> even_steps(const std::vector<Place>& line, double step_m) {
  const double length_m = length_of(line);
  const int pieces = std::max(1, static_cast<int>(std::ceil(length_m / step_m - 1e-9)));
  std::vector<Place> even = {line.front()};
  std::size_t i = 1;
  double before_m = 0.0;  // length up to line[i - 1]
  for (int k = 1; k < pieces; ++k) {
    const double at_m = length_m * k / pieces;
    double piece_m = (line[i] - line[i - 1]).norm();
    while (i + 1 < line.size() && before_m + piece_m < at_m) {
      before_m += piece_m;
      ++i;
      piece_m = (line[i] - line[i - 1]).norm();
    }
    const double share = piece_m > 0.0 ? (at_m - before_m) / piece_m : 0.0;
    even.push_back(line[i - 1] + share * (line[i] - line[i - 1]));
  }
  even.push_back(line.back());
  return even;
}

// Each point becomes the mean of those around it; the ends stay.
std::vector<Place> rounded(const std::vector<Place>& line) {
  const auto reach_max = static_cast<std::ptrdiff_t>(kCorner_m / kRouteStep_m);
  const auto count = static_cast<std::ptrdiff_t>(line.size());
  std::vector<Place> smooth;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const std::ptrdiff_t reach = std::min({reach_max, i, count - 1 - i});
    Place sum = Place::Zero();
    for (std::ptrdiff_t k = i - reach; k <= i + reach; ++k) sum += line[static_cast<std::size_t>(k)];
    smooth.push_back(sum / static_cast<double>(2 * reach + 1));
  }
  return smooth;
}

// Takes the turn's room off the end, and leaves a metre at least.
void keep_off_the_face(std::vector<Place>* line) {
  double left_m = std::min(kTurnRoom_m, length_of(*line) - 1.0);
  if (!(left_m > 0.0)) return;
  while ((line->back() - (*line)[line->size() - 2]).norm() <= left_m) {
    left_m -= (line->back() - (*line)[line->size() - 2]).norm();
    line->pop_back();
  }
  const Place step = (*line)[line->size() - 2] - line->back();
  line->back() += left_m / step.norm() * step;
}

void append_leg(const NetworkNode& from, const NetworkNode& to, std::vector<Place>* line, Route* route) {
  if (line->size() < 2) return;
  if (to.edges.size() == 1) keep_off_the_face(line);
  std::reverse(line->begin(), line->end());
  if (from.edges.size() == 1) keep_off_the_face(line);
  std::reverse(line->begin(), line->end());
  RouteLeg leg;
  leg.line = rounded(even_steps(*line, kRouteStep_m));
  leg.length_m = length_of(leg.line);
  route->length_m += leg.length_m;
  route->legs.push_back(std::move(leg));
  line->clear();
}

const NetworkEdge& edge_between(const NetworkGraph& graph, std::uint32_t from, std::uint32_t to) {
  const NetworkEdge* best = nullptr;
  for (const std::uint32_t index : graph.nodes.at(from).edges) {
    const NetworkEdge& edge = graph.edges[index];
    const bool joins = (edge.from == from && edge.to == to) || (edge.to == from && edge.from == to);
    if (joins && (best == nullptr || edge.length_m < best->length_m)) best = &edge;
  }
  if (best == nullptr) throw std::invalid_argument("route: no edge joins two nodes that follow each other");
  return *best;
}

// Its shape, step by step: headings from its first one on, and half widths.
struct Shape {
  std::vector<double> heading_rad, half_width_m;
};

Shape shape_of(const NetworkEdge& edge, bool reversed) {
  std::vector<Place> line = edge.line;
  std::vector<double> half = edge.half_width_m;
  if (reversed) {
    std::reverse(line.begin(), line.end());
    std::reverse(half.begin(), half.end());
  }
  Shape shape;
  const std::vector<Place> even = even_steps(line, kAlikeStep_m);
  const Place first = even[1] - even[0];
  for (std::size_t i = 1; i < even.size(); ++i) {
    const Place step = even[i] - even[i - 1];
    shape.heading_rad.push_back(std::atan2(first.x() * step.y() - first.y() * step.x(), first.dot(step)));
    const double share = static_cast<double>(i) / static_cast<double>(even.size() - 1);
    shape.half_width_m.push_back(half[static_cast<std::size_t>(share * static_cast<double>(half.size() - 1))]);
  }
  return shape;
}

double alike_m(const Shape& a, const Shape& b) {
  const std::size_t steps = std::min(a.heading_rad.size(), b.heading_rad.size());
  std::size_t alike = 0;
  while (alike < steps && std::abs(a.heading_rad[alike] - b.heading_rad[alike]) < kAlikeHeading_rad &&
         2.0 * std::abs(a.half_width_m[alike] - b.half_width_m[alike]) < kAlikeWidth_m) {
    ++alike;
  }
  return static_cast<double>(alike) * kAlikeStep_m;
}

}  // namespace

std::size_t NetworkGraph::count_nodes(std::size_t edges_of_it) const {
  return static_cast<std::size_t>(std::count_if(
      nodes.begin(), nodes.end(), [edges_of_it](const NetworkNode& node) { return node.edges.size() == edges_of_it; }));
}

// Dijkstra 1959.
Route NetworkGraph::route(std::uint32_t from, std::uint32_t to) const {
  std::vector<double> best_m(nodes.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> before(nodes.size(), from);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  best_m.at(from) = 0.0;
  open.push({0.0, from});
  while (!open.empty()) {
    const auto [way_m, node] = open.top();
    open.pop();
    if (way_m > best_m[node]) continue;
    for (const std::uint32_t index : nodes[node].edges) {
      const NetworkEdge& edge = edges[index];
      const std::uint32_t next = edge.from == node ? edge.to : edge.from;
      if (!(way_m + edge.length_m < best_m[next])) continue;
      best_m[next] = way_m + edge.length_m;
      before[next] = node;
      open.push({best_m[next], next});
    }
  }
  if (from == to || !std::isfinite(best_m.at(to))) return {};
  std::vector<std::uint32_t> way = {to};
  while (way.back() != from) way.push_back(before[way.back()]);
  std::reverse(way.begin(), way.end());
  return route_through(way);
}

Route NetworkGraph::route_through(const std::vector<std::uint32_t>& way) const {
  Route route;
  route.nodes = way;
  std::vector<Place> line;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const NetworkEdge& edge = edge_between(*this, way[i - 1], way[i]);
    std::vector<Place> part = edge.line;
    if (edge.from != way[i - 1]) std::reverse(part.begin(), part.end());
    line.insert(line.end(), part.begin() + (line.empty() ? 0 : 1), part.end());
    const bool turns = i + 1 < way.size() && way[i + 1] == way[i - 1];  // back where it came from
    if (!turns && i + 1 < way.size()) continue;
    append_leg(nodes[way[begin]], nodes[way[i]], &line, &route);
    begin = i;
  }
  return route;
}

Route NetworkGraph::tour(std::uint32_t from, double least_m, std::uint64_t seed) const {
  Random random(seed, 0x7042);
  std::vector<int> driven(edges.size(), 0);
  std::vector<std::uint32_t> way = {from};
  double driven_m = 0.0;
  std::uint32_t last_edge = std::numeric_limits<std::uint32_t>::max();
  while (driven_m < least_m) {
    const std::vector<std::uint32_t>& choices = nodes.at(way.back()).edges;
    if (choices.empty()) break;
    std::uint32_t best = choices.front();
    double best_cost = std::numeric_limits<double>::infinity();
    for (const std::uint32_t index : choices) {
      // To turn round on the spot is for dead ends.
      const double cost = driven[index] + 0.9 * random.uniform() + (index == last_edge ? 1e6 : 0.0);
      if (cost < best_cost) best = index;
      best_cost = std::min(best_cost, cost);
    }
    ++driven[best];
    driven_m += edges[best].length_m;
    way.push_back(edges[best].from == way.back() ? edges[best].to : edges[best].from);
    last_edge = best;
  }
  return route_through(way);
}

std::vector<AlikePair> NetworkGraph::alike_pairs(double least_m) const {
  std::vector<Shape> ahead, back;
  for (const NetworkEdge& edge : edges) {
    ahead.push_back(shape_of(edge, false));
    back.push_back(shape_of(edge, true));
  }
  std::vector<AlikePair> pairs;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      const double same_m = alike_m(ahead[i], ahead[k]), turned_m = alike_m(ahead[i], back[k]);
      if (std::max(same_m, turned_m) < least_m) continue;
      pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), turned_m > same_m,
                       std::max(same_m, turned_m)});
    }
  }
  return pairs;
}

}  // namespace pose_wall::tools::sim
