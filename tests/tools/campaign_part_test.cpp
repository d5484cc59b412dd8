// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the parts of a campaign have each run once and cost about the same, merged they are to the byte what one run
// leaves, and what is no whole campaign is refused by name. Does not prove: that machines compute the same.

#include "lab/campaign/part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "io/csv/csv_table.hpp"
#include "lab/campaign/plan.hpp"
#include "ran_command.hpp"
#include "support/said_by.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using campaign::make_plan;
using campaign::runs_of_part;
using namespace test;

using Runs = std::vector<campaign::Run>;
using RunName = std::tuple<std::string, std::string, std::uint32_t, std::uint64_t, std::uint32_t>;

RunName name_of(const campaign::Run& run) {
  return {run.scene, run.sensor, run.draw, run.seed, run.frames};
}

std::set<RunName> names_of(const Runs& runs) {
  std::set<RunName> names;
  for (const campaign::Run& run : runs) names.insert(name_of(run));
  return names;
}

TEST(CampaignPart, PartsTogetherHaveEachRunOnceAndAsInOneRun) {
  campaign::PlanRequest request;
  request.size = "medium";
  const Runs all = make_plan(request);
  std::set<RunName> together;
  std::size_t runs = 0;
  for (std::uint32_t number = 1; number <= 16; ++number) {
    const Runs part = runs_of_part(all, {number, 16});
    runs += part.size();
    together.merge(names_of(part));
  }
  EXPECT_EQ(runs, all.size());
  EXPECT_EQ(together, names_of(all));
  EXPECT_EQ(names_of(runs_of_part(all, {1, 1})), names_of(all));
}

// OS0-128 has 131,072 points, VLP-16 28,800.
TEST(CampaignPart, PartsCostAboutTheSame) {
  const std::map<std::string, double> points = {
      {"vlp16", 28800.0}, {"os1-64", 65536.0}, {"os0-128", 131072.0}, {"mid360", 20000.0}};
  campaign::PlanRequest request;
  request.size = "medium";
  const Runs all = make_plan(request);
  double least = 1e300, most = 0.0;
  for (std::uint32_t number = 1; number <= 16; ++number) {
    double cost = 0.0;
    for (const campaign::Run& run : runs_of_part(all, {number, 16})) cost += run.frames * points.at(run.sensor);
    least = std::min(least, cost);
    most = std::max(most, cost);
  }
  EXPECT_LT(most, 1.05 * least);
}

std::string refusal_of(const std::string& text) {
  return test::said_by<std::invalid_argument>([&] { campaign::parse_part(text); });
}

TEST(CampaignPart, WhatIsNoPartIsRefusedWithWhatIsAllowed) {
  EXPECT_EQ(refusal_of("3/16"), "");
  EXPECT_EQ(refusal_of("1/1"), "");
  EXPECT_EQ(refusal_of("0/16"), "--part: '0/16' is refused; allowed are 1/16 to 16/16");
  EXPECT_EQ(refusal_of("17/16"), "--part: '17/16' is refused; allowed are 1/16 to 16/16");
  EXPECT_EQ(refusal_of("1/0"), "--part: '1/0' is refused; allowed are 1 to 10000 parts");
  for (const char* text : {"3", "", "/", "3/", "/16", "a/16", "3/16x", "-1/16", "3/16/2", "3 / 16", "1.5/2"}) {
    EXPECT_TRUE(contains(refusal_of(text), "allowed is NUMBER/PARTS, such as 3/16")) << text;
  }
}

TEST(CampaignPart, MorePartsThanRunsAreRefused) {
  campaign::PlanRequest request;
  request.scenes = {"clean", "rough"};
  const Runs all = make_plan(request);
  EXPECT_EQ(runs_of_part(all, {2, 2}).size(), 1U);
  EXPECT_THROW(runs_of_part(all, {1, 3}), std::invalid_argument);
}

// Two scenes, one with an event, two sensors, two draws of a few frames: eight runs.
Ran campaign_with(const std::string& output, std::vector<std::string> more) {
  more.insert(more.begin(), {"campaign", "--scenes", "clean,partial", "--sensors", "vlp16,mid360", "--draws", "2",
                             "--frames", "3", "--quiet", "--output", output});
  return test::command(more);
}

Ran merge(const std::vector<std::string>& folders, const std::string& output,
          const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"campaign", "--merge"};
  words.insert(words.end(), folders.begin(), folders.end());
  words.insert(words.end(), {"--output", output, "--quiet"});
  words.insert(words.end(), more.begin(), more.end());
  return test::command(words);
}

std::map<std::string, std::string> files_in(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[std::filesystem::relative(entry.path(), folder).string()] = text_of(entry.path().string());
  }
  return files;
}

