// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: each note becomes its sentence, with value, limit and key. Frames of fifteen scenes are refused for as many
// causes, and the explanation names the cause of the scene, for the right subject; in Chinese no English is left. Does
// not prove: that the words are good ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "crafted_value.hpp"
#include "english_left.hpp"
#include "pose_wall.hpp"
#include "ran_command.hpp"
#include "study/explain/candidate_words.hpp"
#include "study/explain/explanation.hpp"
#include "study/explain/explanation_text.hpp"
#include "study/explain/gate_words.hpp"
#include "study/explain/outcome_words.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::explain {
namespace {

using namespace test;

// A frame without floor, with notes.
struct Noted {
  api::Config config;
  pose_wall_result result = api::make_result();
  pose_wall_trace trace{};

  void note(std::uint32_t subject, std::uint32_t gate, double value, double limit, bool passed) {
    trace.gate[trace.gates++] = {subject, gate, 0, passed ? 1U : 0U, value, limit};
  }
  Paragraph paragraph(std::size_t index) const {
    return explain_frame(*config.get(), result, trace).paragraphs.at(index);
  }
};

constexpr std::size_t kFrame = 0, kFloor = 1, kLeft = 2, kRight = 3;

TEST(Sentences, AShortWallIsToldWithBothLengthsAndTheKey) {
  Noted noted;
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_INLIERS, 1000.0, 900.0, true);
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_LENGTH, 2.1, 4.0, false);
  noted.note(POSE_WALL_TRACE_RIGHT, POSE_WALL_TRACE_WALL_LENGTH, 8.0, 4.0, true);
  const Paragraph left = noted.paragraph(kLeft);
  EXPECT_EQ(left.acceptance, Acceptance::kRefused);
  ASSERT_EQ(left.sentences.size(), 1U);
  EXPECT_EQ(left.sentences[0],
            "The plane is supported over 2.10 m along the road; 4.00 m is needed (wall_length_min).");
  EXPECT_EQ(noted.paragraph(kRight).acceptance, Acceptance::kAccepted);
  EXPECT_TRUE(noted.paragraph(kRight).sentences.empty());
}

TEST(Sentences, WhatIsOfBothWallsIsToldOfEach) {
  Noted noted;
  noted.note(POSE_WALL_TRACE_WALLS, POSE_WALL_TRACE_ACROSS, 2.0, 1.0, false);
  for (const std::size_t side : {kLeft, kRight}) {
    EXPECT_EQ(noted.paragraph(side).acceptance, Acceptance::kRefused);
    EXPECT_TRUE(contains(noted.paragraph(side).sentences.at(0), "200 % of the wall that the sides show"));
  }
}

TEST(Sentences, ADoubtIsNoRefusalAndIsNotToldTwice) {
  Noted noted;
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_OPEN_DOUBT, 0.05, 0.01, false);
  EXPECT_EQ(noted.paragraph(kLeft).acceptance, Acceptance::kDoubted);
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_SILENT, 0.05, 0.025, false);
  EXPECT_EQ(noted.paragraph(kLeft).acceptance, Acceptance::kRefused);
  EXPECT_EQ(noted.paragraph(kLeft).sentences.size(), 1U);
}

TEST(Sentences, OfManyRivalsTheStrongestIsToldOnce) {
  for (const std::uint32_t gate : {POSE_WALL_TRACE_FLOOR_RIVAL, POSE_WALL_TRACE_WALL_RIVAL}) {
    const bool floor = gate == POSE_WALL_TRACE_FLOOR_RIVAL;
    const std::uint32_t subject = floor ? POSE_WALL_TRACE_FLOOR : POSE_WALL_TRACE_LEFT;
    Noted noted;
    noted.note(subject, gate, 0.692, 0.5, false);
    const auto told = [&] { return noted.paragraph(floor ? kFloor : kLeft).sentences; };
    ASSERT_EQ(told().size(), 1U);
    EXPECT_TRUE(contains(told()[0], "69.2 %") && !contains(told()[0], "further")) << told()[0];
    noted.note(subject, gate, 0.892, 0.5, false);
    ASSERT_EQ(told().size(), 1U);
    EXPECT_TRUE(contains(told()[0], "89.2 %") && contains(told()[0], "for 1 further plane.")) << told()[0];
    noted.note(subject, gate, 0.583, 0.5, false);
    noted.note(subject, gate, 0.892, 0.5, false);
    ASSERT_EQ(told().size(), 1U) << "also where two are as strong";
    EXPECT_TRUE(contains(told()[0], "89.2 %") && contains(told()[0], "for 3 further planes.")) << told()[0];
  }
}

