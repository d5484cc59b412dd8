// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The files of page/, put into the program by the build.

#pragma once

#include <string_view>

namespace pose_wall::tools::report {

struct Assets {
  std::string_view html, style, script;
  std::string_view library;  // which the script may use: three_library, or nothing
};
Assets assets();         // of a report
Assets live_assets();    // of the page of pose_walld, which shares most scripts
Assets motion_assets();  // of the report on a motion table
Assets map_assets();     // of the report on maps

// three.js as one script, for views in three dimensions; a comment where the build did not find it.
std::string_view three_library();

}  // namespace pose_wall::tools::report
