// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/pcd_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include "io/frames/text_cursor.hpp"
#include "io/frames/wide_times.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// Far above any real header, so that a binary file without a header is refused quickly.
constexpr std::size_t kPcdHeaderBytesMax = 64 * 1024;
// A point of more bytes than this is a lying COUNT.
constexpr std::uint64_t kPointStepMax = 1024 * 1024;

using Words = std::vector<std::string_view>;

struct RawHeader {
  std::map<std::string, Words, std::less<>> entries;  // by names in capitals
  std::size_t data_offset = 0;
  std::size_t lines = 0;
  std::optional<std::int64_t> stamp_ns;
};

Words split_words(std::string_view line) {
  Words words;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) words.push_back(word);
  return words;
}

// Some write the words of a header small.
std::string in_capitals(std::string_view word) {
  std::string capitals(word);
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return capitals;
}

RawHeader read_entries(const Bytes& bytes) {
  RawHeader raw;
  TextCursor cursor(as_text(bytes).substr(0, kPcdHeaderBytesMax));
  while (const std::optional<std::string_view> line = cursor.next_line()) {
    Words words = split_words(*line);
    if (words.size() == 3 && words[0] == "#" && words[1] == "stamp_ns") {
      raw.stamp_ns = parse_number<std::int64_t>(words[2]);
    }
    if (words.empty() || words.front().front() == '#') continue;
    std::string name = in_capitals(words.front());
    if (name == "COLUMNS") name = "FIELDS";
    words.erase(words.begin());
    if (!raw.entries.emplace(name, words).second) {
      throw FrameError(say("PCD header line {}: {} appears twice", cursor.line(), name));
    }
    if (name == "DATA") {
      raw.data_offset = cursor.offset();
      raw.lines = cursor.line();
      return raw;
    }
  }
  if (bytes.empty()) throw FrameError(tr("no PCD header: the file is empty"));
  throw FrameError(
      say("no PCD header: no DATA line within the first {} bytes", std::min(kPcdHeaderBytesMax, bytes.size())));
}

std::uint64_t whole_number(std::string_view entry, std::string_view word, std::uint64_t minimum,
                           std::uint64_t maximum) {
  const std::optional<std::uint64_t> number = parse_number<std::uint64_t>(word);
  if (!number || *number < minimum || *number > maximum) {
    throw FrameError(
        say("PCD header: {} is '{}'; a whole number from {} to {} is allowed", entry, word, minimum, maximum));
  }
  return *number;
}

const Words& required_entry(const RawHeader& raw, std::string_view name) {
  const auto entry = raw.entries.find(name);
  if (entry == raw.entries.end()) throw FrameError(say("PCD header: {} is missing", name));
  return entry->second;
}

const Words& entry_per_field(const RawHeader& raw, std::string_view name, std::size_t fields) {
  const Words& words = required_entry(raw, name);
  if (words.size() != fields) {
    throw FrameError(say("PCD header: {} has {} values for {} FIELDS", name, words.size(), fields));
  }
  return words;
}

void check_version(const RawHeader& raw) {
  const auto entry = raw.entries.find("VERSION");
  if (entry == raw.entries.end() || entry->second.empty()) return;
  for (const std::string_view known : {"0.7", ".7", "0.6", ".6", "0.5", ".5"}) {
    if (entry->second.front() == known) return;
  }
  throw FrameError(say("PCD version '{}'; 0.5, 0.6 and 0.7 are read", entry->second.front()));
}

void check_type(const PcdField& field, std::string_view type) {
  const bool is_float = type == "F" && (field.size == 4 || field.size == 8);
  const bool is_integer =
      (type == "I" || type == "U") && (field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8);
  const bool is_bool = type == "B" && field.size == 1;  // PCL's, since its version 1.12
  if (is_float || is_integer || is_bool) return;
  throw FrameError(
      say("PCD header: field '{}' has TYPE '{}' SIZE {}; F of 4 or 8, I and U of 1, 2, 4 or 8 bytes, B of 1 byte "
          "are allowed",
          field.name, type, field.size));
}

