// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A planar scan from above: what was seen free, surfaces, low things and things overhead.

#pragma once

#include <string>

#include "pose_wall_planar_scan.h"
#include "study/planar/scan_source.hpp"

namespace pose_wall::tools {

// view: beside the scan of a cloud; nullptr for a scan of a log.
std::string scan_picture(const SourcedScan& scan, const pose_wall_planar_scan_view* view);

}  // namespace pose_wall::tools
