// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/surfaces.hpp"

#include <map>
#include <mutex>

#include "lab/survey/survey_file.hpp"

namespace pose_wall::tools::campaign {

const sim::Survey& survey_of(const std::string& file) {
  static std::mutex mutex;
  static std::map<std::string, sim::Survey> surveys;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto known = surveys.find(file);
  if (known != surveys.end()) return known->second;
  const SurveyRock rock = read_survey_rock(file, std::nullopt);
  return surveys.emplace(file, sim::Survey{rock.rock, propose_survey_path(rock, file)}).first->second;
}

}  // namespace pose_wall::tools::campaign
