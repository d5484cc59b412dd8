// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/resolved_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"

namespace pose_wall::tools {
namespace {

Vector3 axis_vector(const std::string& axis) {
  const double sign = axis.front() == '-' ? -1.0 : 1.0;
  return axis.back() == 'X' ? Vector3{sign, 0.0, 0.0} : Vector3{0.0, sign, 0.0};
}

Vector3 sampling_point(const ResolvedFrames& frames, double along_m, double lateral_m) {
  Vector3 point{};
  for (std::size_t i = 0; i < 3; ++i) point[i] = along_m * frames.forward_base[i] + lateral_m * frames.left_base[i];
  return point;
}

// Adding zero turns -0 into 0, which a reader would take for a sign.
std::string triple(const Vector3& v, const char* form) {
  return fmt::format(fmt::runtime(form), v[0] + 0.0, v[1] + 0.0, v[2] + 0.0);
}

}  // namespace

ResolvedFrames resolve_frames(const api::Config& config) {
  ResolvedFrames frames;
  char axis[POSE_WALL_TEXT_MAX] = "+X";
  pose_wall_config_get_text(config.get(), "forward_axis", axis, sizeof axis);
  frames.forward_axis = axis;
  frames.forward_base = axis_vector(frames.forward_axis);
  frames.up_base = {0.0, 0.0, 1.0};
  frames.left_base = {-frames.forward_base[1], frames.forward_base[0], 0.0};  // Z x forward
  const double front_m = config.number("s_front");
  const double back_m = config.number("s_back");
  const double left_m = config.number("lateral_offset_left");
  const double right_m = config.number("lateral_offset_right");
  frames.sampling_points_base_m = {sampling_point(frames, front_m, left_m), sampling_point(frames, back_m, left_m),
                                   sampling_point(frames, front_m, right_m), sampling_point(frames, back_m, right_m)};
  frames.extrinsic_position_m = {config.number("extrinsic_x"), config.number("extrinsic_y"),
                                 config.number("extrinsic_z")};
  frames.extrinsic_roll_pitch_yaw_deg = {config.number("extrinsic_roll") * kDegPerRad,
                                         config.number("extrinsic_pitch") * kDegPerRad,
                                         config.number("extrinsic_yaw") * kDegPerRad};
  return frames;
}

std::string resolved_frames_text(const ResolvedFrames& frames, const std::string& indent) {
  constexpr const char* kUnit = "({:+.0f}, {:+.0f}, {:+.0f})";
  constexpr const char* kPoint = "({:+.3f}, {:+.3f}, {:+.3f}) m";
  const char* kAngles = tr("roll {:+.3f}, pitch {:+.3f}, yaw {:+.3f} deg");
  std::string text =
      say("{}forward_axis {}: forward {}, left {}, up {} in base\n", indent, frames.forward_axis,
          triple(frames.forward_base, kUnit), triple(frames.left_base, kUnit), triple(frames.up_base, kUnit));
  for (std::size_t i = 0; i < frames.sampling_points_base_m.size(); ++i) {
    const char* name = pose_wall_quantity_name(static_cast<std::uint32_t>(POSE_WALL_D_LF + i));
    text += say("{}{} is measured from {} in base\n", indent, name, triple(frames.sampling_points_base_m[i], kPoint));
  }
  text += say("{}sensor in base: at {}, {}\n", indent, triple(frames.extrinsic_position_m, kPoint),
              triple(frames.extrinsic_roll_pitch_yaw_deg, kAngles));
  return text;
}

std::string signs_text(const ResolvedFrames& frames, const std::string& indent) {
  struct Signs {
    const char* axis;
    std::uint32_t roll, pitch;  // pose_wall_sense of + ; the engine's own, pinned by a test
  };
  constexpr Signs kSigns[] = {{"+X", POSE_WALL_SENSE_RIGHT_DOWN, POSE_WALL_SENSE_NOSE_DOWN},
                              {"-X", POSE_WALL_SENSE_LEFT_DOWN, POSE_WALL_SENSE_NOSE_UP},
                              {"+Y", POSE_WALL_SENSE_NOSE_UP, POSE_WALL_SENSE_RIGHT_DOWN},
                              {"-Y", POSE_WALL_SENSE_NOSE_DOWN, POSE_WALL_SENSE_LEFT_DOWN}};
  const auto* signs = std::find_if(std::begin(kSigns), std::end(kSigns),
                                   [&frames](const Signs& row) { return frames.forward_axis == row.axis; });
  if (signs == std::end(kSigns)) return "";
  std::string text = say("{}roll: + {}; pitch: + {}; yaw: + {}, in ROS yaw is + to the left\n", indent,
                         tr(pose_wall_sense_name(signs->roll)), tr(pose_wall_sense_name(signs->pitch)),
                         tr(pose_wall_sense_name(POSE_WALL_SENSE_TURNED_RIGHT)));
  if (frames.forward_axis.back() == 'Y') {
    text += say("{}roll and pitch turn about X and Y of base: with forward {} roll is the nose, pitch is the side\n",
                indent, frames.forward_axis);
  }
  return text;
}

}  // namespace pose_wall::tools
