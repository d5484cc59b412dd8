// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/demo/demo_setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "io/config_file/load_config.hpp"
#include "io/numbers/angles.hpp"
#include "lab/sim/machine_body.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools {
namespace {

// A rough heading with pipes along one wall, muck along the other, the face ahead and the machine creeping towards it.
constexpr const char* kHeading[] = {
    "width_m=5.2",      "height_m=3.4",           "lean_left_deg=3",   "lean_right_deg=2",   "face_distance_m=9",
    "roughness_m=0.02", "floor_roughness_m=0.01", "pipe_side=right",   "muck_side=left",     "muck_height_m=0.3",
    "muck_width_m=0.7", "lateral_m=0.25",         "turned_left_deg=4", "turn_rate_dps=-0.5", "speed_mps=0.12",
    "roll_deg=0.8",     "pitch_deg=-1.5",         "sway_roll_deg=0.4", "sway_pitch_deg=0.3", "sway_period_s=8",
    "body=yes"};

std::string axis_word(const sim::Setup& setup) {
  static constexpr std::array<const char*, 4> kWords = {"+X", "-X", "+Y", "-Y"};
  return kWords.at(static_cast<std::size_t>(setup.machine.forward_axis));
}

std::string body_box(const sim::Setup& setup) {
  return fmt::format("{}", fmt::join(sim::body_box_base_m(setup.machine), " "));
}

std::string radians(double degrees) {
  return fmt::format("{:.17g}", degrees * kRadPerDeg);
}

std::vector<std::string> settings_as_simulated(const sim::Setup& setup) {
  const sim::Mount& mount = setup.mount;
  std::vector<std::string> settings = {"forward_axis=" + axis_word(setup),
                                       fmt::format("s_front={}", setup.machine.s_front_m),
                                       fmt::format("s_back={}", setup.machine.s_back_m),
                                       fmt::format("extrinsic_x={}", mount.mount_x_m),
                                       fmt::format("extrinsic_y={}", mount.mount_y_m),
                                       fmt::format("extrinsic_z={}", mount.mount_z_m),
                                       "extrinsic_roll=" + radians(mount.mount_roll_deg),
                                       "extrinsic_pitch=" + radians(mount.mount_pitch_deg),
                                       "extrinsic_yaw=" + radians(mount.mount_yaw_deg)};
  if (setup.machine.body != 0.0) settings.push_back("body_box_1=" + body_box(setup));
  return settings;
}

}  // namespace

sim::Setup demo_setup(const DemoOptions& options) {
  sim::Setup setup =
      sim::make_setup(options.scene.empty() ? "clean" : options.scene, options.sensor, false, options.seed);
  if (options.scene.empty()) {
    for (const char* assignment : kHeading) sim::set_parameter(setup, assignment);
  }
  for (const std::string& assignment : options.simulation) sim::set_parameter(setup, assignment);
  return setup;
}

LoadedConfig demo_config(const DemoOptions& options, const sim::Setup& setup) {
  std::vector<std::string> settings = settings_as_simulated(setup);
  settings.insert(settings.end(), options.settings.begin(), options.settings.end());
  return load_config(options.config_file, settings);
}

}  // namespace pose_wall::tools
