// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/next_steps.hpp"

#include "io/language/language.hpp"
#include "io/terminal/program_word.hpp"
#include "io/terminal/shell_word.hpp"
#include "study/info/wide_text.hpp"

namespace pose_wall::tools {

std::string next_steps_text(const std::vector<NextStep>& steps) {
  if (steps.empty()) return "";
  std::string text = std::string(tr("Next:")) + "\n";
  for (const NextStep& step : steps) {
    text += wrapped_behind("  # ", step.why, kLineWidth);
    text += "  " + program_word();
    for (const std::string& word : step.words) text += " " + shell_word(word);
    text += "\n";
  }
  return text;
}

std::vector<std::string> input_words(const std::vector<std::string>& inputs, const InputOptions& options) {
  std::vector<std::string> words;
  const auto add = [&words](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--topic", options.topic);
  add("--source", options.source);
  add("--sensor", options.packets.sensor);
  add("--metadata", options.packets.metadata);
  words.insert(words.end(), inputs.begin(), inputs.end());
  return words;
}

}  // namespace pose_wall::tools
