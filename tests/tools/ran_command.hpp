// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The command as a test runs it: in its own process, with what it printed and what it said on stderr.

#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "apps/command.hpp"
#include "io/csv/csv_table.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::test {

struct Ran {
  int exit_status = 0;
  std::string errors;
  std::string printed;
};

// The words behind `pose_wall`, and more of them.
inline Ran command(std::vector<std::string> words, const std::vector<std::string>& more = {}) {
  words.insert(words.begin(), "pose_wall");
  words.insert(words.end(), more.begin(), more.end());
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Ran ran;
  ran.exit_status = run_command(static_cast<int>(argv.size()), argv.data());
  ran.errors = ::testing::internal::GetCapturedStderr();
  ran.printed = ::testing::internal::GetCapturedStdout();
  return ran;
}

// Whether it ended so and said this where errors go.
inline ::testing::AssertionResult says(const Ran& ran, int exit_status, const std::string& part) {
  if (ran.exit_status == exit_status && contains(ran.errors, part)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "exit status " << ran.exit_status << ", not " << exit_status << ", or no '"
                                       << part << "' in: " << ran.errors;
}

// A table that it wrote.
inline CsvTable table_of(const std::string& file) {
  std::ifstream stream(file);
  return CsvTable::parse(stream);
}

}  // namespace pose_wall::tools::test
