// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/outside_key.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "io/language/language.hpp"

namespace pose_wall::tools {
std::vector<std::string> choices_of(const OutsideKey& key) {
  std::vector<std::string> words;
  std::istringstream choices(key.choices);
  for (std::string word; std::getline(choices >> std::ws, word, ',');) words.push_back(word);
  return words;
}

std::string allowed_text(const OutsideKey& key) {
  const std::string unit = key.unit == std::string("1") || *key.unit == '\0' ? "" : std::string(" ") + key.unit;
  switch (key.type) {
    case OutsideKey::Type::kText:
      return tr("text");
    case OutsideKey::Type::kChoice:
      return say("one of {}", key.choices);
    case OutsideKey::Type::kNumber:
      return say("a number from {:.9g} to {:.9g}{}", key.minimum, key.maximum, unit);
    case OutsideKey::Type::kInteger:
      return say("a whole number from {:.9g} to {:.9g}{}", key.minimum, key.maximum, unit);
    case OutsideKey::Type::kSwitch:
      return tr("0 or 1");
    case OutsideKey::Type::kHostPort:
      return tr("HOST:PORT, as 127.0.0.1:8080, or nothing");
    case OutsideKey::Type::kIpv4:
      return tr("an IPv4 address, as 192.168.1.100");
    case OutsideKey::Type::kIpv4OrNone:
      return tr("an IPv4 address, as 192.168.1.201, or nothing");
  }
  return "";
}

std::optional<double> number_of(const OutsideKey& key, const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!(number >= key.minimum && number <= key.maximum)) return std::nullopt;
  if (key.type == OutsideKey::Type::kInteger && number != std::floor(number)) return std::nullopt;
  return number;
}

}  // namespace pose_wall::tools
