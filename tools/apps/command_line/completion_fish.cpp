// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/command_line/completion.hpp"
#include "io/terminal/shell_word.hpp"

namespace pose_wall::tools {
namespace {

// -r: a value must follow, a file or one of the words; -x: one of the words only.
std::string value_of(const OptionGrammar& option) {
  if (option.kind == ValueKind::kNone) return "";
  const std::vector<std::string> words = value_words(option);
  if (words.empty()) return option.kind == ValueKind::kFile ? " -r -F" : " -x";
  return fmt::format(" -x -a {}", shell_quoted(fmt::format("{}", fmt::join(words, " "))));
}

std::string option_line(const std::string& condition, const OptionGrammar& option) {
  std::string line = fmt::format("complete -c pose_wall -n {}", shell_quoted(condition));
  if (option.is_positional) {
    if (option.choices.empty()) return "";
    return line + fmt::format(" -f -a {}\n", shell_quoted(fmt::format("{}", fmt::join(option.choices, " "))));
  }
  for (const std::string& name : option.names) {
    line += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return line + value_of(option) + " -d " + shell_quoted(option.help) + "\n";
}

}  // namespace

std::string fish_completion(const CommandGrammar& grammar) {
  std::string script = "# fish completion for pose_wall; made by `pose_wall completion fish`\n";
  for (const OptionGrammar& option : grammar.command.options) script += option_line("__fish_use_subcommand", option);
  for (const VerbGrammar& verb : grammar.verbs) {
    script += fmt::format("complete -c pose_wall -f -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                          shell_quoted(verb.help));
    for (const OptionGrammar& option : verb.options) {
      script += option_line("__fish_seen_subcommand_from " + verb.name, option);
    }
  }
  return script;
}

}  // namespace pose_wall::tools
