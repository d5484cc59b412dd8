// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a campaign leaves the same records however many runs go on at a time, goes on where it was interrupted, and
// does not mix records of different settings. Does not prove: that the measured values are right.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "io/frames/whole_file.hpp"
#include "lab/campaign/folder.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// Two scenes, one with an event, one sensor, two draws of a few frames.
Ran campaign_in(const std::string& folder, const std::vector<std::string>& more = {}) {
  return test::command({"campaign", "--output", folder, "--scenes", "clean,partial", "--sensors", "vlp16", "--draws",
                        "2", "--frames", "4", "--quiet"},
                       more);
}

void expect_same(const TempFolder& a, const TempFolder& b) {
  for (const char* name : {"campaign.json", "frames.csv", "card.md", "card.json", "level_curve.csv",
                           "stanford_angles.svg", "stanford_distances.svg", "records/clean/vlp16/000001.csv"}) {
    const std::string text = text_of(a.file(name));
    EXPECT_FALSE(text.empty()) << name;
    EXPECT_EQ(text, text_of(b.file(name))) << name;
  }
}

TEST(Campaign, TwoJobsLeaveTheSameRecordsAsOne) {
  const TempFolder one;
  const TempFolder two;
  EXPECT_EQ(campaign_in(one.path(), {"--jobs", "1"}).exit_status, 0);
  EXPECT_EQ(campaign_in(two.path(), {"--jobs", "2"}).exit_status, 0);
  expect_same(one, two);
}

TEST(Campaign, GoesOnWhereItWasInterrupted) {
  const TempFolder whole;
  const TempFolder interrupted;
  ASSERT_EQ(campaign_in(whole.path()).exit_status, 0);
  ASSERT_EQ(campaign_in(interrupted.path()).exit_status, 0);
  std::filesystem::remove(interrupted.file("records/clean/vlp16/000001.csv"));
  std::filesystem::remove(interrupted.file("card.json"));
  interrupted.write(part_of("records/partial/vlp16/000000.csv"), "half a rec");
  const std::string kept = interrupted.file("records/clean/vlp16/000000.csv");
  const auto kept_since = std::filesystem::last_write_time(kept);
  EXPECT_EQ(campaign_in(interrupted.path()).exit_status, 0);
  EXPECT_EQ(std::filesystem::last_write_time(kept), kept_since);
  expect_same(whole, interrupted);
}

TEST(Campaign, AnInterruptKeepsWhatIsDoneAndSaysHowToGoOn) {
  const TempFolder folder;
  std::thread impatient([&folder] {
    const auto is_there = [&] { return std::filesystem::exists(folder.file("records/clean/vlp16/000000.csv")); };
    while (!is_there()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::raise(SIGINT);
  });
  const Ran ran = test::command({"campaign", "--output", folder.path(), "--scenes", "clean", "--sensors", "vlp16",
                                 "--draws", "500", "--frames", "10", "--quiet"});
  impatient.join();
  EXPECT_EQ(ran.exit_status, 130);
  const std::ptrdiff_t done = std::count_if(std::filesystem::directory_iterator(folder.file("records/clean/vlp16")),
                                            std::filesystem::directory_iterator(),
                                            [](const auto& entry) { return entry.path().extension() == ".csv"; });
  EXPECT_GE(done, 1);
  EXPECT_EQ(ran.errors, "interrupted: " + std::to_string(done) + " of 500 runs are done; the same command continues\n");
}

TEST(Campaign, RefusesRecordsOfOtherSettingsUnlessToldToRemoveThem) {
  const TempFolder folder;
  ASSERT_EQ(campaign_in(folder.path()).exit_status, 0);
  const std::string frames = text_of(folder.file("frames.csv"));
  const Ran other = campaign_in(folder.path(), {"--set", "integrity_risk=1e-9"});
  EXPECT_EQ(other.exit_status, 2);
  EXPECT_NE(other.errors.find("settings: the records have 'defaults', this campaign has 'integrity_risk=1e-09'"),
            std::string::npos)
      << other.errors;
  EXPECT_NE(other.errors.find("--fresh"), std::string::npos);
  EXPECT_TRUE(test::says(campaign_in(folder.path(), {"--seed", "9"}), 2,
                         "\n  seed: the records have 1, this campaign has 9\n--fresh"));
  EXPECT_EQ(text_of(folder.file("frames.csv")), frames);
  EXPECT_EQ(campaign_in(folder.path(), {"--set", "integrity_risk=1e-9", "--fresh"}).exit_status, 0);
  EXPECT_NE(text_of(folder.file("frames.csv")), frames);
}

TEST(Campaign, FreshRemovesNothingThatIsNoCampaigns) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.file("records"));
  std::ofstream(folder.file("records/mine.txt")) << "precious";
  EXPECT_EQ(campaign_in(folder.path(), {"--fresh"}).exit_status, 1);
  EXPECT_TRUE(std::filesystem::exists(folder.file("records/mine.txt")));
}

TEST(Campaign, FreshRemovesWhatAnOlderVersionLeft) {
  const TempFolder folder;
  ASSERT_EQ(campaign_in(folder.path()).exit_status, 0);
  std::ofstream(folder.file("campaign.json")) << R"({"identity": {"version": "0.0.1", "program": "1"}, "runs": 4})";
  EXPECT_TRUE(test::says(campaign_in(folder.path()), 1, "another folder is needed, or --fresh"));
  EXPECT_EQ(campaign_in(folder.path(), {"--fresh"}).exit_status, 0);
}

