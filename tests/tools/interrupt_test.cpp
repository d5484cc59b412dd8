// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: after Ctrl-C what verbs wrote is whole: rows, clouds, records; and the exit status is the one shells expect.
// That every verb has it, also before its first result: interrupt_verbs_test.cpp.

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "apps/command.hpp"
#include "interrupted_child.hpp"
#include "io/csv/csv_table.hpp"
#include "io/csv/truth_csv.hpp"
#include "io/frames/load_frame.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// Two frames as a command line of two thousand.
std::vector<std::string> long_run(const TempFolder& folder, std::vector<std::string> words) {
  EXPECT_EQ(command({"sim", "--sensor", "vlp16", "-n", "2", "-q", "-o", folder.file("road")}).exit_status, 0);
  for (int i = 0; i < 2000; ++i) words.push_back(folder.file("road/frames/00000" + std::to_string(i % 2) + ".pcd"));
  return words;
}

// Of a table that was told on standard output.
CsvTable table_in(const std::string& text) {
  EXPECT_EQ(text.back(), '\n');
  std::istringstream stream(text);
  return CsvTable::parse(stream);  // throws where a row has too few cells
}

TEST(Interrupt, RunLeavesWholeRowsAndWholeClouds) {
  const TempFolder folder;
  const auto words = long_run(folder, {"run", "-q", "--annotate", folder.file("labelled")});
  const Ended ended = interrupted_when_told(words, Stream::kOut, "000001.pcd", folder.file("said"));
  EXPECT_EQ(ended.exit_status, 130);
  EXPECT_TRUE(contains(text_of(folder.file("said")), "interrupted after ")) << text_of(folder.file("said"));
  const CsvTable table = table_in(ended.text);
  EXPECT_LT(table.rows(), 2000U);
  std::size_t clouds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("labelled"))) {
    EXPECT_GT(load_frame(entry.path()).cloud.width, 1000U) << entry.path();
    ++clouds;
  }
  EXPECT_EQ(clouds, table.rows());
}

TEST(Interrupt, LinesOfJsonAreWhole) {
  const TempFolder folder;
  const auto words = long_run(folder, {"run", "-q", "--format", "json"});
  const Ended ended = interrupted_when_told(words, Stream::kOut, "000001.pcd", folder.file("said"));
  EXPECT_EQ(ended.exit_status, 130);
  std::istringstream all(ended.text);
  std::size_t count = 0;
  for (std::string line; std::getline(all, line); ++count) {
    EXPECT_EQ(nlohmann::json::parse(line).at("frame").get<std::size_t>(), count);
  }
  EXPECT_GE(count, 2U);
  EXPECT_LT(count, 2000U);
}

TEST(Interrupt, MotionLeavesWholeRowsAndItsMap) {
  const TempFolder folder;
  const std::string map = folder.file("m.ply");
  const auto words = long_run(folder, {"motion", "-q", "--tum", folder.file("m.tum"), "--map", map});
  const Ended ended = interrupted_when_told(words, Stream::kOut, "000001.pcd", folder.file("said"));
  EXPECT_EQ(ended.exit_status, 130);
  EXPECT_LT(table_in(ended.text).rows(), 2000U);
  EXPECT_TRUE(contains(text_of(map), "end_header\n"));
}

// Runs `pose_wall WORDS...` in a child whose work takes hours, sends it SIGINT once `is_under_way`, and returns its
// exit status; -1 when it ended otherwise.
int interrupted_status(const std::vector<std::string>& words, const std::string& said,
                       const std::function<bool()>& is_under_way) {
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // it would go on without the test
    std::vector<const char*> argv = {"pose_wall"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    if (std::freopen(said.c_str(), "w", stderr) == nullptr) _exit(99);
    const int status = run_command(static_cast<int>(argv.size()), argv.data());
    std::fflush(nullptr);
    _exit(status);
  }
  int status = 0;
  while (!is_under_way()) {
    if (waitpid(child, &status, WNOHANG) == child) return -1;  // it gave up by itself
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  kill(child, SIGINT);
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Interrupt, SimLeavesFramesWithTheirTruth) {
  const TempFolder folder;
  const auto frame = [&](int i) { return folder.file("road/frames/00000" + std::to_string(i) + ".pcd"); };
  EXPECT_EQ(interrupted_status({"sim", "--sensor", "vlp16", "-n", "100000", "-q", "-o", folder.file("road")},
                               folder.file("said"), [&] { return std::filesystem::exists(frame(3)); }),
            130);
  const std::vector<TruthRow> truth = read_truth_csv(folder.file("road/truth.csv"));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("road/frames"))) {
    EXPECT_GT(load_frame(entry.path()).cloud.width, 1000U) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, truth.size());
  EXPECT_GE(files, 4U);
}

TEST(Interrupt, CampaignCanGoOn) {
  const TempFolder folder;
  const std::vector<std::string> words = {
      "campaign", "--scenes", "clean", "--sensors", "vlp16", "--draws", "20000", "-n", "2", "-o", folder.file("card")};
  const auto records = [&] {
    std::size_t count = 0;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("card"), ignored)) {
      count += entry.is_regular_file(ignored) ? 1U : 0U;
    }
    return count;
  };
  EXPECT_EQ(interrupted_status(words, folder.file("said"), [&] { return records() > 3; }), 130);
  EXPECT_TRUE(contains(text_of(folder.file("said")), "the same command continues"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("card"))) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

}  // namespace
}  // namespace pose_wall::tools
