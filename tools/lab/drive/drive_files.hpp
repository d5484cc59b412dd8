// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A drive told: a table, a row a frame, a picture.

#pragma once

#include <string>

#include "lab/drive/drive_run.hpp"

namespace pose_wall::tools {

std::string drive_as_csv(const std::vector<DriveFrame>& frames);
std::string drive_picture(const DriveRun& drive, const DriveEnd& end, const TaughtRoads& roads,
                          const std::string& title);
std::string drive_table(const DriveRun& drive, const DriveEnd& end, const TaughtRoads& roads);

}  // namespace pose_wall::tools
