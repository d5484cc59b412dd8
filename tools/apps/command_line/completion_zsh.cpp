// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/command_line/completion.hpp"
#include "io/terminal/shell_word.hpp"

namespace pose_wall::tools {
namespace {

constexpr const char* kHelpers = R"zsh(
_pose_wall_assignment() { # keys...: one of them, and behind its "=" what it may be
  if compset -P 1 '(#b)([a-z0-9_]##)='; then
    local -a words
    words=(${=_pose_wall_key_values[$match[1]]})
    if (($#words)); then compadd -a words; else _message value; fi
  else
    compadd -S = -- ${(@)@%=}
  fi
}
)zsh";

std::string word_list(ValueKind kind) {
  OptionGrammar option;
  option.kind = kind;
  return fmt::format("{}", fmt::join(value_words(option), " "));
}

// Signs that mean something within a spec of _arguments.
std::string spec_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string action_of(const OptionGrammar& option) {
  switch (option.kind) {
    case ValueKind::kFile:
      return "_files";
    case ValueKind::kEngineKey:
      return "_pose_wall_assignment $=_pose_wall_engine_keys";
    case ValueKind::kSimulatorKey:
      return "_pose_wall_assignment $=_pose_wall_simulator_keys";
    case ValueKind::kGate:
      return fmt::format("_pose_wall_assignment {}", fmt::join(value_words(option), " "));
    case ValueKind::kGateName:
    case ValueKind::kChoice:
    case ValueKind::kScene:
    case ValueKind::kSensor: {
      const std::string words = fmt::format("{}", fmt::join(value_words(option), " "));
      return option.is_list ? fmt::format("_values -s , name {}", words) : fmt::format("({})", words);
    }
    default:
      return " ";
  }
}

std::string spec_of(const OptionGrammar& option) {
  const std::string value = option.value.empty() ? "value" : option.value;
  if (option.is_positional) {
    return shell_quoted(
        fmt::format("{}:{}:{}", option.is_repeatable ? "*" : "", spec_text(option.names.front()), action_of(option)));
  }
  std::string names;
  for (const std::string& name : option.names) {
    const bool is_long = name.rfind("--", 0) == 0;
    const char* const ending = option.kind == ValueKind::kNone ? "" : is_long ? "=" : "+";
    names += (names.empty() ? "" : ",") + name + ending;
  }
  const std::string others = option.is_repeatable ? "*" : fmt::format("({})", fmt::join(option.names, " "));
  std::string spec = fmt::format("[{}]", spec_text(option.help));
  if (option.kind != ValueKind::kNone) spec += fmt::format(":{}:{}", spec_text(value), action_of(option));
  const std::string braced = option.names.size() > 1 ? "{" + names + "}" : names;
  return shell_quoted(others) + braced + shell_quoted(spec);
}

std::string verb_case(const VerbGrammar& verb) {
  std::string specs;
  for (const OptionGrammar& option : verb.options) specs += " \\\n      " + spec_of(option);
  return fmt::format("    {}) _arguments -s -S{} ;;\n", verb.name, specs);
}

}  // namespace

std::string zsh_completion(const CommandGrammar& grammar) {
  std::string verbs, cases;
  for (const VerbGrammar& verb : grammar.verbs) {
    verbs += "    " + shell_quoted(spec_text(verb.name) + ":" + verb.help) + "\n";
    cases += verb_case(verb);
  }
  std::string keys;
  for (const KeyChoices& key : keys_with_choices()) {
    keys += fmt::format("  {} {}\n", key.key, shell_quoted(fmt::format("{}", fmt::join(key.words, " "))));
  }
  return "#compdef pose_wall\n# zsh completion for pose_wall; made by `pose_wall completion zsh`\n"
         "setopt localoptions extendedglob\n" +
         fmt::format("typeset -g _pose_wall_engine_keys={}\n", shell_quoted(word_list(ValueKind::kEngineKey))) +
         fmt::format("typeset -g _pose_wall_simulator_keys={}\n", shell_quoted(word_list(ValueKind::kSimulatorKey))) +
         "typeset -gA _pose_wall_key_values=(\n" + keys + ")\n" + kHelpers +
         "\n_pose_wall() {\n  setopt localoptions extendedglob\n  local -a verbs\n  verbs=(\n" + verbs +
         "  )\n  if ((CURRENT == 2)); then\n    _describe -t verbs verb verbs\n    return\n  fi\n"
         "  words=(\"${(@)words[2,-1]}\")\n  ((CURRENT--))\n  case $words[1] in\n" +
         cases + "  esac\n}\n\n_pose_wall \"$@\"\n";
}

}  // namespace pose_wall::tools
