// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a level is made of is told alike by CSV, JSON, explain, the page of report and the closing table; parts
// add up to their level, as figures too; the cause is the largest; old tables are still read. Does not prove: that the
// engine splits its levels rightly, see the tests of the engine.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "crafted_value.hpp"
#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"
#include "pose_wall.hpp"
#include "ran_command.hpp"
#include "study/explain/level_words.hpp"
#include "study/explain/outcome_words.hpp"
#include "study/results/run_summary.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using explain::level_sum;
using namespace test;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Parts degrees_of(Parts parts) {
  for (double& part : parts) part *= kRadPerDeg;
  return parts;
}

// By pose_wall_part: random, range bias, bend, rival, extrapolation, lag, age.
const Parts kYawParts = degrees_of({0.64, 0.90, 0.0, 2.10, 0.0, 0.0, 0.0});

TEST(LevelSum, LargestFirstInTheUnitOfTheQuantity) {
  const pose_wall_value yaw = crafted_value(POSE_WALL_DEGRADED, 0.2, 0.2, kYawParts);
  EXPECT_EQ(level_sum(yaw, POSE_WALL_YAW), "3.64° = 2.10° rival + 0.90° range bias + 0.64° random; lag 0");
  const pose_wall_value near = crafted_value(POSE_WALL_VALID, 2.0, 2.0, {0.012, 0.03, 0.0, 0.0, 0.001, 0.004, 0.0});
  EXPECT_EQ(level_sum(near, POSE_WALL_D_LF),
            "0.047 m = 0.030 m range bias + 0.012 m random + 0.004 m lag + 0.001 m extrapolation");
  const pose_wall_value held = crafted_value(POSE_WALL_HELD, 2.0, kNone, {0.01, 0.05, 0.0, 0.0, 0.0, 0.0, 0.2});
  EXPECT_EQ(level_sum(held, POSE_WALL_D_RB), "0.26 m = 0.20 m age + 0.05 m range bias + 0.01 m random")
      << "of what is held nobody asks whether it lags";
}

TEST(LevelSum, IsEmptyWhereThereIsNoLevel) {
  EXPECT_EQ(level_sum(unmeasured_value(), POSE_WALL_YAW), "");
  pose_wall_value unbounded = crafted_value(POSE_WALL_DEGRADED, 0.2, 0.2, kYawParts);
  unbounded.protection_level = std::numeric_limits<double>::infinity();
  EXPECT_EQ(level_sum(unbounded, POSE_WALL_YAW), "");
  unbounded.protection_level = 1e300;
  EXPECT_EQ(level_sum(unbounded, POSE_WALL_YAW), "");
}

// The figures of a sum, as whole numbers of the last digit.
std::vector<long> figures_of(const std::string& sum) {
  std::vector<long> figures;
  std::string digits;
  for (const char c : sum.substr(0, sum.find(';')) + " ") {
    if ((c >= '0' && c <= '9') || c == '.') {
      if (c != '.') digits += c;
    } else if (!digits.empty()) {
      figures.push_back(std::stol(digits));
      digits.clear();
    }
  }
  return figures;
}

TEST(LevelSum, FiguresAddUpAsTheyStand) {
  std::mt19937 random(7);
  for (std::uint32_t round = 0; round < 2000; ++round) {
    Parts parts{};
    for (double& part : parts)
      part =
          random() % 3 == 0 ? 0.0 : std::ldexp(static_cast<double>(random() % 1000), -10 - static_cast<int>(round % 9));
    const std::uint32_t quantity = round % POSE_WALL_QUANTITIES;
    const std::string sum = level_sum(crafted_value(POSE_WALL_VALID, 1.0, 1.0, parts), quantity);
    const std::vector<long> figures = figures_of(sum);
    ASSERT_FALSE(figures.empty()) << sum;
    long total = 0;
    for (std::size_t i = 1; i < figures.size(); ++i) {
      total += figures[i];
      EXPECT_GT(figures[i], 0) << "what rounds to nothing is left out: " << sum;
      // Of two parts that differ by less than a digit either may have been rounded up.
      EXPECT_LE(figures[i], i > 1 ? figures[i - 1] + 1 : figures[0]) << sum;
    }
    EXPECT_EQ(total, figures.size() > 1 ? figures[0] : 0) << sum;
  }
}

// What explain says of a crafted frame.
std::string said_of(const pose_wall_value& value, std::uint32_t quantity) {
  pose_wall_result result = api::make_result();
  result.quantity[quantity] = value;
  const pose_wall_trace trace{};
  return explain::outcome_sentence(result, explain::Notes(trace), quantity);
}

TEST(OutcomeSentence, TellsWhatTheLevelIsMadeOf) {
  const double raw = 12.3 * kRadPerDeg;
  EXPECT_EQ(said_of(crafted_value(POSE_WALL_DEGRADED, raw, raw, kYawParts), POSE_WALL_YAW),
            "yaw: degraded, 12.30°, error at most 3.64°. Its level: 3.64° = 2.10° rival + 0.90° range bias + 0.64° "
            "random; lag 0.");
}