// By src/engine/floor/rivals.cpp: what such a floor is doubted by, and its tilt, for it may be a heap's flank.
TEST(Sentences, AFloorThatMayBeARampSaysAllThatItsLevelsGrowBy) {
  const auto told = [](std::uint32_t gate) {
    Noted noted;
    noted.note(POSE_WALL_TRACE_FLOOR, gate, 0.3, 0.2, false);
    return noted.paragraph(kFloor).sentences.at(0);
  };
  EXPECT_TRUE(contains(told(POSE_WALL_TRACE_FLOOR_NEAR),
                       "the protection levels grow by the slope of one, and of a steep floor by its tilt as well."));
  EXPECT_TRUE(contains(told(POSE_WALL_TRACE_FLOOR_BESIDE), "Of a steep floor they grow by its tilt as well."));
  EXPECT_TRUE(contains(told(POSE_WALL_TRACE_FLOOR_RIVAL),
                       "If the floor is steep, they grow by its tilt as well, since a machine stands about upright."));
}

// The engine counts the frames for which it keeps a doubt, and the results of earlier frames tell which one began it.
TEST(Sentences, ADoubtThatIsKeptNamesTheFrameThatShowedTheRival) {
  pose_wall_result both = api::make_result(), left_refused = api::make_result();
  for (pose_wall_value& value : both.quantity) value.raw = 1.0;
  for (pose_wall_value& value : left_refused.quantity) value.raw = NAN;
  left_refused.quantity[POSE_WALL_YAW].raw = left_refused.quantity[POSE_WALL_D_RF].raw = 1.0;
  both.left.reasons = left_refused.left.reasons = POSE_WALL_R_WALL_AMBIGUOUS;
  RivalsSeen rivals;
  rivals.add(both, 7);
  rivals.add(left_refused, 8);
  both.left.reasons = 0;
  rivals.add(both, 9);
  Noted noted;
  for (pose_wall_value& value : noted.result.quantity) value.raw = 1.0;
  for (const std::uint32_t quantity : {POSE_WALL_YAW, POSE_WALL_D_LB, POSE_WALL_D_RB}) {
    noted.note(POSE_WALL_TRACE_QUANTITY + quantity, POSE_WALL_TRACE_DOUBTED, 2.0, 0.0, false);
  }
  const std::vector<std::string> told = explain_frame(*noted.config.get(), noted.result, noted.trace, rivals).outcome;
  const char* const says = "Frames left, this one included: 2. It was last seen in frame 7.";
  EXPECT_TRUE(contains(told[POSE_WALL_YAW], says)) << told[POSE_WALL_YAW];
  EXPECT_TRUE(contains(told[POSE_WALL_D_LB], says)) << told[POSE_WALL_D_LB];
  EXPECT_FALSE(contains(told[POSE_WALL_D_RB], "last seen")) << told[POSE_WALL_D_RB];
  EXPECT_FALSE(contains(told[POSE_WALL_D_LF], "last seen")) << "no doubt is kept";
}

TEST(Sentences, WhatTwoGatesAskForIsToldOnce) {
  const Explanation explanation{
      {{POSE_WALL_TRACE_FLOOR, Acceptance::kRefused, {"No."}, {"a; b c", "d; b c", "a"}}}, {}, {}};
  EXPECT_TRUE(contains(sentences_text(explanation), "To look at: a; b c; d.\n")) << sentences_text(explanation);
}

