// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "apps/command_line/parse_fault.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cstdlib>
#include <vector>

#include "io/language/language.hpp"
#include "io/terminal/did_you_mean.hpp"

namespace pose_wall::tools {
namespace {

// The command, then the verb that was given.
std::vector<const CLI::App*> parsed_parts(const CLI::App& app) {
  std::vector<const CLI::App*> parts = {&app};
  for (const CLI::App* verb : app.get_subcommands()) parts.push_back(verb);
  return parts;
}

std::vector<std::string> long_names(const CLI::App& part) {
  std::vector<std::string> names;
  for (const CLI::Option* option : part.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string left_over_text(const CLI::App& part, const std::string& word) {
  char* end = nullptr;
  std::strtod(word.c_str(), &end);
  if (!word.empty() && *end == '\0') return say("unexpected number {}", word);
  const std::string name = word.substr(0, word.find('='));
  const bool is_option = word.size() > 1 && word[0] == '-';
  return is_option ? say("unknown option {}{}", name, did_you_mean(name, long_names(part)))
                   : say("unexpected word '{}'", word);
}

// Words that the parser could not use; empty where there are none.
std::string left_over_text(const CLI::App& app) {
  std::vector<std::string> faults;
  for (const CLI::App* part : parsed_parts(app)) {
    for (const std::string& word : part->remaining()) faults.push_back(left_over_text(*part, word));
  }
  return fmt::format("{}", fmt::join(faults, "; "));
}

// Of the command and of its verb.
std::vector<const CLI::Option*> parsed_options(const CLI::App& app) {
  std::vector<const CLI::Option*> options;
  for (const CLI::App* part : parsed_parts(app)) {
    const std::vector<const CLI::Option*> own = part->get_options();
    options.insert(options.end(), own.begin(), own.end());
  }
  return options;
}

std::string missing_text(const CLI::App& app) {
  for (const CLI::Option* option : parsed_options(app)) {
    if (option->get_required() && option->count() == 0) return say("{} is missing", option->get_name());
  }
  return app.get_subcommands().empty() ? tr("a verb is missing") : "";
}

std::string needs_text(const CLI::App& app) {
  for (const CLI::Option* option : parsed_options(app)) {
    for (const CLI::Option* needed : option->get_needs()) {
      if (option->count() > 0 && needed->count() == 0) {
        return say("{} also needs {}", option->get_name(), needed->get_name());
      }
    }
  }
  return "";
}

std::string excludes_text(const CLI::App& app) {
  for (const CLI::Option* option : parsed_options(app)) {
    for (const CLI::Option* other : option->get_excludes()) {
      if (option->count() > 0 && other->count() > 0) {
        return say("{} and {} exclude each other", option->get_name(), other->get_name());
      }
    }
  }
  return "";
}

// Where the message has the name as a whole word; npos: nowhere.
std::size_t place_of(const std::string& name, const std::string& message) {
  const auto is_of_a_word = [&message](std::size_t at) {
    return at < message.size() && (std::isalnum(static_cast<unsigned char>(message[at])) != 0 || message[at] == '-');
  };
  for (std::size_t at = message.find(name); at != std::string::npos; at = message.find(name, at + 1)) {
    if (!is_of_a_word(at + name.size()) && (at == 0 || !is_of_a_word(at - 1))) return at;
  }
  return std::string::npos;
}

// The first option that the message names.
const CLI::Option* option_at_fault(const CLI::App& app, const std::string& message) {
  const CLI::Option* first = nullptr;
  std::size_t first_place = std::string::npos;
  for (const CLI::Option* option : parsed_options(app)) {
    const std::size_t place = place_of(option->get_name(), message);
    if (place < first_place) {
      first = option;
      first_place = place;
    }
  }
  return first;
}

bool takes_no_value(const CLI::Option& option) {
  return option.get_items_expected_max() == 0;
}

std::string mismatch_text(const CLI::App& app, const std::string& message) {
  const CLI::Option* option = option_at_fault(app, message);
  if (option == nullptr) return "";
  if (takes_no_value(*option)) return say("{} takes no value", option->get_name());
  const bool is_repeated = option->results().size() > 1;
  return is_repeated ? say("{} is given {} times; once is allowed", option->get_name(), option->results().size())
                     : say("{}: a value is missing behind it", option->get_name());
}

std::string conversion_text(const CLI::App& app, const std::string& message) {
  const CLI::Option* option = option_at_fault(app, message);
  if (option == nullptr) return "";
  if (takes_no_value(*option)) return say("{} takes no value", option->get_name());
  return say("{}: '{}' is refused; a number is allowed", option->get_name(),
             fmt::format("{}", fmt::join(option->results(), " ")));
}

// Empty for a kind that no option of ours has.
std::string text_by_kind(const CLI::App& app, const CLI::ParseError& error) {
  switch (static_cast<CLI::ExitCodes>(error.get_exit_code())) {
    case CLI::ExitCodes::RequiredError:
      return missing_text(app);
    case CLI::ExitCodes::RequiresError:
      return needs_text(app);
    case CLI::ExitCodes::ExcludesError:
      return excludes_text(app);
    case CLI::ExitCodes::ArgumentMismatch:
      return mismatch_text(app, error.what());
    case CLI::ExitCodes::ConversionError:
      return conversion_text(app, error.what());
    default:
      // ValidationError: the option's name, and the words of our own validators.
      return "";
  }
}

}  // namespace

std::string parse_fault_text(const CLI::App& app, const CLI::ParseError& error) {
  // A mistyped option is often why another one is missing.
  std::string text = left_over_text(app);
  if (text.empty()) text = text_by_kind(app, error);
  return text.empty() ? error.what() : text;
}

}  // namespace pose_wall::tools
