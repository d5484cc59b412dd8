// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/command_line/completion.hpp"
#include "io/terminal/shell_word.hpp"

namespace pose_wall::tools {
namespace {

// Bash takes words apart at "=" (COMP_WORDBREAKS), unless a user has told it not to: both are understood.
constexpr const char* kFunction = R"bash(
_pose_wall() {
  local word=${COMP_WORDS[COMP_CWORD]} verb=${COMP_WORDS[1]} at=$COMP_CWORD key='' before='' option words
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "$_pose_wall_verbs $(_pose_wall_options '')" -- "$word"))
    return
  fi
  [[ $word == = ]] && word='' at=$((at + 1))
  option=${COMP_WORDS[at - 1]}
  if [[ $option == = ]]; then
    option=${COMP_WORDS[at - 2]}
    if [[ $option != -* ]]; then
      key=$option option=${COMP_WORDS[at - 3]}
      [[ $option == = ]] && option=${COMP_WORDS[at - 4]}
    fi
  elif [[ $word == --*=* ]]; then
    option=${word%%=*} before=${word%%=*}= word=${word#*=}
  fi
  if [[ $option == -* && $word == *=* ]]; then
    key=${word%%=*} before+=$key= word=${word#*=}
  fi
  if words=$(_pose_wall_values "$verb" "$option"); then
    [[ -n $key ]] && words=$(_pose_wall_key_values "$key")
    if _pose_wall_is_list "$verb" "$option" && [[ $word == *,* ]]; then
      before+=${word%,*}, word=${word##*,}
    fi
    COMPREPLY=($(compgen -P "$before" -W "$words" -- "$word"))
    if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace 2> /dev/null || :; fi
  elif [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$(_pose_wall_options "$verb")" -- "$word"))
  elif words=$(_pose_wall_values "$verb" ''); then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
  fi
  return 0
}
complete -o bashdefault -o default -F _pose_wall pose_wall
)bash";

std::string options_case(const VerbGrammar& verb) {
  std::string names;
  for (const OptionGrammar& option : verb.options) {
    if (!option.is_positional) names += fmt::format("{}{}", names.empty() ? "" : " ", fmt::join(option.names, " "));
  }
  return fmt::format("    {}) echo {} ;;\n", shell_quoted(verb.name), shell_quoted(names));
}

// "'run --set' | 'run -s'"; a positional has no name before it.
std::string pattern_of(const VerbGrammar& verb, const OptionGrammar& option) {
  if (option.is_positional) return shell_quoted(verb.name + " ");
  std::string pattern;
  for (const std::string& name : option.names) {
    pattern += (pattern.empty() ? "" : " | ") + shell_quoted(verb.name + " " + name);
  }
  return pattern;
}

std::string words_of(const OptionGrammar& option) {
  if (option.kind == ValueKind::kEngineKey) return "\"$_pose_wall_engine_keys\"";
  if (option.kind == ValueKind::kSimulatorKey) return "\"$_pose_wall_simulator_keys\"";
  if (option.kind == ValueKind::kScene) return "\"$_pose_wall_scenes\"";
  return shell_quoted(fmt::format("{}", fmt::join(value_words(option), " ")));
}

std::string values_cases(const VerbGrammar& verb) {
  std::string cases;
  for (const OptionGrammar& option : verb.options) {
    if (option.kind == ValueKind::kNone || (option.is_positional && option.choices.empty())) continue;
    cases += fmt::format("    {}) echo {} ;;\n", pattern_of(verb, option), words_of(option));
  }
  return cases;
}

std::string list_cases(const VerbGrammar& verb) {
  std::string cases;
  for (const OptionGrammar& option : verb.options) {
    if (option.is_list) cases += fmt::format("    {}) return 0 ;;\n", pattern_of(verb, option));
  }
  return cases;
}

std::string word_list(const char* variable, ValueKind kind) {
  OptionGrammar option;
  option.kind = kind;
  return fmt::format("{}={}\n", variable, shell_quoted(fmt::format("{}", fmt::join(value_words(option), " "))));
}

std::string key_values_cases() {
  std::string cases;
  for (const KeyChoices& key : keys_with_choices()) {
    cases += fmt::format("    {}) echo {} ;;\n", shell_quoted(key.key),
                         shell_quoted(fmt::format("{}", fmt::join(key.words, " "))));
  }
  return cases;
}

}  // namespace

std::string bash_completion(const CommandGrammar& grammar) {
  std::string verbs, options = options_case(grammar.command), values, lists;
  for (const VerbGrammar& verb : grammar.verbs) {
    verbs += (verbs.empty() ? "" : " ") + verb.name;
    options += options_case(verb);
    values += values_cases(verb);
    lists += list_cases(verb);
  }
  return "# bash completion for pose_wall; made by `pose_wall completion bash`\n" +
         fmt::format("_pose_wall_verbs={}\n", shell_quoted(verbs)) +
         word_list("_pose_wall_engine_keys", ValueKind::kEngineKey) +
         word_list("_pose_wall_simulator_keys", ValueKind::kSimulatorKey) +
         word_list("_pose_wall_scenes", ValueKind::kScene) + "\n_pose_wall_options() { # verb\n  case $1 in\n" +
         options + "  esac\n}\n" +
         "\n# Words that may follow the option, none where files may; fails where it takes no value.\n" +
         "_pose_wall_values() { # verb, option\n  case \"$1 $2\" in\n" + values + "    *) return 1 ;;\n  esac\n}\n" +
         "\n_pose_wall_is_list() { # verb, option\n  case \"$1 $2\" in\n" + lists + "  esac\n  return 1\n}\n" +
         "\n_pose_wall_key_values() { # key\n  case $1 in\n" + key_values_cases() + "  esac\n}\n" + kFunction;
}

}  // namespace pose_wall::tools
