// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In which settings of the engine a sensor differs from the defaults. The simulator writes them into its roads,
// `doctor` proposes them.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

// A setting of the engine: a key of pose_wall.yaml and its value.
struct EngineSetting {
  std::string key;
  std::string value;
};

// Of a class of sensors ("vlp16") or of one as it is built ("velodyne-vlp16"); empty where there is no such name.
std::vector<EngineSetting> engine_settings_of(std::string_view sensor);

}  // namespace pose_wall::tools
