// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Motion beside the engine, by functions that the caller handed over. Whatever becomes of it, the engine gets its
// frame.

#include <cstring>

#include "runtime.hpp"
#include "saturated.hpp"

namespace pose_wall::runtime {

bool config_wants_motion(const pose_wall_config& config) {
  char word[POSE_WALL_TEXT_MAX] = {};
  return pose_wall_config_get_text(&config, "motion", word, sizeof(word)) == POSE_WALL_OK &&
         std::strcmp(word, "on") == 0;
}

std::int32_t Runtime::open_motion() {
  if (!has_motion()) return POSE_WALL_OK;
  const pose_wall_motion_settings* const settings = options_.motion_settings != nullptr ? &motion_settings_ : nullptr;
  return options_.motion->open(&config_, settings, motion_block_, motion_bytes_, &motion_);
}

// As for the engine: the damage may have hit the config, too.
void Runtime::open_motion_anew() {
  if (config_is_whole()) open_motion();
}

void Runtime::reset_motion() {
  if (has_motion() && options_.motion->reset(motion_) != POSE_WALL_OK) open_motion_anew();
}

pose_wall_motion_result Runtime::no_motion() const {
  pose_wall_motion_result none{};
  if (!has_motion()) return none;
  none.struct_size = sizeof(none);
  return options_.motion->blank(motion_, &none) == POSE_WALL_OK ? none : blank_motion_;
}

// The frame's pose among its inputs, as pose_wall_motion_process_both puts it there.
void Runtime::move(FrameSlot* slot) {
  pose_wall_publication& p = slot->publication;
  p.has_motion = 0;
  p.motion_status = POSE_WALL_OK;
  p.odometry = {};
  if (!has_motion()) {
    p.motion = {};
    return;
  }
  const std::int64_t begin_ns = looked_ns_;
  if (slot->cloud.inputs == nullptr) {
    slot->inputs = {};
    slot->inputs.struct_size = sizeof(slot->inputs);
    slot->cloud.inputs = &slot->inputs;
  }
  // Places of two odometries are not comparable, so the caller's is not used even where motion has none.
  slot->inputs.given &= ~std::uint32_t{POSE_WALL_INPUT_ODOMETRY};
  slot->inputs.odometry = {};
  p.motion.struct_size = sizeof(p.motion);
  p.motion_status = options_.motion->process(motion_, &slot->cloud, &p.motion);
  if (p.motion_status == POSE_WALL_OK) p.motion_status = options_.motion->give(motion_, &slot->inputs);
  if (p.motion_status == POSE_WALL_OK) {
    p.has_motion = 1;
    if ((slot->inputs.given & POSE_WALL_INPUT_ODOMETRY) != 0) p.odometry = slot->inputs.odometry;
    p.motion.points_in += slot->left_out_not_finite + slot->left_out_zero;
  } else {
    if (p.motion_status == POSE_WALL_E_ENGINE) open_motion_anew();
    p.motion = no_motion();
  }
  looked_ns_ = now();
  times_.motion.add(difference(looked_ns_, begin_ns));
}

}  // namespace pose_wall::runtime
