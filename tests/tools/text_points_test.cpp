// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points as plain text are read with any separator, with and without names of columns, comments and counts; a
// line that cannot be read is named with what is allowed; a folder's tables are not taken for frames.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "io/frames/input_list.hpp"
#include "io/frames/load_frame.hpp"
#include "io/frames/text_points.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

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

// A sensor with 16 rings that turns once: x y z intensity and a fifth value, in the order of measurement.
std::string turn_text(const std::function<double(int step, int ring)>& fifth) {
  std::string text;
  for (int step = 0; step < 360; ++step) {
    for (int ring = 0; ring < 16; ++ring) {
      const double azimuth = step * M_PI / 180.0, elevation = (2 * ring - 15) * M_PI / 180.0;
      text += fmt::format("{:.4f} {:.4f} {:.4f} {} {:g}\n", 5.0 * std::cos(azimuth), 5.0 * std::sin(azimuth),
                          5.0 * std::tan(elevation), (step * 7919 + ring * 104729) % 251, fifth(step, ring));
    }
  }
  return text;
}

// Noise, as intensities are.
double shade(int step, int ring) {
  return static_cast<double>((step * 7907 + ring * 15485863) % 241);
}

TEST(TextPoints, TheFifthColumnIsWhatItsValuesShow) {
  const auto none = std::uint32_t{POSE_WALL_FIELD_NONE};
  for (const double unit_s : {1.0, 1e-3, 1e-6}) {
    const Frame timed = read_plain(
        bytes_of(turn_text([unit_s](int step, int ring) { return (step * 277e-6 + ring * 2e-6) / unit_s; })));
    EXPECT_NE(timed.cloud.time.type, none) << unit_s;
    EXPECT_EQ(timed.cloud.ring.type, none) << unit_s;
  }
  const Frame ringed = read_plain(bytes_of(turn_text([](int, int ring) { return static_cast<double>(ring); })));
  EXPECT_EQ(ringed.cloud.time.type, none);
  EXPECT_EQ(number_at(ringed, ringed.cloud.ring, 17), 1.0);
  EXPECT_EQ(ringed.fields.back().name, "ring");
  const Frame constant = read_plain(bytes_of(turn_text([](int, int) { return 255.0; })));
  EXPECT_EQ(constant.cloud.time.type, none);
  EXPECT_EQ(constant.cloud.ring.type, none);
  for (const double scale : {1.0, 1.0 / 255.0, 257.0}) {
    const std::string said =
        refusal(read_plain, turn_text([scale](int step, int ring) { return scale * shade(step, ring); }));
    EXPECT_TRUE(contains(said, "neither times nor rings; --layout xyzit, --layout xyzir or --layout xyzi_")) << said;
  }
}

TEST(TextPoints, TheFilesOfARecordingAreReadAlikeAndTheChoiceIsSaid) {
  const TempFolder folder;
  const auto ring_of = [](int, int ring) { return static_cast<double>(ring); };
  folder.write("f/0.asc", turn_text(shade));  // does not tell
  folder.write("f/1.asc", turn_text(ring_of));
  folder.write("f/2.asc", turn_text([](int step, int) { return step * 277e-6; }));  // tells otherwise
  FrameSequence frames({folder.file("f")});
  ASSERT_EQ(frames.notes().size(), 1U);
  EXPECT_EQ(frames.notes().front(), folder.file("f/1.asc") +
                                        ": no line names the columns; by their values read as x y z intensity ring. "
                                        "--layout says otherwise");
  EXPECT_NE(frames.next()->frame->cloud.ring.type, std::uint32_t{POSE_WALL_FIELD_NONE});
  EXPECT_NE(frames.next()->frame->cloud.ring.type, std::uint32_t{POSE_WALL_FIELD_NONE});
  EXPECT_TRUE(contains(frames.next()->error, "look like x y z intensity time"));
  InputOptions options;
  options.layout = "xyzi_";
  FrameSequence told({folder.file("f")}, options);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(told.next()->frame->cloud.time.type, std::uint32_t{POSE_WALL_FIELD_NONE});
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
      {"1 2\n",
       "line 1: 2 values; x y z [intensity] [time or ring] are allowed, or a first line that names the columns"},
      {"1 2 3 4 5 6 7\n", "line 1: 7 values; x y z [intensity] [time or ring]"},
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
