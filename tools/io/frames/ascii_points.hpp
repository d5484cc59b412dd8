// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points written as text, one per line, decoded into bytes the engine reads: shared by ascii PCD, ascii PLY and plain
// text.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame.hpp"
#include "io/frames/text_cursor.hpp"

namespace pose_wall::tools {

// One column, or several when count > 1. A column without a name is counted and passed over.
struct AsciiColumn {
  std::string name;
  std::uint32_t count = 1;
  bool is_double = false;  // stored as float64; float32 otherwise
};

enum class AsciiStyle {
  kBlanks,  // words between spaces and tabs
  kText     // also between commas and semicolons; lines that begin with #, // or % are comments
};

// Reads `points` lines from the cursor, or all when the count is not declared; blank lines do not count. Columns that
// the engine does not know are passed over. Throws FrameError naming the line, or both counts when lines are missing.
Frame parse_ascii_points(TextCursor& cursor, const std::vector<AsciiColumn>& columns,
                         std::optional<std::uint64_t> points, AsciiStyle style = AsciiStyle::kBlanks);

}  // namespace pose_wall::tools
