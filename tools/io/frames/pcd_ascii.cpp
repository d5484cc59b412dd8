// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/pcd_ascii.hpp"

#include <optional>
#include <vector>

#include "io/frames/ascii_points.hpp"
#include "io/frames/text_cursor.hpp"

namespace pose_wall::tools {

Frame parse_pcd_ascii(const Bytes& bytes, const PcdHeader& header) {
  std::vector<AsciiColumn> columns;
  for (const PcdField& field : header.fields) {
    // Whole numbers of four bytes (a time in microseconds) do not fit a float32.
    const bool is_double = field.size == 8 || (field.size == 4 && field.type != 'F');
    columns.push_back({field.name, field.count, is_double});
  }
  TextCursor cursor(as_text(bytes), header.data_offset, header.lines);
  return parse_ascii_points(cursor, columns,
                            header.points != 0 ? std::optional<std::uint64_t>(header.points) : std::nullopt);
}

}  // namespace pose_wall::tools
