// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The command as a test runs it: in its own process, with what was said on stderr.

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "command.hpp"

namespace pose_wall::tools::test {

struct Ran {
  int exit_status;
  std::string errors;
};

// The words behind `pose_wall`.
inline Ran command(std::vector<std::string> words) {
  words.insert(words.begin(), "pose_wall");
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  ::testing::internal::CaptureStderr();
  const int exit_status = run_command(static_cast<int>(argv.size()), argv.data());
  return {exit_status, ::testing::internal::GetCapturedStderr()};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace pose_wall::tools::test
