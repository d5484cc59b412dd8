// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Messages that viewers know by the name of their schema and draw in three dimensions:
// https://docs.foxglove.dev/docs/sdk/schemas. A test compares ours with those that Foxglove publishes
// (@foxglove/schemas).

#pragma once

#include <string>

namespace pose_wall::tools::live {

enum class WellKnown { kPoseInFrame, kFrameTransforms, kSceneUpdate, kLog };

// "foxglove.PoseInFrame"
const char* well_known_name(WellKnown type);
// JSON Schema of the message, whole.
std::string well_known_schema(WellKnown type);

}  // namespace pose_wall::tools::live
