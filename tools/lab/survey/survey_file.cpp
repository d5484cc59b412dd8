// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/survey/survey_file.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "lab/survey/embree_rock.hpp"
#include "lab/survey/surface_shape.hpp"

namespace pose_wall::tools {

SurveyRock read_survey_rock(const std::filesystem::path& file, std::optional<double> disc_radius_m) {
  const SurfaceShape shape = read_surface_shape(file);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : shape.points) box.extend(p);
  const sim::Vector low = box.min().cast<double>(), high = box.max().cast<double>();
  if (!shape.is_cloud()) {
    if (disc_radius_m) {
      throw SurveyError(fmt::format("{}: it is a mesh of {} triangles; a radius of discs is for clouds alone",
                                    file.string(), shape.triangles.size()));
    }
    return {make_embree_rock(shape, 0.0), fmt::format("{} triangles", shape.triangles.size()), low, high};
  }
  const double radius_m = disc_radius_m.value_or(2.0 * spacing_m(shape.points));
  return {make_embree_rock(shape, radius_m), fmt::format("{} discs of {:.3f} m", shape.points.size(), radius_m), low,
          high};
}

}  // namespace pose_wall::tools
