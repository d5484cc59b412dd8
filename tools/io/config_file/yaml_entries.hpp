// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The entries of a pose_wall.yaml as text, with their lines: what YAML means by a number is not asked here, since the
// engine reads "+X" and "+2.0" itself.

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace pose_wall::tools {

struct YamlEntry {
  std::string key;
  std::string value;  // items of a sequence are joined by spaces
  bool is_sequence = false;
  std::size_t line = 0;  // of the key, from 1
};

// The message names neither line nor file.
class YamlError : public std::runtime_error {
 public:
  YamlError(std::size_t line, const std::string& what) : std::runtime_error(what), line_(line) {}

  std::size_t line() const { return line_; }  // from 1

 private:
  std::size_t line_;
};

// One document, a mapping of names to scalars or flat sequences; an empty file has no entries. Throws YamlError.
std::vector<YamlEntry> parse_yaml_entries(const std::string& text);

}  // namespace pose_wall::tools
