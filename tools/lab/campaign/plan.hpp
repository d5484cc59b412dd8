// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which runs a campaign is made of. A run is one draw of a scene's sizes, seen by one sensor: a sequence of frames with
// an engine of its own.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lab/campaign/movement.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/setup.hpp"

namespace pose_wall::tools::campaign {

struct Run {
  std::string scene;
  std::string sensor;
  std::uint32_t draw = 0;
  std::uint64_t seed = 0;               // of `pose_wall sim --random`: gives the same frames
  std::uint32_t frames = 0;             // of the scene
  double drive_in_m = 0.0;              // driven before the scene begins
  std::uint32_t drive_in_frames = 0;    // on this way
  std::string surface{};                // file of a real road, in place of the scene
  std::vector<std::string> settings{};  // KEY=VALUE of the simulator over what the scene draws: see movement_of
};

// Of the table, or that which stands for real roads. nullptr if there is none of this name.
const sim::SceneChoice* scene_of(const std::string& name);

// The scene as this run draws it, with the run's settings and its way in.
sim::Setup setup_of(const Run& run);

struct PlanRequest {
  bool motion = false;                // of the motion library, its classes for scenes: see motion_classes
  std::vector<std::string> scenes;    // empty: all
  std::vector<std::string> sensors;   // empty: those of the size
  std::vector<std::string> surfaces;  // files of real roads, besides the scenes
  std::string kind = "all";           // or the name of a scene kind
  std::string size = "small";
  std::optional<std::uint32_t> draws;   // per scene and sensor; none: those of the size
  std::optional<std::uint32_t> frames;  // per draw; none: those of the size, or what the scene's event asks for
  std::uint32_t first_draw = 0;
  std::uint64_t seed = 1;
  double drive_in_m = 0.0;  // driven before each scene begins
  Scans scans = Scans::kTurning;
};

std::vector<std::string> size_names();
// Those of the request, else those of its size. Throws std::invalid_argument for a size that does not exist.
const std::vector<std::string>& sensors_of(const PlanRequest& request);

// Scene by scene, sensor by sensor, draw by draw; of motion draw by draw, class by class, sensor by sensor. The same
// request gives the same runs. Of motion the drawn sizes do not depend on the size, only how long a run is. Throws
// std::invalid_argument for names that do not exist, with the nearest one.
std::vector<Run> make_plan(const PlanRequest& request);

// Short enough to be typed again, and another one for every run of a campaign.
std::uint64_t run_seed(std::uint64_t campaign_seed, const std::string& scene, const std::string& sensor,
                       std::uint32_t draw);

// Of the scenes and of the way in.
std::uint32_t frames_of(const Run& run);
std::size_t frames_of(const std::vector<Run>& runs);

}  // namespace pose_wall::tools::campaign
