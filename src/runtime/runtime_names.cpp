// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Names and sentences.

#include "../export.hpp"
#include "pose_wall_box.h"
#include "pose_wall_runtime.h"

namespace {

const char* box_status_text(int32_t status) {
  switch (status) {
    case POSE_WALL_BOX_E_FORMAT:
      return "no black box, or its header is damaged";
    case POSE_WALL_BOX_E_VERSION:
      return "a black box of a build whose structs differ from this one's";
    case POSE_WALL_BOX_E_END:
      return "no further record";
    case POSE_WALL_BOX_E_EMPTY:
      return "the record holds a digest only: there is nothing to compute";
    case POSE_WALL_BOX_E_RUN:
      return "the record is of another run than the box's header, whose config may not be its own";
    case POSE_WALL_BOX_E_KIND:
      return "the record is of a kind that this build does not know";
    default:
      return pose_wall_status_text(status);
  }
}

}  // namespace

extern "C" {

POSE_WALL_EXPORT const char* pose_wall_runtime_status_text(int32_t status) {
  switch (status) {
    // In the words of this header, where pose_wall.h speaks of its engine.
    case POSE_WALL_E_BUSY:
      return "a runtime was started in this block and not stopped, or another call is inside this engine";
    case POSE_WALL_E_ABI:
      return "the program was built against the header of an earlier ABI: build it again against this one";
    case POSE_WALL_RUNTIME_E_OPTION:
      return "an option is out of its range, or reserved is not zero: pose_wall_runtime_options_check() tells which";
    case POSE_WALL_RUNTIME_E_HANDLE:
      return "not an open runtime";
    case POSE_WALL_RUNTIME_E_STATE:
      return "not allowed in this state: the runtime does not run, or is not stopped";
    case POSE_WALL_RUNTIME_E_THREAD:
      return "not allowed from the callback or the sink: it would wait for itself";
    case POSE_WALL_RUNTIME_E_BUSY:
      return "another thread is inside pose_wall_runtime_push()";
    case POSE_WALL_RUNTIME_E_LARGE:
      return "the cloud has more points than cloud_points_max, or wider ones than point_bytes_max";
    case POSE_WALL_RUNTIME_E_NOTHING:
      return "nothing was published since the start";
    case POSE_WALL_RUNTIME_E_SYSTEM:
      return "the system refused a thread, or what the options require; see the *_error statistics";
    case POSE_WALL_RUNTIME_E_STALE:
      return "what was published last is as old as watchdog_ns: `activity` tells what the worker is at";
    case POSE_WALL_RUNTIME_E_MOTION:
      return "the runtime was opened without motion, or its config's key `motion` is off";
    default:
      return box_status_text(status);
  }
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