// The parts of three, measured once; each test gets copies that it may spoil.
class ThreeParts : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    measured_ = std::make_unique<TempFolder>();
    for (const char* number : {"1", "2", "3"}) {
      const std::string folder = measured_->file(std::string("part") + number);
      EXPECT_EQ(campaign_with(folder, {"--part", std::string(number) + "/3"}).exit_status, 0);
    }
  }
  static void TearDownTestSuite() { measured_.reset(); }

  ThreeParts() { std::filesystem::copy(measured_->path(), folder_.path(), std::filesystem::copy_options::recursive); }

  std::string part_folder(int number) const { return folder_.file("part" + std::to_string(number)); }
  std::string output() const { return folder_.file("whole"); }
  Ran merge_all() const { return merge({part_folder(1), part_folder(2), part_folder(3)}, output()); }

  void expect_refused(const Ran& ran, const std::string& message) const {
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_TRUE(contains(ran.errors, message)) << ran.errors;
    EXPECT_FALSE(std::filesystem::exists(output() + "/card.md"));
  }

  static std::unique_ptr<TempFolder> measured_;
  TempFolder folder_;
};

std::unique_ptr<TempFolder> ThreeParts::measured_;

TEST_F(ThreeParts, MergedAreToTheByteWhatOneRunLeaves) {
  const TempFolder one;
  ASSERT_EQ(campaign_with(one.path(), {}).exit_status, 0);
  ASSERT_EQ(merge({part_folder(3), part_folder(1), part_folder(2)}, output()).exit_status, 0);
  const auto expected = files_in(one.path());
  EXPECT_EQ(expected.size(), 6U + 1U + 8U) << "card, diagrams, curve, frames, campaign.json, eight records";
  EXPECT_EQ(files_in(output()), expected);
  ASSERT_EQ(merge_all().exit_status, 0) << "once more, over what is there";
  EXPECT_EQ(files_in(output()), expected);
}

TEST_F(ThreeParts, APartHasNoCardAndContinues) {
  EXPECT_FALSE(std::filesystem::exists(part_folder(1) + "/card.md"));
  const auto before = files_in(part_folder(1));
  std::filesystem::remove(part_folder(1) + "/" + std::prev(before.end())->first);
  EXPECT_TRUE(contains(merge_all().errors, part_folder(1) + ": part 1/3 is not finished: "));
  EXPECT_EQ(campaign_with(part_folder(1), {"--part", "1/3"}).exit_status, 0);
  EXPECT_EQ(files_in(part_folder(1)), before);
}

TEST_F(ThreeParts, AMissingPartIsNamed) {
  expect_refused(merge({part_folder(1), part_folder(3)}, output()), "--merge has 2 parts of 3; missing are 2/3");
  expect_refused(merge({part_folder(1)}, output()), "missing are 2/3, 3/3");
}

TEST_F(ThreeParts, APartGivenTwiceIsNamed) {
  std::filesystem::copy(part_folder(2), folder_.file("copy"), std::filesystem::copy_options::recursive);
  expect_refused(merge({part_folder(1), part_folder(2), folder_.file("copy"), part_folder(3)}, output()),
                 folder_.file("copy") + ": part 2/3 is in " + part_folder(2) + " already; each part is allowed once");
}

TEST_F(ThreeParts, PartsOfOtherCampaignsAreNamedWithWhatDiffers) {
  const std::string other = folder_.file("other");
  const auto refused_with = [&](const std::vector<std::string>& more, const std::string& message) {
    std::vector<std::string> words = {"--part", "2/3", "--fresh"};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(campaign_with(other, words).exit_status, 0);
    const Ran ran = merge({part_folder(1), other, part_folder(3)}, output());
    expect_refused(ran, message);
    EXPECT_TRUE(contains(ran.errors, other + ": a part of another campaign than " + part_folder(1))) << ran.errors;
  };
  refused_with({"--seed", "2"}, "seed: " + part_folder(1) + " has 1, " + other + " has 2");
  refused_with({"--kind", "nominal"}, "kind: " + part_folder(1) + " has all, " + other + " has nominal");
  refused_with({"--set", "integrity_risk=1e-4"}, other + " has 'integrity_risk=0.0001'");
}

TEST_F(ThreeParts, ADivisionIntoOthersPartsIsRefused) {
  ASSERT_EQ(campaign_with(folder_.file("half"), {"--part", "2/2"}).exit_status, 0);
  expect_refused(merge({part_folder(1), folder_.file("half")}, output()),
                 "has 1 of 3, " + folder_.file("half") + " has 1 of 2");
}

