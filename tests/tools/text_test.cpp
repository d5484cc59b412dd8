// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: words, tables and CSV cells come out as a reader expects them.

#include <gtest/gtest.h>

#include <sstream>

#include "io/csv/csv_table.hpp"
#include "io/terminal/did_you_mean.hpp"
#include "io/terminal/text_table.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

TEST(DidYouMean, DistanceCountsSwapsAsOne) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("run", "rnu"), 1U);
  EXPECT_EQ(edit_distance("voxel", "vxoell"), 2U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(DidYouMean, NearestWordWithinReach) {
  const std::vector<std::string> known = {"run", "eval", "check-config"};
  EXPECT_EQ(nearest_word("rum", known), "run");
  EXPECT_EQ(nearest_word("chekc-confg", known), "check-config");
  EXPECT_EQ(nearest_word("elephant", known), "");
  EXPECT_EQ(nearest_word("x", known), "");
  EXPECT_EQ(did_you_mean("evla", known), "; did you mean 'eval'?");
}

TEST(TextTable, ColumnsAreAsWideAsTheirWidestCellInCharacters) {
  TextTable table({"", "angle"});
  table.add_row({"roll", "1.5°"});
  table.add_row({"d", "123456789"});
  EXPECT_EQ(table.text(), "          angle\n----  ---------\nroll       1.5°\nd     123456789\n");
}

TEST(TextTable, WrappedTextKeepsItsWords) {
  EXPECT_EQ(wrapped("one two three", 2, 7), "  one two\n  three\n");
  EXPECT_EQ(wrapped("", 2, 7), "");
}

TEST(Csv, CellsAreQuotedWhereNeededAndReadBack) {
  const std::vector<std::string> cells = {"plain", "a,b", "say \"x\"", "two\nlines", ""};
  std::istringstream stream("a,b,c,d,e\r\n" + csv_line(cells));
  const CsvTable table = CsvTable::parse(stream);
  ASSERT_EQ(table.rows(), 1U);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(table.cell(0, i), cells[i]);
}

TEST(Csv, NumbersHaveNineDigitsAndNothingForNan) {
  EXPECT_EQ(csv_number(0.123456789123), "0.123456789");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()), "");
}

std::string refusal_of(const std::string& text) {
  std::istringstream stream(text);
  return test::said_by<CsvError>([&] {
    const CsvTable table = CsvTable::parse(stream);
    table.number(0, 0);
  });
}

TEST(Csv, BadTablesNameLineAndColumn) {
  EXPECT_EQ(refusal_of("# comment\nframe\n7\n"), "");
  EXPECT_EQ(refusal_of("# comment\n"), "no line with column names");
  EXPECT_EQ(refusal_of("a,b\n1,2\n3\n"), "line 3: 1 cells, the head has 2 columns");
  EXPECT_EQ(refusal_of("a,a\n1,2\n"), "column 'a' appears twice");
  EXPECT_EQ(refusal_of("{\"reasons\":[],\"reasons\":[]}\n"),
            "line 1: this is JSON; a table of CSV is allowed, as run writes it without --format json");
  EXPECT_EQ(refusal_of("a\n\"1\n2\n"), "line 2: a quote is not closed");
  EXPECT_EQ(refusal_of("a\nseven\n"), "line 2, column a: 'seven' is not a number");
}

}  // namespace
}  // namespace pose_wall::tools
