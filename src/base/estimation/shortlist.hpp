// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/estimation/plane.hpp"

namespace pose_wall {

struct Hypothesis {
  Plane plane;
  double cost = 0.0;  // smaller is better
};

// The best few hypotheses that differ from each other. The runner-up that merely repeats the winner would hide the
// surface behind it; that is why near-copies compete for one place.
//
// Alike: bool operator()(const Plane&, const Plane&), true where two hypotheses mean the same surface.
template <std::uint32_t kCapacity>
class Shortlist {
 public:
  std::uint32_t count() const { return count_; }
  const Hypothesis& operator[](std::uint32_t i) const { return items_[i]; }
  Hypothesis& operator[](std::uint32_t i) { return items_[i]; }
  void clear() { count_ = 0; }
  // Hypotheses that cost this much or more are not taken.
  double too_much() const {
    constexpr double kAnyCost = 1e300;  // no hypothesis costs as much
    return count_ == kCapacity ? items_[count_ - 1].cost : kAnyCost;
  }

  template <typename Alike>
  void offer(const Hypothesis& h, const Alike& alike) {
    if (h.cost >= too_much()) return;
    // Worse than a near-copy: no news. Better: all the near-copies go.
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (items_[i].cost <= h.cost && alike(items_[i].plane, h.plane)) return;
    }
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!alike(items_[i].plane, h.plane)) items_[kept++] = items_[i];
    }
    count_ = kept;
    insert_sorted(h);
  }

 private:
  void insert_sorted(const Hypothesis& h) {
    if (count_ == kCapacity) --count_;
    std::uint32_t place = count_++;
    for (; place > 0 && items_[place - 1].cost > h.cost; --place) items_[place] = items_[place - 1];
    items_[place] = h;
  }

  Hypothesis items_[kCapacity];
  std::uint32_t count_ = 0;
};

}  // namespace pose_wall
