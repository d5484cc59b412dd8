// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Dijkstra's algorithm with buckets as wide as the shortest step: within a bucket no place can better another one (Dial
// 1969; Goldberg 2001), so the order inside does not matter.

#include "planar/route/cost_to_go.hpp"

namespace pose_wall::planar::route {

void CostToGo::lay_out(Arena& arena, std::uint32_t places) {
  distance_ = arena.take<std::uint32_t>(places);
  next_ = arena.take<std::uint32_t>(places);
  before_ = arena.take<std::uint32_t>(places);
}

void CostToGo::begin(const Lattice* lattice, const LatticeGrid& grid, const Shape* circle, const LatticePlaces& places,
                     std::uint32_t longest) {
  moves_count_ = 0;
  for (std::uint32_t k = 0; k < lattice->headings(); ++k) {
    if (lattice->heading(k).length <= longest) moves_[moves_count_++] = &lattice->heading(k);
  }
  grid_ = grid;
  circle_ = circle;
  places_ = places;
  width_ = static_cast<std::uint32_t>(lattice->step_m() / kUnits_m);
  distance_.first(places.count()).fill(kUnknown);
  for (std::uint32_t& head : head_) head = kNone;
  end_ = kFar;
  settled_ = waiting_ = met_ = 0;
  is_cut_ = false;
}

bool CostToGo::is_free(std::uint32_t place, std::int32_t column, std::int32_t row) {
  if (distance_[place] == kBlocked) return false;
  if (distance_[place] != kUnknown) return true;
  if (grid_.is_free(*circle_, column, row)) return true;
  distance_[place] = kBlocked;
  return false;
}

void CostToGo::put(std::uint32_t place, std::uint32_t distance) {
  distance_[place] = distance;
  std::uint32_t& head = head_[distance / width_ % kBuckets];
  next_[place] = head;
  before_[place] = kNone;
  if (head != kNone) before_[head] = place;
  head = place;
  ++waiting_;
}

void CostToGo::take_out(std::uint32_t place) {
  const std::uint32_t before = before_[place], next = next_[place];
  if (before != kNone) {
    next_[before] = next;
  } else {
    head_[distance_[place] / width_ % kBuckets] = next;
  }
  if (next != kNone) before_[next] = before;
  --waiting_;
}

void CostToGo::seed(std::uint32_t place, std::uint32_t distance) {
  if (!is_free(place, places_.column(place), places_.row(place))) return;
  if (distance_[place] != kUnknown) {
    if (distance_[place] <= distance) return;
    take_out(place);
  }
  put(place, distance);
}

void CostToGo::relax_from(std::uint32_t place) {
  const std::int32_t column = places_.column(place), row = places_.row(place);
  looks_ += moves_count_;
  for (std::uint32_t k = 0; k < moves_count_; ++k) {
    const Heading& heading = *moves_[k];
    const std::int32_t c = column + heading.dx, r = row + heading.dy;
    if (!places_.holds(c, r)) continue;
    const std::uint32_t to = places_.number(c, r), distance = distance_[place] + heading.length;
    const std::uint32_t old = distance_[to];
    if (old == kBlocked || old <= distance || !is_free(to, c, r)) continue;
    if (old != kUnknown) take_out(to);
    put(to, distance);
  }
}

bool CostToGo::spread(const Target& target) {
  bool is_met = false;
  std::uint32_t empty = 0;  // buckets in a row
  // A seed lies at most a few steps away, so the first bucket is among the first sixteen.
  for (std::uint32_t bucket = 0; waiting_ > 0 && empty < kBuckets; ++bucket) {
    if (bucket * static_cast<std::uint64_t>(width_) >= end_) {
      is_cut_ = true;
      return is_met;
    }
    std::uint32_t& head = head_[bucket % kBuckets];
    empty = head == kNone ? empty + 1 : 0;
    while (head != kNone) {
      const std::uint32_t place = head;
      take_out(place);
      ++settled_;
      if (!is_met && target.holds(places_.column(place), places_.row(place))) {
        is_met = true;
        met_ = place;
        end_ = (distance_[place] / 16 * 17 / width_ + 24) * width_;  // the search strays no further
      }
      relax_from(place);
    }
  }
  end_ = kFar;
  return is_met;
}

std::uint32_t CostToGo::step_down(std::uint32_t place) const {
  std::uint32_t best = place;
  for (std::uint32_t k = 0; k < moves_count_; ++k) {
    const std::int32_t c = places_.column(place) + moves_[k]->dx;
    const std::int32_t r = places_.row(place) + moves_[k]->dy;
    if (!places_.holds(c, r)) continue;
    const std::uint32_t to = places_.number(c, r);
    // The predecessor by distance and length: the least distance alone would cross corners.
    if (distance_[to] < kFar && distance_[to] + moves_[k]->length == distance_[place]) best = to;
  }
  return best;
}

}  // namespace pose_wall::planar::route
