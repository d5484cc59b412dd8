// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/command_line/man_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <sstream>

#include "io/config_file/key_table.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools {
namespace {

// The code point that begins at `at`, which moves behind it; the text is our own, hence UTF-8.
std::uint32_t code_point(const std::string& text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at++]);
  if (first < 0x80) return first;
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  std::uint32_t point = first & (0x3FU >> more);
  for (int i = 0; i < more && at < text.size(); ++i)
    point = point << 6 | (static_cast<unsigned char>(text[at++]) & 0x3FU);
  return point;
}

std::string bold(const std::string& text) {
  return "\\fB" + roff_text(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + roff_text(text) + "\\fR";
}

// So many letters of "a|b|c" stand beside an option's name; more fill no line of a page.
constexpr std::size_t kBesideMost = 60;

std::string option_entry(const OptionGrammar& option) {
  std::string names;
  for (const std::string& name : option.names) {
    names += (names.empty() ? "" : ", ") + (option.is_positional ? italic(name) : bold(name));
  }
  const bool is_long = option.value.size() > kBesideMost && !option.choices.empty();
  if (option.kind != ValueKind::kNone && !option.is_positional) names += " " + italic(is_long ? "NAME" : option.value);
  if (option.is_positional && option.is_repeatable) names += "...";
  std::string help = roff_text(option.help) + ".";
  if (option.is_positional && !option.choices.empty()) help = "One of " + roff_text(option.value) + ".";
  if (is_long) help += roff_text(fmt::format(" One of {}.", fmt::join(option.choices, ", ")));
  if (!option.default_text.empty()) help += roff_text(fmt::format(" Default: {}.", option.default_text));
  return ".TP\n" + names + "\n" + help + "\n";
}

std::string synopsis_of(const VerbGrammar& verb) {
  std::string line = ".B pose_wall " + roff_text(verb.name) + "\n.RI [ option ...]";
  for (const OptionGrammar& option : verb.options) {
    if (!option.is_positional) continue;
    const std::string name = roff_text(option.names.front()) + (option.is_repeatable ? " ..." : "");
    line += option.is_required ? "\n.I " + name : "\n.RI [ \"" + name + "\" ]";
  }
  return line + "\n.br\n";
}

// Lines that begin with blanks are to be typed as they stand, the others are sentences.
std::string footer_text(const std::string& footer) {
  std::string text;
  std::istringstream lines(footer);
  bool is_example = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_typed = line.rfind("  ", 0) == 0;
    if (is_typed != is_example) text += is_typed ? ".PP\n.nf\n.RS\n" : ".RE\n.fi\n.PP\n";
    if (text.empty()) text = ".PP\n";
    is_example = is_typed;
    text += roff_text(is_typed ? line.substr(2) : line) + "\n";
  }
  return is_example ? text + ".RE\n.fi\n" : text;
}

std::string verb_section(const VerbGrammar& verb) {
  std::string text = ".SS " + roff_text(verb.name) + "\n" + roff_text(verb.help) + ".\n";
  for (const OptionGrammar& option : verb.options) {
    if (option.names.back() != "--help") text += option_entry(option);
  }
  return text + footer_text(verb.footer);
}

std::string keys_section() {
  const api::Config defaults;
  std::string text, group;
  for (const pose_wall_key_info& key : config_keys()) {
    if (group != key.group) text += ".SS " + roff_text(group = key.group) + "\n";
    text += ".TP\n" + bold(key.name) + "\n" +
            roff_text(fmt::format("Default {}; allowed: {}. {}", config_written_text(*defaults.get(), key),
                                  allowed_text(key), key.help)) +
            "\n";
  }
  return text;
}

constexpr const char* kEnd =
    ".SH EXIT STATUS\n"
    "0: done. 1: an input could not be read (the others are processed), or a result not written. 2: bad usage or\n"
    "config, found before any work is done. 3: what was asked about is not so (\\fBcampaign \\-\\-gate\\fR,\n"
    "\\fBreplay\\-box\\fR, \\fBdoctor\\fR). 130: interrupted by Ctrl\\-C; what is written is whole rows and whole\n"
    "files.\n"
    ".SH ENVIRONMENT\n.TP\n\\fBNO_COLOR\\fR\n"
    "Any text forbids colours. They are shown on a terminal only, and not on one whose \\fBTERM\\fR is dumb.\n"
    ".SH SEE ALSO\n"
    "tools/README.md in the sources (a guided tour), \\fBpose_wall check\\-config \\-\\-keys\\fR.\n";

}  // namespace

std::string roff_text(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins_line = out.empty() || out.back() == '\n';
    const std::uint32_t point = code_point(text, at);
    if (begins_line && (point == '.' || point == '\'')) out += "\\&";
    if (point == '\\') {
      out += "\\e";
    } else if (point == '-') {
      out += "\\-";
    } else if (point == '\'' || point == '`' || point == '^' || point == '~') {
      out += point == '\'' ? "\\(aq" : point == '`' ? "\\(ga" : point == '^' ? "\\(ha" : "\\(ti";
    } else if (point >= 0x80) {
      out += fmt::format("\\[u{:04X}]", point);
    } else {
      out += static_cast<char>(point);
    }
  }
  return out;
}

std::string man_page(const CommandGrammar& grammar, const std::string& description, const std::string& version) {
  std::string page = ".\\\" Made by `pose_wall man`.\n" +
                     fmt::format(".TH POSE_WALL 1 \"\" \"pose_wall {}\" \"User Commands\"\n", roff_text(version)) +
                     ".SH NAME\npose_wall \\- pose of a tunnelling machine in its roadway, from one 3D LiDAR\n"
                     ".SH SYNOPSIS\n.nh\n";
  for (const VerbGrammar& verb : grammar.verbs) page += synopsis_of(verb);
  page +=
      ".hy\n.SH DESCRIPTION\n" + roff_text(description) + "\n" + footer_text(grammar.command.footer) + ".SH VERBS\n";
  for (const VerbGrammar& verb : grammar.verbs) page += verb_section(verb);
  return page + ".SH CONFIGURATION KEYS\nIn a file for \\fB\\-\\-config\\fR, and for \\fB\\-\\-set\\fR.\n" +
         keys_section() + kEnd;
}

}  // namespace pose_wall::tools