TEST(OutcomeSentence, TellsTheRawsOwnLevelWhereItDiffers) {
  EXPECT_EQ(said_of(crafted_value(POSE_WALL_VALID, 2.0, 2.02, {0.05, 0.06, 0.0, 0.0, 0.0, 0.02, 0.0}), POSE_WALL_D_LF),
            "d_lf: valid, 2.00 m, error at most 0.13 m. Its level: 0.13 m = 0.06 m range bias + 0.05 m random + 0.02 m "
            "lag. This "
            "frame alone measured 2.02 m ± 0.11 m.");
}

TEST(OutcomeSentence, NamesTheLagWhereItIsTheLargestPart) {
  const Parts parts = degrees_of({0.1, 0.1, 0.1, 0.1, 0.1, 0.12, 0.0});
  EXPECT_EQ(said_of(crafted_value(POSE_WALL_VALID, 0.0, 0.12 * kRadPerDeg, parts), POSE_WALL_YAW),
            "yaw: valid, 0.00°, error at most 0.62°. Its level: 0.62° = 0.12° lag + 0.10° random + 0.10° range bias + "
            "0.10° bend + "
            "0.10° rival + 0.10° extrapolation. This frame alone measured 0.12° ± 0.50°: the value follows earlier "
            "frames (temporal_smoothing_tau, yaw_rate_limit_deg).");
}

TEST(OutcomeSentence, OfWhatWasNeverMeasuredThereIsNoLevel) {
  EXPECT_EQ(said_of(unmeasured_value(), POSE_WALL_YAW), "yaw: invalid. Not measured.");
}

TEST(ClosingTable, TellsSignsAndMedianParts) {
  RunSummary summary;
  for (const double rival_deg : {1.0, 2.0, 9.0}) {
    FrameOutcome outcome;
    outcome.result = api::make_result();
    outcome.result->positive_means[POSE_WALL_ROLL] = POSE_WALL_SENSE_LEFT_DOWN;
    for (pose_wall_value& value : outcome.result->quantity) value = unmeasured_value();
    outcome.result->quantity[POSE_WALL_YAW] =
        crafted_value(POSE_WALL_VALID, 0.1, 0.1, degrees_of({1.5, 0.0, 0.0, rival_deg, 0.0, 0.25, 0.0}));
    summary.add(outcome);
  }
  const std::string text = summary.text(1.0);
  EXPECT_TRUE(contains(text, "\nroll (+ left side down)")) << text;
  EXPECT_TRUE(contains(text, "\npitch ")) << "an unknown sign is not made up: " << text;
  const std::size_t at = text.rfind("median level");
  ASSERT_NE(at, std::string::npos) << text;
  const std::string levels = text.substr(at);
  const std::string head = levels.substr(0, levels.find('\n'));
  EXPECT_TRUE(contains(head, "random") && contains(head, "rival") && contains(head, "lag")) << head;
  EXPECT_FALSE(contains(head, "bend")) << "what no level has has no column";
  std::istringstream words(levels.substr(levels.find("\nyaw ")));
  std::vector<std::string> row(9);
  for (std::string& word : row) words >> word;
  EXPECT_EQ(
      row, (std::vector<std::string>{"yaw", "3.750°", "3.500°", "1.500°", "2.000°", "0.250°", "rival", "(66.7", "%)"}));
  const std::string nothing = RunSummary().text(1.0);
  EXPECT_EQ(nothing.find("median level"), nothing.rfind("median level")) << "nothing was measured: no table of parts";
}

// A road that is driven along, so that values are smoothed, and held where the sensor freezes.
struct DrivenRoad {
  explicit DrivenRoad(const std::string& scene) {
    EXPECT_EQ(command({"sim", "-q", "--scene", scene, "--sensor", "vlp16", "-n", "16", "--set", "speed_mps=0.5", "-o",
                       folder.file("road")})
                  .exit_status,
              0);
  }
  std::string settings() const { return folder.file("road/pose_wall.yaml"); }
  std::string frames() const { return folder.file("road/frames"); }
  std::string run(const std::string& name, const std::vector<std::string>& more) const {
    EXPECT_EQ(command({"run", "-q", "-c", settings(), "-o", folder.file(name), frames()}, more).exit_status, 0);
    return folder.file(name);
  }

  TempFolder folder;
};

// Nine digits of each part and of the level.
constexpr double kRounding = 8e-9;

