// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Names and sentences.

#include "part/export.hpp"
#include "pose_wall_runtime.h"

extern "C" {

POSE_WALL_EXPORT const char* pose_wall_runtime_status_text(int32_t status) {
  return pose_wall_status_text(status);
}

POSE_WALL_EXPORT const char* pose_wall_runtime_activity_name(uint32_t activity) {
  switch (activity) {
    case POSE_WALL_RUNTIME_AT_NOTHING:
      return "nothing";
    case POSE_WALL_RUNTIME_AT_WAIT:
      return "wait";
    case POSE_WALL_RUNTIME_AT_CHOICE:
      return "choice";
    case POSE_WALL_RUNTIME_AT_FRAME:
      return "frame";
    case POSE_WALL_RUNTIME_AT_SILENCE:
      return "silence";
    case POSE_WALL_RUNTIME_AT_CALLBACK:
      return "callback";
    default:
      return "unknown";
  }
}

POSE_WALL_EXPORT const char* pose_wall_runtime_drop_name(uint32_t drop) {
  switch (drop) {
    case POSE_WALL_RUNTIME_DROP_DESCRIPTION:
      return "description";
    case POSE_WALL_RUNTIME_DROP_LARGE:
      return "large";
    case POSE_WALL_RUNTIME_DROP_BUSY:
      return "busy";
    case POSE_WALL_RUNTIME_DROP_OVERTAKEN:
      return "overtaken";
    case POSE_WALL_RUNTIME_DROP_STOPPED:
      return "stopped";
    case POSE_WALL_RUNTIME_DROP_ENGINE:
      return "engine";
    case POSE_WALL_RUNTIME_DROP_LATE:
      return "late";
    default:
      return "unknown";
  }
}

}  // extern "C"
