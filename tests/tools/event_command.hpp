// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The command that a card gives for an event: made, and typed as a person would.

#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "lab/campaign/folder.hpp"
#include "lab/campaign/record.hpp"
#include "ran_command.hpp"

namespace pose_wall::tools::test {

// Makes the roll of one frame mislead in the records of a campaign. Returns the command of its card's first event, with
// `again` in the place of DIR.
inline std::string command_of_event(const std::string& folder, std::size_t run, std::size_t frame,
                                    const std::string& again) {
  const campaign::Manifest manifest = campaign::read_manifest(folder);
  campaign::RunRecord record = campaign::read_records(folder, manifest).at(run);
  record.frames.at(frame).quantity[POSE_WALL_ROLL].truth += 0.5;
  record.frames.at(frame).quantity[POSE_WALL_ROLL].surveyed += 0.5;
  campaign::write_record(campaign::record_file(folder, record.run), record, manifest.fingerprint());
  EXPECT_EQ(command({"campaign", "--card-only", "--quiet", "--output", folder}).exit_status, 0);
  std::ifstream page(folder + "/card.json");
  std::string text = nlohmann::json::parse(page)["worst_events"][0]["command"];
  for (std::size_t at = text.find("DIR"); at != std::string::npos; at = text.find("DIR")) text.replace(at, 3, again);
  return text;
}

// As a shell would; there are no quotes in it.
inline void run_all_of(const std::string& line) {
  std::istringstream words(line + " &&");
  std::vector<std::string> one;
  for (std::string word; words >> word;) {
    if (word != "&&") {
      one.push_back(word);
      continue;
    }
    ASSERT_EQ(one.front(), "pose_wall");
    ASSERT_EQ(command({one.begin() + 1, one.end()}).exit_status, 0) << line;
    one.clear();
  }
}

}  // namespace pose_wall::tools::test
