// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/command_line/help_format.hpp"

#include <memory>
#include <string>
#include <vector>

#include "io/language/language.hpp"
#include "io/terminal/text_table.hpp"

namespace pose_wall::tools {
namespace {

// CLI11's name of the group of every verb and of every option that has no other.
constexpr const char* kVerbGroup = "Subcommands";
constexpr const char* kMarked[] = {translatable("Usage"),       translatable("OPTIONS"),  translatable("SUBCOMMAND"),
                                   translatable("Positionals"), translatable("REQUIRED"), translatable("Needs"),
                                   translatable("Excludes"),    translatable("Options"),  translatable("Subcommands")};

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() {
    for (const char* word : kMarked) label(word, tr(word));
  }

  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> opts) const override {
    return CLI::Formatter::make_group(get_label(group), is_positional, opts);
  }

  // CLI11 counts bytes, and a Chinese sign has three of them in two columns.
  std::string make_option(const CLI::Option* opt, bool is_positional) const override {
    const std::string name = "  " + make_option_name(opt, is_positional) + make_option_opts(opt);
    const std::string description = make_option_desc(opt), margin(get_column_width(), ' ');
    const std::size_t width = shown_width(name);
    std::string out = name;
    if (width >= margin.size()) {
      out += "\n" + margin;
    } else {
      out += std::string(margin.size() - width, ' ');
    }
    for (const char c : description) {
      out += c;
      if (c == '\n') out += margin;
    }
    return out + "\n";
  }
};

}  // namespace

void use_help_format(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormat>());
  app.set_help_flag("-h,--help", tr("Print this help message and exit"));
}

void name_verb_group(CLI::App& app) {
  for (CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_group() == kVerbGroup) verb->group(tr(kVerbGroup));
  }
}

}  // namespace pose_wall::tools
