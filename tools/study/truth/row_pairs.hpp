// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which row of a table of results and which of a table of truth are of the same frame.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/csv/csv_table.hpp"

namespace pose_wall::tools {

// What a table's rows are told apart by, as it is written; nothing where the table has no such column.
struct RowKeys {
  using Column = std::optional<std::vector<std::string>>;
  Column frame;
  Column stamp_ns;
};

// By the table's columns `frame` and `stamp_ns`, and by `status` of run or `along_state` of motion.
RowKeys row_keys(const CsvTable& table);

// The stamp of a frame that could not be read is a guess. Where another row has the same one, such a row gives it up.
void yield_stamps(const std::vector<bool>& is_unreadable, RowKeys* keys);

struct RowPairs {
  std::string by;                                         // "stamp_ns" or "frame"
  std::vector<std::pair<std::size_t, std::size_t>> rows;  // of results and of truth, in the order of the results
  std::size_t other_stamps = 0;                           // pairs by frame whose stamps differ
};

// By stamps where both tables have them, no two rows of a table the same one, and some are in both: a number counts the
// inputs of one run, which may have been a part of the frames. By the numbers else, for a frame without a stamp of its
// own has one by --rate. Throws CsvError where neither is possible, or a number appears twice.
RowPairs pair_rows(const RowKeys& results, const RowKeys& truth);

}  // namespace pose_wall::tools
