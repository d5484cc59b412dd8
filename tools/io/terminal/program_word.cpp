// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/terminal/program_word.hpp"

#include "io/terminal/shell_word.hpp"

namespace pose_wall::tools {
namespace {

std::string& word() {
  static std::string set = "pose_wall";
  return set;
}

}  // namespace

void set_program_word(const std::string& typed) {
  if (!typed.empty()) word() = shell_word(typed);
}

const std::string& program_word() {
  return word();
}

}  // namespace pose_wall::tools