TEST_F(ThreeParts, AnotherProgramsPartIsRefused) {
  const std::string file = part_folder(2) + "/campaign.json";
  std::string text = text_of(file);
  const std::string key = "\"program\": \"";
  text.replace(text.find(key) + key.size(), 4, "????");
  std::ofstream(file) << text;
  expect_refused(merge_all(), "program: another build of pose_wall made the records");
  std::ofstream(file) << "{}";
  expect_refused(merge_all(), part_folder(2) + ": no campaign was run there");
}

TEST_F(ThreeParts, FoldersWithoutPartsAreRefused) {
  expect_refused(merge({part_folder(1), folder_.file("nothing")}, output()),
                 folder_.file("nothing") + ": no campaign was run there; allowed are folders that");
  const TempFolder whole;
  ASSERT_EQ(campaign_with(whole.path(), {}).exit_status, 0);
  expect_refused(merge({whole.path()}, output()), whole.path() + ": holds a whole campaign; allowed are parts");
  EXPECT_TRUE(test::says(merge({part_folder(1), part_folder(2), part_folder(3)}, part_folder(2)), 2,
                         "--output is a part itself"));
}

TEST_F(ThreeParts, AFolderKeepsToItsPart) {
  EXPECT_TRUE(test::says(campaign_with(part_folder(1), {"--part", "2/3"}), 2,
                         "part: the records have part 1/3, this campaign has part 2/3"));
  const Ran whole = campaign_with(part_folder(1), {});
  EXPECT_TRUE(contains(whole.errors, "part: the records have part 1/3, this campaign has all runs")) << whole.errors;
  EXPECT_TRUE(test::says(test::command({"campaign", "--card-only", "--output", part_folder(1)}), 2,
                         "holds part 1/3 of a campaign"));
}

TEST(CampaignPart, OptionsThatNeedAllRunsAreRefused) {
  const TempFolder folder;
  for (const char* option : {"--gate", "--events=3"}) {
    EXPECT_TRUE(test::says(campaign_with(folder.path(), {"--part", "1/2", option}), 2,
                           "--part makes no card: " + std::string(option).substr(0, 6)));
  }
  EXPECT_TRUE(test::says(merge({folder.path()}, folder.file("whole"), {"--seed", "1"}), 2,
                         "--merge takes the records of the parts as they are: --seed"));
}

TEST(CampaignPart, TheMergedCardMeetsTheGateAsOneRunDoes) {
  const TempFolder one, part, whole;
  const std::vector<std::string> wrong = {"--set", "alert_limit_angle_deg=0.01"};
  std::vector<std::string> gate = wrong, first = wrong;
  gate.emplace_back("--gate");
  first.insert(first.end(), {"--part", "1/1"});
  const Ran at_once = campaign_with(one.path(), gate);
  ASSERT_EQ(at_once.exit_status, 3) << "nothing is valid";
  ASSERT_EQ(campaign_with(part.path(), first).exit_status, 0);
  const Ran merged = merge({part.path()}, whole.path(), {"--gate"});
  EXPECT_EQ(merged.exit_status, 3);
  EXPECT_EQ(merged.errors, at_once.errors);
}

// Times differ from run to run.
std::string without_times(const std::string& file) {
  const CsvTable table = test::table_of(file);
  std::string text;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t column = 0; column < table.head().size(); ++column) {
      if (table.head()[column] != "total_ms") text += table.cell(row, column) + ",";
    }
  }
  return text;
}

TEST(CampaignPart, MotionIsMergedTheSameWay) {
  const TempFolder folder;
  const auto motion_with = [](const std::string& output, std::vector<std::string> more) {
    more.insert(more.begin(), {"campaign", "--motion", "--scenes", "rough,distorted", "--sensors", "vlp16", "--frames",
                               "4", "--quiet", "--output", output});
    return test::command(more).exit_status;
  };
  ASSERT_EQ(motion_with(folder.file("one"), {}), 0);
  ASSERT_EQ(motion_with(folder.file("a"), {"--part", "1/2"}), 0);
  ASSERT_EQ(motion_with(folder.file("b"), {"--part", "2/2"}), 0);
  ASSERT_EQ(merge({folder.file("a"), folder.file("b")}, folder.file("whole")).exit_status, 0);
  for (const char* scene : {"rough", "distorted"}) {
    const std::string record = std::string("/records/") + scene + "/vlp16/000000.csv";
    EXPECT_EQ(without_times(folder.file("whole") + record), without_times(folder.file("one") + record)) << scene;
  }
  EXPECT_EQ(text_of(folder.file("whole/campaign.json")), text_of(folder.file("one/campaign.json")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("whole/card.md")));
}

}  // namespace
}  // namespace pose_wall::tools
