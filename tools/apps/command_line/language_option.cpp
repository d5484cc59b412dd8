// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/command_line/language_option.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

#include "io/language/language.hpp"
#include "io/language/language_name.hpp"
#include "io/terminal/did_you_mean.hpp"

namespace pose_wall::tools {
namespace {

bool has_option(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]).substr(0, kLanguageOption.size()) == kLanguageOption) return true;
  }
  return false;
}

std::string language_fault(const std::string& word) {
  return language_named(word) ? "" : say("'{}' is refused; zh (Chinese) or en (English) is allowed", word);
}

}  // namespace

void choose_language_by(int argc, const char* const* argv, const char* program) {
  choose_language(language_of(argc, argv));
  choose_did_you_mean([](const std::string& nearest) { return say("; did you mean '{}'?", nearest); });
  const std::string unknown = unknown_language_in_environment();
  if (unknown.empty() || has_option(argc, argv)) return;
  // Whoever set it may read Chinese alone.
  fmt::print(stderr, "{}: POSE_WALL_LANGUAGE={}: zh (Chinese, 中文) or en (English) is allowed\n", program, unknown);
}

void add_language_option(CLI::App& app) {
  app.add_option_function<std::string>(
         std::string(kLanguageOption), [](const std::string&) {},
         tr("Language of what a person reads: en or zh; default: POSE_WALL_LANGUAGE, else the locale's"))
      ->check(CLI::Validator(language_fault, "{en,zh}", ""));
}

}  // namespace pose_wall::tools
