// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/yaml_entries.hpp"

#include <fmt/format.h>
#include <yaml.h>

#include <cstring>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// libyaml's words for what people get wrong.
[[maybe_unused]] constexpr const char* kProblems[] = {
    translatable("could not find expected ':'"),
    translatable("found a tab character that violates indentation"),
    translatable("found a tab character where an indentation space is expected"),
    translatable("mapping values are not allowed in this context"),
    translatable("block sequence entries are not allowed in this context"),
    translatable("did not find expected key"),
    translatable("did not find expected ',' or ']'"),
    translatable("did not find expected '-' indicator"),
    translatable("did not find expected node content"),
    translatable("did not find expected <document start>"),
    translatable("did not find expected alphabetic or numeric character"),
    translatable("found character that cannot start any token"),
    translatable("found unexpected end of stream"),
    translatable("found unknown escape character"),
    translatable("found undefined alias"),
    translatable("invalid leading UTF-8 octet"),
    translatable("invalid trailing UTF-8 octet"),
    translatable("incomplete UTF-8 octet sequence"),
    translatable("control characters are not allowed"),
    translatable("cannot be read"),
};

// One that the table lacks stays English, in brackets.
std::string problem_words(const std::string& problem) {
  const std::string words = tr(problem.c_str());
  return words == problem && language() != Language::kEnglish ? say("the form is wrong ({})", problem) : words;
}

// Owns libyaml's parser and the event it gave last.
class EventStream {
 public:
  explicit EventStream(const std::string& text) {
    yaml_parser_initialize(&parser_);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
    std::memset(&event_, 0, sizeof event_);
  }
  EventStream(const EventStream&) = delete;
  EventStream& operator=(const EventStream&) = delete;
  ~EventStream() {
    yaml_event_delete(&event_);
    yaml_parser_delete(&parser_);
  }

  yaml_event_type_t next() {
    yaml_event_delete(&event_);
    if (yaml_parser_parse(&parser_, &event_) == 0) {
      const char* problem = parser_.problem != nullptr ? parser_.problem : "cannot be read";
      throw YamlError(parser_.problem_mark.line + 1, say("not YAML: {}", problem_words(problem)));
    }
    return event_.type;
  }

  std::size_t line() const { return event_.start_mark.line + 1; }

  std::string scalar() const {
    const auto& scalar = event_.data.scalar;
    std::string text(reinterpret_cast<const char*>(scalar.value), scalar.length);
    if (text.find('\0') != std::string::npos) {
      throw YamlError(line(), tr("a zero byte is not allowed in a value"));
    }
    return text;
  }

 private:
  yaml_parser_t parser_;
  yaml_event_t event_;
};

std::string read_sequence(EventStream& events, const std::string& key) {
  std::string joined;
  for (yaml_event_type_t type = events.next(); type != YAML_SEQUENCE_END_EVENT; type = events.next()) {
    if (type != YAML_SCALAR_EVENT) {
      throw YamlError(events.line(), say("{}: a list of numbers is allowed here, nothing nested", key));
    }
    joined += (joined.empty() ? "" : " ") + events.scalar();
  }
  return joined;
}

YamlEntry read_entry(EventStream& events) {
  YamlEntry entry;
  entry.key = events.scalar();
  entry.line = events.line();
  switch (events.next()) {
    case YAML_SCALAR_EVENT:
      entry.value = events.scalar();
      break;
    case YAML_SEQUENCE_START_EVENT:
      entry.is_sequence = true;
      entry.value = read_sequence(events, entry.key);
      break;
    case YAML_ALIAS_EVENT:
      throw YamlError(events.line(), say("{}: aliases (*name) are not supported", entry.key));
    default:
      throw YamlError(events.line(), say("{}: one value is expected; keys are not nested", entry.key));
  }
  return entry;
}

}  // namespace

std::vector<YamlEntry> parse_yaml_entries(const std::string& text) {
  EventStream events(text);
  std::vector<YamlEntry> entries;
  events.next();                                               // start of the stream
  if (events.next() == YAML_STREAM_END_EVENT) return entries;  // no document at all
  const yaml_event_type_t root = events.next();
  if (root != YAML_MAPPING_START_EVENT) {
    throw YamlError(events.line(), tr("lines of the form 'key: value' are expected"));
  }
  for (yaml_event_type_t type = events.next(); type != YAML_MAPPING_END_EVENT; type = events.next()) {
    if (type != YAML_SCALAR_EVENT) {
      throw YamlError(events.line(), tr("a key is expected here"));
    }
    entries.push_back(read_entry(events));
  }
  events.next();  // end of the document
  if (events.next() != YAML_STREAM_END_EVENT) {
    throw YamlError(events.line(), tr("a second document; one is allowed"));
  }
  return entries;
}

}  // namespace pose_wall::tools