TEST(Sentences, PointsThatAreDroppedNameTheirLimit) {
  Noted noted;
  noted.result.points_in = noted.result.dropped_far = 5000;
  noted.note(POSE_WALL_TRACE_FRAME, POSE_WALL_TRACE_POINTS, 0.0, 100.0, false);
  const Paragraph frame = noted.paragraph(kFrame);
  EXPECT_EQ(frame.acceptance, Acceptance::kRefused);
  EXPECT_TRUE(contains(frame.sentences.at(1), "5000 are farther than range_max (30.00 m)")) << frame.sentences.at(1);
  EXPECT_TRUE(contains(frame.helps.at(0), "--unit mm")) << frame.helps.at(0);
}

TEST(Sentences, EveryGateHasOneWithItsKey) {
  for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES; ++gate) {
    Note note{{POSE_WALL_TRACE_QUANTITY, gate, 0, 0, 0.5, 0.25}, {}};
    ASSERT_EQ(pose_wall_trace_gate_info(gate, &note.info), POSE_WALL_OK);
    const std::string said = sentence_of(note) + help_of(note);
    EXPECT_NE(sentence_of(note), "") << note.info.name;
    EXPECT_EQ(said.find('{'), std::string::npos) << said;
    const std::string key = std::string(note.info.key).substr(0, std::string(note.info.key).find('|'));
    EXPECT_TRUE(contains(said, key)) << note.info.name << ": " << said;
  }
}

TEST(GatesTable, RatiosAndColoursOnlyWhereTheyAreAskedFor) {
  Noted noted;
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_LENGTH, 1.0, 4.0, false);
  const std::string plain = gates_text(Notes(noted.trace), false);
  EXPECT_TRUE(contains(plain, "wall_length_min")) << plain;
  EXPECT_TRUE(contains(plain, "0.25")) << plain;
  EXPECT_TRUE(contains(plain, "REFUSES")) << plain;
  EXPECT_FALSE(contains(plain, "\033")) << plain;
  EXPECT_TRUE(contains(gates_text(Notes(noted.trace), true), "\033[31m"));
}

TEST(GatesTable, WhatFailedStandsFirstAndTheEndNamesTheList) {
  Noted noted;
  noted.note(POSE_WALL_TRACE_FRAME, POSE_WALL_TRACE_POINTS, 9000.0, 500.0, true);
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_LENGTH, 3.0, 2.0, true);
  noted.note(POSE_WALL_TRACE_RIGHT, POSE_WALL_TRACE_WALL_LENGTH, 1.0, 2.0, false);
  noted.note(POSE_WALL_TRACE_RIGHT, POSE_WALL_TRACE_WALL_LEAN, 0.5, 0.2, false);
  const std::string text = gates_text(Notes(noted.trace), false);
  const std::size_t short_wall = text.find("1.00 m"), lean = text.find("wall_lean "), points = text.find("9000"),
                    long_wall = text.find("3.00 m");
  EXPECT_LT(short_wall, lean) << text;
  EXPECT_LT(lean, points) << text;
  EXPECT_LT(points, long_wall) << text;
  EXPECT_TRUE(contains(text, "\nMeaning of each gate: pose_wall explain --gates\n")) << text;
  const std::string coloured = gates_text(Notes(noted.trace), true);
  EXPECT_LT(coloured.rfind("\033[31m"), coloured.find("9000")) << "colours follow their rows\n" << coloured;
}

TEST(GatesTable, WhatIsAskedTwiceSaysOfWhat) {
  Noted noted;
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_LENGTH, 3.0, 2.0, true);
  noted.note(POSE_WALL_TRACE_RIGHT, POSE_WALL_TRACE_WALL_LENGTH, 5.0, 2.0, true);
  noted.note(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WALL_LENGTH, 4.0, 2.0, true);
  for (const double rival : {0.6, 0.7}) {
    noted.note(POSE_WALL_TRACE_FRAME, POSE_WALL_TRACE_POINTS, rival, 0.5, false);  // no plane's
  }
  const std::string text = gates_text(Notes(noted.trace), false);
  const auto told = [&](const std::string& words) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(told("wall_length (drawn)"), 1U) << text;  // the left one's first
  EXPECT_LT(text.find("wall_length (drawn)"), text.find("3.00 m")) << text;
  EXPECT_EQ(told("wall_length"), 3U + 3U) << text;  // and its key in each row
  EXPECT_EQ(told("(drawn)"), 1U) << text;
}

