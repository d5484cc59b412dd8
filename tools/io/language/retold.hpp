// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Texts that are ready in English, told in another language. Parts of the daemon tell how they fare in English, for
// machines read that, too; a log and a page tell it again in the language of their reader.

#pragma once

#include <string>

#include "io/language/language.hpp"

namespace pose_wall::tools {

// The catalogue's text; else that of the entry whose words fit best around what was filled in ("place: {}"); else what
// sentences behind "; " have of their own. What no entry fits stays English.
std::string retold(Language language, const std::string& english);

}  // namespace pose_wall::tools
