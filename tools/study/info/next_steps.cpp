// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/info/next_steps.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "io/language/language.hpp"
#include "study/info/wide_text.hpp"

namespace pose_wall::tools {
namespace {

// As a shell takes it for one word.
std::string quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return c >= 0x80U || std::isalnum(c) != 0 ||
           std::string_view("_-./:=+,@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string next_steps_text(const std::vector<NextStep>& steps) {
  if (steps.empty()) return "";
  std::string text = std::string(tr("Next:")) + "\n";
  for (const NextStep& step : steps) {
    text += wrapped_behind("  # ", step.why, kLineWidth);
    text += "  pose_wall";
    for (const std::string& word : step.words) text += " " + quoted(word);
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