// A plane of a wall, drawn and come to nothing.
pose_wall_trace_candidate candidate(std::uint32_t subject, std::uint32_t fate, double angle_rad, double d_m) {
  pose_wall_trace_candidate c{};
  c.subject = subject;
  c.fate = fate;
  c.normal[0] = std::sin(angle_rad);
  c.normal[1] = std::cos(angle_rad);
  c.d_m = d_m;
  return c;
}

TEST(PlanesTable, WallsThatCameToNothingAreToldOnce) {
  Noted noted;
  const auto add = [&](const pose_wall_trace_candidate& c) { noted.trace.candidate[noted.trace.candidates++] = c; };
  for (const double d_m : {2.50, 2.53, 2.47}) {
    add(candidate(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_OUT_OF_RANGE, 1.0 + 0.1 * (d_m - 2.5), d_m));
  }
  add(candidate(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_UNSUPPORTED, 1.0, 2.5));
  add(candidate(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_OUT_OF_RANGE, 1.2, 2.5));
  add(candidate(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_OUT_OF_RANGE, 1.0, 3.0));
  add(candidate(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WEAKER, 0.0, 2.50));
  add(candidate(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WEAKER, 0.0, 2.51));
  add(candidate(POSE_WALL_TRACE_LEFT, POSE_WALL_TRACE_WEAKER, 0.0, 2.51));  // weighed twice
  EXPECT_EQ(planes_of(*noted.config.get(), noted.result, Notes(noted.trace), POSE_WALL_TRACE_LEFT).size(), 6U);
}

TEST(PlanesTable, APlaneOutOfRangeIsToldAgainstWhatItShouldRunAlong) {
  Noted noted;
  for (const auto& [subject, says] : {std::pair(POSE_WALL_TRACE_LEFT, "too far across the machine"),
                                      std::pair(POSE_WALL_TRACE_RIGHT, "too far across"),
                                      std::pair(POSE_WALL_TRACE_AHEAD, "too far along the machine"),
                                      std::pair(POSE_WALL_TRACE_BEHIND, "too far along")}) {
    noted.trace.candidate[0] = candidate(subject, POSE_WALL_TRACE_OUT_OF_RANGE, 1.0, 2.5);
    noted.trace.candidates = 1;
    const auto planes = planes_of(*noted.config.get(), noted.result, Notes(noted.trace), subject);
    ASSERT_EQ(planes.size(), 1U);
    EXPECT_TRUE(contains(planes[0].fate, says)) << planes[0].fate;
    EXPECT_TRUE(contains(planes[0].fate, "yaw_max_deg is 45°")) << planes[0].fate;
  }
}

// A refused frame with its cause, as the scene has it.
struct Refused {
  const char* name;
  std::vector<std::string> scene;     // words behind `sim`
  std::vector<std::string> settings;  // words behind `explain`
  unsigned frame;
  const char* verdicts;  // of frame, floor, left, right: accepted, doubted, refused
  const char* of;        // whose sentence it is
  const char* says;
};

void PrintTo(const Refused& r, std::ostream* os) {
  *os << r.name;
}

class ExplainedFrame : public ::testing::TestWithParam<Refused> {};

std::string all_of(const nlohmann::json& paragraph) {
  std::string text;
  for (const char* list : {"sentences", "to_look_at"}) {
    for (const std::string line : paragraph[list]) text += line + " ";
  }
  return text;
}

