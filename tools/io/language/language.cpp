// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/language/language.hpp"

#include <cstdlib>
#include <string_view>
#include <unordered_map>

#include "io/language/both_languages.hpp"
#include "io/language/language_name.hpp"
#include "io/language/po_catalogue.hpp"

namespace pose_wall::tools {
namespace {

Language& chosen_language() {
  static Language chosen = Language::kEnglish;
  return chosen;
}

constexpr const char* kVariable = "POSE_WALL_LANGUAGE";

// Locales of other languages speak English.
Language named(std::string_view word) {
  return language_named(word).value_or(Language::kEnglish);
}

using Catalogue = std::unordered_map<std::string_view, const char*>;

const Catalogue& chinese() {
  static const Catalogue catalogue = [] {
    Catalogue made;
    for (const Translation& entry : chinese_translations()) made.emplace(entry.english, entry.translated.c_str());
    return made;
  }();
  return catalogue;
}

}  // namespace

const std::vector<Translation>& chinese_translations() {
  static const std::vector<Translation> all = read_po(chinese_catalogues());
  return all;
}

Language language() {
  return chosen_language();
}

void choose_language(Language chosen) {
  chosen_language() = chosen;
}

const char* language_name() {
  return language() == Language::kChinese ? "zh" : "en";
}

Language language_of(int argc, const char* const* argv) {
  for (int i = argc - 1; i > 0; --i) {
    const std::string_view word = argv[i];
    if (word.substr(0, kLanguageOption.size()) != kLanguageOption) continue;
    std::optional<Language> chosen;
    if (word.size() > kLanguageOption.size() && word[kLanguageOption.size()] == '=') {
      chosen = language_named(word.substr(kLanguageOption.size() + 1));
    } else if (word.size() == kLanguageOption.size() && i + 1 < argc) {
      chosen = language_named(argv[i + 1]);
    }
    // A word that names none is refused later, in the language of the environment.
    if (chosen) return *chosen;
  }
  for (const char* variable : {kVariable, "LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* value = std::getenv(variable);
    if (value != nullptr && *value != '\0') return named(value);
  }
  return Language::kEnglish;
}

std::optional<Language> language_named(std::string_view word) {
  std::string name(word.substr(0, word.find_first_of("_-.@")));
  for (char& letter : name) letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  if (name == "zh" || name == "cn") return Language::kChinese;
  if (name == "en" || name == "c" || name == "posix") return Language::kEnglish;
  return std::nullopt;
}

std::string unknown_language_in_environment() {
  const char* value = std::getenv(kVariable);
  const bool is_unknown = value != nullptr && *value != '\0' && !language_named(value);
  return is_unknown ? value : "";
}

const char* tr(const char* english) {
  return tr(language(), english);
}

const char* tr(Language language, const char* english) {
  if (language == Language::kEnglish) return english;
  const auto found = chinese().find(english);
  return found == chinese().end() ? english : found->second;
}

}  // namespace pose_wall::tools
