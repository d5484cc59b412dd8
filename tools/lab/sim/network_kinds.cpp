// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/network_kinds.hpp"

namespace pose_wall::tools::sim {
namespace {

// Wide enough for a roadheader under its stop.
NetworkPlan wide_plan() {
  NetworkPlan plan;
  plan.length_m = 130.0;
  plan.roads = 2;
  plan.dead_ends_m = 0.0;
  plan.width_min_m = 5.0;
  plan.width_max_m = 6.0;
  return plan;
}

NetworkPlan alike_plan() {
  NetworkPlan plan = wide_plan();
  plan.alike = true;
  return plan;
}

NetworkPlan twin_plan() {
  constexpr double kSpacing_m = 24.0;  // of the grid of walls: so twins are equal to 1 cm
  NetworkPlan plan = wide_plan();
  plan.alike = plan.twin_rock = true;
  plan.spacing_m = kSpacing_m;
  return plan;
}

NetworkPlan smooth_plan() {
  NetworkPlan plan = wide_plan();
  plan.lining = Lining::kSmooth;
  return plan;
}

NetworkPlan steel_plan() {
  constexpr double kPitch_m = 1.2;
  NetworkPlan plan = wide_plan();
  plan.steel_pitch_m = kPitch_m;
  return plan;
}

NetworkPlan corridor_plan() {
  NetworkPlan plan = wide_plan();
  plan.roads = 1;
  plan.length_m = 60.0;
  return plan;
}

}  // namespace

const std::vector<NetworkKind>& network_kinds() {
  static const std::vector<NetworkKind> kinds = {
      {"rock", "two roads and their cross roads in rough rock", wide_plan()},
      {"alike", "the same, but both roads have one shape", alike_plan()},
      {"twin", "the same, but both roads have the same rock to a centimetre", twin_plan()},
      {"smooth", "roads with a smooth lining", smooth_plan()},
      {"steel", "roads with steel sets", steel_plan()},
      {"corridor", "one road without a junction", corridor_plan()},
  };
  return kinds;
}

const NetworkKind* find_network_kind(std::string_view name) {
  for (const NetworkKind& kind : network_kinds()) {
    if (name == kind.name) return &kind;
  }
  return nullptr;
}

}  // namespace pose_wall::tools::sim
