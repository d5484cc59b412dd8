// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The language of everything a person reads: sentences, tables, messages, help. English stands in the source, and each
// translation in a catalogue zh/*.po (GNU gettext's format, so that Poedit and others edit it). Columns of CSV
// and members of JSON have no language.
//
//   fmt::print("{}", say("{} frames, {:.1f} s", frames, seconds_s));       translated, then filled in
//   constexpr Row kRows[] = {{"leaf", translatable("Voxels grew to {}.")}};  translated where it is used: tr(row.text)
//
// tests/checks/check_translations.py finds texts that a catalogue lacks, has in vain, or fills in otherwise.

#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace pose_wall::tools {

enum class Language { kEnglish, kChinese };

// Of this process; English until it is chosen. Choose it once, before threads start.
Language language();
void choose_language(Language chosen);

// "en" or "zh".
const char* language_name();

// By the last `--language` of the words that names a language; else by POSE_WALL_LANGUAGE, LC_ALL, LC_MESSAGES or LANG,
// the first that is set and not empty. Other languages speak English.
Language language_of(int argc, const char* const* argv);

// The text in the chosen language; the English one where the catalogue lacks it. The pointer stays valid.
const char* tr(const char* english);

// Marks a text of a table for the catalogue.
constexpr const char* translatable(const char* english) {
  return english;
}

// Chinese may name the arguments in another order: {1} ... {0}.
template <typename... Args>
std::string say(fmt::format_string<Args...> english, Args&&... args) {
  const fmt::string_view text = english;
  return fmt::vformat(tr(std::string(text.data(), text.size()).c_str()), fmt::make_format_args(args...));
}

struct Translation {
  std::string english, translated;
};
// Every entry of the Chinese catalogues, in their order; for tests.
const std::vector<Translation>& chinese_translations();

}  // namespace pose_wall::tools
