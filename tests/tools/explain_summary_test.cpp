// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the summary counts states, reasons and stretches as the frames have them, and names the worst frame. Its
// memory is bounded. Its commands explain the frames that they name. A frame is found by number, name or stamp, and a
// fault names what is allowed. Does not prove: that the chosen frames are those that a person would choose.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "bag_files.hpp"
#include "crafted_value.hpp"
#include "english_left.hpp"
#include "pose_wall.hpp"
#include "ran_command.hpp"
#include "study/explain/summary.hpp"
#include "study/explain/summary_text.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::explain {
namespace {

using namespace test;

TEST(ThinnedRow, IsExactForShortRowsAndBoundedForLongOnes) {
  ThinnedRow row;
  EXPECT_TRUE(std::isnan(row.median()));
  for (const double value : {3.0, 1.0, 2.0}) row.add(value);
  EXPECT_EQ(row.median(), 2.0);
  ThinnedRow long_row;
  for (int i = 0; i < 1000000; ++i) long_row.add(static_cast<double>(i));
  EXPECT_NEAR(long_row.median(), 5e5, 1e3);
}

// A frame as the engine would give it: all seven valid unless changed.
pose_wall_result good_frame() {
  pose_wall_result result = api::make_result();
  for (pose_wall_value& value : result.quantity) {
    value = crafted_value(POSE_WALL_VALID, 0.001, 0.001, {0.001, 0.002, 0.0, 0.0, 0.0, 0.0, 0.0});
  }
  return result;
}

pose_wall_result without_left_wall(std::uint32_t reason) {
  pose_wall_result result = good_frame();
  for (const std::uint32_t q : {POSE_WALL_D_LF, POSE_WALL_D_LB}) result.quantity[q] = unmeasured_value();
  result.left.reasons = reason;
  result.quantity[POSE_WALL_D_LF].reasons = reason;
  return result;
}

void add(RecordingSummary* summary, const pose_wall_result& result) {
  FrameOutcome outcome;
  outcome.frame = summary->frames();
  outcome.result = result;
  summary->add(outcome);
}

TEST(RecordingSummary, CountsStatesReasonsAndStretches) {
  const api::Config config;
  RecordingSummary summary(*config.get());
  EXPECT_FALSE(summary.worst());
  add(&summary, good_frame());
  EXPECT_TRUE(summary.is_new(without_left_wall(POSE_WALL_R_WALL_SHORT)));
  summary.add_notes(without_left_wall(POSE_WALL_R_WALL_SHORT), pose_wall_trace{});
  for (int i = 0; i < 3; ++i) add(&summary, without_left_wall(POSE_WALL_R_WALL_SHORT));
  EXPECT_FALSE(summary.is_new(without_left_wall(POSE_WALL_R_WALL_SHORT)));
  EXPECT_TRUE(summary.is_new(without_left_wall(POSE_WALL_R_WALL_LEANS))) << "a reason that no notes were read of";
  summary.add(FrameOutcome{});  // could not be read
  for (int i = 0; i < 2; ++i) add(&summary, without_left_wall(POSE_WALL_R_WALL_SEEN_THROUGH));

  EXPECT_EQ(summary.frames(), 7U);
  EXPECT_EQ(summary.unreadable(), 1U);
  const QuantitySummary& left = summary.quantities()[POSE_WALL_D_LF];
  EXPECT_EQ(left.states[POSE_WALL_INVALID], 5U);
  EXPECT_EQ(left.states[POSE_WALL_VALID], 1U);
  EXPECT_EQ(left.cause(), static_cast<std::uint32_t>(POSE_WALL_PART_RANGE_BIAS));
  EXPECT_NEAR(left.levels.median(), 0.003, 1e-12);
  std::string told;
  for (const Stretch& s : summary.longest_stretches(10)) {
    told += std::to_string(s.first) + "-" + std::to_string(s.last) + " " + story_words(s.story) + "\n";
  }
  EXPECT_EQ(told,
            "0-0 all seven values valid\n1-3 left wall refused (wall_short)\n4-4 could not be read\n"
            "5-6 left wall refused (wall_seen_through)\n");
  EXPECT_EQ(summary.longest_stretches(1).at(0).first, 1U);
  EXPECT_EQ(summary.stories().front().frames, 5U);
  EXPECT_EQ(summary.stories().front().first, 1U);
  const std::string text = summary_text(summary, "pose_wall explain road");
  for (const char* part : {"7 frames; 1 of them could not be read", "wall_short", "1–3",
                           "left wall refused (wall_short)", "pose_wall explain road --frame 1\n"}) {
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  }
}

TEST(RecordingSummary, TheWorstHasTheLowestStatesAndThenTheLargestLevel) {
  const api::Config config;
  RecordingSummary summary(*config.get());
  add(&summary, good_frame());
  EXPECT_EQ(summary.worst()->frame, 0U);
  pose_wall_result wide = good_frame();
  wide.quantity[POSE_WALL_D_RF] = crafted_value(POSE_WALL_DEGRADED, 2.0, 2.0, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(summary.is_worst(wide));
  add(&summary, wide);
  pose_wall_result wider = good_frame();
  wider.quantity[POSE_WALL_D_RF] = crafted_value(POSE_WALL_DEGRADED, 2.0, 2.0, {3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  add(&summary, wider);
  EXPECT_EQ(summary.worst()->frame, 2U);
  add(&summary, without_left_wall(POSE_WALL_R_WALL_SHORT));
  EXPECT_EQ(summary.worst()->frame, 3U);
  EXPECT_EQ(summary.widest()->frame, 2U);
  EXPECT_EQ(summary.widest()->widest, static_cast<std::uint32_t>(POSE_WALL_D_RF));
  EXPECT_FALSE(summary.is_worst(wider)) << "the first of equals stays";
  const std::vector<FrameToSee> frames = frames_to_see(summary);
  EXPECT_EQ(frames.front().frame, 3U);
  EXPECT_EQ(frames.front().why.size(), 2U) << "it is the first of its story, too";
}

TEST(RecordingSummary, AStretchHasAReasonInCommonAndNamesThoseOfSomeFrames) {
  const api::Config config;
  RecordingSummary summary(*config.get());
  for (const std::uint32_t more : {0U, std::uint32_t{POSE_WALL_R_WALL_LEANS}, 0U}) {
    add(&summary, without_left_wall(POSE_WALL_R_WALL_SHORT | more));
  }
  add(&summary, without_left_wall(POSE_WALL_R_WALL_LEANS));
  const std::vector<Stretch> stretches = summary.longest_stretches(10);
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_EQ(stretches[0].last, 2U);
  EXPECT_EQ(story_words(stretches[0].story), "left wall refused (wall_short; at times wall_leans)");
  EXPECT_EQ(story_words(stretches[1].story), "left wall refused (wall_leans)");
  ASSERT_EQ(summary.stories().size(), 1U);
  EXPECT_EQ(story_words(summary.stories()[0].story), "left wall refused (at times wall_short, wall_leans)");
}

TEST(RecordingSummary, StretchesAreBoundedAndTheLongestStay) {
  const api::Config config;
  RecordingSummary summary(*config.get());
  for (int i = 0; i < 3; ++i) add(&summary, good_frame());
  for (std::uint32_t i = 0; i < 10000; ++i) {
    add(&summary, without_left_wall(i % 2 == 0 ? POSE_WALL_R_WALL_SHORT : POSE_WALL_R_WALL_LEANS));
  }
  EXPECT_EQ(summary.stretch_count(), 10001U);
  EXPECT_LE(summary.longest_stretches(100000).size(), 4001U);
  EXPECT_EQ(summary.longest_stretches(1).at(0).frames(), 3U);
}

// Six frames; of frames 3 and 4 the floor gives no return.
struct MixedRoad {
  MixedRoad() {
    for (const char* scene : {"clean", "no_floor"}) {
      EXPECT_EQ(command({"sim", "-q", "--scene", scene, "--sensor", "vlp16", "-n", "6", "-o", folder.file(scene)})
                    .exit_status,
                0);
    }
    for (const char* name : {"000003.pcd", "000004.pcd"}) {
      std::filesystem::copy_file(folder.file(std::string("no_floor/frames/") + name), frames() + "/" + name,
                                 std::filesystem::copy_options::overwrite_existing);
    }
  }
  std::string frames() const { return folder.file("clean/frames"); }
  std::string settings() const { return folder.file("clean/pose_wall.yaml"); }
  Ran explain(const std::vector<std::string>& more) const {
    return command({"explain", "-q", "-c", settings(), frames()}, more);
  }
  nlohmann::json page(const std::vector<std::string>& more) const {
    std::vector<std::string> words = more;
    words.emplace_back("--json");
    const Ran ran = explain(words);
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    return nlohmann::json::parse(ran.printed);
  }

  TempFolder folder;
};

TEST(ExplainDigest, NamesTheStretchWithoutFloorAndItsWorstFrame) {
  const MixedRoad road;
  const nlohmann::json page = road.page({});
  const nlohmann::json& summary = page.at("digest");
  EXPECT_EQ(summary.at("frames"), 6);
  bool found = false;
  for (const nlohmann::json& s : summary.at("stretches")) {
    if (s.at("story").at("kind") != "floor_refused") continue;
    found = true;
    EXPECT_EQ(s.at("first"), 3);
    EXPECT_EQ(s.at("last"), 4);
  }
  EXPECT_TRUE(found) << summary;
  bool gates_named = false;
  for (const nlohmann::json& reason : summary.at("reasons")) {
    if (reason.at("reason") != "floor_not_found") continue;
    EXPECT_EQ(reason.at("frames"), 2);
    gates_named = !reason.at("gates").empty();
  }
  EXPECT_TRUE(gates_named) << summary;
  const int worst = page.at("worst_frame").at("frame");
  EXPECT_TRUE(worst == 3 || worst == 4) << worst;
  for (const nlohmann::json& to_see : summary.at("frames_to_look_at")) {
    std::istringstream command_line(to_see.at("command").get<std::string>());
    std::vector<std::string> words;
    for (std::string word; command_line >> word;) words.push_back(word);
    ASSERT_EQ(words.at(0), "pose_wall");
    words.erase(words.begin());
    words.insert(words.end(), {"-q", "--json"});
    EXPECT_EQ(nlohmann::json::parse(command(words).printed).at("frame"), to_see.at("frame")) << to_see;
  }
  EXPECT_EQ(road.page({"--frame", "worst"}), page.at("worst_frame"));
  EXPECT_EQ(road.page({"--frame", std::to_string(worst)}), page.at("worst_frame"));
}

TEST(ExplainDigest, TextHasItsPartsAndTheCommandsOfTheFrames) {
  const MixedRoad road;
  const Ran ran = road.explain({"--set", "wall_length_min=1.5", "--picture", road.folder.file("worst.svg")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  for (const char* part : {"6 frames\n", "median level", "gates behind it", "Stretches of frames alike", "3–4",
                           "floor refused (floor_not_found)", "Frames worth a look", "The worst of 6 frames is frame ",
                           "Planes that were considered"}) {
    EXPECT_TRUE(contains(ran.printed, part)) << part << "\n" << ran.printed;
  }
  EXPECT_TRUE(contains(test::text_of(road.folder.file("worst.svg")), "floor refused"));
  const std::string command_line =
      "pose_wall explain --config " + road.settings() + " --set wall_length_min=1.5 " + road.frames() + " --frame ";
  EXPECT_TRUE(contains(ran.printed, command_line)) << ran.printed;
}

TEST(ExplainDigest, InChineseNoEnglishIsLeft) {
  const MixedRoad road;
  const test::EnglishAfterwards english;
  const Ran ran = road.explain({"--language", "zh"});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  for (const char* part :
       {"6 帧\n", "保护级中位数", "3–4（2 帧）：底板被拒绝（floor_not_found", "值得查看的帧", "6 帧中最差的是第 "}) {
    EXPECT_TRUE(contains(ran.printed, part)) << part << "\n" << ran.printed;
  }
  EXPECT_EQ(test::english_in(ran.printed), "");
}

TEST(ExplainDigest, UnreadableFramesAreCountedAndNothingReadableIsAFault) {
  const MixedRoad road;
  road.folder.write("clean/frames/000001.pcd", "no cloud");
  const Ran ran = road.explain({});
  EXPECT_EQ(ran.exit_status, 1);
  EXPECT_TRUE(contains(ran.printed, "6 frames; 1 of them could not be read")) << ran.printed;
  EXPECT_TRUE(contains(ran.errors, "000001.pcd")) << ran.errors;
  EXPECT_TRUE(
      test::says(command({"explain", "-q", road.folder.file("clean/frames/000001.pcd")}), 1, "no frame could be read"));
}

TEST(FrameChoice, AFrameIsFoundByNameOrStamp) {
  const MixedRoad road;
  const nlohmann::json page = road.page({"--frame", "4"});
  EXPECT_EQ(road.page({"--frame", "000004.pcd"}), page);
  EXPECT_EQ(road.page({"--frame", "frames/000004.pcd"}), page);
  EXPECT_EQ(road.page({"--stamp", "+0.4"}), page);
  EXPECT_EQ(road.page({"--stamp", "1000.43"}), page);
  EXPECT_EQ(road.page({"--stamp", "0001000400000001"}), page) << "nanoseconds, as in the CSV";
  EXPECT_EQ(road.page({"--stamp", "1000400000001"}), page) << "however few digits";
  const Ran stamp = road.explain({"--stamp", "1000.43"});
  EXPECT_TRUE(contains(stamp.printed, "The nearest stamp is 1000.400 s, -0.030 s off: frame 4")) << stamp.printed;
  EXPECT_TRUE(contains(road.explain({"--frame", "000004.pcd"}).printed, "000004.pcd is frame 4."));
}

// Clouds of two points: no frame has enough, and all are alike.
TEST(FrameChoice, FramesOfABagHaveNamesAndStampsToo) {
  const TempFolder folder;
  std::vector<test::WrittenMessage> messages;
  for (std::uint32_t i = 0; i < 3; ++i) {
    test::CloudMessage cloud;
    cloud.nsec = 100000000 * i;
    messages.push_back({0, test::ros1_message(cloud)});
  }
  const std::string bag = folder.write("road.bag", test::ros1_bag({{"/lidar", "sensor_msgs/PointCloud2"}}, messages));
  const auto frame_of = [&](const std::vector<std::string>& choice) {
    const Ran ran = command({"explain", "-q", "--json", bag}, choice);
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    return nlohmann::json::parse(ran.printed);
  };
  EXPECT_EQ(frame_of({"--frame", "road.bag#1"}).at("frame"), 1);
  EXPECT_EQ(frame_of({"--stamp", "1700000000.19"}).at("frame"), 2);
  EXPECT_EQ(frame_of({"--stamp", "1700000000100000000"}).at("frame"), 1);
  EXPECT_EQ(frame_of({}).at("digest").at("stories").at(0).at("story").at("kind"), "frame_refused");
  EXPECT_TRUE(test::says(command({"explain", "-q", bag, "--frame", "road.bag#7"}), 2, "(road.bag#0 to road.bag#2)"));
}

TEST(FrameChoice, FaultsNameWhatIsAllowed) {
  const MixedRoad road;
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"--frame", "6"}, "there are 6 frames, 0 to 5"},
      {{"--frame", "-1"}, "allowed: a number from 0 to 5"},
      {{"--frame", "000009.pcd"}, "the name of a frame (000000.pcd to 000005.pcd), worst"},
      {{"--frame", "00003.pcd"}, "did you mean '000003.pcd'"},
      {{"--frame", "000003.pcd", road.folder.file("no_floor/frames")}, "2 frames have this name"},
      {{"--stamp", "1700000000.5"}, "run from 1000.000 s to 1000.500 s"},
      {{"--stamp", "noon"}, "'noon' is no stamp; allowed: seconds"},
      {{"--stamp", "1", "--frame", "1"}, "--frame and --stamp exclude each other"},
  };
  for (const auto& [words, part] : cases) EXPECT_TRUE(test::says(road.explain(words), 2, part));
}

}  // namespace
}  // namespace pose_wall::tools::explain
