// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points as plain text (.xyz .txt .csv .asc): a line each, values separated by spaces, tabs, commas or semicolons.
//
// Columns are x y z [intensity] [time or ring], or what a first line names (also behind # or //, as CloudCompare writes
// it). Without names the fifth column is what its values show.
// Lines that begin with #, // or % are comments. A first line with one whole number announces how many points follow.

#pragma once

#include <optional>
#include <string_view>

#include "io/frames/bare_points.hpp"
#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// Reads the points. `columns` names the columns where no line of the file does; nullptr: as above, and as `of_others`
// where the values of a fifth column do not show what it is. Throws FrameError that names the line and what is allowed.
Frame read_text_points(const Bytes& bytes, const BareLayout* columns = nullptr, const BareLayout* of_others = nullptr);

// Of five columns without names, where the fifth shows what it is: xyzit or xyzir. Throws FrameError.
std::optional<BareLayout> text_layout_shown(const Bytes& bytes);

// Whether the first line that is no comment holds numbers, or names x, y and z.
bool begins_like_points(std::string_view beginning);

}  // namespace pose_wall::tools
