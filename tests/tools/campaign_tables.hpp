// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Tables that `pose_wall campaign` prints of chosen runs, and requests for them that it refuses.

#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::test {

class CampaignRuns {
 public:
  // The options that choose the runs.
  explicit CampaignRuns(std::vector<std::string> chosen) : chosen_(std::move(chosen)) {}

  Ran with(std::vector<std::string> words) const {
    words.insert(words.begin(), "campaign");
    words.insert(words.end(), chosen_.begin(), chosen_.end());
    return command(words);
  }

  nlohmann::json rows(const std::string& option, const std::string& what) const {
    const Ran ran = with({"--json", option, what});
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    return nlohmann::json::parse(ran.printed).at("rows");
  }

  // `refused`: what the option is given, and a part of the answer.
  void expect_refused(const std::string& option,
                      const std::vector<std::pair<std::string, std::string>>& refused) const {
    for (const auto& [what, said] : refused) {
      const Ran ran = with({option, what});
      EXPECT_EQ(ran.exit_status, 2) << what;
      EXPECT_TRUE(contains(ran.errors, said)) << what << ": " << ran.errors;
      EXPECT_EQ(ran.printed, "") << what;
    }
  }

 private:
  std::vector<std::string> chosen_;
};

}  // namespace pose_wall::tools::test
