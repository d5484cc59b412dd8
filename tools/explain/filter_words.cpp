// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "explain/filter_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "explain/amounts.hpp"
#include "terminal/counted.hpp"

namespace pose_wall::tools::explain {
namespace {

struct Dropped {
  std::uint32_t count;
  std::string as;
  const char* help;
};

std::string limit_of(const pose_wall_config& config, const char* key) {
  double value_m = 0.0;
  pose_wall_config_get_number(&config, key, &value_m);
  return fmt::format("{} ({})", key, metres(value_m));
}

std::vector<Dropped> dropped_points(const pose_wall_config& config, const pose_wall_result& r) {
  std::vector<Dropped> out = {
      {r.dropped_not_finite, "are no numbers",
       "these are directions without a return: dust, mud on the window, or dark"},
      {r.dropped_zero, "are zero, without a return",
       "these are directions without a return: dust, mud on the window, or dark"},
      {r.dropped_near, "are nearer than " + limit_of(config, "range_min"),
       "something close blocks the view: dust, spray, mud on the window, the machine itself"},
      {r.dropped_far, "are farther than " + limit_of(config, "range_max"),
       "is the file in metres? Millimetres look like this; range_max"},
      {r.dropped_body, "are inside the body boxes", "check body_box_1 to body_box_4 and the extrinsic"}};
  out.erase(std::remove_if(out.begin(), out.end(), [](const Dropped& d) { return d.count == 0; }), out.end());
  std::stable_sort(out.begin(), out.end(), [](const Dropped& a, const Dropped& b) { return a.count > b.count; });
  return out;
}

}  // namespace

FilterWords filter_words(const pose_wall_config& config, const pose_wall_result& result) {
  const std::vector<Dropped> dropped = dropped_points(config, result);
  std::vector<std::string> parts;
  parts.reserve(dropped.size());
  for (const Dropped& d : dropped) parts.push_back(fmt::format("{} {}", d.count, d.as));
  FilterWords out;
  out.sentence =
      fmt::format("{} came in{}{}; {} of {} are left, and {} were dropped as lone.", counted(result.points_in, "point"),
                  parts.empty() ? "" : ", of which ", fmt::join(parts, ", "),
                  counted(result.voxels - result.outliers, "voxel"), metres(result.voxel_leaf_m), result.outliers);
  if (result.points_in == 0) {
    out.help = "an empty cloud came from the driver";
  } else if (!dropped.empty() && 4 * static_cast<std::uint64_t>(dropped.front().count) >= result.points_in) {
    out.help = dropped.front().help;
  } else if (2 * result.outliers >= result.voxels) {
    out.help =
        "points scatter: dust, or a sparse sensor that needs a larger outlier_radius or fewer "
        "outlier_min_neighbors";
  }
  return out;
}

}  // namespace pose_wall::tools::explain
