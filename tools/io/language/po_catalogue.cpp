// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/language/po_catalogue.hpp"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

namespace pose_wall::tools {
namespace {

[[noreturn]] void refuse(std::size_t line, const char* why) {
  throw std::invalid_argument(fmt::format("line {} of the catalogue: {}", line, why));
}

// What stands between the quotes, with its escapes resolved.
std::string unquoted(const std::string& text, std::size_t line) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') refuse(line, "a text in double quotes is expected");
  std::string out;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != '\\') {
      out += text[i];
      continue;
    }
    ++i;
    const char escaped = text[i];
    if (escaped != 'n' && escaped != 't' && escaped != '"' && escaped != '\\') {
      refuse(line, "only \\n, \\t, \\\" and \\\\ are allowed");
    }
    out += escaped == 'n' ? '\n' : escaped == 't' ? '\t' : escaped;
  }
  return out;
}

bool begins_with(const std::string& text, const char* word) {
  return text.rfind(word, 0) == 0;
}

}  // namespace

std::vector<Translation> read_po(std::string_view text) {
  std::vector<Translation> all;
  std::istringstream lines{std::string(text)};
  std::string* filling = nullptr;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#') {
      filling = nullptr;
    } else if (begins_with(line, "msgid ")) {
      all.emplace_back();
      filling = &all.back().english;
      *filling = unquoted(line.substr(6), number);
    } else if (begins_with(line, "msgstr ")) {
      if (all.empty()) refuse(number, "a msgstr without a msgid");
      filling = &all.back().translated;
      *filling = unquoted(line.substr(7), number);
    } else if (line[0] == '"' && filling != nullptr) {
      *filling += unquoted(line, number);
    } else {
      refuse(number, "msgid, msgstr, a text in double quotes or a comment is expected");
    }
  }
  std::vector<Translation> translated;
  for (Translation& entry : all) {
    if (!entry.english.empty() && !entry.translated.empty()) translated.push_back(std::move(entry));
  }
  return translated;
}

}  // namespace pose_wall::tools
