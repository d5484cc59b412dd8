// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, on rows written by hand: an honest table passes the gate of motion, and every way of lying fails it by name,
// along a bend as on the straight. Does not prove: that the library is honest.

#include "lab/campaign/motion_card.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "campaign_records.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/gate.hpp"
#include "lab/campaign/worst_events.hpp"
#include "motion_tables.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::campaign {
namespace {

using namespace test;

constexpr double kStep_m = 0.1;
constexpr int kFrames = 101;  // ten metres

// Of row i: what the library says, what is true, and how they go into the table.
struct HandRow {
  double x = 0.0, y = 0.0, z = 0.0, yaw_rad = 0.0;  // as measured
  double true_x = 0.0, true_y = 0.0, road_rad = 0.0;
  double step_x = kStep_m;
  std::string state = "measured";
  Cells more;
};
using Change = std::function<void(int, HandRow&)>;

Cells levels(const char* prefix, double sigma_m, double level_m) {
  Cells cells;
  for (std::uint32_t d = 0; d < POSE_WALL_MOTION_DIRECTIONS; ++d) {
    const std::string name = prefix + std::string(pose_wall_motion_direction_name(d));
    cells[name + "_sigma"] = fmt::format("{}", sigma_m);
    cells[name + "_pl"] = fmt::format("{}", level_m);
  }
  return cells;
}

Cells as_cells(const Run& run, int i, const HandRow& row) {
  Cells cells = with(placed(row.x, row.y, row.z, row.yaw_rad), levels("", 0.01, 0.05));
  if (i > 0) cells = with(with(cells, stepped(row.step_x, 0.0)), levels("step_", 0.002, 0.01));
  const Cells truth = {{"true_x", fmt::format("{}", row.true_x)},
                       {"true_y", fmt::format("{}", row.true_y)},
                       {"true_z", "0"},
                       {"true_qx", "0"},
                       {"true_qy", "0"},
                       {"true_qz", "0"},
                       {"true_qw", "1"},
                       {"true_road_x", fmt::format("{:.17g}", std::cos(row.road_rad))},
                       {"true_road_y", fmt::format("{:.17g}", std::sin(row.road_rad))}};
  cells = with(cells, truth);
  cells = with(cells, {{"scene", run.scene},
                       {"sensor", run.sensor},
                       {"draw", std::to_string(run.draw)},
                       {"seed", "7"},
                       {"frame", std::to_string(i)},
                       {"source", "by hand"},
                       {"stamp_ns", std::to_string(100'000'000LL * i)},
                       {"along_state", row.state},
                       {"along_m", fmt::format("{}", row.x)},
                       {"contrast", "0.8"},
                       {"patches", "12"},
                       {"total_ms", "2"}});
  return with(cells, row.more);
}

// A drive ahead, every number right, but for what `change` makes of a row.
MotionRecord drive(const char* name, const Change& change = nullptr, std::uint32_t draw = 0) {
  const Run run{name, "os1-64", draw, 7, kFrames};
  std::string text = csv_line(motion_record_head());
  for (int i = 0; i < kFrames; ++i) {
    HandRow row;
    row.x = row.true_x = kStep_m * i;
    if (change) change(i, row);
    const Cells cells = as_cells(run, i, row);
    std::vector<std::string> line;
    for (const std::string& column : motion_record_head()) {
      const auto cell = cells.find(column);
      line.push_back(cell == cells.end() ? "" : cell->second);
    }
    text += csv_line(line);
  }
  std::istringstream stream(text);
  return motion_record_of(CsvTable::parse(stream));
}

MotionCard motion_card_of(const std::vector<MotionRecord>& records) {
  MotionCard card;
  card.manifest.runs = records.size();
  card.manifest.plan.motion = true;
  for (const MotionRecord& record : records) card.add(record);
  keep_worst(5, &card.events);
  return card;
}

std::string broken(const char* name, const Change& change = nullptr) {
  return joined(gate_faults(motion_card_of({drive(name, change)})));
}

void call_all(const std::string& state, HandRow& row) {
  row.state = state;
}

TEST(MotionCard, AnHonestDrivePasses) {
  EXPECT_EQ(broken("rough"), "");
  EXPECT_EQ(broken("smooth", [](int, HandRow& row) { call_all("unobservable", row); }), "");
}

TEST(MotionCard, MeasuredOnASmoothLiningIsWrongEvenWhereItIsRight) {
  EXPECT_TRUE(
      contains(broken("smooth"), "smooth os1-64: unobservable in 0 % of the frames; at least 99 % is required"));
  const auto two = [](int i, HandRow& row) { row.state = i == 50 || i == 60 ? "measured" : "unobservable"; };
  EXPECT_TRUE(contains(broken("smooth", two), "unobservable in 98 %")) << broken("smooth", two);
  const auto one = [](int i, HandRow& row) { row.state = i == 50 ? "measured" : "unobservable"; };
  EXPECT_EQ(broken("smooth", one), "") << "one in a hundred may be";
}

TEST(MotionCard, UnobservableOnRoughRockIsTooLittle) {
  const std::string faults = broken("rough", [](int, HandRow& row) { call_all("unobservable", row); });
  EXPECT_TRUE(contains(faults, "measured in 0 % of the frames; at least 95 % is required")) << faults;
}

// The machine does not move for the library, which is sure of it.
TEST(MotionCard, StandingStillForWantOfKnowledgeMisleads) {
  const std::string faults = broken("smooth", [](int, HandRow& row) {
    row.x = 0.0;
    row.step_x = 0.0;
  });
  EXPECT_TRUE(contains(faults, "misleading steps: 100 of 100")) << faults;
  EXPECT_TRUE(contains(faults, "misleading poses: 100 of 100")) << faults;
  EXPECT_TRUE(contains(faults, "step beyond its level, along: 100 of 100")) << faults;
}

TEST(MotionCard, OneMisleadingStepIsTooMany) {
  const MotionCard card = motion_card_of({drive("rough", [](int i, HandRow& row) {
    if (i == 40) row.step_x += 0.02;  // twice its level
  })});
  const std::string faults = joined(gate_faults(card));
  EXPECT_TRUE(contains(faults, "misleading steps: 1 of 100")) << faults;
  EXPECT_FALSE(contains(faults, "misleading poses")) << faults;
  ASSERT_EQ(card.events.size(), 1U);
  EXPECT_EQ(card.events[0].frame, 40U);
  EXPECT_NEAR(card.events[0].excess, 2.0, 1e-6);
  EXPECT_TRUE(contains(card_page(card),
                       "pose_wall campaign --motion --seed 1 --scenes rough --sensors os1-64 --first-draw 0 --draws 1 "
                       "--frames 41 --output DIR"));
}

TEST(MotionCard, AnErrorThatIsNotCalledMeasuredIsBeyondButNotMisleading) {
  const std::string faults = broken("rough", [](int i, HandRow& row) {
    if (i != 40) return;
    row.x += 0.06;
    row.state = "ambiguous";
  });
  EXPECT_TRUE(contains(faults, "pose beyond its level, along: 1 of 100")) << faults;
  EXPECT_FALSE(contains(faults, "misleading")) << faults;
}

TEST(MotionCard, AMissingLevelIsNoPromise) {
  const std::string faults = broken("rough", [](int i, HandRow& row) {
    row.more = {{i == 9 ? "up_pl" : "source", ""}};
  });
  EXPECT_TRUE(contains(faults, "pose beyond its level, up: 1 of 100")) << faults;
}

TEST(MotionCard, AlongIsJudgedByTheWayThatWasDriven) {
  // Half a per cent of ten metres is 50 mm; the level holds whatever comes.
  const auto short_by = [](double share) {
    return [share](int, HandRow& row) {
      row.x *= 1.0 - share;
      row.step_x *= 1.0 - share;
      row.more = {{"along_pl", "1"}, {"step_along_pl", "1"}};
    };
  };
  EXPECT_EQ(broken("rough", short_by(0.0049)), "");
  const MotionCard card = motion_card_of({drive("rough", short_by(0.02))});
  const std::string faults = joined(gate_faults(card));
  EXPECT_EQ(faults, "rough os1-64: error along is 4 times the allowed one\n");
  EXPECT_NEAR(card.classes[0].along_share.at(0), 0.02, 1e-9);
  EXPECT_NEAR(card.classes[0].along_m.at(0), 0.2, 1e-9);
}

TEST(MotionCard, StandingMayDriftFiveMillimetres) {
  const auto drift = [](double drift_m) {
    return [drift_m](int i, HandRow& row) {
      row.true_x = 0.0;
      row.x = drift_m * i / (kFrames - 1);
      row.step_x = 0.0;
    };
  };
  EXPECT_EQ(broken("standing", drift(0.0049)), "");
  EXPECT_TRUE(contains(broken("standing", drift(0.0051)), "error along is 1.02 times"));
}

TEST(MotionCard, AcrossUpAndTurnHaveLimitsOfTheirOwn) {
  const std::string faults = broken("rough", [](int i, HandRow& row) {
    if (i == 30) row.y = 0.02;
    if (i == 31) row.z = -0.03;
    if (i == 32) row.yaw_rad = 0.004;
  });
  EXPECT_EQ(faults,
            "rough os1-64: error across is 0.02 m; at most 0.01 m is allowed\n"
            "rough os1-64: error up is 0.03 m; at most 0.01 m is allowed\n"
            "rough os1-64: error of the turn is 0.2292 degrees; at most 0.1 degrees is allowed\n");
}

// A quarter of a bend: what is along at its end is across at its begin.
TEST(MotionCard, AlongABendIsAlongTheRoadThere) {
  const auto bend = [](double ahead_m, double aside_m) {
    return [ahead_m, aside_m](int i, HandRow& row) {
      constexpr double kRadius_m = 6.0;
      const double heading = 0.5 * M_PI * i / (kFrames - 1);
      row.road_rad = heading;
      row.true_x = kRadius_m * std::sin(heading);
      row.true_y = kRadius_m * (1.0 - std::cos(heading));
      row.x = row.true_x;
      row.y = row.true_y;
      row.state = "unobservable";
      row.more = levels("step_", 1.0, 9.0);
      if (i + 1 < kFrames) return;
      row.y += ahead_m;
      row.x -= aside_m;
    };
  };
  EXPECT_EQ(broken("smooth_curve", bend(0.0, 0.0)), "");
  const std::string ahead = broken("smooth_curve", bend(0.06, 0.0)), aside = broken("smooth_curve", bend(0.0, 0.06));
  EXPECT_EQ(ahead, "smooth_curve os1-64: pose beyond its level, along: 1 of 100; none is allowed\n");
  EXPECT_EQ(aside, "smooth_curve os1-64: pose beyond its level, across: 1 of 100; none is allowed\n");
}

TEST(MotionCard, ARunThatIsAlwaysLostIsToldAndNotJudged) {
  const std::string faults = broken("rough", [](int, HandRow& row) {
    row.state = "lost";
    for (const char* name :
         {"x", "y", "z", "qx", "qy", "qz", "qw", "step_x", "step_y", "step_z", "step_rx", "step_ry", "step_rz"}) {
      row.more[name] = "";
    }
  });
  EXPECT_TRUE(contains(faults, "1 of 1 runs have no pose at all")) << faults;
  EXPECT_TRUE(contains(faults, "measured in 0 %")) << faults;
}

TEST(MotionCard, LosingThePlaceAgainAndAgainIsNoHonesty) {
  const auto lost_from = [](int first) {
    return [first](int i, HandRow& row) {
      if (i < first) return;
      row.state = "lost";
      for (const char* name : {"x", "y", "z", "qx", "qy", "qz", "qw"}) row.more[name] = "";
    };
  };
  EXPECT_EQ(broken("faint", lost_from(kFrames - 5)), "");
  EXPECT_EQ(broken("faint", lost_from(kFrames - 6)),
            "faint os1-64: lost in 6 % of the frames; at most 5 % is allowed\n");
}

TEST(MotionCard, PeriodicSetsAreMeasuredOrAmbiguous) {
  EXPECT_EQ(broken("sets", [](int i, HandRow& row) { row.state = i % 2 == 0 ? "measured" : "ambiguous"; }), "");
  EXPECT_EQ(broken("sets", [](int, HandRow& row) { row.state = "unobservable"; }),
            "sets os1-64: measured or ambiguous in 0 % of the frames; at least 95 % is required\n");
}

TEST(MotionCard, AnUnfinishedCampaignAndAnEmptyOneFail) {
  MotionCard card = motion_card_of({drive("rough")});
  card.manifest.runs = 2;
  EXPECT_EQ(joined(gate_faults(card)), "the campaign is not finished: runs done 1 of 2\n");
  EXPECT_EQ(joined(gate_faults(motion_card_of({}))), "no frame was judged\n");
}

// Errors of the step by turns ahead and back by so many sigma; the accumulated one likewise.
TEST(MotionCard, SigmaMustBeTrueOnRoughRockFromFortyRunsOn) {
  const auto runs_of = [](std::size_t count, double sigmas) {
    const MotionRecord one = drive("rough", [sigmas](int i, HandRow& row) {
      row.step_x += (i % 2 == 0 ? 1 : -1) * sigmas * 0.002;
      row.x += i == 0 ? 0.0 : (i % 2 == 0 ? 1 : -1) * sigmas * 0.01;
    });
    return motion_card_of(std::vector<MotionRecord>(count, one));
  };
  EXPECT_EQ(joined(gate_faults(runs_of(40, 1.0))), "");
  EXPECT_EQ(joined(gate_faults(runs_of(39, 0.5))), "");
  const std::string wide = joined(gate_faults(runs_of(40, 0.5)));
  EXPECT_EQ(wide,
            "rough rock: mean z² along of the step is 0.25; it must be within 0.5 and 1.3\n"
            "rough rock: mean z² along of the pose is 0.25; it must be within 0.5 and 1.3\n");
  const std::string narrow = joined(gate_faults(runs_of(40, 2.0)));
  EXPECT_TRUE(contains(narrow, "mean z² along of the step is 4.00")) << narrow;
}

TEST(MotionCard, JsonSaysWhatThePageSays) {
  const MotionCard card = motion_card_of({drive("rough", nullptr, 0), drive("rough", nullptr, 1), drive("smooth")});
  const auto page = nlohmann::json::parse(card_json(card));
  ASSERT_EQ(page["classes"].size(), 2U);
  EXPECT_EQ(page["classes"][0]["runs"], 2);
  EXPECT_EQ(page["classes"][0]["frames"], 2 * kFrames);
  EXPECT_EQ(page["classes"][0]["states"]["measured"], 1.0);
  EXPECT_EQ(page["classes"][0]["contrast"]["median"], 0.8);
  EXPECT_EQ(page["classes"][0]["ms_mean"], 2.0);
  EXPECT_EQ(page["classes"][1]["broken"].size(), 1U);
  EXPECT_EQ(page["gate_faults"].size(), 1U);
  EXPECT_TRUE(contains(card_page(card), "Gate not passed: 1 requirement fails"));
}

TEST(MotionCard, RefusesRowsOfAClassThatDoesNotExist) {
  MotionCard card;
  EXPECT_THROW(card.add(drive("no_such_class")), std::runtime_error);
}

}  // namespace
}  // namespace pose_wall::tools::campaign
