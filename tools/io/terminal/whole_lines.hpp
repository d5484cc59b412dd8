// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Standard output in whole lines.

#pragma once

namespace pose_wall::tools {

// A terminal or file that takes standard output and standard error then never shows a line of one inside a line of the
// other, and both in the order in which they were written. Call it before anything is written.
void write_whole_lines();

}  // namespace pose_wall::tools
