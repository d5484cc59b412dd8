// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The order in which people number files: 9.pcd before 10.pcd.

#pragma once

#include <string_view>

namespace pose_wall::tools {

// Digits side by side are compared as one number, everything else byte by byte. Names that are alike so far (7 and 07)
// are compared as bytes, so that the order is total.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace pose_wall::tools
