// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Texts in a language that is named instead of the process's own: people of both may look at one daemon.

#pragma once

#include <fmt/format.h>

#include <string>

#include "io/language/language.hpp"

namespace pose_wall::tools {

// The English one where the catalogue lacks it. The pointer stays valid.
const char* tr(Language language, const char* english);

// Filled in; english is marked by translatable().
template <typename... Args>
std::string say_in(Language language, const char* english, const Args&... args) {
  return fmt::vformat(tr(language, english), fmt::make_format_args(args...));
}

}  // namespace pose_wall::tools
