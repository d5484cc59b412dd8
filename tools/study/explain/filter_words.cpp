// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/filter_words.hpp"

#include <algorithm>
#include <vector>

#include "io/language/language.hpp"
#include "study/explain/amounts.hpp"
#include "study/explain/prose.hpp"

namespace pose_wall::tools::explain {
namespace {

struct Dropped {
  std::uint32_t count;
  std::string as;  // "12 are not finite"
  const char* help;
};

std::string limit_of(const pose_wall_config& config, const char* key) {
  double value_m = 0.0;
  pose_wall_config_get_number(&config, key, &value_m);
  return say("{} ({})", key, metres(value_m));
}

// Largest count first.
std::vector<Dropped> dropped_points(const pose_wall_config& config, const pose_wall_result& r) {
  const char* const no_return = translatable("directions without a return: dust, mud on the window, or dark");
  std::vector<Dropped> out = {
      {r.dropped_not_finite, say("{} are not finite", r.dropped_not_finite), no_return},
      {r.dropped_zero, say("{} are zero, without a return", r.dropped_zero), no_return},
      {r.dropped_near, say("{} are nearer than {}", r.dropped_near, limit_of(config, "range_min")),
       translatable("something close blocks the view: dust, spray, mud on the window, the machine itself")},
      {r.dropped_far, say("{} are farther than {}", r.dropped_far, limit_of(config, "range_max")),
       translatable("is the file in metres? --unit mm reads millimetres; range_max")},
      {r.dropped_body, say("{} are inside the body boxes", r.dropped_body),
       translatable("check body_box_1 to body_box_4 and the extrinsic")}};
  out.erase(std::remove_if(out.begin(), out.end(), [](const Dropped& d) { return d.count == 0; }), out.end());
  std::stable_sort(out.begin(), out.end(), [](const Dropped& a, const Dropped& b) { return a.count > b.count; });
  return out;
}

std::string left_over(const pose_wall_result& r) {
  const std::uint32_t left = r.voxels - r.outliers;
  const std::string leaf = metres(r.voxel_leaf_m);
  return left == 1 ? say("{} voxel of {} is left; {} lone ones were dropped.", left, leaf, r.outliers)
                   : say("{} voxels of {} are left; {} lone ones were dropped.", left, leaf, r.outliers);
}

}  // namespace

FilterWords filter_words(const pose_wall_config& config, const pose_wall_result& result) {
  const std::vector<Dropped> dropped = dropped_points(config, result);
  std::vector<std::string> parts;
  parts.reserve(dropped.size());
  for (const Dropped& d : dropped) parts.push_back(d.as);
  FilterWords out;
  out.sentence = paragraph({say("{} came in.", points_text(result.points_in)),
                            parts.empty() ? "" : say("Of these {}.", listed(parts)), left_over(result)});
  if (result.points_in == 0) {
    out.help = tr("an empty cloud came from the driver");
  } else if (!dropped.empty() && 4 * static_cast<std::uint64_t>(dropped.front().count) >= result.points_in) {
    out.help = tr(dropped.front().help);
  } else if (2 * result.outliers >= result.voxels) {
    out.help =
        tr("points scatter: dust, or a sparse sensor that needs a larger outlier_radius or fewer "
           "outlier_min_neighbors");
  }
  return out;
}

}  // namespace pose_wall::tools::explain
