// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <memory>

#include "lab/sim/rock_surface.hpp"
#include "lab/survey/surface_shape.hpp"

namespace pose_wall::tools {

// Rays through triangles, or through discs of a radius about a cloud's points. Where discs overlap, the ray ends at
// their mean, weighed by how near their middles are: single discs stick out of a surface that bends.
std::shared_ptr<const sim::RockSurface> make_embree_rock(const SurfaceShape& shape, double disc_radius_m);

}  // namespace pose_wall::tools
