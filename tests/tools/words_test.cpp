// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, walking over all verbs and options there are: every verb has an example that it would take; every mistyped
// verb, option, choice, key, scene and sensor is answered with the one that was meant; colours and progress are as
// documented; the completion of bash offers what the parser knows.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "apps/command_line/completion.hpp"
#include "apps/command_line/man_page.hpp"
#include "io/terminal/colours.hpp"
#include "io/terminal/progress_bar.hpp"
#include "io/terminal/shell_word.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// Two neighbours change places, the usual slip; the first letter is seldom wrong.
std::string mistyped(std::string word) {
  for (std::size_t i = word.find_first_not_of('-') + 1; i + 1 < word.size(); ++i) {
    if (word[i] == word[i + 1] || word[i] == '=' || word[i + 1] == '=') continue;
    std::swap(word[i], word[i + 1]);
    return word;
  }
  return word + "x";
}

std::string long_name(const OptionGrammar& option) {
  return option.names.back();
}

// The words without which the verb would say that something is missing.
std::vector<std::string> needed_words(const VerbGrammar& verb, const TempFolder& folder) {
  std::vector<std::string> words = {verb.name};
  for (const OptionGrammar& option : verb.options) {
    if (!option.is_required && option.names.back() != "--output") continue;
    if (!option.is_positional) words.push_back(long_name(option));
    words.push_back(option.is_positional ? folder.file("good.bin") : folder.file("output"));
    if (!option.choices.empty()) words.back() = option.choices.front();
    if (option.kind == ValueKind::kNumber) words.back() = "1";
  }
  return words;
}

TEST(Words, EveryVerbHasAnExampleThatItWouldTake) {
  const CommandGrammar grammar = command_grammar();
  ASSERT_GE(grammar.verbs.size(), 9U);
  for (const VerbGrammar& verb : grammar.verbs) {
    const Ran help = command({verb.name, "--help"});
    EXPECT_EQ(help.exit_status, 0) << verb.name;
    EXPECT_TRUE(contains(help.printed, "Example")) << verb.name;
    EXPECT_TRUE(contains(help.printed, "\n  pose_wall " + verb.name) ||
                contains(help.printed, "pose_wall " + verb.name + " "))
        << verb.name;
    // Options in examples are options that are there.
    std::istringstream lines(help.printed.substr(std::min(help.printed.find("Example"), help.printed.size())));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("  pose_wall ", 0) != 0) continue;
      std::istringstream words(line);
      std::string word, of;
      words >> word >> of;
      const auto shown = std::find_if(grammar.verbs.begin(), grammar.verbs.end(),
                                      [&of](const VerbGrammar& v) { return v.name == of; });
      ASSERT_NE(shown, grammar.verbs.end()) << line;
      while (words >> word) {
        if (word[0] != '-' || word.size() < 2) continue;
        const bool is_known = std::any_of(shown->options.begin(), shown->options.end(), [&word](const auto& option) {
          return std::find(option.names.begin(), option.names.end(), word) != option.names.end();
        });
        EXPECT_TRUE(is_known) << word << " in: " << line;
      }
    }
  }
}

TEST(Words, AMistypedVerbOrOptionIsAnswered) {
  const TempFolder folder;
  folder.write("good.bin", std::string(16, '\0'));
  for (const VerbGrammar& verb : command_grammar().verbs) {
    EXPECT_TRUE(test::says(command({mistyped(verb.name)}), 2, "did you mean '" + verb.name + "'"));
    for (const OptionGrammar& option : verb.options) {
      if (option.is_positional || long_name(option).size() < 6) continue;
      std::vector<std::string> words = needed_words(verb, folder);
      words.push_back(mistyped(long_name(option)));
      const Ran ran = command(words);
      EXPECT_EQ(ran.exit_status, 2) << words.back();
      EXPECT_TRUE(contains(ran.errors, "did you mean '" + long_name(option) + "'"))
          << verb.name << " " << words.back() << ": " << ran.errors;
    }
  }
  EXPECT_TRUE(contains(command({"--verison"}).errors, "did you mean '--version'"));
}

