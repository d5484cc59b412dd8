// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: run and info take bags: topics are chosen and misspelt, cut bags keep exit status 1, bags of ROS 2 in SQLite
// and folders of rosbag2 are read, and info says what is inside.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_SQLITE
#include <sqlite3.h>
#endif

#include "bag_files.hpp"
#include "io/csv/csv_table.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "ran_command.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

const char* const kClouds = "sensor_msgs/msg/PointCloud2";

CloudMessage cloud(std::uint32_t tenths) {
  CloudMessage message;
  message.nsec = tenths * 100'000'000;
  message.data = std::string(32, '\0');
  return message;
}

std::string two_topics() {
  return mcap({{"/front/points", kClouds}, {"/rear/points", kClouds}},
              {{0, cdr_message(cloud(1))}, {1, cdr_message(cloud(2))}, {0, cdr_message(cloud(3))}}, nullptr);
}

std::string printed(const std::vector<std::string>& words, int exit_status) {
  const Ran ran = command(words);
  EXPECT_EQ(ran.exit_status, exit_status) << ran.errors;
  return ran.printed;
}

TEST(RunVerb, ATopicOfSeveralIsNamed) {
  const TempFolder folder;
  const std::string bag = folder.write("two.mcap", two_topics());
  Ran ran = command({"run", "-q", "-o", folder.file("o.csv"), bag});
  EXPECT_EQ(ran.exit_status, 2);
  EXPECT_TRUE(contains(ran.errors, "/front/points (2 messages), /rear/points (1 message)")) << ran.errors;
  ran = command({"run", "-q", "--topic", "/frnt/points", "-o", folder.file("o.csv"), bag});
  EXPECT_EQ(ran.exit_status, 2);
  EXPECT_TRUE(contains(ran.errors, "did you mean '/front/points'")) << ran.errors;
  ran = command({"run", "-q", "--topic", "/front/points", "-o", folder.file("o.csv"), bag});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  const CsvTable table = table_of(folder.file("o.csv"));
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.cell(1, *table.find_column("source")), bag + "#1");
  EXPECT_EQ(table.cell(1, *table.find_column("stamp_ns")), "1700000000300000000");
  EXPECT_EQ(command({"run", "-q", "--topic", "/x", folder.write("a.bin", "")}).exit_status, 2);
}

TEST(RunVerb, ABagThatWasCutKeepsItsFramesAndEndsWithOne) {
  const TempFolder folder;
  const std::string bag = two_topics();
  const std::string cut = folder.write("cut.mcap", bag.substr(0, bag.find(mcap_record(15, test::raw(0U)))));
  EXPECT_TRUE(test::says(command({"run", "-q", "--topic", "/front/points", "-o", folder.file("o.csv"), cut}), 1,
                         cut + ": offset "));
  const CsvTable table = table_of(folder.file("o.csv"));
  ASSERT_EQ(table.rows(), 3U);
  EXPECT_EQ(table.cell(2, *table.find_column("status")), "unreadable");
}

// As a recording of results alone has it: the topic is there and holds nothing. The table of the last run stays.
TEST(InputVerbs, ATopicWithoutAMessageIsSaidAndCostsNoResults) {
  const TempFolder folder;
  const std::string bag = folder.write("empty.mcap", mcap({{"/lidar/points", kClouds}}, {}, nullptr));
  const std::string kept = folder.write("kept.csv", "of the last run\n");
  const std::string why = "topic /lidar/points holds no message";
  EXPECT_TRUE(test::says(command({"run", "-o", kept, bag}), 1, why));
  EXPECT_EQ(text_of(kept), "of the last run\n");
  EXPECT_TRUE(test::says(command({"doctor", bag}), 1, why));
  const Ran info = command({"info", bag});
  EXPECT_TRUE(test::says(info, 1, why));
  EXPECT_TRUE(contains(info.printed, "/lidar/points")) << "its topics are listed";
}

TEST(RunVerb, OneFrameAloneIsExplained) {
  const TempFolder folder;
  const std::string bag = folder.write("one.mcap", mcap({{"/points", kClouds}}, {{0, cdr_message(cloud(1))}}, nullptr));
  EXPECT_TRUE(contains(command({"run", "-o", folder.file("o.csv"), bag}).errors, "One frame alone"));
  EXPECT_FALSE(
      contains(command({"run", "-s", "motion=off", "-o", folder.file("o.csv"), bag}).errors, "One frame alone"));
}

TEST(RunVerb, ABagWithoutCloudsSaysWhatItHolds) {
  const TempFolder folder;
  const std::string bag = folder.write("a.mcap", mcap({{"/words", "std_msgs/msg/String"}}, {{0, "x"}}, nullptr));
  EXPECT_TRUE(test::says(command({"run", "-q", "-o", folder.file("o.csv"), bag}), 1,
                         "/words (std_msgs/msg/String, 1 message)"));
  EXPECT_TRUE(contains(command({"run", "-q", folder.file("none.bag")}).errors, "no such file"));
}

