// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "campaign/classes.hpp"

#include <algorithm>
#include <array>

namespace pose_wall::tools::campaign {
namespace {

constexpr std::array<std::string_view, 17> kNominal = {
    "clean", "rough",  "steel_sets",  "shotcrete",  "nominal",     "wide",       "cross_fall",   "humps",  "leaning",
    "body",  "tilted", "upside_down", "range_bias", "range_noise", "boom_sweep", "lean_differs", "jitter",
};

}  // namespace

bool is_nominal(std::string_view scene) {
  return std::find(kNominal.begin(), kNominal.end(), scene) != kNominal.end();
}

double available_floor(std::string_view scene) {
  return is_nominal(scene) ? 0.9 : 0.0;
}

}  // namespace pose_wall::tools::campaign
