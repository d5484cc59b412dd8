// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Catalogues of translations as GNU gettext writes them (PO files): pairs of msgid and msgstr. Plural forms and
// contexts are not read: a catalogue that has them is refused.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/language/language.hpp"

namespace pose_wall::tools {

// In the order of the file, without its header and without entries that have no translation yet. Throws
// std::invalid_argument that names the line.
std::vector<Translation> read_po(std::string_view text);

// Those that the build puts into the program.
std::string_view chinese_catalogues();

}  // namespace pose_wall::tools
