// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points as plain text are read with any separator, with and without names of columns, comments and counts; a
// line that cannot be read is named with what is allowed; a folder's tables are not taken for frames.

#include <gtest/gtest.h>

#include <cmath>

#include "frames/input_list.hpp"
#include "frames/load_frame.hpp"
#include "frames/text_points.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::bytes_of;
using test::contains;
using test::number_at;
using test::refusal;
using test::TempFolder;

Frame read_plain(Bytes bytes) {
  return read_text_points(bytes);
}

double x_of(const Frame& frame, std::uint32_t point) {
  return number_at(frame, frame.cloud.x, point);
}

TEST(TextPoints, SpacesTabsCommasAndSemicolonsSeparate) {
  for (const char* text :
       {"1 2 3\n4 5 6\n", "1\t2\t3\n4\t5\t6", "1,2,3\r\n4,5,6\r\n", "1;2;3\n4;5;6\n", " 1, 2, 3\n\n 4, 5, 6\n",
        "\xEF\xBB\xBF"
        "1 2 3\n4 5 6\n"}) {
    const Frame frame = read_plain(bytes_of(text));
    ASSERT_EQ(frame.cloud.width, 2U) << text;
    EXPECT_EQ(x_of(frame, 1), 4.0) << text;
    EXPECT_EQ(number_at(frame, frame.cloud.z, 0), 3.0) << text;
    EXPECT_EQ(frame.cloud.intensity.type, std::uint32_t{POSE_WALL_FIELD_NONE}) << text;
  }
}

TEST(TextPoints, ColumnsBehindXYZAreIntensityAndTime) {
  const Frame frame = read_plain(bytes_of("1 2 3 0.5 0.01\n4 5 6 0.75 0.02\n"));
  EXPECT_EQ(number_at(frame, frame.cloud.intensity, 1), 0.75);
  EXPECT_EQ(number_at(frame, frame.cloud.time, 1), 0.02);
}

TEST(TextPoints, AFirstLineNamesTheColumns) {
  for (const char* head : {"t,X,Y,Z,r", "\"t\";\"x\";\"y\";\"z\";\"r\"", "// t X Y Z r", "# t x y z r",
                           "t Points_m_XYZ:0 Points_m_XYZ:1 Points_m_XYZ:2 r", "t x[m] y_m z(m) r"}) {
    const Frame frame = read_plain(bytes_of(std::string(head) + "\n9 1 2 3 7\n9 4 5 6 7\n"));
    ASSERT_EQ(frame.cloud.width, 2U) << head;
    EXPECT_EQ(x_of(frame, 1), 4.0) << head;
    EXPECT_EQ(number_at(frame, frame.cloud.time, 0), 9.0) << head;
  }
}

TEST(TextPoints, CommentsAndACountMayStandBeforeThem) {
  const Frame frame = read_plain(bytes_of("# from a scanner\n// in metres\n2\n1 2 3\n% between\n4 5 6\n"));
  EXPECT_EQ(frame.cloud.width, 2U);
  EXPECT_TRUE(contains(refusal(read_plain, "3\n1 2 3\n4 5 6\n"), "declares 3 points, but 2 lines"));
}

TEST(TextPoints, NaNIsADirectionWithoutReturn) {
  const Frame frame = read_plain(bytes_of("nan nan nan\n1 2 3\n"));
  EXPECT_EQ(frame.cloud.width, 2U);
  EXPECT_TRUE(std::isnan(x_of(frame, 0)));
}

TEST(TextPoints, ALineThatCannotBeReadIsNamedWithWhatIsAllowed) {
  const std::pair<const char*, const char*> cases[] = {
      {"1 2 3\n4 five 6\n", "line 2: 'five' is not a number; a line holds x y z, separated by spaces"},
      {"1 2 3\n\n4 5\n", "line 3: 2 values, 3 expected; a line holds x y z"},
      {"x y z i\n1 2 3\n", "line 2: 3 values, 4 expected; a line holds x y z i"},
      {"1 2\n", "line 1: 2 values; x y z [intensity] [time] are allowed, or a first line that names the columns"},
      {"1 2 3 4 5 6 7\n", "line 1: 7 values; x y z [intensity] [time]"},
      {"1,5;2,5;3,5\n", "line 1: commas and semicolons; numbers with a decimal point"},
      {"# nothing 1\n", "there is no line of points"},
      {"x y z x\n1 2 3 4\n", "field 'x' appears twice"},
  };
  for (const auto& [text, part] : cases)
    EXPECT_TRUE(contains(refusal(read_plain, text), part)) << refusal(read_plain, text);
}

TEST(TextPoints, LayoutOptionNamesColumnsWhereTheFileDoesNot) {
  const TempFolder folder;
  BareChoice said;
  said.given = parse_bare_layout("_xyz___");
  const Frame frame = load_frame(folder.write("a.txt", "17 1 2 3 255 0 0\n18 4 5 6 255 0 0\n"), said);
  EXPECT_EQ(x_of(frame, 1), 4.0);
}

TEST(TextPoints, DamageNeverDescribesMoreThanThereIs) {
  EXPECT_TRUE(test::survives_damage(read_plain, "# x y z intensity\n3\n1 2 3 0.5\n4;5;6;0.5\n-7.5e1,8,9,1\n"));
}

TEST(TextPoints, AFolderGivesItsTextOnlyWhereItHasNoOtherFrames) {
  const TempFolder folder;
  const auto names_in = [&folder](const char* name) {
    std::string names;
    for (const auto& file : collect_inputs({folder.file(name)}).files) names += file.filename().string() + " ";
    return names;
  };
  for (const char* name : {"both/1.pcd", "text/notes.txt"}) folder.write(name, "measured on Monday, 3 o'clock\n");
  for (const char* name : {"both/reference.csv", "text/10.xyz", "text/9.xyz"}) folder.write(name, "x y z\n1 2 3\n");
  folder.write("text/truth.csv", "frame,stamp_ns,roll\n0,0,0\n");
  EXPECT_EQ(names_in("both"), "1.pcd ");
  EXPECT_EQ(names_in("text"), "9.xyz 10.xyz ");
}

TEST(RunVerb, ReadsPlainText) {
  const TempFolder folder;
  const test::Ran ran =
      test::command({"run", "-q", "-o", folder.file("o.csv"), folder.write("a.csv", "x,y,z\n1,2,3\n")});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  const CsvTable table = test::table_of(folder.file("o.csv"));
  EXPECT_EQ(table.cell(0, *table.find_column("points_in")), "1");
}

}  // namespace
}  // namespace pose_wall::tools
