// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "io/frames/text_cursor.hpp"
#include "io/frames/wide_times.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::size_t kHeaderBytesMax = 64 * 1024;

std::uint32_t parse_type(std::string_view word) {
  using Name = std::pair<std::string_view, std::uint32_t>;
  static constexpr std::array<Name, 18> kTypes = {{{"char", POSE_WALL_FIELD_INT8},
                                                   {"int8", POSE_WALL_FIELD_INT8},
                                                   {"uchar", POSE_WALL_FIELD_UINT8},
                                                   {"uint8", POSE_WALL_FIELD_UINT8},
                                                   {"short", POSE_WALL_FIELD_INT16},
                                                   {"int16", POSE_WALL_FIELD_INT16},
                                                   {"ushort", POSE_WALL_FIELD_UINT16},
                                                   {"uint16", POSE_WALL_FIELD_UINT16},
                                                   {"int", POSE_WALL_FIELD_INT32},
                                                   {"int32", POSE_WALL_FIELD_INT32},
                                                   {"uint", POSE_WALL_FIELD_UINT32},
                                                   {"uint32", POSE_WALL_FIELD_UINT32},
                                                   {"int64", kFieldInt64},
                                                   {"uint64", kFieldUint64},
                                                   {"float", POSE_WALL_FIELD_FLOAT32},
                                                   {"float32", POSE_WALL_FIELD_FLOAT32},
                                                   {"double", POSE_WALL_FIELD_FLOAT64},
                                                   {"float64", POSE_WALL_FIELD_FLOAT64}}};
  const auto known =
      std::find_if(kTypes.begin(), kTypes.end(), [word](const Name& name) { return name.first == word; });
  if (known == kTypes.end()) throw FrameError(say("'{}' is no PLY type", word));
  return known->second;
}

PlyEncoding parse_format(std::string_view rest) {
  const std::string_view word = take_word(rest);
  const std::string_view version = take_word(rest);
  if (version != "1.0") throw FrameError(say("PLY version '{}'; 1.0 is read", version));
  if (word == "ascii") return PlyEncoding::kAscii;
  if (word == "binary_little_endian") return PlyEncoding::kBinaryLittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::kBinaryBigEndian;
  throw FrameError(say("format '{}'; ascii, binary_little_endian and binary_big_endian are allowed", word));
}

PlyElement parse_element(std::string_view rest) {
  PlyElement element;
  element.name = take_word(rest);
  const std::string_view count = take_word(rest);
  const std::optional<std::uint64_t> number = parse_number<std::uint64_t>(count);
  if (!number) throw FrameError(say("element {} has the count '{}', a whole number is expected", element.name, count));
  element.count = *number;
  return element;
}

PlyProperty parse_property(std::string_view rest) {
  PlyProperty property;
  std::string_view type = take_word(rest);
  if (type == "list") {
    property.length_type = parse_type(take_word(rest));
    if (property.length_type >= POSE_WALL_FIELD_FLOAT32) throw FrameError(tr("a list's length must be a whole number"));
    type = take_word(rest);
  }
  property.type = parse_type(type);
  property.name = take_word(rest);
  return property;
}

// True at end_header.
bool parse_line(std::string_view line, PlyHeader& header, bool& has_format) {
  const std::string_view keyword = take_word(line);
  if (keyword == "end_header") return true;
  if (keyword == "format") {
    header.encoding = parse_format(line);
    has_format = true;
  } else if (keyword == "element") {
    header.elements.push_back(parse_element(line));
  } else if (keyword == "property") {
    if (header.elements.empty()) throw FrameError(tr("property before the first element"));
    header.elements.back().properties.push_back(parse_property(line));
  } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
    throw FrameError(say("unknown keyword '{}'", keyword));
  }
  return false;
}

}  // namespace

PlyHeader parse_ply_header(const Bytes& bytes) {
  if (bytes.empty()) throw FrameError(tr("no PLY header: the file is empty"));
  TextCursor cursor(as_text(bytes).substr(0, kHeaderBytesMax));
  if (cursor.next_line() != std::string_view("ply")) throw FrameError(tr("no PLY header: the first line is not 'ply'"));
  PlyHeader header;
  bool has_format = false;
  while (const std::optional<std::string_view> line = cursor.next_line()) {
    try {
      if (!parse_line(*line, header, has_format)) continue;
    } catch (const FrameError& error) {
      throw FrameError(say("PLY header line {}: {}", cursor.line(), error.what()));
    }
    if (!has_format) throw FrameError(tr("PLY header: format is missing"));
    header.data_offset = cursor.offset();
    header.lines = cursor.line();
    return header;
  }
  throw FrameError(say("PLY header: no end_header within the first {} bytes", std::min(kHeaderBytesMax, bytes.size())));
}

}  // namespace pose_wall::tools
