// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: errors against truth are computed as their names say, angles wrapped, and tables that do not fit are refused.

#include "study/truth/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "io/numbers/quantile.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = 3.14159265358979323846;

CsvTable table(const std::string& text) {
  std::istringstream stream(text);
  return CsvTable::parse(stream);
}

TEST(Quantile, NearestRank) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2.0);
  EXPECT_EQ(quantile({3, 1, 2}, 1.0), 3.0);
  EXPECT_EQ(quantile({5}, 0.95), 5.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(ErrorFigures, ByHand) {
  const ErrorFigures figures = error_figures({3.0, -4.0, 1.0});
  EXPECT_EQ(figures.count, 3U);
  EXPECT_DOUBLE_EQ(figures.bias, 0.0);
  EXPECT_DOUBLE_EQ(figures.rmse, std::sqrt(26.0 / 3.0));
  EXPECT_DOUBLE_EQ(figures.absolute_max, 4.0);
  EXPECT_TRUE(std::isnan(error_figures({}).rmse));
}

TEST(WrapAngle, IntoHalfOpenTurn) {
  EXPECT_NEAR(wrap_angle(2 * kPi + 0.1), 0.1, 1e-12);
  EXPECT_NEAR(wrap_angle(-kPi - 0.1), kPi - 0.1, 1e-12);
  EXPECT_GT(wrap_angle(-kPi), 0.0);
}

TEST(ErrorStatistics, CountsWhatItPromises) {
  ErrorStatistics distances(false, 0.10);
  distances.add({1.02, 1.01, 0.01, 0.05, POSE_WALL_VALID}, 1.0);    // fine
  distances.add({1.20, 1.20, 0.01, 0.05, POSE_WALL_VALID}, 1.0);    // beyond everything while valid
  distances.add({1.20, kNaN, 0.01, 0.30, POSE_WALL_HELD}, 1.0);     // held, within its own bound
  distances.add({9.99, kNaN, kNaN, kNaN, POSE_WALL_INVALID}, 1.0);  // says it is invalid
  distances.add({1.0, 1.0, 0.01, 0.05, POSE_WALL_VALID}, kNaN);     // no truth
  EXPECT_EQ(distances.frames(), 4U);
  EXPECT_EQ(distances.measured(), 2U);
  EXPECT_EQ(distances.valid(), 2U);
  EXPECT_EQ(distances.value().count, 3U);
  EXPECT_EQ(distances.raw_beyond_protection(), 1U);
  EXPECT_EQ(distances.value_beyond_protection(), 1U);
  EXPECT_EQ(distances.valid_beyond_alert(), 1U);
  EXPECT_NEAR(distances.mean_z2(), (1.0 + 400.0) / 2.0, 1e-9);
}

TEST(ErrorStatistics, AMissingProtectionLevelProtectsNothing) {
  ErrorStatistics distances(false, 0.10);
  distances.add({1.0, 1.0, 0.01, kNaN, POSE_WALL_VALID}, 1.0);
  EXPECT_EQ(distances.raw_beyond_protection(), 1U);
}

const char* kHead = "frame,stamp_ns,roll,roll_raw,roll_sigma,roll_pl,roll_state\n";

TEST(CompareWithTruth, MatchesByFrameAndWrapsAngles) {
  const CsvTable results = table(std::string(kHead) + "0,0,3.14,3.14,0.01,0.1,valid\n1,5,,,,,\n7,9,1,1,1,1,held\n");
  const CsvTable truth = table("frame,roll\n1,0\n0,-3.14\n2,0\n");
  const Comparison comparison = compare_with_truth(results, truth, {0.02, 0.1});
  EXPECT_EQ(comparison.matched, 2U);
  EXPECT_EQ(comparison.result_rows_alone, 1U);
  EXPECT_EQ(comparison.truth_rows_alone, 1U);
  ASSERT_EQ(comparison.quantities.size(), 1U);
  const ErrorStatistics& roll = comparison.quantities[0].statistics;
  EXPECT_EQ(roll.frames(), 2U);
  EXPECT_EQ(roll.measured(), 1U);
  EXPECT_NEAR(roll.raw().bias, 6.28 - 2 * kPi, 1e-9);
}

// The third frame of the truth measured alone is frame 0 of its results.
TEST(CompareWithTruth, MatchesAPartOfTheFramesByTheirStamps) {
  const CsvTable results = table(std::string(kHead) + "0,25,1.02,1.02,0.01,0.1,valid\n");
  const CsvTable truth = table("frame,stamp_ns,roll\n0,5,0\n1,15,0.5\n2,25,1\n");
  const Comparison comparison = compare_with_truth(results, truth, {0.02, 0.1});
  EXPECT_EQ(comparison.matched_by, "stamp_ns");
  EXPECT_EQ(comparison.matched, 1U);
  EXPECT_EQ(comparison.truth_rows_alone, 2U);
  EXPECT_EQ(comparison.other_stamps, 0U);
  EXPECT_NEAR(comparison.quantities.at(0).statistics.raw().bias, 0.02, 1e-9);
}

// A frame that cannot be read has a guessed stamp, often that of the next frame.
TEST(CompareWithTruth, AnUnreadableRowLeavesTheOthersTheirStamps) {
  const std::string head = "frame,stamp_ns,status,roll,roll_raw,roll_sigma,roll_pl,roll_state\n";
  const CsvTable results =
      table(head + "0,10,valid,1,1,0.01,0.1,valid\n1,20,unreadable,,,,,\n" + "2,20,valid,2,2,0.01,0.1,valid\n");
  const Comparison comparison = compare_with_truth(results, table("frame,stamp_ns,roll\n0,10,1\n1,20,2\n"), {1, 1});
  EXPECT_EQ(comparison.matched_by, "stamp_ns");
  EXPECT_EQ(comparison.matched, 2U);
  EXPECT_EQ(comparison.quantities.at(0).statistics.raw().absolute_max, 0.0);
  EXPECT_EQ(comparison.quantities.at(0).statistics.valid_without_truth(), 0U);
  // A stamp of its own, by the file's name, counts: the frame was there and was not measured.
  const CsvTable named = table(head + "0,10,valid,1,1,0.01,0.1,valid\n1,20,unreadable,,,,,\n");
  const Comparison all = compare_with_truth(named, table("frame,stamp_ns,roll\n0,10,1\n1,20,2\n"), {1, 1});
  EXPECT_EQ(all.quantities.at(0).statistics.frames(), 2U);
  EXPECT_EQ(all.quantities.at(0).statistics.valid(), 1U);
}

TEST(CompareWithTruth, StampsThatTellNothingApartAreLeftForNumbersAndDifferencesAreCounted) {
  const std::string rows = "0,5,1,1,1,1,valid\n1,5,1,1,1,1,valid\n2,9,1,1,1,1,valid\n";
  const CsvTable standing = table(kHead + rows);
  const Comparison same = compare_with_truth(standing, table("frame,stamp_ns,roll\n0,5,0\n1,5,0\n2,9,0\n"), {1, 1});
  EXPECT_EQ(same.matched_by, "frame");
  EXPECT_EQ(same.other_stamps, 0U);
  // A part of a recording whose stamps stand still: nothing tells which, but the stamps tell that it is one.
  const Comparison part = compare_with_truth(standing, table("frame,stamp_ns,roll\n0,1,0\n1,5,0\n2,5,0\n"), {1, 1});
  EXPECT_EQ(part.matched_by, "frame");
  EXPECT_EQ(part.other_stamps, 2U);
  // Frames without stamps have those of --rate: none is in the truth.
  const Comparison none = compare_with_truth(table(std::string(kHead) + "0,0,1,1,1,1,valid\n"),
                                             table("frame,stamp_ns,roll\n0,1700,0\n1,1800,0\n"), {1, 1});
  EXPECT_EQ(none.matched_by, "frame");
  EXPECT_EQ(none.other_stamps, 1U);
}

TEST(CompareWithTruth, TablesThatDoNotFitAreRefused) {
  const std::string row = "0,0,1,1,1,1,valid\n";
  const CsvTable good = table(kHead + row);
  const auto refusal_of = [](const CsvTable& results, const CsvTable& truth) -> std::string {
    return test::said_by<CsvError>([&] { compare_with_truth(results, truth, {1, 1}); });
  };
  const std::pair<std::string, const char*> cases[] = {
      {refusal_of(good, table("frame,yaw\n0,1\n")), "results have no column 'yaw'"},
      {refusal_of(good, table("index,roll\n0,1\n")), "'frame' or 'stamp_ns' in common"},
      {refusal_of(good, table("frame,roll\n4,1\n")), "no row in common"},
      {refusal_of(good, table("frame,speed\n0,1\n")), "none of the columns"},
      {refusal_of(good, table("frame,roll\n0,1\n0,2\n")), "frame 0 twice"},
      {refusal_of(table(std::string(kHead) + "0,0,1,1,1,1,good\n"), table("frame,roll\n0,1\n")), "'good' is no state"},
  };
  for (const auto& [message, part] : cases)
    EXPECT_NE(message.find(part), std::string::npos) << part << " | " << message;
}

}  // namespace
}  // namespace pose_wall::tools