TEST_P(ExplainedFrame, NamesTheCauseThatTheSceneHas) {
  const Refused& r = GetParam();
  const TempFolder folder;
  const test::EnglishAfterwards english;
  std::vector<std::string> sim = {"sim", "-q", "-n", std::to_string(r.frame + 1), "-o", folder.path(), "--scene"};
  sim.insert(sim.end(), r.scene.begin(), r.scene.end());
  ASSERT_EQ(command(sim).exit_status, 0);
  std::vector<std::string> words = {"explain",
                                    "-q",
                                    "--json",
                                    "-c",
                                    folder.file("pose_wall.yaml"),
                                    "--frame",
                                    std::to_string(r.frame),
                                    folder.file("frames")};
  words.insert(words.end(), r.settings.begin(), r.settings.end());
  const Ran ran = command(words);
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  const auto page = nlohmann::json::parse(ran.printed);
  std::string verdicts, told;
  for (const auto& paragraph : page["explanation"]) {
    verdicts += paragraph["verdict"].get<std::string>()[0];
    if (paragraph["of"] == r.of) told = all_of(paragraph);
  }
  EXPECT_EQ(verdicts, r.verdicts);
  EXPECT_TRUE(contains(told, r.says)) << r.of << ": " << told;

  words.erase(std::find(words.begin(), words.end(), "--json"));
  words.insert(words.end(), {"--language", "zh", "--picture", folder.file("why.svg")});
  const Ran chinese = command(words);
  ASSERT_EQ(chinese.exit_status, 0) << chinese.errors;
  EXPECT_TRUE(contains(chinese.printed, "考察过的平面"));
  EXPECT_EQ(test::english_in(chinese.printed), "");
  EXPECT_EQ(test::english_in(test::words_of_svg(test::text_of(folder.file("why.svg")))), "");
}

const Refused kRefused[] = {
    {"no_return_from_the_floor",
     {"no_floor"},
     {},
     0,
     "arrr",
     "floor",
     "2.10 m above the sensor, tilted by 0.00° (95.8 % of the points tried): no floor is above the sensor"},
    {"sensor_higher_than_the_config_says",
     {"clean"},
     {"-s", "ground_height_max=1.2"},
     0,
     "arrr",
     "floor",
     "lies 1.40 m below the sensor, tilted by 0.01° (76.6 % of the points tried): ground_height_max allows 1.20 m"},
    {"walls_in_reach_for_a_short_length",
     {"one_wall", "--set", "width_m=8.2"},
     {"-s", "range_max=4.15"},
     0,
     "aarr",
     "left wall",
     "Alone it needs support over 5.00 m (wall_alone_length_min); it has 2.00 m"},
    {"pipes_before_a_dark_wall",
     {"pipes_before_dark_wall"},
     {},
     0,
     "aara",
     "left wall",
     "58.8 % of the wall returns nothing"},
    {"props_and_nothing_behind", {"props_before_void"}, {}, 0, "aada", "left wall", "more than 1 % is doubted"},
    {"conveyor_before_a_dark_wall",
     {"conveyor_before_dark_wall"},
     {},
     0,
     "aara",
     "left wall",
     "looks over the top of the plane: it is a conveyor"},
    {"on_a_crossing",
     {"crosscut", "--set", "walls=left", "--set", "crosscut_width_m=9", "--set", "crosscut_at_m=0"},
     {},
     0,
     "aarr",
     "left wall",
     "the machine stands across a road"},
    {"turned_square_to_the_road",
     {"clean", "--set", "turned_left_deg=90"},
     {},
     0,
     "aarr",
     "right wall",
     "the machine seems to stand across the road"},
    {"turned_beyond_the_range",
     {"clean", "--set", "turned_left_deg=48"},
     {},
     0,
     "aarr",
     "right wall",
     "The wall is turned by 48.00° against the machine; 45.00° is the most (yaw_max_deg)"},
    {"dust",
     {"dust", "--set", "dust=0.98", "--set", "dust_range_m=0.3"},
     {},
     0,
     "arrr",
     "frame",
     "something close blocks the view: dust"},
    {"frozen_sensor", {"frozen"}, {}, 15, "raaa", "frame", "The same points came again 5 times"},
    {"something_before_the_window", {"below_range_min"}, {}, 0, "aara", "left wall", "are nearer than range_min"},
    {"mud_on_the_window", {"half_blocked"}, {}, 0, "aaar", "right wall", "a window with mud on it"},
    {"file_in_millimetres", {"millimetres"}, {}, 0, "rrrr", "frame", "--unit mm reads millimetres; range_max"},
    {"walls_that_run_apart", {"splayed_wide"}, {}, 0, "aarr", "left wall", "they are not parallel (wall_parallel_cos)"},
};

