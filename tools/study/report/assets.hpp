// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The files of page/, put into the program by the build.

#pragma once

#include <string_view>

namespace pose_wall::tools::report {

struct Assets {
  std::string_view html, style, script;
};
Assets assets();         // of a report
Assets live_assets();    // of the page of pose_walld, which shares most scripts
Assets motion_assets();  // of the report on a motion table
Assets map_assets();     // of the report on maps

}  // namespace pose_wall::tools::report
