// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/live/health_words.hpp"

#include "io/language/both_languages.hpp"
#include "io/language/retold.hpp"

namespace pose_wall::tools::live {
namespace {

// Kinds of parts. The longer ones come first.
constexpr const char* kKinds[] = {
    translatable("planar stop"),
    translatable("planar roadway"),
    translatable("planar command"),
    translatable("commands"),
    translatable("source replay"),
    translatable("source udp"),
    translatable("source ros1"),
    translatable("source ros2"),
    translatable("sink page"),
    translatable("sink recorder"),
    translatable("sink"),
    translatable("part black box"),
    translatable("part runtime"),
    translatable("part config"),
    translatable("part axes"),
    translatable("part motion"),
    translatable("part host clock"),
    translatable("part settings"),
};

// Names and values of facts that are no sentence: elsewhere the same word may mean something else.
[[maybe_unused]] constexpr const char* kWords[] = {
    translatable("fact of"),           translatable("fact type"),         translatable("fact frames"),
    translatable("fact waits"),        translatable("fact commands"),     translatable("fact stops"),
    translatable("value type"),        translatable("value unit"),        translatable("value none"),
    translatable("value good"),        translatable("value none_moving"), translatable("value one_time"),
    translatable("value stop"),        translatable("value slow"),        translatable("value go"),
    translatable("value nothing"),     translatable("value wait"),        translatable("value choice"),
    translatable("value frame"),       translatable("value silence"),     translatable("value callback"),
    translatable("value first"),       translatable("value blind"),       translatable("value tracked"),
    translatable("value refused"),     translatable("value yes"),         translatable("value no"),
    translatable("value since_start"),
};

// The catalogue's word for one of a kind, else its word for it anywhere, else the word.
std::string word_of(Language language, const std::string& kind, const std::string& word) {
  const std::string key = kind + " " + word, found = tr(language, key.c_str());
  return found != key ? found : retold(language, word);
}

}  // namespace

std::string part_words(Language language, const std::string& part) {
  if (language == Language::kEnglish) return part;
  for (const std::string kind : kKinds) {
    const bool is_alone = kind.rfind("part ", 0) == 0;
    const std::string name = is_alone ? kind.substr(5) : kind;
    if (part == name) return tr(language, kind.c_str());
    if (!is_alone && part.rfind(name + " ", 0) == 0) return tr(language, kind.c_str()) + part.substr(name.size());
  }
  return part;
}

std::string grade_words(Language language, Grade grade) {
  static constexpr const char* kNames[] = {translatable("grade ok"), translatable("grade warning"),
                                           translatable("grade error"), translatable("grade stale")};
  return language == Language::kEnglish ? grade_name(grade) : tr(language, kNames[static_cast<int>(grade)]);
}

PartHealth in_language(Language language, const PartHealth& health) {
  if (language == Language::kEnglish) return health;
  PartHealth told = health;
  told.part = part_words(language, health.part);
  told.summary = retold(language, health.summary);
  for (auto& [name, value] : told.facts) {
    const auto known = health.chinese_facts.find(name);
    value = known != health.chinese_facts.end() ? known->second : word_of(language, "value", value);
    name = word_of(language, "fact", name);
  }
  return told;
}

}  // namespace pose_wall::tools::live
