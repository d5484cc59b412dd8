// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a part tells of itself, in the language of who reads it. Parts speak English (health.hpp); the log and the page
// tell it in Chinese by tools/io/language/zh/live_health.po.

#pragma once

#include <string>

#include "apps/live/health.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools::live {

// "sink modbus 127.0.0.1:502": the kind is translated, what follows is a name.
std::string part_words(Language language, const std::string& part);

// "good", "warning", "fault", "old", as people call them.
std::string grade_words(Language language, Grade grade);

// Part, summary, and names and values of facts.
PartHealth in_language(Language language, const PartHealth& health);

}  // namespace pose_wall::tools::live