TEST(InfoVerb, SaysWhatIsInside) {
  const TempFolder folder;
  const std::string bag = folder.write("two.mcap", two_topics());
  const std::string text = printed({"info", bag}, 0);
  for (const char* part : {"MCAP", "2 min, 2 median, 2 max", "5.00 Hz", "100.0 % at zero", "/rear/points", "looked at",
                           "uint16   ring", "2023-11-14 22:13:20"}) {
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  }
  const std::string json = printed({"info", "--json", "--topic", "/rear/points", bag}, 0);
  for (const char* part : {"\"frames\": 1", "\"first_ns\": 1700000000200000000", "\"role\": \"ring\""}) {
    EXPECT_TRUE(contains(json, part)) << part << "\n" << json;
  }
  printed({"info", folder.file("none.mcap")}, 1);
  const std::string frame = folder.write("a.bin", std::string(16, '\0'));
  EXPECT_TRUE(contains(printed({"info", "--topic", "/rear/points", bag, frame}, 0), "a.bin")) << "one is the bag";
  EXPECT_EQ(printed({"info", "--topic", "/rear/points", frame, frame}, 2), "") << "none is";
}

#if POSE_WALL_HAS_SQLITE

std::string points_of(std::uint32_t number) {
  return std::string(3200, static_cast<char>('a' + number));
}

// What rosbag2 writes, by SQLite itself.
void write_sqlite_bag(const std::string& file, std::uint32_t first, std::uint32_t frames) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &db), SQLITE_OK);
  sqlite3_exec(db,
               "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
               "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"
               "CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
               "INSERT INTO topics VALUES(1, '/words', 'std_msgs/msg/String', 'cdr');"
               "INSERT INTO topics VALUES(2, '/points', 'sensor_msgs/msg/PointCloud2', 'cdr');",
               nullptr, nullptr, nullptr);
  for (std::uint32_t i = first; i < first + frames; ++i) {
    CloudMessage message = cloud(i);
    message.width = 200;
    message.data = points_of(i);
    const std::string data = cdr_message(message);
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(db, "INSERT INTO messages(topic_id, timestamp, data) VALUES(2, 5, ?)", -1, &insert, nullptr);
    sqlite3_bind_blob(insert, 1, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(insert), SQLITE_DONE);
    sqlite3_finalize(insert);
  }
  sqlite3_close(db);
}

TEST(SqliteBag, IsReadAloneAndInTheFolderOfItsRecorder) {
  const TempFolder folder;
  folder.write("bag/metadata.yaml",
               "rosbag2_bagfile_information:\n  version: 4\n  relative_file_paths:\n    - b_0.db3\n    - b_1.db3\n");
  write_sqlite_bag(folder.file("bag/b_0.db3"), 0, 2);
  write_sqlite_bag(folder.file("bag/b_1.db3"), 2, 3);
  ASSERT_EQ(command({"run", "-q", "-o", folder.file("o.csv"), folder.file("bag/b_1.db3")}).exit_status, 0);
  EXPECT_EQ(table_of(folder.file("o.csv")).rows(), 3U);
  const Ran ran = command({"run", "-q", "-o", folder.file("o.csv"), folder.file("bag")});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  const CsvTable table = table_of(folder.file("o.csv"));
  ASSERT_EQ(table.rows(), 5U);
  EXPECT_EQ(table.cell(4, *table.find_column("stamp_ns")), "1700000000400000000");
  EXPECT_EQ(table.cell(4, *table.find_column("points_in")), "200");
}

TEST(SqliteBag, CutAnywhereItNeverPassesForWhole) {
  const TempFolder folder;
  write_sqlite_bag(folder.file("b.db3"), 0, 6);
  const std::string whole = test::text_of(folder.file("b.db3"));
  std::uint32_t most = 0;
  for (std::size_t length = 0; length < whole.size(); length += 509) {
    const std::string cut = folder.write("cut.db3", whole.substr(0, length));
    FrameSequence frames({cut});
    std::size_t errors = frames.errors().size();
    std::uint32_t given = 0;
    while (const std::optional<SourcedFrame> frame = frames.next()) {
      if (frame->frame) {
        const pose_wall_cloud& made = frame->frame->cloud;
        ASSERT_EQ(std::string(static_cast<const char*>(made.data), made.data_bytes), points_of(given)) << length;
      }
      if (frame->frame) ++given;
      if (!frame->frame) ++errors;
    }
    EXPECT_GE(errors, 1U) << length;
    most = std::max(most, given);
  }
  EXPECT_GE(most, 3U) << "frames before the cut are given";
}

#endif

TEST(Rosbag2Folder, FaultsOfItsMetadataAreSaid) {
  const TempFolder folder;
  const std::string head = "rosbag2_bagfile_information:\n";
  const auto said = [&](const std::string& rest) {
    folder.write("bag/metadata.yaml", head + rest);
    return command({"run", "-q", "-o", folder.file("o.csv"), folder.file("bag")}).errors;
  };
  EXPECT_TRUE(contains(said("  relative_file_paths: [gone.mcap]\n"), "gone.mcap: no such file"));
  EXPECT_TRUE(contains(said("  relative_file_paths: []\n"), "names no file"));
  EXPECT_TRUE(contains(said("  compression_mode: FILE\n  relative_file_paths: [a.db3]\n"), "compression_mode FILE"));
  EXPECT_TRUE(contains(said("  relative_file_paths: [a\n"), "metadata.yaml:3: "));
}

}  // namespace
}  // namespace pose_wall::tools
