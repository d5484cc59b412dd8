// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall completion, pose_wall man: what shells and manuals should know of the command, told by the command.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "apps/command_line/completion.hpp"
#include "apps/command_line/grammar.hpp"
#include "apps/command_line/man_page.hpp"
#include "apps/options/one_of.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/language/language.hpp"
#include "pose_wall.h"

namespace pose_wall::tools {
namespace {

std::string completion(const CLI::App& app, const std::string& shell) {
  const CommandGrammar grammar = grammar_of(app);
  if (shell == "zsh") return zsh_completion(grammar);
  return shell == "fish" ? fish_completion(grammar) : bash_completion(grammar);
}

int print(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  return written ? kExitDone : kExitUnreadable;
}

}  // namespace

void add_completion(CLI::App& app, int& exit_code) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("completion", tr("Print a script that completes words in a shell"));
  verb->add_option("SHELL", *shell, tr("bash, zsh or fish"))->required()->check(one_of({"bash", "zsh", "fish"}));
  verb->footer(
      tr("Examples:\n"
         "  source <(pose_wall completion bash)\n"
         "  pose_wall completion zsh > ~/.zfunc/_pose_wall\n"
         "  pose_wall completion fish > ~/.config/fish/completions/pose_wall.fish\n"
         "Packages install the scripts where the shells find them."));
  verb->callback([shell, &app, &exit_code] { exit_code = print(completion(app, *shell)); });
}

void add_man(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("man", "Print the manual page, for man and groff");
  verb->group("");
  verb->footer("Example:\n  pose_wall man | man -l -");
  verb->callback(
      [&app, &exit_code] { exit_code = print(man_page(grammar_of(app), app.get_description(), pose_wall_version())); });
}

}  // namespace pose_wall::tools
