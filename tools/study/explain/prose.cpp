// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/explain/prose.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>

#include "io/language/language.hpp"

namespace pose_wall::tools::explain {

std::string paragraph(const std::vector<std::string>& sentences) {
  const char* const gap = language() == Language::kChinese ? "" : " ";
  std::string text;
  for (const std::string& sentence : sentences) {
    if (sentence.empty()) continue;
    if (!text.empty()) text += gap;
    text += sentence;
  }
  return text;
}

std::string listed(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, tr(", ")));
}

std::string in_a_row(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, language() == Language::kChinese ? "，" : ", "));
}

std::string clauses(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, tr("; ")));
}

std::vector<std::string> clauses_of(const std::string& text) {
  const char* const divider = tr("; ");
  std::vector<std::string> parts;
  for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + std::strlen(divider)) {
    end = text.find(divider, at);
    parts.push_back(text.substr(at, end == std::string::npos ? end : end - at));
  }
  return parts;
}

std::string frames_text(std::size_t count) {
  return count == 1 ? say("{} frame", count) : say("{} frames", count);
}

std::string points_text(std::size_t count) {
  return count == 1 ? say("{} point", count) : say("{} points", count);
}

}  // namespace pose_wall::tools::explain
