// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/parameters.hpp"

#include <charconv>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "io/terminal/did_you_mean.hpp"
#include "lab/sim/parameter_rows.hpp"

namespace pose_wall::tools::sim {
namespace {

// Its parts one behind the other, numbers in six digits.
template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

std::vector<std::string> words_of(std::string_view choices) {
  std::vector<std::string> words;
  while (!choices.empty()) {
    const std::size_t bar = choices.find('|');
    words.emplace_back(choices.substr(0, bar));
    choices.remove_prefix(bar == std::string_view::npos ? choices.size() : bar + 1);
  }
  return words;
}

double parse_word(const Parameter& p, std::string_view value) {
  const std::vector<std::string> words = words_of(p.words);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == value) return static_cast<double>(i);
  }
  throw std::invalid_argument(text(p.name, ": '", value, "' is not one of ", p.words, did_you_mean(value, words)));
}

std::optional<double> number_of(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

double parse_number(const Parameter& p, std::string_view value) {
  const std::optional<double> number = number_of(value);
  if (!number) throw std::invalid_argument(text(p.name, ": '", value, "' is not a number"));
  if (!(*number >= p.minimum && *number <= p.maximum)) {
    throw std::invalid_argument(text(p.name, ": ", value, " is outside ", p.minimum, " to ", p.maximum, " ", p.unit));
  }
  return *number;
}

std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (const Parameter& p : parameters()) names.emplace_back(p.name);
  return names;
}

}  // namespace

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> all = road_parameters();
    for (const auto& rows : {machine_parameters(), sensor_parameters()})
      all.insert(all.end(), rows.begin(), rows.end());
    return all;
  }();
  return table;
}

const Parameter* find_parameter(std::string_view name) {
  for (const Parameter& p : parameters()) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

void set_parameter(Setup& setup, std::string_view name, std::string_view value) {
  const Parameter* const p = find_parameter(name);
  if (p == nullptr) {
    throw std::invalid_argument(text("unknown key '", name, "'", did_you_mean(name, parameter_names()),
                                     "; `pose_wall sim --list` shows them all"));
  }
  p->field(setup) = *p->words != '\0' ? parse_word(*p, value) : parse_number(*p, value);
}

void set_parameter(Setup& setup, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) throw std::invalid_argument(text("'", assignment, "' is not KEY=VALUE"));
  set_parameter(setup, assignment.substr(0, equals), assignment.substr(equals + 1));
}

std::string parameter_text(const Parameter& parameter, double value) {
  if (*parameter.words == '\0') return text(value);
  return words_of(parameter.words).at(static_cast<std::size_t>(value));
}

}  // namespace pose_wall::tools::sim
