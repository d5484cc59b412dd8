// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: after Ctrl-C what verbs wrote is whole: rows, clouds, pages; and the exit status is the one shells expect.

#include <gtest/gtest.h>
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

#include "command.hpp"
#include "csv/csv_table.hpp"
#include "frames/load_frame.hpp"
#include "frames/whole_file.hpp"
#include "planar_logs.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"
#include "truth/truth_csv.hpp"

namespace pose_wall::tools {
namespace {

using test::command;
using test::contains;
using test::table_of;
using test::TempFolder;
using test::text_of;

// Runs `pose_wall WORDS...` in a child, sends it SIGINT once `is_under_way`, and returns its exit status; -1 when it
// ended otherwise, -2 when it never got under way.
int interrupted_status(const std::vector<std::string>& words, const std::string& said,
                       const std::function<bool()>& is_under_way) {
  const pid_t child = fork();
  if (child == 0) {
    std::vector<const char*> argv = {"pose_wall"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    if (std::freopen(said.c_str(), "w", stderr) == nullptr) _exit(99);
    const int status = run_command(static_cast<int>(argv.size()), argv.data());
    std::fflush(nullptr);
    _exit(status);
  }
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  bool seen = false;
  while (!seen && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    seen = is_under_way();
  }
  kill(child, seen ? SIGINT : SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (!seen) return -2;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Two frames as a command line of two thousand.
std::vector<std::string> long_run(const TempFolder& folder, std::vector<std::string> words) {
  EXPECT_EQ(command({"sim", "--sensor", "vlp16", "-n", "2", "-q", "-o", folder.file("road")}).exit_status, 0);
  for (int i = 0; i < 2000; ++i) words.push_back(folder.file("road/frames/00000" + std::to_string(i % 2) + ".pcd"));
  return words;
}

std::size_t lines_of(const std::string& file) {
  const std::string text = text_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Interrupt, RunLeavesWholeRowsAndWholeClouds) {
  const TempFolder folder;
  const std::string csv = folder.file("o.csv");
  const auto words = long_run(folder, {"run", "-q", "-o", csv, "--annotate", folder.file("labelled")});
  EXPECT_EQ(interrupted_status(words, folder.file("said"), [&] { return lines_of(csv) > 4; }), 130);
  EXPECT_TRUE(contains(text_of(folder.file("said")), "interrupted after ")) << text_of(folder.file("said"));
  EXPECT_EQ(text_of(csv).back(), '\n');
  const CsvTable table = table_of(csv);  // throws where a row has too few cells
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
  const std::string lines = folder.file("o.jsonl");
  const auto words = long_run(folder, {"run", "-q", "--format", "json", "-o", lines});
  EXPECT_EQ(interrupted_status(words, folder.file("said"), [&] { return lines_of(lines) > 4; }), 130);
  std::istringstream all(text_of(lines));
  std::size_t count = 0;
  for (std::string line; std::getline(all, line); ++count) {
    EXPECT_EQ(nlohmann::json::parse(line).at("frame").get<std::size_t>(), count);
  }
  EXPECT_LT(count, 2000U);
}

TEST(Interrupt, MotionLeavesWholeRowsAndItsMap) {
  const TempFolder folder;
  const std::string csv = folder.file("m.csv"), map = folder.file("m.ply");
  const auto words = long_run(folder, {"motion", "-q", "-o", csv, "--tum", folder.file("m.tum"), "--map", map});
  EXPECT_EQ(interrupted_status(words, folder.file("said"), [&] { return lines_of(csv) > 4; }), 130);
  EXPECT_EQ(text_of(csv).back(), '\n');
  const CsvTable table = table_of(csv);  // throws where a row has too few cells
  EXPECT_LT(table.rows(), 2000U);
  EXPECT_TRUE(contains(text_of(map), "end_header\n"));
}

TEST(Interrupt, MapWritesTheScansSoFar) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", test::DrawnRoom::long_log(100'000));
  const std::string part = part_of(folder.file("poses.tum")).string();
  int seen = 0;
  // The part is opened before the scans; some milliseconds later they are under way.
  const auto is_under_way = [&] { return std::filesystem::exists(part) && ++seen > 20; };
  EXPECT_EQ(interrupted_status({"map", "-q", "--poses", folder.file("poses.tum"), "-o", folder.file("map"), log},
                               folder.file("said"), is_under_way),
            130);
  const std::size_t poses = lines_of(folder.file("poses.tum"));
  EXPECT_GT(poses, 0U);
  EXPECT_LT(poses, 100'000U);
  EXPECT_TRUE(
      contains(text_of(folder.file("said")), "interrupted after " + std::to_string(poses) + " of 100000 scans"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("map/map.yaml")));
  EXPECT_FALSE(std::filesystem::exists(part));
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

TEST(Interrupt, ReportShowsWhatWasRead) {
  const TempFolder folder;
  const std::string page = folder.file("o.html");
  const auto words = long_run(folder, {"report", "-o", page});
  // The page's place is taken before the reading begins, with Ctrl-C still the default's for a moment.
  auto reading_at = std::chrono::steady_clock::time_point::max();
  const auto is_reading = [&] {
    const auto now = std::chrono::steady_clock::now();
    if (std::filesystem::exists(part_of(page))) {
      reading_at = std::min(reading_at, now + std::chrono::milliseconds(500));
    }
    return now > reading_at;
  };
  EXPECT_EQ(interrupted_status(words, folder.file("said"), is_reading), 130);
  const std::string text = text_of(page);
  EXPECT_TRUE(contains(text.substr(text.size() - std::min<std::size_t>(text.size(), 20)), "</html>"));
  EXPECT_FALSE(std::filesystem::exists(part_of(page)));
}

TEST(Interrupt, CampaignCanGoOn) {
  const TempFolder folder;
  const std::vector<std::string> words = {
      "campaign", "--scenes", "clean", "--sensors", "vlp16", "--draws", "3000", "-n", "2", "-o", folder.file("card")};
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
