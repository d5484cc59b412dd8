// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every gate, name and reason that explain may print has its Chinese, and sentences are joined without spaces.
// Does not prove: that the Chinese is good.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "english_left.hpp"
#include "io/language/engine_words.hpp"
#include "pose_wall.hpp"
#include "ran_command.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/gate_list_texts.hpp"
#include "study/explain/gate_words.hpp"
#include "study/explain/outcome_words.hpp"
#include "study/explain/prose.hpp"
#include "study/explain/story.hpp"

namespace pose_wall::tools::explain {
namespace {

using namespace test;

class ExplainInChinese : public ::testing::Test {
 protected:
  void SetUp() override { choose_language(Language::kChinese); }
  void TearDown() override { choose_language(Language::kEnglish); }
};

TEST_F(ExplainInChinese, TheFinderOfEnglishFindsIt) {
  EXPECT_EQ(english_in("地面：the floor bends，允许 0.1 m"), "the floor bends");
  EXPECT_EQ(english_in("检查 extrinsic_roll、--frame 和 road/pose_wall.yaml"), "");
}

TEST_F(ExplainInChinese, EveryGateHasItsSentenceHelpAndRowInTheList) {
  for (std::uint32_t gate = 0; gate < POSE_WALL_TRACE_GATES; ++gate) {
    Note note{{POSE_WALL_TRACE_QUANTITY, gate, 0, 0, 0.5, 0.25}, {}};
    ASSERT_EQ(pose_wall_trace_gate_info(gate, &note.info), POSE_WALL_OK);
    const std::string said = sentence_of(note), help = help_of(note);
    EXPECT_TRUE(contains(said, "。")) << note.info.name << ": " << said;
    EXPECT_FALSE(contains(said, "。 ")) << note.info.name << ": " << said;
    EXPECT_EQ(english_in(said + help), "") << note.info.name;
    EXPECT_NE(std::string(tr(note.info.asks)), note.info.asks) << note.info.name;
    const std::string key = std::string(note.info.key).substr(0, std::string(note.info.key).find('|'));
    EXPECT_TRUE(contains(said + help, key)) << note.info.name << ": " << said;
  }
  EXPECT_EQ(english_in(gate_list_text()), "");
  for (const char* unit : {" share ", " points ", " frames ", " steps "}) {
    EXPECT_FALSE(contains(gate_list_text(), unit)) << unit;
  }
}

TEST_F(ExplainInChinese, EveryNameAndReasonOfTheEngineIsTranslated) {
  const auto expect_chinese = [](const std::string& english) { EXPECT_NE(tr(english.c_str()), english); };
  for (std::uint32_t state = 0; state <= POSE_WALL_VALID; ++state) expect_chinese(pose_wall_state_name(state));
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) expect_chinese(part_words(part));
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) expect_chinese(pose_wall_reason_text(bit));
  for (std::uint32_t sense = POSE_WALL_SENSE_UNKNOWN + 1; sense <= POSE_WALL_SENSE_TURNED_RIGHT; ++sense) {
    expect_chinese(pose_wall_sense_name(sense));
  }
}

TEST_F(ExplainInChinese, SentencesAndListsAreJoinedAsChineseIs) {
  EXPECT_EQ(paragraph({"甲。", "", "乙。"}), "甲。乙。");
  EXPECT_EQ(listed({"左墙", "右墙"}), "左墙、右墙");
  EXPECT_EQ(clauses_of(clauses({"甲", "乙"})), (std::vector<std::string>{"甲", "乙"}));
  EXPECT_EQ(frames_text(1), "1 帧");
  EXPECT_EQ(frames_text(12), "12 帧");
  choose_language(Language::kEnglish);
  EXPECT_EQ(paragraph({"A.", "", "B."}), "A. B.");
  EXPECT_EQ(frames_text(1), "1 frame");
  EXPECT_EQ(frames_text(12), "12 frames");
}

TEST_F(ExplainInChinese, AnOutcomeIsWhollyChinese) {
  pose_wall_result result = api::make_result();
  const pose_wall_trace trace{};
  EXPECT_EQ(outcome_sentence(result, Notes(trace), POSE_WALL_YAW).substr(0, 12), "yaw：无效");
}

TEST_F(ExplainInChinese, HelpAndFaultsAreChineseToo) {
  const test::Ran help = command({"explain", "--help", "--language", "zh"});
  EXPECT_EQ(help.exit_status, 0);
  for (const char* part : {"整段记录的摘要", "时间戳最近的一帧", "SVG 文件", "退出码"}) {
    EXPECT_TRUE(contains(help.printed, part)) << part;
  }
  const test::Ran stamp = command({"explain", "--stamp", "noon", "frames", "--language", "zh"});
  EXPECT_EQ(stamp.exit_status, 2);
  EXPECT_TRUE(contains(stamp.errors, "“noon”不是时间戳")) << stamp.errors;
}

}  // namespace
}  // namespace pose_wall::tools::explain