TEST(Words, AMistypedChoiceKeySceneOrSensorIsAnswered) {
  const TempFolder folder;
  folder.write("good.bin", std::string(16, '\0'));
  std::size_t asked = 0;
  for (const VerbGrammar& verb : command_grammar().verbs) {
    for (const OptionGrammar& option : verb.options) {
      for (const std::string& word : value_words(option)) {
        if (option.is_positional || word.size() < 5) continue;
        std::vector<std::string> words = needed_words(verb, folder);
        words.push_back(long_name(option));
        words.push_back(mistyped(word) + (word.back() == '=' ? "1" : ""));
        const std::string meant = word.substr(0, word.find('='));
        const Ran ran = command(words);
        EXPECT_EQ(ran.exit_status, 2) << verb.name << " " << words.back();
        EXPECT_TRUE(contains(ran.errors, "did you mean '")) << verb.name << " " << words.back() << ": " << ran.errors;
        ++asked;
        if (option.kind != ValueKind::kChoice && asked % 7 != 0) continue;  // the nearest may be another: few twins
        EXPECT_TRUE(contains(ran.errors, "did you mean '" + meant) || contains(ran.errors, meant)) << ran.errors;
      }
    }
  }
  EXPECT_GT(asked, 500U);
}

TEST(Words, QuietVerbsSayWhatTheyDoOfIt) {
  std::size_t quiet = 0;
  for (const VerbGrammar& verb : command_grammar().verbs) {
    for (const OptionGrammar& option : verb.options) {
      if (long_name(option) != "--quiet") continue;
      EXPECT_EQ(option.names.front(), "-q") << verb.name;
      EXPECT_EQ(option.help.rfind("Nothing on stderr but errors", 0), 0U) << verb.name << ": " << option.help;
      ++quiet;
    }
  }
  EXPECT_GE(quiet, 6U) << "run, sim, demo, report, campaign, replay-box";
}

TEST(Words, WhatIsSaidToNameTheScenesDoes) {
  EXPECT_TRUE(contains(command({"demo", "--help"}).printed, "see pose_wall sim --list"));
  EXPECT_TRUE(contains(command({"sim", "--list"}).printed, "steel_sets"));
}

TEST(Words, AQuietDemoSaysNothing) {
  const TempFolder folder;
  const Ran quiet = command({"demo", "-q", "-n", "1", "--sensor", "vlp16", "-o", folder.file("out")});
  EXPECT_EQ(quiet.exit_status, 0);
  EXPECT_EQ(quiet.printed, "");
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/demo.svg")));
}

TEST(Colours, OnATerminalOnlyAndNeverWithNoColor) {
  EXPECT_TRUE(wants_colours(true, nullptr, "xterm"));
  EXPECT_TRUE(wants_colours(true, "", nullptr)) << "empty is as if not set";
  EXPECT_FALSE(wants_colours(false, nullptr, "xterm"));
  EXPECT_FALSE(wants_colours(true, "1", "xterm"));
  EXPECT_FALSE(wants_colours(true, nullptr, "dumb"));
}

TEST(Progress, ShowsRateAndTimeLeft) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(200.0), "3 min 20 s");
  EXPECT_EQ(duration_text(7500.0), "2 h 05 min");
  ::testing::internal::CaptureStderr();
  {
    ProgressBar bar(10, true, "events");
    bar.advance("first");
  }
  const std::string line = ::testing::internal::GetCapturedStderr();
  EXPECT_TRUE(contains(line, "1/10") && contains(line, " events/s") && contains(line, " s left")) << line;
  ::testing::internal::CaptureStderr();
  ProgressBar(10, false).advance("");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// What bash offers behind these words, the last of them half typed. Words as bash takes them apart.
