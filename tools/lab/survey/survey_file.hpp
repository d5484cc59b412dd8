// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A real road from files: a triangle mesh or a dense cloud with normals, and the poses of a machine in it.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "lab/sim/rock_surface.hpp"

namespace pose_wall::tools {

// The message names the file, what is wrong in it, and what is allowed.
class SurveyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct SurveyRock {
  std::shared_ptr<const sim::RockSurface> rock;
  std::string about;      // "1000000 triangles", "162113 discs of 0.150 m"
  sim::Vector low, high;  // of its points
};

// Mesh: PLY, OBJ, glTF 2. Cloud: a PLY without faces, with nx, ny, nz; each point is a disc. Metres, z up; a glTF has y
// up by its specification and is turned. disc_radius_m: none means twice the cloud's own spacing.
SurveyRock read_survey_rock(const std::filesystem::path& file, std::optional<double> disc_radius_m);

// A way through it that nobody gave poses for (survey_line.hpp), a place each metre, in the height of a sensor on a low
// machine. Throws SurveyError that names the file where no place of it is like a road.
std::vector<sim::Placement> propose_survey_path(const SurveyRock& rock, const std::filesystem::path& file);

// Lines `t x y z qx qy qz qw` (TUM): base in the rock's frame, one line a frame.
std::vector<sim::Placement> read_survey_path(const std::filesystem::path& file);
// The same lines, of poses a second apart.
std::string survey_path_text(const std::vector<sim::Placement>& path);

}  // namespace pose_wall::tools