std::vector<PcdField> parse_fields(const RawHeader& raw) {
  const Words& names = required_entry(raw, "FIELDS");
  const Words& sizes = entry_per_field(raw, "SIZE", names.size());
  const Words& types = entry_per_field(raw, "TYPE", names.size());
  const bool counted = raw.entries.count("COUNT") != 0;
  std::vector<PcdField> fields;
  std::uint64_t offset = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    PcdField field;
    field.name = names[i];
    field.size = static_cast<std::uint32_t>(whole_number("SIZE", sizes[i], 1, 8));
    const std::string type = in_capitals(types[i]);
    check_type(field, type);
    field.type = type.front();
    if (counted) {
      const Words& counts = entry_per_field(raw, "COUNT", names.size());
      field.count = static_cast<std::uint32_t>(whole_number("COUNT", counts[i], 1, kPointStepMax));
    }
    field.offset = static_cast<std::uint32_t>(offset);
    offset += std::uint64_t{field.size} * field.count;
    if (offset > kPointStepMax) {
      throw FrameError(say("PCD header: a point of more than {} bytes", kPointStepMax));
    }
    fields.push_back(field);
  }
  if (fields.empty()) throw FrameError(tr("PCD header: FIELDS names no field"));
  return fields;
}

std::uint64_t single_number(const RawHeader& raw, std::string_view name) {
  const Words& words = required_entry(raw, name);
  return whole_number(name, words.empty() ? std::string_view{} : words.front(), 0,
                      std::numeric_limits<std::uint32_t>::max());
}

// WIDTH and HEIGHT are often wrong (0 x 0 in recorded files), so they count only where POINTS is absent.
std::uint64_t declared_points(const RawHeader& raw) {
  if (raw.entries.count("POINTS") != 0) return single_number(raw, "POINTS");
  return single_number(raw, "WIDTH") * (raw.entries.count("HEIGHT") != 0 ? single_number(raw, "HEIGHT") : 1);
}

PcdEncoding parse_encoding(const RawHeader& raw) {
  const Words& words = required_entry(raw, "DATA");
  const std::string_view word = words.empty() ? std::string_view{} : words.front();
  const std::string capitals = in_capitals(word);
  if (capitals == "ASCII") return PcdEncoding::kAscii;
  if (capitals == "BINARY") return PcdEncoding::kBinary;
  if (capitals == "BINARY_COMPRESSED") return PcdEncoding::kBinaryCompressed;
  throw FrameError(say("PCD header: DATA is '{}'; ascii, binary and binary_compressed are allowed", word));
}

}  // namespace

PcdHeader parse_pcd_header(const Bytes& bytes) {
  const RawHeader raw = read_entries(bytes);
  check_version(raw);
  PcdHeader header;
  header.fields = parse_fields(raw);
  header.point_step = header.fields.back().offset + header.fields.back().size * header.fields.back().count;
  header.points = declared_points(raw);
  header.encoding = parse_encoding(raw);
  header.data_offset = raw.data_offset;
  header.lines = raw.lines;
  header.stamp_ns = raw.stamp_ns;
  return header;
}

std::uint64_t points_or_held(const PcdHeader& header, std::uint64_t available) {
  if (header.points == 0 && available % header.point_step == 0) return available / header.point_step;
  return header.points;
}

std::uint32_t field_type_of(const PcdField& field) {
  if (field.count != 1) return POSE_WALL_FIELD_NONE;
  struct Known {
    char type;
    std::uint32_t size, field_type;
  };
  static constexpr Known kKnown[] = {{'F', 4, POSE_WALL_FIELD_FLOAT32},
                                     {'F', 8, POSE_WALL_FIELD_FLOAT64},
                                     {'I', 1, POSE_WALL_FIELD_INT8},
                                     {'I', 2, POSE_WALL_FIELD_INT16},
                                     {'I', 4, POSE_WALL_FIELD_INT32},
                                     {'I', 8, kFieldInt64},
                                     {'U', 1, POSE_WALL_FIELD_UINT8},
                                     {'U', 2, POSE_WALL_FIELD_UINT16},
                                     {'U', 4, POSE_WALL_FIELD_UINT32},
                                     {'U', 8, kFieldUint64},
                                     {'B', 1, kFieldBool}};
  const Known* const found = std::find_if(std::begin(kKnown), std::end(kKnown), [&field](const Known& known) {
    return known.type == field.type && known.size == field.size;
  });
  return found != std::end(kKnown) ? found->field_type : static_cast<std::uint32_t>(POSE_WALL_FIELD_NONE);
}

}  // namespace pose_wall::tools
