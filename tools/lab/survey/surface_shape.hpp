// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace pose_wall::tools {

struct SurfaceShape {
  std::vector<Eigen::Vector3f> points;   // corners of triangles, or middles of discs; z up, m
  std::vector<Eigen::Vector3f> normals;  // of discs: unit
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool is_cloud() const { return triangles.empty(); }
};

// Throws SurveyError.
SurfaceShape read_surface_shape(const std::filesystem::path& file);

// How far apart neighbours of a cloud are, in the median.
double spacing_m(const std::vector<Eigen::Vector3f>& points);

}  // namespace pose_wall::tools