TEST(Campaign, BlanksBesideTheCommasOfNamesDoNotMatter) {
  const TempFolder folder;
  const auto run = [&folder](const std::string& scenes, const std::string& sensors) {
    return test::command({"campaign", "--output", folder.path(), "--scenes", scenes, "--sensors", sensors, "--draws",
                          "1", "--frames", "1", "--quiet"});
  };
  EXPECT_EQ(run("clean, partial", " vlp16 ,mid360").exit_status, 0);
  EXPECT_EQ(run("clean,partial", "vlp16,mid360").exit_status, 0) << "the same campaign";
  const Ran wrong = run("clean, partail", "vlp16");
  EXPECT_EQ(wrong.exit_status, 2);
  EXPECT_NE(wrong.errors.find("'partail'; did you mean 'partial'?"), std::string::npos) << wrong.errors;
}

// Every run would read it, and find it empty.
TEST(Campaign, SettingsThatCanBeReadOnceOnlyAreRefused) {
  const TempFolder folder;
  const Ran ran = test::command({"campaign", "-q", "-c", "/dev/null", "-o", folder.file("card")});
  EXPECT_EQ(ran.exit_status, 2);
  EXPECT_TRUE(test::contains(ran.errors, "--config /dev/null: not a regular file")) << ran.errors;
}

TEST(Campaign, AFileInTheWayOfTheFolderIsNamed) {
  const TempFolder folder;
  const std::string file = folder.write("mine.txt", "precious");
  for (const std::string& output : {file, file + "/card/deep"}) {
    const Ran ran = campaign_in(output);
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_NE(ran.errors.find("--output " + output + ": " + file + " is a file; allowed is a folder"),
              std::string::npos)
        << ran.errors;
  }
  EXPECT_EQ(test::command({"sim", "--output", file}).exit_status, 2);
  EXPECT_EQ(text_of(file), "precious");
}

TEST(Campaign, RefusesARecordThatCameFromElsewhere) {
  const TempFolder folder;
  const TempFolder other;
  ASSERT_EQ(campaign_in(folder.path()).exit_status, 0);
  ASSERT_EQ(campaign_in(other.path(), {"--set", "integrity_risk=1e-9"}).exit_status, 0);
  const char* record = "records/clean/vlp16/000001.csv";
  folder.write(record, text_of(other.file(record)));
  EXPECT_TRUE(test::says(campaign_in(folder.path()), 1, "000001.csv: a record of another campaign"));
}

TEST(Campaign, MakesTheCardAnewFromRecords) {
  const TempFolder folder;
  ASSERT_EQ(campaign_in(folder.path()).exit_status, 0);
  const std::string card = text_of(folder.file("card.md"));
  std::filesystem::remove(folder.file("card.md"));
  const auto card_only = [](const std::string& path, std::vector<std::string> more) {
    more.insert(more.begin(), {"campaign", "--card-only", "--quiet", "--output", path});
    return test::command(more);
  };
  EXPECT_EQ(card_only(folder.path(), {}).exit_status, 0);
  EXPECT_EQ(text_of(folder.file("card.md")), card);
  EXPECT_EQ(card_only(folder.file("nothing"), {}).exit_status, 1);
  EXPECT_TRUE(test::says(card_only(folder.path(), {"--draws", "9", "-n", "3", "--fresh", "--gate"}), 2,
                         "--draws, --frames, --fresh cannot go with it"));
  EXPECT_EQ(text_of(folder.file("card.md")), card);
}

TEST(Campaign, GateFailsOnADoctoredRecord) {
  const TempFolder folder;
  ASSERT_EQ(campaign_in(folder.path()).exit_status, 0);
  const campaign::Manifest manifest = campaign::read_manifest(folder.path());
  std::vector<campaign::RunRecord> records = campaign::read_records(folder.path(), manifest);
  campaign::QuantityRecord& yaw = records[0].frames[3].quantity[POSE_WALL_YAW];
  yaw.truth += 0.5;
  yaw.surveyed += 0.5;
  yaw.measured.state = POSE_WALL_VALID;
  campaign::write_record(campaign::record_file(folder.path(), records[0].run), records[0], manifest.fingerprint());
  EXPECT_TRUE(test::says(campaign_in(folder.path(), {"--gate"}), 3, "misleading frames: 1 of 16"));
}

TEST(Campaign, RecordsSurviveTheirFile) {
  const TempFolder folder;
  ASSERT_EQ(campaign_in(folder.path()).exit_status, 0);
  const std::string text = text_of(folder.file("records/partial/vlp16/000000.csv"));
  const campaign::Manifest manifest = campaign::read_manifest(folder.path());
  const auto record = campaign::read_record(folder.file("records/partial/vlp16/000000.csv"), manifest.fingerprint());
  EXPECT_EQ(record.frames.size(), 4U);
  campaign::write_record(folder.file("again.csv"), record, manifest.fingerprint());
  EXPECT_EQ(text_of(folder.file("again.csv")), text);
}

}  // namespace
}  // namespace pose_wall::tools
