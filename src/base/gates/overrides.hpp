// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Limits in place of a table's, and gates that stop nothing: for sweeps and ablations, in traced libraries alone. They
// are of all threads, and set before the frames.

#pragma once

#include <cstdint>

namespace pose_wall {

template <std::uint32_t count>
class GateOverrides {
 public:
  void set(std::uint32_t id, double limit) {
    one_[id].is_set = true;
    one_[id].limit = limit;
  }
  // The gate judges and notes as before, and lets everything pass.
  void let_pass(std::uint32_t id) { one_[id].lets_pass = true; }
  void forget() {
    for (One& one : one_) one = One{};
  }
  double limit_or(std::uint32_t id, double of_table) const { return one_[id].is_set ? one_[id].limit : of_table; }
  bool lets_pass(std::uint32_t id) const { return one_[id].lets_pass; }

 private:
  struct One {
    bool is_set = false, lets_pass = false;
    double limit = 0.0;
  };
  One one_[count];
};

}  // namespace pose_wall
