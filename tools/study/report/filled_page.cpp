// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/report/filled_page.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/picture/svg.hpp"

namespace pose_wall::tools::report {
namespace {

// Each name stands once in the HTML.
void put_in(std::string* text, std::string_view name, std::string_view content) {
  const std::size_t at = text->find(name);
  if (at == std::string::npos) throw std::logic_error("the page has no place for " + std::string(name));
  text->replace(at, name.size(), content);
}

// A "</script>" in a file's name must not end the data.
std::string script_safe(std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

}  // namespace

std::string filled_page(const Assets& parts, std::string data, const std::string& title) {
  std::string text(parts.html);
  put_in(&text, "/*@style@*/", parts.style);
  put_in(&text, "/*@script@*/", parts.script);
  // From the end on: what a name was replaced by is not looked at for names again.
  put_in(&text, "@data@", script_safe(std::move(data)));
  if (!parts.library.empty()) put_in(&text, "/*@library@*/", parts.library);
  put_in(&text, "@title@", picture::escaped(title));
  return text;
}

}  // namespace pose_wall::tools::report
