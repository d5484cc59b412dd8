// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/language/retold.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <vector>

#include "io/language/both_languages.hpp"

namespace pose_wall::tools {
namespace {

// With fewer letters of its own an entry ("{}: {}") fits whatever comes.
constexpr std::size_t kLettersLeast = 5;
// What is filled in may be a text in its turn: "refused: " and why.
constexpr int kDepthMost = 4;

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_letter));
}

// A format string: its words, and between each two of them the number of what is filled in.
struct Form {
  std::vector<std::string> words{""};
  std::vector<std::size_t> arguments;
};

// Nothing of one that names its arguments or doubles a brace.
std::optional<Form> form_of(const std::string& text) {
  Form form;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '{' && text[at] != '}') {
      form.words.back() += text[at++];
      continue;
    }
    std::size_t end = at + 1;
    for (int depth = 1; end < text.size() && depth > 0; ++end)
      depth += text[end] == '{' ? 1 : text[end] == '}' ? -1 : 0;
    const std::string inside = text.substr(at + 1, end - at - 2);
    const std::string number = inside.substr(0, inside.find(':'));
    const bool counts_on = number.empty() && text[at] == '{' && text[end - 1] == '}';
    const bool is_told = number.size() == 1 && std::isdigit(static_cast<unsigned char>(number[0])) != 0;
    if (!counts_on && !is_told) return std::nullopt;
    form.arguments.push_back(is_told ? static_cast<std::size_t>(number[0] - '0') : form.arguments.size());
    form.words.emplace_back();
    at = end;
  }
  return form;
}

struct Entry {
  Form english, translated;
  std::size_t letters = 0;
};

// The most letters first: what says more fits better.
const std::vector<Entry>& forms() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> made;
    for (const Translation& entry : chinese_translations()) {
      const std::optional<Form> english = form_of(entry.english), translated = form_of(entry.translated);
      if (!english || !translated || english->arguments.empty()) continue;
      std::size_t letters = 0;
      for (const std::string& words : english->words) letters += letters_of(words);
      if (letters >= kLettersLeast) made.push_back({*english, *translated, letters});
    }
    std::stable_sort(made.begin(), made.end(), [](const Entry& a, const Entry& b) { return a.letters > b.letters; });
    return made;
  }();
  return all;
}

// What stands between the words, or nothing where they do not fit.
std::optional<std::vector<std::string>> filled_in(const Form& form, const std::string& text) {
  const std::string &first = form.words.front(), &last = form.words.back();
  if (text.size() < first.size() + last.size() || text.compare(0, first.size(), first) != 0 ||
      text.compare(text.size() - last.size(), last.size(), last) != 0) {
    return std::nullopt;
  }
  std::vector<std::string> found;
  std::size_t at = first.size();
  for (std::size_t i = 1; i < form.words.size(); ++i) {
    const bool is_last = i + 1 == form.words.size();
    const std::size_t next = is_last ? text.size() - last.size() : text.find(form.words[i], at);
    if (next == std::string::npos || next < at) return std::nullopt;
    found.push_back(text.substr(at, next - at));
    at = next + form.words[i].size();
  }
  return found;
}

std::string retold_within(Language language, const std::string& english, int depth);

std::optional<std::string> by_form(Language language, const std::string& english, int depth) {
  for (const Entry& entry : forms()) {
    const auto found = filled_in(entry.english, english);
    if (!found) continue;
    std::string text = entry.translated.words.front();
    for (std::size_t i = 0; i < entry.translated.arguments.size(); ++i) {
      const std::size_t argument = entry.translated.arguments[i];
      if (argument >= found->size()) return std::nullopt;
      text += retold_within(language, (*found)[argument], depth + 1) + entry.translated.words[i + 1];
    }
    return text;
  }
  return std::nullopt;
}

// Words with commas between, each of which the catalogue has.
std::string list_of(Language language, const std::string& english) {
  std::string text;
  for (std::size_t at = 0; at <= english.size();) {
    const std::size_t end = std::min(english.find(", ", at), english.size());
    const std::string word = english.substr(at, end - at), found = tr(language, word.c_str());
    if (found == word) return english;
    text += (text.empty() ? "" : "、") + found;
    at = end + 2;
  }
  return text;
}

std::string retold_within(Language language, const std::string& english, int depth) {
  if (letters_of(english) == 0 || depth > kDepthMost) return english;
  const std::string whole = tr(language, english.c_str());
  if (whole != english) return whole;
  if (const auto found = by_form(language, english, depth)) return *found;
  if (const std::size_t end = english.find("; "); end != std::string::npos) {
    return retold_within(language, english.substr(0, end), depth + 1) + "；" +
           retold_within(language, english.substr(end + 2), depth + 1);
  }
  // "mqtt: no answer", "a thing in the way, low"
  if (const std::size_t end = english.find(": "); end != std::string::npos) {
    return retold_within(language, english.substr(0, end), depth + 1) + ": " +
           retold_within(language, english.substr(end + 2), depth + 1);
  }
  return list_of(language, english);
}

}  // namespace

std::string retold(Language language, const std::string& english) {
  return language == Language::kEnglish ? english : retold_within(language, english, 0);
}

}  // namespace pose_wall::tools
