// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// In place of the readers where the build did not find their libraries.

#include "lab/survey/survey_file.hpp"

namespace pose_wall::tools {

SurveyRock read_survey_rock(const std::filesystem::path&, std::optional<double>) {
  throw SurveyError("this build reads no surfaces: install libembree-dev and libassimp-dev, configure and build again");
}

}  // namespace pose_wall::tools
