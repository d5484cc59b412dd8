// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A story told: a table, a row a frame, a picture.

#pragma once

#include <string>

#include "lab/drive/story.hpp"

namespace pose_wall::tools {

std::string story_as_csv(const std::vector<StoryFrame>& frames);
std::string story_picture(const DriveStory& story, const StoryEnd& end, const TaughtRoads& roads,
                          const std::string& title);
std::string story_table(const DriveStory& story, const StoryEnd& end, const TaughtRoads& roads);

}  // namespace pose_wall::tools
