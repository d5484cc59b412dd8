// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Cuts text into lines and words, for headers and ascii points.

#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

inline std::string_view as_text(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Walks over text; knows the byte and the line it stands at.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text, std::size_t offset = 0, std::size_t line = 0)
      : text_(text), offset_(offset), line_(line) {}

  // The next line without its end (LF or CRLF); nothing at the end of the text.
  std::optional<std::string_view> next_line() {
    if (offset_ >= text_.size()) return std::nullopt;
    const std::size_t end = std::min(text_.find('\n', offset_), text_.size());
    std::string_view line = text_.substr(offset_, end - offset_);
    offset_ = std::min(end + 1, text_.size());
    ++line_;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  std::size_t offset() const { return offset_; }
  std::size_t line() const { return line_; }  // of the line given last, from 1

 private:
  std::string_view text_;
  std::size_t offset_;
  std::size_t line_;
};

constexpr std::string_view kBlankSigns = " \t";
constexpr std::string_view kTextSeparators = " \t,;";  // of plain text points

// Takes the first word off `line`; empty when none is left.
inline std::string_view take_word(std::string_view& line, std::string_view separators = kBlankSigns) {
  const std::size_t start = std::min(line.find_first_not_of(separators), line.size());
  const std::size_t end = std::min(line.find_first_of(separators, start), line.size());
  const std::string_view word = line.substr(start, end - start);
  line.remove_prefix(end);
  return word;
}

// The whole word as a number, whatever the locale; "nan" and "inf" are numbers for floating types.
template <typename Number>
std::optional<Number> parse_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  // A float too small or too large for its type is data, not a fault of the file's form: it is no measurement.
  if (std::is_floating_point_v<Number> && error == std::errc::result_out_of_range) return Number{0};
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace pose_wall::tools