void expect_split(const CsvTable& table, std::size_t row, const std::string& q) {
  const auto cell = [&](const std::string& ending) { return table.cell(row, table.find_column(q + ending).value()); };
  const auto number = [&](const std::string& ending) { return std::stod(cell(ending)); };
  if (cell("_pl").empty()) {
    EXPECT_EQ(cell("_cause"), "");
    EXPECT_EQ(cell("_raw_pl"), "");
    for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
      EXPECT_EQ(cell(std::string("_pl_") + pose_wall_part_name(part)), "");
    }
    return;
  }
  double sum = 0.0, largest = -1.0;
  std::string cause;
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
    const double share = number(std::string("_pl_") + pose_wall_part_name(part));
    EXPECT_GE(share, 0.0);
    sum += share;
    if (share > largest) cause = pose_wall_part_name(part);
    largest = std::max(largest, share);
  }
  EXPECT_NEAR(sum, number("_pl"), kRounding * (1.0 + sum)) << q << row;
  EXPECT_EQ(cell("_cause"), cause) << q << row;
  EXPECT_EQ(cell("_raw_pl").empty(), cell("_raw").empty()) << q << row;
  if (cell("_raw").empty()) {
    EXPECT_EQ(cell("_raw_state"), "invalid");
    return;
  }
  // The road's memory may know it better than this look, and never less well.
  EXPECT_LE(number("_pl") - number("_pl_lag"), number("_raw_pl") + kRounding * (1.0 + sum)) << q << row;
}

TEST(LevelColumns, PartsAddUpAndTheCauseIsTheLargest) {
  const std::vector<std::string> names = {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"};
  std::size_t held = 0, lagging = 0, none = 0;
  for (const char* scene : {"nominal", "frozen", "no_floor"}) {
    for (const char* motion : {"motion=on", "motion=off"}) {  // values lag without an odometry alone
      const CsvTable table = table_of(DrivenRoad(scene).run("parts.csv", {"--parts", "--set", motion}));
      ASSERT_EQ(table.rows(), 16U);
      for (std::size_t row = 0; row < table.rows(); ++row) {
        for (const std::string& q : names) {
          expect_split(table, row, q);
          held += table.cell(row, *table.find_column(q + "_state")) == "held" ? 1U : 0U;
          lagging += table.number(row, *table.find_column(q + "_pl_lag")) > 0.0 ? 1U : 0U;
          none += table.cell(row, *table.find_column(q + "_pl")).empty() ? 1U : 0U;
        }
      }
    }
  }
  EXPECT_GT(held, 0U);
  EXPECT_GT(lagging, 0U);
  EXPECT_GT(none, 0U);
}

TEST(LevelColumns, StandBehindAllOthersAndOldTablesAreStillRead) {
  const DrivenRoad road("nominal");
  const std::string narrow = road.run("narrow.csv", {}), wide = road.run("wide.csv", {"--parts"});
  std::vector<std::string> head = table_of(narrow).head(), wide_head = table_of(wide).head();
  const auto old_end = std::find(head.begin(), head.end(), "error") + 1;
  EXPECT_EQ(head.end() - old_end, 3 * POSE_WALL_QUANTITIES + 1 + 2);
  EXPECT_EQ(*old_end, "roll_raw_pl");
  EXPECT_EQ(head.back(), "alert_limit_distance");
  EXPECT_EQ(wide_head.size(), head.size() + POSE_WALL_PARTS * POSE_WALL_QUANTITIES);
  // The newest stand last in both, so that no older column has moved.
  EXPECT_TRUE(std::equal(head.begin(), head.end() - 2, wide_head.begin()));
  EXPECT_TRUE(std::equal(head.end() - 2, head.end(), wide_head.end() - 2));
  // The table as it was written before these columns were there.
  const std::size_t old_columns = static_cast<std::size_t>(old_end - head.begin());
  std::string old;
  std::istringstream rows(text_of(narrow));
  for (std::string row; std::getline(rows, row);) {
    std::size_t end = 0;
    for (std::size_t column = 0; column < old_columns; ++column) end = row.find(',', end) + 1;
    old += row.substr(0, end - 1) + "\n";
  }
  const std::string truth = road.folder.file("road/truth.csv");
  const Ran of_old = command({"eval", road.folder.write("old.csv", old), truth});
  ASSERT_EQ(of_old.exit_status, 0) << of_old.errors;
  EXPECT_TRUE(contains(of_old.printed, "d_rb")) << of_old.printed;
  for (const std::string& file : {narrow, wide}) EXPECT_EQ(command({"eval", file, truth}).printed, of_old.printed);
}

TEST(ExplainVerb, OutcomesHaveTheirParts) {
  const DrivenRoad road("nominal");
  const Ran ran = command({"explain", "-q", "--json", "-c", road.settings(), "-n", "9", road.frames()});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  const nlohmann::json page = nlohmann::json::parse(ran.printed);
  for (const nlohmann::json& value : page.at("outcome")) {
    double sum = 0.0, largest = 0.0;
    for (const nlohmann::json& part : value.at("parts")) {
      sum += part.get<double>();
      largest = std::max(largest, part.get<double>());
    }
    EXPECT_NEAR(sum, value.at("protection_level").get<double>(), 1e-12 * sum) << value;
    EXPECT_EQ(value.at("parts").at(value.at("cause").get<std::string>()), largest) << value;
    EXPECT_LE(sum - value.at("parts").at("lag").get<double>(),
              value.at("raw_protection_level").get<double>() * (1.0 + 1e-12));
    EXPECT_TRUE(contains(value.at("sentence").get<std::string>(), " Its level: ")) << value;
  }
}

}  // namespace
}  // namespace pose_wall::tools
