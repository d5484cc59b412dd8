// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/supposed_mount.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools::doctor {
namespace {

// To find the floor of a sensor that leans on purpose; never proposed.
constexpr double kSearchTilt_deg = 45.0;
constexpr std::size_t kSearchFrames = 8, kFloorFrames = 24;
// Less is not worth a key, and within what floors are uneven by.
constexpr double kTiltMin_deg = 0.3;
constexpr double kHeightOff_m = 0.3;
constexpr std::size_t kBodyCells = 20;

double usable(const SupposedMount& supposed) {
  return supposed.floor.is_found() ? 0.5 * supposed.floor.measured + 0.5 * supposed.road.score : 0.0;
}

MountChoice chosen(SupposedMount a, SupposedMount b, bool is_sure, std::string reason) {
  MountChoice choice{std::move(a), std::nullopt, is_sure, std::move(reason), false};
  if (b.floor.is_found()) choice.other = std::move(b);
  return choice;
}

// What stands under a sensor carries it.
bool carries(const SupposedMount& a, const SupposedMount& b) {
  return a.floor.is_found() && a.body.cells_below >= kBodyCells && a.body.cells_below >= 3 * b.body.cells_below;
}

bool has_height(const SupposedMount& supposed, double height_m) {
  return supposed.floor.is_found() && std::fabs(supposed.floor.height_m - height_m) <= kHeightOff_m;
}

MountChoice by_height(SupposedMount upright, SupposedMount flipped, double height_m) {
  const bool up = has_height(upright, height_m), down = has_height(flipped, height_m);
  if (up == down) {
    std::string reason = up ? say("--height {:.2f} m fits floor and roof alike", height_m)
                            : say("no floor lies as far below as --height {:.2f} m", height_m);
    MountChoice choice = chosen(std::move(upright), std::move(flipped), false, std::move(reason));
    choice.contradicts_height = !up;
    return choice;
  }
  std::string reason = say("by --height {:.2f} m", height_m);
  if (up) return chosen(std::move(upright), std::move(flipped), true, std::move(reason));
  return chosen(std::move(flipped), std::move(upright), true, std::move(reason));
}

MountChoice by_what_is_seen(SupposedMount upright, SupposedMount flipped) {
  if (carries(upright, flipped)) {
    return chosen(std::move(upright), std::move(flipped), true, tr("the machine's body is on the floor's side"));
  }
  if (carries(flipped, upright)) {
    return chosen(std::move(flipped), std::move(upright), true, tr("the machine's body is on the floor's side"));
  }
  if (!flipped.floor.is_found()) {
    return chosen(std::move(upright), std::move(flipped), true, tr("no other plane could be a floor"));
  }
  if (!upright.floor.is_found()) {
    return chosen(std::move(flipped), std::move(upright), false, tr("a plane lies on the sensor's upper side alone"));
  }
  if (usable(flipped) > usable(upright) + 0.3) {
    return chosen(std::move(flipped), std::move(upright), false, tr("floor and walls fit better upside down"));
  }
  return chosen(std::move(upright), std::move(flipped), false,
                tr("floor and roof look alike here; upright is the usual way"));
}

void look_around(SupposedMount& supposed, const api::Config& config, const std::vector<KeptFrame>& frames) {
  supposed.road = look_along_road(config, frames, kSearchFrames);
  const RoadFrame frame(supposed.config, supposed.floor, supposed.road.azimuth_base_rad);
  supposed.ends = look_at_ends(frames, frame, supposed.road);
  supposed.body = look_for_body(frames, frame, supposed.road, supposed.ends);
  supposed.noise = look_at_noise(frames, frame, supposed.road);
}

api::Config without(api::Config config, const std::vector<Box>& boxes) {
  std::size_t next = 0;
  for (int slot = 1; slot <= 4 && next < boxes.size(); ++slot) {
    const std::string key = fmt::format("body_box_{}", slot);
    double told[6] = {};
    pose_wall_config_get_box(config.get(), key.c_str(), told);
    if (told[1] > told[0]) continue;
    config.set(key.c_str(), box_text(boxes[next++]).c_str());
  }
  return config;
}

}  // namespace

SupposedMount suppose_mount(const api::Config& told, bool flipped, const std::vector<KeptFrame>& frames) {
  SupposedMount supposed;
  supposed.is_flipped = flipped;
  supposed.config = told;
  if (flipped) flip_mount(supposed.config);
  api::Config search = supposed.config;
  search.set("ground_tilt_max_deg", std::max(told.number("ground_tilt_max_deg"), kSearchTilt_deg));
  supposed.floor = look_at_floor(search, frames, kSearchFrames);
  if (!supposed.floor.is_found()) return supposed;
  const api::Config unlevelled = supposed.config;
  level_mount(supposed.config, supposed.floor.up_lidar);
  supposed.floor = look_at_floor(supposed.config, frames, kFloorFrames);
  if (!supposed.floor.is_found()) return supposed;
  supposed.tilt_rad = tilt_rad(unlevelled, supposed.floor.up_lidar);
  supposed.config = unlevelled;
  if (supposed.tilt_rad * kDegPerRad >= kTiltMin_deg) level_mount(supposed.config, supposed.floor.up_lidar);

  look_around(supposed, supposed.config, frames);
  // False returns of the housing and a body close by may hide the road: once more without them.
  if (!supposed.road.is_found && !supposed.body.boxes_base.empty()) {
    look_around(supposed, without(supposed.config, supposed.body.boxes_base), frames);
  }
  return supposed;
}

MountChoice choose_mount(const api::Config& told, bool is_told, std::optional<double> height_m,
                         const std::vector<KeptFrame>& frames) {
  SupposedMount upright = suppose_mount(told, false, frames);
  if (is_told && upright.floor.is_found()) {
    return {std::move(upright), std::nullopt, true, tr("as the config's extrinsic says"), false};
  }
  SupposedMount flipped = suppose_mount(told, true, frames);
  if (height_m) return by_height(std::move(upright), std::move(flipped), *height_m);
  return by_what_is_seen(std::move(upright), std::move(flipped));
}

}  // namespace pose_wall::tools::doctor