INSTANTIATE_TEST_SUITE_P(Refused, ExplainedFrame, ::testing::ValuesIn(kRefused),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ExplainVerb, UsageFaultsNameWhatThereIs) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "-n", "2", "-o", folder.path()}).exit_status, 0);
  const std::string frames = folder.file("frames"), config = folder.file("pose_wall.yaml");
  EXPECT_TRUE(test::says(command({"explain", "-c", config, "--frame", "2", frames}), 2, "there are 2 frames, 0 to 1"));
  EXPECT_TRUE(test::says(command({"explain", "-c", config, "-n", "0", "-p", folder.file("no/why.svg"), frames}), 2,
                         "--picture " + folder.file("no/why.svg") + ": cannot"));
  EXPECT_TRUE(contains(command({"explian", frames}).errors, "did you mean 'explain'"));
  EXPECT_TRUE(contains(command({"explain", "--farme", "0", frames}).errors, "did you mean '--frame'"));
}

TEST(ExplainVerb, TextAndPictureAreWhole) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "-n", "2", "-o", folder.path()}).exit_status, 0);
  const Ran ran = command({"explain", "-q", "-c", folder.file("pose_wall.yaml"), "--frame", "1", "--picture",
                           folder.file("why.svg"), folder.file("frames")});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  for (const char* part : {"frame 1, measured after 1 frame before it", "Floor: accepted", "Outcome", "  yaw: valid",
                           "Planes that were considered", "Gates", "wall_length_min"}) {
    EXPECT_TRUE(contains(ran.printed, part)) << part;
  }
  EXPECT_FALSE(contains(ran.printed, "\033")) << "no colours but on a terminal";
  const std::string picture = test::text_of(folder.file("why.svg"));
  EXPECT_TRUE(contains(picture, "frame 1, itself accepted, floor accepted, left wall accepted")) << picture.size();
  EXPECT_TRUE(contains(picture, "</svg>"));
}

TEST(ExplainVerb, AFileNameThatIsNoUtf8IsStillJson) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "--sensor", "vlp16", "-n", "1", "-o", folder.path()}).exit_status, 0);
  const std::string frame = folder.file("frames/\xff.pcd");
  std::filesystem::rename(folder.file("frames/000000.pcd"), frame);
  const Ran ran = command({"explain", "-q", "--json", "-c", folder.file("pose_wall.yaml"), "-n", "0", frame});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_EQ(nlohmann::json::parse(ran.printed).at("source"), folder.file("frames/\uFFFD.pcd"));
}

TEST(Sentences, NoHelpRaisesTheLimitThatAValueMisses) {
  for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES; ++gate) {
    Note note{{POSE_WALL_TRACE_QUANTITY, gate, 0, 0, 0.5, 0.25}, {}};
    ASSERT_EQ(pose_wall_trace_gate_info(gate, &note.info), POSE_WALL_OK);
    EXPECT_FALSE(contains(help_of(note), "alert_limit")) << note.info.name << ": " << help_of(note);
  }
  pose_wall_result result = api::make_result();
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
    Noted noted;
    noted.note(POSE_WALL_TRACE_QUANTITY + POSE_WALL_D_LF, POSE_WALL_TRACE_PROTECTION_SMOOTHED, 0.5, 0.1, false);
    pose_wall_value& value = result.quantity[POSE_WALL_D_LF];
    value = test::crafted_value(POSE_WALL_DEGRADED, 2.5, 2.5, {});
    value.cause = part;
    std::vector<std::string> helps = outcome_helps(result, Notes(noted.trace), POSE_WALL_D_LF);
    helps.erase(std::remove(helps.begin(), helps.end(), ""), helps.end());
    ASSERT_EQ(helps.size(), 1U) << pose_wall_part_name(part) << ": the remedy of its cause, and no other";
    EXPECT_FALSE(contains(helps.front(), "raise")) << helps.front();
    if (part == POSE_WALL_PART_EXTRAPOLATION) {
      EXPECT_TRUE(contains(helps.front(), "mount the sensor")) << helps.front();
      EXPECT_TRUE(contains(helps.front(), "s_front")) << helps.front();
    }
  }
}

}  // namespace
}  // namespace pose_wall::tools::explain