std::string offered(const TempFolder& folder, const std::vector<std::string>& words) {
  std::string script = "source " + folder.file("words.bash") + "\nCOMP_WORDS=(pose_wall";
  for (const std::string& word : words) script += " " + shell_quoted(word);
  script += ")\nCOMP_CWORD=" + std::to_string(words.size()) + "\n_pose_wall\necho \"${COMPREPLY[*]}\"\n";
  const std::string file = folder.write("ask.bash", script);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> bash(popen(("bash -eu " + file + " 2>&1").c_str(), "r"),
                                                             pclose);
  std::array<char, 4096> part{};
  std::string answer;
  while (std::fgets(part.data(), part.size(), bash.get()) != nullptr) answer += part.data();
  return answer.substr(0, answer.find_last_not_of('\n') + 1);
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

TEST(Completion, BashOffersWhatTheParserKnows) {
  const TempFolder folder;
  const CommandGrammar grammar = command_grammar();
  folder.write("words.bash", bash_completion(grammar));
  std::vector<std::string> verbs;
  for (const VerbGrammar& verb : grammar.verbs) {
    verbs.push_back(verb.name);
    std::vector<std::string> options;
    for (const OptionGrammar& option : verb.options) {
      for (const std::string& name : option.names) {
        if (name.rfind("--", 0) == 0) options.push_back(name);
      }
    }
    EXPECT_EQ(offered(folder, {verb.name, "--"}), joined(options)) << verb.name;
  }
  EXPECT_EQ(offered(folder, {""}), joined(verbs) + " -h --help --version --language");
}

TEST(Completion, BashOffersValuesOfOptions) {
  const TempFolder folder;
  folder.write("words.bash", bash_completion(command_grammar()));
  EXPECT_EQ(offered(folder, {"run", "--format", ""}), "csv json");
  EXPECT_EQ(offered(folder, {"run", "--format", "=", "j"}), "json");
  EXPECT_EQ(offered(folder, {"run", "--format=j"}), "--format=json") << "where '=' takes no words apart";
  EXPECT_EQ(offered(folder, {"run", "--set", "voxel_l"}), "voxel_leaf=");
  EXPECT_EQ(offered(folder, {"check-config", "-s", "voxel_l"}), "voxel_leaf=");
  EXPECT_EQ(offered(folder, {"run", "--set", "forward_axis", "="}), "+X -X +Y -Y");
  EXPECT_EQ(offered(folder, {"run", "--set", "forward_axis", "=", "-"}), "-X -Y");
  EXPECT_EQ(offered(folder, {"run", "--set", "=", "forward_axis", "=", "-"}), "-X -Y");
  EXPECT_EQ(offered(folder, {"run", "-s", "forward_axis=+"}), "forward_axis=+X forward_axis=+Y");
  EXPECT_EQ(offered(folder, {"sim", "--set", "turn_r"}), "turn_rate_dps=") << "a key of the simulator";
  EXPECT_EQ(offered(folder, {"sim", "--set", "voxel_l"}), "");
  EXPECT_EQ(offered(folder, {"sim", "--scene", "clea"}), "clean");
  EXPECT_EQ(offered(folder, {"campaign", "--scenes", "rough,clea"}), "rough,clean");
  EXPECT_EQ(offered(folder, {"campaign", "--sweep", "wall_lea"}), "wall_lean=");
  EXPECT_EQ(offered(folder, {"demo", "--sensor", "vl"}), "vlp16");
  EXPECT_EQ(offered(folder, {"completion", ""}), "bash zsh fish");
  EXPECT_EQ(offered(folder, {"run", "-c", "pose"}), "") << "files are the shell's own";
  EXPECT_EQ(offered(folder, {"run", "--quiet", "fra"}), "") << "a flag takes no value";
}

TEST(ManPage, SignsOfTheSourceAreNoCommands) {
  EXPECT_EQ(roff_text(".TH 'a' \\n"), "\\&.TH \\(aqa\\(aq \\en");
  EXPECT_EQ(roff_text("--set -2°"), "\\-\\-set \\-2\\[u00B0]");
  const CommandGrammar grammar = command_grammar();
  const std::string page = man_page(grammar, "What it is.", "1.2");
  for (const VerbGrammar& verb : grammar.verbs) {
    EXPECT_TRUE(contains(page, "\n.SS " + roff_text(verb.name) + "\n")) << verb.name;
  }
  EXPECT_TRUE(contains(page, "\\fBvoxel_leaf\\fR"));
  EXPECT_TRUE(std::all_of(page.begin(), page.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
}

}  // namespace
}  // namespace pose_wall::tools
