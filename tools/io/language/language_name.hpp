// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Words that name a language: on the command line, in the environment, in a locale.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/language/language.hpp"

namespace pose_wall::tools {

inline constexpr std::string_view kLanguageOption = "--language";

// Of "zh", "zh_CN", "zh-CN.UTF-8", "cn", "en", "en_US.UTF-8", in small or capital letters; nothing for other words.
std::optional<Language> language_named(std::string_view word);

// The value of POSE_WALL_LANGUAGE where it names no language; else empty.
std::string unknown_language_in_environment();

}  // namespace pose_wall::tools
