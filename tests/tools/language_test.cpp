// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which language is chosen, how catalogues are read, and how Chinese is laid out. That each text has its Chinese is
// shown by tests/checks/check_translations.py.

#include "io/language/language.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "io/language/language_name.hpp"
#include "io/language/po_catalogue.hpp"
#include "io/language/retold.hpp"
#include "io/terminal/text_table.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

class LanguageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"POSE_WALL_LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"}) unsetenv(name);
  }
  void TearDown() override { choose_language(Language::kEnglish); }

  static Language of(std::vector<const char*> words) {
    words.insert(words.begin(), "pose_wall");
    return language_of(static_cast<int>(words.size()), words.data());
  }
};

TEST_F(LanguageTest, TheOptionGoesBeforeTheEnvironment) {
  EXPECT_EQ(of({"run"}), Language::kEnglish);
  EXPECT_EQ(of({"run", "--language", "zh"}), Language::kChinese);
  EXPECT_EQ(of({"--language=zh", "run"}), Language::kChinese);
  EXPECT_EQ(of({"--language=zh", "run", "--language", "en"}), Language::kEnglish);
  EXPECT_EQ(of({"run", "--language"}), Language::kEnglish);
  setenv("LANG", "zh_CN.UTF-8", 1);
  EXPECT_EQ(of({"run"}), Language::kChinese);
  setenv("LC_ALL", "C", 1);
  EXPECT_EQ(of({"run"}), Language::kEnglish);
  setenv("POSE_WALL_LANGUAGE", "zh", 1);
  EXPECT_EQ(of({"run"}), Language::kChinese);
  EXPECT_EQ(of({"run", "--language", "en"}), Language::kEnglish);
}

TEST_F(LanguageTest, ChineseHasSeveralNames) {
  for (const char* word : {"zh", "zh_CN", "zh-CN.UTF-8", "cn", "CN", "ZH"}) {
    EXPECT_EQ(of({"run", "--language", word}), Language::kChinese) << word;
    setenv("POSE_WALL_LANGUAGE", word, 1);
    EXPECT_EQ(of({"run"}), Language::kChinese) << word;
    EXPECT_EQ(unknown_language_in_environment(), "") << word;
  }
}

TEST_F(LanguageTest, AnUnknownLanguageIsNamed) {
  EXPECT_EQ(unknown_language_in_environment(), "");
  setenv("LANG", "de_DE.UTF-8", 1);
  EXPECT_EQ(unknown_language_in_environment(), "") << "locales of other languages speak English";
  setenv("POSE_WALL_LANGUAGE", "chn", 1);
  EXPECT_EQ(of({"run"}), Language::kEnglish);
  EXPECT_EQ(unknown_language_in_environment(), "chn");
}

TEST_F(LanguageTest, TextsWithoutTranslationStayEnglish) {
  choose_language(Language::kChinese);
  EXPECT_STREQ(tr("no catalogue holds this"), "no catalogue holds this");
  EXPECT_EQ(say("no catalogue holds {} of {:.1f}", 3, 2.0), "no catalogue holds 3 of 2.0");
}

TEST_F(LanguageTest, EveryChineseTextIsUsedInChineseAlone) {
  ASSERT_FALSE(chinese_translations().empty());
  for (const Translation& entry : chinese_translations()) {
    choose_language(Language::kEnglish);
    EXPECT_EQ(tr(entry.english.c_str()), entry.english);
    choose_language(Language::kChinese);
    EXPECT_EQ(tr(entry.english.c_str()), entry.translated);
  }
}

TEST(Retold, FindsWholeTextsFormsAndSentences) {
  const auto zh = [](const char* english) { return retold(Language::kChinese, english); };
  EXPECT_EQ(retold(Language::kEnglish, "measures"), "measures");
  EXPECT_EQ(zh("measures"), "正在测量");
  EXPECT_EQ(zh("measures; times of points are of no use"), "正在测量；点的时间不可用");
  EXPECT_EQ(zh("packets come, none is of sensor 'vlp16': is another one there?"),
            "有数据包，但都不是“vlp16”的：接的是另一种传感器吗？");
  EXPECT_EQ(zh("measures; changed 294 more times in 30 s"), "正在测量；30 秒内又变化 294 次") << "another order";
  EXPECT_EQ(zh("place: unique; the floor is not at planar_floor_z"), "位置：唯一；底板不在 planar_floor_z 处");
  EXPECT_EQ(zh("pauses: No space left on device"), "暂停：磁盘已满") << "what is filled in has its Chinese, too";
  EXPECT_EQ(zh("a thing in the way, low"), "前方有障碍物、低矮");
}

TEST(Retold, LeavesWhatItDoesNotKnow) {
  for (const char* text : {"", "-", "1203", "16#1234ABCD", "no catalogue holds this", "/var/lib/x.mcap", "{", "x: y"}) {
    EXPECT_EQ(retold(Language::kChinese, text), text);
  }
}

TEST(PoCatalogue, ReadsTextsOverSeveralLinesAndPassesOverWhatIsNotTranslated) {
  const std::vector<Translation> read = read_po(
      "# note\nmsgid \"\"\nmsgstr \"\"\n\"Language: zh\\n\"\n\n"
      "msgid \"\"\n\"one \"\n\"{}\\n\"\nmsgstr \"一 {}\\n\"\n\n"
      "msgid \"two\"\nmsgstr \"\"\n\nmsgid \"a \\\"b\\\"\"\nmsgstr \"甲\\\\\"\n");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].english, "one {}\n");
  EXPECT_EQ(read[0].translated, "一 {}\n");
  EXPECT_EQ(read[1].english, "a \"b\"");
  EXPECT_EQ(read[1].translated, "甲\\");
}

TEST(PoCatalogue, RefusesWhatItWouldMisread) {
  for (const char* text :
       {"msgid one", "msgstr \"x\"", "msgid \"a\\q\"", "msgid_plural \"x\"", "\"alone\"", "msgid \"a"}) {
    EXPECT_THROW(read_po(text), std::invalid_argument) << text;
  }
  const std::string said = test::said_by<std::invalid_argument>([] { read_po("# first\n\nmsgid_plural \"x\"\n"); });
  EXPECT_NE(said.find("line 3"), std::string::npos) << said;
}

TEST(TextWidth, ChineseSignsAreAsWideAsTwoLetters) {
  EXPECT_EQ(shown_width("左墙 d"), 6U);
  EXPECT_EQ(shown_width("°±Å"), 3U);
  EXPECT_EQ(shown_width("，"), 2U);
  TextTable table({"墙", "m"});
  table.add_row({"ab", "1"});
  EXPECT_EQ(table.text(), "墙  m\n--  -\nab  1\n");
}

TEST(TextWidth, ChineseLinesEndBetweenSignsAndNeverBeforePunctuation) {
  EXPECT_EQ(wrapped("地面点不足，无法拟合", 0, 10), "地面点不\n足，无法拟\n合\n");
  EXPECT_EQ(wrapped("a wall here", 2, 6), "  a wall\n  here\n");
  EXPECT_EQ(wrapped("参见 pose_wall --help", 0, 12), "参见\npose_wall\n--help\n");
}

}  // namespace
}  // namespace pose_wall::tools
